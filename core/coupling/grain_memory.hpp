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
  Triple fluid_velocity{};  ///< [m/s] its own plus the slip, at the last refresh
  Triple stress_impulse{};  ///< [N] sum over the refreshes of V_p (-grad p + div tau)
  Triple given{};           ///< [N s] drag on one computed grain that the fluid was told to balance
  Triple place{};           ///< [m] at map()
  Triple velocity{};        ///< [m/s] at map()
  double coefficient = 0;   ///< [kg/s] the drag coefficient given to the fluid at map()
  Triple owed{};            ///< [N s] impulse the fluid has still to receive, weight included
  std::array<bool, 3> is_paired{};  ///< the component's force found open faces at map()
  bool has_velocity = false;
  double size_ratio = 1.0;  ///< diameter over the Sauter mean in its cell, at map()
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
  std::vector<Remembered> rows_;
  std::vector<Leaver> leavers_;
  std::size_t width_ = 0;
  std::vector<double> kept_;  ///< width_ per row
};

}  // namespace dust::coupling
