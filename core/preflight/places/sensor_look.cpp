// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/sensor_look.hpp"

#include "base/text.hpp"

#include <exception>
#include <variant>

namespace dust::preflight {
namespace {

/// Warns of means of blocks that hold too little of the run to have an error.
void check_blocks(const scenario::Setup& setup, const scenario::SensorSpec& spec,
                  const sdk::ParameterSchema& parameters, scenario::Diagnostics& diagnostics) {
  const double* block = nullptr;
  const double* begin = nullptr;
  for (std::size_t n = 0; n < parameters.size() && n < spec.model.values.size(); ++n) {
    if (parameters[n].name == "block") block = std::get_if<double>(&spec.model.values[n]);
    if (parameters[n].name == "averaging_after") begin = std::get_if<double>(&spec.model.values[n]);
  }
  if (block == nullptr || begin == nullptr) return;
  const double averaged = setup.time.end - *begin;
  // An error is the scatter of at least two of them.
  if (!(averaged > 0.0) || averaged >= 2.0 * *block) return;
  diagnostics.warning(spec.model.where,
                      spec.model.path + ".block: the " + base::duration_text(averaged) +
                          " that are averaged hold fewer than two blocks of " +
                          base::duration_text(*block) + ": its means have no error; make it " +
                          base::duration_text(0.1 * averaged));
}

}  // namespace

sdk::WorldView empty_world(const scenario::Setup& setup, std::span<const double> class_diameters) {
  sdk::WorldView world;
  world.interval = setup.time.fluid_step;
  world.domain_min = setup.domain.min;
  world.domain_max = setup.domain.max;
  world.gravity = setup.gravity;
  world.class_diameters = class_diameters;
  return world;
}

void check_first_look(const scenario::Setup& setup, const scenario::SensorSpec& spec,
                      const sdk::ParameterSchema& parameters, sdk::Sensor& sensor,
                      const sdk::WorldView& world, scenario::Diagnostics& diagnostics) {
  if (!setup.fluid && sensor.wants_fluid()) {
    diagnostics.warning(spec.model.where, spec.model.path +
                                              ": looks at the fluid, and fluid is none: it has "
                                              "nothing to tell; take it out, or declare a fluid");
  } else {
    check_blocks(setup, spec, parameters, diagnostics);
  }
  try {
    sensor.observe(world);
  } catch (const std::exception& problem) {
    diagnostics.error(spec.model.where, spec.model.path + ": " + problem.what());
  }
}

}  // namespace dust::preflight
