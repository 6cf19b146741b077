// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/flow.hpp"
#include "fluid/geometry/body_field.hpp"
#include "fluid/grid.hpp"

#include <array>
#include <vector>

namespace dust::run {

/// How fast the gas goes along walls, as friction velocities: from the speed relative to the wall
/// beside it, half a cell off a side and a cell off a body (airborne::friction_velocity).
class WallShear {
 public:
  /// `viscosity` [m2/s] kinematic.
  WallShear(const fluid::Grid& grid, double viscosity) : grid_(grid), viscosity_(viscosity) {}

  void clear() { probes_.clear(); }
  /// A piece of a side in the cell (i, j, k), `normal` into the gas.
  void add_side(const std::array<int, 3>& cell, int direction, double normal);
  /// A piece of a body, which is nearest to `centre` of its cell.
  void add_body(sdk::Vec3 centre, const fluid::BodyField::Hit& hit);
  /// [m/s] By piece, in the order in which they were added. `surfaces` as of Flow::surface_motions.
  void find(const fluid::FaceField& velocity, const std::vector<airborne::SurfaceMotion>& surfaces,
            std::vector<double>& friction_velocity) const;

 private:
  struct Probe {
    sdk::Vec3 point;  ///< [m] in the gas
    sdk::Vec3 normal;
    double distance;  ///< [m] of it from the wall
    bool is_body;     ///< else the halo knows the wall's velocity
  };
  /// [m/s] Linear between the faces.
  [[nodiscard]] sdk::Vec3 velocity_at(const fluid::FaceField& velocity, sdk::Vec3 point) const;

  fluid::Grid grid_;
  double viscosity_;
  std::vector<Probe> probes_;
};

}  // namespace dust::run
