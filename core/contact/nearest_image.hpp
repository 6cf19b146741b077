// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/periodic.hpp"
#include "contact/batch_kernels.hpp"
#include "dust/sdk/vec3.hpp"

namespace dust::contact {

/// The way from one point to the nearest image of another.
inline sdk::Vec3 nearest_image(const Images& images, const double* from, const double* to) {
  double d[3];
  for (int k = 0; k < 3; ++k) {
    d[k] = base::nearest_image(to[k] - from[k], images.length[k], images.half[k]);
  }
  return {d[0], d[1], d[2]};
}

}  // namespace dust::contact
