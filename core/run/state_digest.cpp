// SPDX-License-Identifier: Apache-2.0
#include "run/state_digest.hpp"

#include "io/run_files.hpp"

#include <span>

namespace dust::run {

std::string state_digest(const sdk::GrainColumns& c, const fluid::FluidSolver* fluid,
                         const fluid::Grid& grid) {
  io::Sha256 sha;
  const auto update = [&sha](const auto& span) { sha.update(span.data(), span.size_bytes()); };
  update(c.id);
  for (const auto& column : {c.x, c.y, c.z, c.velocity_x, c.velocity_y, c.velocity_z,
                             c.angular_velocity_x, c.angular_velocity_y, c.angular_velocity_z}) {
    update(column);
  }
  for (int k = 0; fluid != nullptr && k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      const auto from = static_cast<std::size_t>(grid.index(0, j, k));
      const auto count = static_cast<std::size_t>(grid.count[0]);
      for (const auto& component : fluid->velocity().component) {
        update(std::span(component).subspan(from, count));
      }
      update(std::span(fluid->pressure()).subspan(from, count));
    }
  }
  return sha.hex_digest();
}

}  // namespace dust::run
