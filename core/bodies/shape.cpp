// SPDX-License-Identifier: Apache-2.0
#include "bodies/shape.hpp"

#include "bodies/shape_kinds.hpp"

namespace dust::bodies {

void Shape::find_within(sdk::Vec3 point, double reach, std::vector<std::int32_t>& parts) const {
  parts.clear();
  for (int part = 0; part < this->parts(); ++part) {
    if (is_within(part, point, reach)) parts.push_back(part);
  }
}

const std::vector<ShapeKind>& shape_catalogue() {
  static const std::vector<ShapeKind> catalogue = {
      conveyor_kind(), belt_conveyor_kind(), plate_kind(),   plane_kind(),
      box_kind(),      cylinder_kind(),      frustum_kind(), cone_kind(),
      disc_kind(),     container_kind(),     mesh_kind(),
  };
  return catalogue;
}

}  // namespace dust::bodies
