// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "particles/energy/energy_balance.hpp"
#include "particles/store/particle_store.hpp"

#include <cstddef>
#include <vector>

namespace dust::particles {

/// What the particles and contacts of a tile add [J].
struct EnergySums {
  // Of the last step alone.
  double translation = 0.0, rotation = 0.0, elastic_normal = 0.0, elastic_friction = 0.0;
  // Added up: work of contacts on their two sides by its part, of walls, gravity and fluid.
  double normal = 0.0, tangential = 0.0, rolling = 0.0, walls = 0.0, gravity = 0.0, fluid = 0.0;
};

/// The energy account of a run, kept only where it is asked for. Sums are made tile by tile, in the
/// order of tiles: the same on any number of threads.
class EnergyAccount {
 public:
  void begin() { is_on_ = true; }
  [[nodiscard]] bool is_on() const { return is_on_; }

  /// Before a step: what is of the last step alone begins anew.
  void begin_step();
  /// New tiles; what the old ones have added up is kept.
  void restart(std::size_t tiles);
  [[nodiscard]] EnergySums& tile(std::size_t index) { return tiles_[index]; }

  /// A particle has come, or goes between two steps; `gravity` [m/s2], four per material, `step`
  /// [s].
  void enter(const ParticleStore& particles, std::size_t row);
  void leave(const ParticleStore& particles, std::size_t row, const double* gravity, double step);

  [[nodiscard]] EnergyBalance balance() const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  [[nodiscard]] EnergySums sum() const;

  bool is_on_ = false;
  std::vector<EnergySums> tiles_;
  EnergySums before_;  ///< of tiles that are gone
  double entered_ = 0.0, left_ = 0.0;
};

}  // namespace dust::particles
