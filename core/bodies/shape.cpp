// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape.hpp"

#include "bodies/shape_kinds.hpp"

namespace dust::bodies {

const std::vector<ShapeKind>& shape_catalogue() {
  static const std::vector<ShapeKind> catalogue = {
      conveyor_kind(), belt_conveyor_kind(), plate_kind(),   plane_kind(),
      box_kind(),      cylinder_kind(),      frustum_kind(), cone_kind(),
      disc_kind(),     container_kind(),     mesh_kind(),
  };
  return catalogue;
}

}  // namespace dust::bodies
