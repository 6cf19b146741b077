// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/sensor_look.hpp"

#include <exception>

namespace dust::preflight {
sdk::WorldView empty_world(const scenario::Setup& setup, std::span<const double> class_diameters) {
  sdk::WorldView world;
  world.interval = setup.time.fluid_step;
  world.domain_min = setup.domain.min;
  world.domain_max = setup.domain.max;
  world.gravity = setup.gravity;
  world.class_diameters = class_diameters;
  return world;
}

void check_first_looks(const scenario::Setup& setup, std::span<const double> class_diameters,
                       const registry::Registry& registry, scenario::Diagnostics& diagnostics) {
  const sdk::WorldView world = empty_world(setup, class_diameters);
  for (const scenario::SensorSpec& spec : setup.sensors) {
    // One that is refused already need not be asked.
    if (diagnostics.has_error_below(spec.model.path)) continue;
    const auto sensor = registry.create_as<sdk::Sensor>(spec.model);
    if (!setup.fluid && sensor->wants_fluid()) {
      diagnostics.warning(spec.model.where, spec.model.path +
                                                ": looks at the fluid, and fluid is none: it has "
                                                "nothing to tell; take it out, or declare a fluid");
    }
    try {
      sensor->observe(world);
    } catch (const std::exception& problem) {
      diagnostics.error(spec.model.where, spec.model.path + ": " + problem.what());
    }
  }
}

}  // namespace dust::preflight
