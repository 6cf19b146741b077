// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/body_places.hpp"

#include "base/text.hpp"
#include "bodies/survey/surface_in_box.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {

void check_body_places(const scenario::Setup& setup, const ParticleModels& models,
                       scenario::Diagnostics& diagnostics) {
  const sdk::Vec3 middle = 0.5 * (setup.domain.min + setup.domain.max);
  const sdk::Vec3 half = 0.5 * (setup.domain.max - setup.domain.min);
  constexpr double k_finest = 4e-3;  // of half the domain's diagonal
  const double finest = k_finest * norm(half);
  for (std::size_t n = 0; n < models.bodies.size(); ++n) {
    const bodies::Body& body = models.bodies[n];
    const bool is_moved = std::any_of(body.motions.begin(), body.motions.end(),
                                      [](const auto& m) { return m->moves_body(); });
    if (is_moved) continue;
    const double distance = std::abs(body.nearest(middle).distance);
    if (bodies::may_meet_box(body, body.placement(0.0), middle, half, finest)) continue;
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
