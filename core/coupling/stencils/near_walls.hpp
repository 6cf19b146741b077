// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "particles/surfaces.hpp"

#include <optional>
#include <vector>

namespace dust::coupling {

/// The surfaces of bodies, for what a wall does to the flow round a grain beside it.
class NearWalls {
 public:
  struct Wall {
    double distance;   ///< [m] of the point
    sdk::Vec3 normal;  ///< from the surface to the point
  };

  /// Takes the parts of bodies; sides of the domain are left out, and bodies that go to other
  /// places.
  void use(std::vector<particles::Surface> surfaces);
  /// The surface nearest to `point` within `reach` [m]; a body that was removed is none.
  [[nodiscard]] std::optional<Wall> nearest(sdk::Vec3 point, double reach) const;

 private:
  std::vector<particles::Surface> surfaces_;
};

}  // namespace dust::coupling
