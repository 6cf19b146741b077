// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/nearest_image.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/neighbours/search.hpp"
#include "particles/pair_law_table.hpp"
#include "particles/store/particle_store.hpp"
#include "particles/store/tile.hpp"
#include "particles/surface_search.hpp"
#include "particles/surfaces.hpp"

#include <cmath>
#include <cstddef>
#include <cstdint>
#include <span>

namespace dust::particles {

/// What pair lists are made from: views of what others own.
struct ListScene {
  const ParticleStore& particles;
  const Tiling& tiling;
  const PairLawTable& laws;
  std::span<const Surface> surfaces;
  const contact::Images& images;
  std::span<const double> gravity;  ///< four per material, reduced by buoyancy
  sdk::Vec3 origin;                 ///< [m] of cells in which particles are sorted
  double step = 0.0;                ///< [s] the coarse one
  double largest_diameter = 0.0;    ///< [m]

  /// [s] of so many coarse steps.
  [[nodiscard]] double time_of(std::int64_t steps) const {
    return static_cast<double>(steps) * step;
  }
  [[nodiscard]] const double* position(std::size_t row) const { return particles.position(row); }
  [[nodiscard]] double radius(std::size_t row) const { return particles.radius(row); }
  [[nodiscard]] double speed2(std::size_t row) const {
    const double* v = particles.velocity(row);
    return v[0] * v[0] + v[1] * v[1] + v[2] * v[2];
  }
  /// Not one that has just come, perhaps into an overlap.
  [[nodiscard]] bool has_made_steps(std::int32_t row) const {
    return particles.time_since_kick(static_cast<std::size_t>(row)) == 0.5 * step;
  }
  [[nodiscard]] std::size_t blocks() const { return (particles.size() + k_block - 1) / k_block; }
  /// Whether a particle that goes on for a `duration` [s], and may be found within `reach` [m] of
  /// where its centre is then, may touch a surface in that time. The surfaces stand where the step
  /// before saw them.
  [[nodiscard]] bool may_meet(std::size_t row, const Surface& surface, double reach,
                              double duration) const {
    const double* p = position(row);
    return surface.may_touch({p[0], p[1], p[2]}, reach + way(row, duration), duration + step);
  }
  /// Numbers of all surfaces of which that is so, ascending.
  [[nodiscard]] std::span<const std::int32_t> find_surfaces(std::size_t row, double reach,
                                                            double duration,
                                                            SurfaceSearch& search) const {
    const double* p = position(row);
    return search.may_touch(surfaces, {p[0], p[1], p[2]}, reach + way(row, duration),
                            duration + step);
  }
  /// [m] Of a particle that goes on for a `duration` [s].
  [[nodiscard]] double way(std::size_t row, double duration) const {
    return duration * std::sqrt(speed2(row));
  }
  /// Side i of a pair is the fine particle where there is one, else the lower id, so that a history
  /// keeps its sign through all sorts.
  [[nodiscard]] RowPair in_order(std::int32_t i, std::int32_t j) const;

  /// [m/s] of all particles, and of surfaces that come nearer.
  [[nodiscard]] double fastest_speed() const;
  /// [m/s] root mean square over the particles; the same on any number of threads.
  [[nodiscard]] double typical_speed() const;
};

}  // namespace dust::particles
