// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/grain_memory.hpp"
#include "coupling/lattice.hpp"
#include "coupling/wide_kernel.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace dust::coupling {

/// Coefficient and source of each face from the grains around it. A grain with drag coefficient K,
/// velocity v and weight W adds, at face f of component d with trilinear weight w_f,
///   coefficient += W w_f K eps_f / (a eps_c^2 V)
///   source      += W w_f K eps_f v / (a eps_c^2 V) + w_f owed / (e V step)
/// a = sum(w open), e = sum(w open eps) over its eight faces, eps_c the void fraction of its cell,
/// V the cell volume. Grains larger than a cell act through all faces of the cells they are spread
/// over. Derivation and what this conserves: docs/theory/coupling.md.
class FaceExchange {
 public:
  /// `is_set_three`: the momentum equation is that of set III, whose fluid receives a density of
  /// force on the whole control volume, a_f V, in place of eps_f a_f V.
  FaceExchange(const Lattice& lattice, const sdk::VoidageRule& rule, bool is_set_three);

  /// Spreads all grains (places, velocities and coefficients as remembered at map()) and the debts,
  /// which are thereby paid. Returns the number of force components without an open face.
  std::int64_t spread(const particles::GrainRows& grains, GrainMemory& memory,
                      const fluid::CellField& eps, double step);
  /// Writes what each grain's drag has given to a fluid of this velocity (Remembered::given), and
  /// compares the sum over the grains with that over the faces: returns |difference| / scale.
  double settle(const particles::GrainRows& grains, GrainMemory& memory,
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
  std::int64_t spread_component(int d, const particles::GrainRows& grains, GrainMemory& memory,
                                const fluid::CellField& eps, double step);
  void clear(int d);

  const Lattice& lattice_;
  const sdk::VoidageRule& rule_;
  bool is_set_three_;
  fluid::Exchange exchange_;
  std::array<std::vector<Touched>, 3> touched_;
  Triple paid_{};  ///< [N s] debts in the source
};

}  // namespace dust::coupling
