// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "particles/grain_rows.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace dust::coupling {

using Triple = std::array<double, 3>;

/// What the coupling remembers of one grain.
struct Remembered {
  // What a refresh needs stands together.
  Triple fluid_velocity{};  ///< [m/s] its own plus the slip, at the last refresh
  Triple velocity{};        ///< [m/s] its own, at the last refresh
  Triple stress_impulse{};  ///< [N] sum over the refreshes of V_p (-grad p + div tau)
  double size_ratio = 1.0;  ///< diameter over the Sauter mean in its cell, at map()
  bool has_velocity = false;
  std::array<bool, 3> is_paired{};  ///< the component's force found open faces at map()
  std::int32_t spot = -1;  ///< its number in the order of the cells at map(), -1 = not there then
  Triple given{};          ///< [N s] drag that the fluid was told to balance, weight included
  Triple place{};          ///< [m] at collect()
  Triple owed{};           ///< [N s] impulse the fluid has still to receive, weight included
};

/// What a grain does to the fluid by itself, if that is to be taken off.
struct OwnFlow {
  Triple disturbance{};      ///< [m/s] of the fluid around it, by the force it has received
  double solids = 0.0;       ///< [-] in its cell, beyond what would be there without it
  Triple face_solids{};      ///< [-] the same at its faces
  double self_stress = 0.0;  ///< [-] force by the stress of its own drag, over that drag
  double mobility = 0.0;     ///< [s/kg] steady disturbance per force on the grain
  double growth = 0.0;       ///< [-] share of the way to the steady disturbance per fluid step
};

/// Impulse owed to the fluid [N s] for a grain that is gone, at the place where it was last [m].
struct Leaver {
  Triple place{};
  Triple owed{};
};

/// Remembers grains across calls by their id, however the rows are reordered in between.
class GrainMemory {
 public:
  /// Brings the memory into the order of `grains`; new grains start empty.
  void align(const particles::GrainRows& grains);

  /// Changes whenever the order of the rows has.
  [[nodiscard]] std::uint64_t order() const { return order_; }

  /// Keeps what each grain does to the fluid by itself; before the first align().
  void keep_own_flow() { has_own_flow_ = true; }
  OwnFlow& own_flow(std::size_t row) { return own_flow_[row]; }
  [[nodiscard]] const OwnFlow& own_flow(std::size_t row) const { return own_flow_[row]; }

  /// Keeps `width` further numbers per grain, zero for new grains; before the first align().
  void keep(std::size_t width) { width_ = width; }
  /// Those of a row.
  double* kept(std::size_t row) { return kept_.data() + width_ * row; }

  [[nodiscard]] std::size_t size() const { return rows_.size(); }
  Remembered& operator[](std::size_t row) { return rows_[row]; }
  const Remembered& operator[](std::size_t row) const { return rows_[row]; }
  [[nodiscard]] std::vector<Leaver>& leavers() { return leavers_; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  std::vector<std::int64_t> ids_;
  std::uint64_t order_ = 0;
  std::vector<Remembered> rows_;
  std::vector<OwnFlow> own_flow_;  ///< empty unless kept
  bool has_own_flow_ = false;
  std::vector<Leaver> leavers_;
  std::size_t width_ = 0;
  std::vector<double> kept_;  ///< width_ per row
};

}  // namespace dust::coupling
