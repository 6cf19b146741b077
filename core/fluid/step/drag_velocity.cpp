// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/drag_velocity.hpp"

#include "fluid/parallel.hpp"
#include "fluid/step/step_rows.hpp"

#include <algorithm>

namespace dust::fluid {

void DragVelocity::begin(bool has_drag) {
  if (has_drag || is_set_) {
    for (auto& component : sum_.component) std::fill(component.begin(), component.end(), 0.0);
  }
  is_set_ = has_drag;
}

void DragVelocity::add_stage(const Geometry& geometry, const FaceField& stage, double share) {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      const double* from = &stage.component[d][o];
      double* to = &sum_.component[d][o];
      for (int i = 0; i < n[0]; ++i) to[i] += share * from[i];
    });
  }
}

void DragVelocity::add_pressure(const Geometry& geometry, const Continuity& continuity,
                                const FaceProperties& properties, double step,
                                const FaceField& drag, double share) {
  const FaceField& k_field = continuity.coefficients();
  const CellField& phi = continuity.increment();
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      pressure_drag_row(n[0], grid_.stride[d], step, properties.inertia(d, o),
                        1.0 / grid_.spacing[d], share, &k_field.component[d][o],
                        &drag.component[d][o], &phi[o], &sum_.component[d][o]);
    });
  }
}

}  // namespace dust::fluid
