// SPDX-License-Identifier: Apache-2.0
#include "run/run_checks.hpp"

#include "base/finite.hpp"
#include "dust/sdk/error.hpp"

#include <string>

namespace dust::run {

void check_finite(const sdk::GrainColumns& c) {
  for (std::size_t n = 0; n < c.id.size(); ++n) {
    if (!base::is_finite({c.x[n], c.y[n], c.z[n]}) ||
        !base::is_finite({c.velocity_x[n], c.velocity_y[n], c.velocity_z[n]}) ||
        !base::is_finite(
            {c.angular_velocity_x[n], c.angular_velocity_y[n], c.angular_velocity_z[n]})) {
      throw sdk::ModelError("grain " + std::to_string(c.id[n]) +
                            " has a position or velocity that is not a number; likely causes: a "
                            "time step too long for the stiffness, or an overlap at entry");
    }
  }
}

}  // namespace dust::run
