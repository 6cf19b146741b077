// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/body_places.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {

void check_body_places(const scenario::Setup& setup, const ParticleModels& models,
                       scenario::Diagnostics& diagnostics) {
  const sdk::Vec3 middle = 0.5 * (setup.domain.min + setup.domain.max);
  const double reach = 0.5 * norm(setup.domain.max - setup.domain.min);
  for (std::size_t n = 0; n < models.bodies.size(); ++n) {
    const bodies::Body& body = models.bodies[n];
    const bool is_moved = std::any_of(body.motions.begin(), body.motions.end(),
                                      [](const auto& m) { return m->moves_body(); });
    if (is_moved) continue;
    const double distance = std::abs(body.nearest(middle).distance);
    if (!(distance > reach)) continue;
    const bool is_mesh = !body.shape->notes().empty();
    diagnostics.warning(setup.bodies[n].shape.where,
                        "bodies." + body.name +
                            ": none of its surface is in the domain, the "
                            "nearest of it " +
                            base::length_text(distance) +
                            " from the domain's middle: nothing "
                            "meets it; " +
                            (is_mesh ? "is the unit of its file right (unit: 1 mm)?"
                                     : "are its place and size right?"));
  }
}

}  // namespace dust::preflight
