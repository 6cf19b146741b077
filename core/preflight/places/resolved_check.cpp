// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/resolved_check.hpp"

#include "base/text.hpp"
#include "bodies/survey/thickness.hpp"

namespace dust::preflight {

void check_resolved_at_thin_bodies(const scenario::Setup& setup, const ParticleModels& models,
                                   scenario::Diagnostics& diagnostics) {
  if (!setup.fluid || setup.fluid->resolved.empty()) return;
  sdk::Vec3 cell = setup.domain.max - setup.domain.min;
  for (int d = 0; d < 3; ++d) cell[d] /= setup.fluid->cells[static_cast<std::size_t>(d)];
  for (const bodies::Body& body : models.bodies) {
    const auto thin = bodies::thinnest_place(body, setup.domain.min, setup.domain.max, cell);
    if (!thin) continue;
    diagnostics.warning(
        setup.fluid->resolved_where,
        "coupling.resolved: bodies." + body.name + " is " + base::length_text(thin->thickness, 2) +
            " thick at " + base::place_text(thin->place) + ", thinner than a cell (" +
            base::length_text(thin->cell, 3) +
            "): a resolved sphere that comes near it drives the fluid on its other side, too; make "
            "it thicker or the cells finer");
  }
}

}  // namespace dust::preflight
