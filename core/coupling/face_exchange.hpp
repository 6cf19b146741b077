// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/cell_order.hpp"
#include "coupling/face_void.hpp"
#include "coupling/grain_memory.hpp"
#include "coupling/lattice.hpp"
#include "coupling/smooth_kernel.hpp"
#include "coupling/wide_kernel.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::coupling {

class StressBook;

/// Where the grains of a call are, batch by batch in the order of the cells.
struct Spots {
  CellOrder order;
  std::vector<SpotBatch> batches;
  std::vector<double> eps;  ///< void fraction around each: of its cell, or the mean over its cells
  std::vector<char> is_smooth;     ///< of each: coupled through a SmoothKernel
  std::uint64_t memory_order = 0;  ///< GrainMemory::order() when they were ordered

  /// The rows of a batch.
  [[nodiscard]] std::span<const std::int32_t> rows(std::size_t batch) const {
    const std::size_t first = batch * SpotBatch::k_size;
    return order.rows().subspan(first, std::min(SpotBatch::k_size, order.rows().size() - first));
  }
};

/// Drag of a batch of grains as the fluid is given it, K [(1 + b) s - b s_0] for the slip s to come
/// and that of before, s_0: the tangent to a drag that grows as s^(1+b), so that the fluid is not
/// too late with it where drag is stiff (docs/theory/coupling.md, Time).
struct GivenDrag {
  const double* coefficient;  ///< [kg/s] K at s_0
  const double* steepness;    ///< [-] b = d ln K / d ln s, 0..1
};

/// Coefficient and source of each face from the grains around it. A grain with drag coefficient K,
/// velocity v and weight W adds, at face f of component d with trilinear weight w_f,
///   coefficient += W w_f K eps_f / (a eps_c^2 V)
///   source      += W w_f K eps_f v / (a eps_c^2 V) + w_f owed / (e V step)
/// and for the tangent of the drag K (1 + b) in place of K, and source += W w_f K b s_0 / (a eps_c
/// V). a = sum(w open), e = sum(w open eps) over its eight faces, eps_c the void fraction of its
/// cell, V the cell volume. Grains larger than a cell act through all faces of the cells they are
/// spread over, those whose own disturbance is taken off through the faces of a SmoothKernel.
/// Derivation and what this conserves: docs/theory/coupling.md.
class FaceExchange {
 public:
  /// `is_set_three`: the momentum equation is that of set III, whose fluid receives a density of
  /// force on the whole control volume, a_f V, in place of eps_f a_f V.
  FaceExchange(const Lattice& lattice, const FaceVoid& face_void, const sdk::VoidageRule& rule,
               bool is_set_three);

  /// Makes room for as many batches.
  void resize(std::size_t batches);
  /// What each grain of a batch gives, from the sums over its faces. Debts are paid thereby.
  void charge(const particles::GrainRows& grains, const Spots& spots, std::size_t batch,
              const GivenDrag& given, GrainMemory& memory, const fluid::CellField& eps,
              double step);
  /// Gives the faces what the batches are charged with, the debts of the grains that are gone, and
  /// part of those of cells (`owed(d)` [N s] per padded cell, null: there are none). Returns the
  /// number of force components without an open face.
  std::int64_t spread(const Spots& spots, GrainMemory& memory, const fluid::CellField& eps,
                      double step, StressBook* stress);
  /// Writes what each grain's drag has given to a fluid of this velocity (Remembered::given), and
  /// compares the sum over the grains with that over the faces: returns |difference| / scale.
  /// `spots` as charged; `rows` of these grains by now, -1 for those that are gone.
  double settle(const Spots& spots, std::span<const std::int32_t> rows, GrainMemory& memory,
                const fluid::CellField& eps, const fluid::FaceField& velocity, double step);

  [[nodiscard]] const fluid::Exchange& exchange() const { return exchange_; }
  /// Force on the fluid per cell volume [N/m3], as settled.
  void per_cell(std::vector<float>& values) const;

 private:
  struct Touched {
    std::ptrdiff_t face;
    double volume;  ///< [m3] of the face's control volume that the force's density acts on
    double force;   ///< [N] on the fluid, once settled
  };
  /// One grain's of the ChargeColumns; zero if it finds no open face.
  struct Charge {
    double drag = 0.0, push = 0.0, extra = 0.0;
  };
  /// Sums over a batch, added up in the order of the batches.
  struct BatchSums {
    std::int64_t unpaired = 0;
    bool has_wide = false;    ///< grains larger than a cell
    bool has_smooth = false;  ///< grains with a SmoothKernel
    Triple paid{};
    Triple given{};  ///< [N s] weight included
    Triple size{};   ///< [N s] sum of the magnitudes
  };
  void sum_wide(const SpotBatch& spots, int d, const fluid::CellField& eps,
                ChargeInput& input) const;
  void charge_smooth(const Spots& spots, std::size_t batch, const GrainMemory& memory,
                     std::array<ChargeInput, 3>& inputs,
                     std::array<ChargeColumns, 3>& charges) const;
  void give_smooth(int d, const SmoothKernel& kernel, const Charge& charge);
  [[nodiscard]] double drag_through(int d, const SmoothKernel& kernel, const std::vector<double>& u,
                                    double velocity, double lag) const;
  void give(int d, const Spots& spots, const fluid::CellField& eps);
  void give_runs(int d, const SpotBatch& spots, const ChargeColumns& charges);
  template <class Faces>
  void give_one(int d, const Faces& faces, const Charge& charge);
  std::int64_t pay_leavers(int d, GrainMemory& memory, double step);
  void pay_cells(int d, std::vector<double>& owed, double step);
  /// Adds to one face of this open share and void fraction what is weighted already.
  void add(int d, std::ptrdiff_t face, double open, double eps, const Charge& weighted);
  void clear(int d);

  const Lattice& lattice_;
  const FaceVoid& face_void_;
  const sdk::VoidageRule& rule_;
  bool is_set_three_;
  fluid::Exchange exchange_;
  std::array<std::vector<Touched>, 3> touched_;
  std::vector<std::array<ChargeColumns, 3>> charges_;  ///< of the batches
  std::vector<BatchSums> sums_;
  Triple paid_{};  ///< [N s] debts in the source
};

}  // namespace dust::coupling
