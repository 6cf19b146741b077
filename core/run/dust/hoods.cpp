// SPDX-License-Identifier: Apache-2.0
#include "run/dust/hoods.hpp"

#include "setup/draws_out.hpp"

namespace dust::run {

std::vector<particles::Opening> openings_of(const scenario::Setup& setup,
                                            const scenario::DustSetup& dust) {
  std::vector<particles::Opening> openings;
  if (!setup.fluid) return openings;
  for (const scenario::BodySpec& body : setup.bodies) {
    // One that only blows drives away what would touch it.
    if (!body.suction || !scenario::draws_out(*body.suction)) continue;
    openings.push_back({body.name, -1, body.suction->min, body.suction->max});
  }
  for (const scenario::SideOpeningSpec& opening : dust.openings) {
    openings.push_back({scenario::k_side_names[static_cast<std::size_t>(opening.side)],
                        opening.side, opening.min, opening.max});
  }
  return openings;
}

}  // namespace dust::run
