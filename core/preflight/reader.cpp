// SPDX-License-Identifier: Apache-2.0
#include "preflight/reader.hpp"

#include "preflight/air/driven_speed.hpp"
#include "preflight/air/flow_check.hpp"
#include "preflight/air/opening_check.hpp"
#include "preflight/air/wall_shear_check.hpp"
#include "preflight/derived.hpp"
#include "preflight/dust_check.hpp"
#include "preflight/emissions.hpp"
#include "preflight/history_check.hpp"
#include "preflight/places/belt_check.hpp"
#include "preflight/places/body_places.hpp"
#include "preflight/places/outlet_check.hpp"
#include "preflight/places/periodic_check.hpp"
#include "preflight/places/reach_check.hpp"
#include "preflight/places/release_check.hpp"
#include "preflight/places/resolved_check.hpp"
#include "preflight/places/sensor_look.hpp"
#include "preflight/places/sensor_places.hpp"
#include "preflight/places/sensor_surfaces.hpp"
#include "preflight/places/suction_cover.hpp"
#include "preflight/stiffness/cohesion_check.hpp"
#include "preflight/stiffness/softness.hpp"
#include "scenario/diagnostics.hpp"

#include <stdexcept>

namespace dust::preflight {
namespace {

using Result = std::optional<scenario::ReadResult>;

void check_sides(const scenario::ReadResult& read, const SideModels& sides,
                 scenario::Diagnostics& diagnostics) {
  check_flow(read.setup, sides, diagnostics);
  if (!diagnostics.has_errors()) {
    check_driven_speed(read.setup, sides, read.dust.openings, diagnostics);
    check_opening_cells(read.setup, read.dust.openings, diagnostics);
  }
}

void check_sensors(const scenario::Setup& setup, const ParticleModels& models,
                   const SideModels& sides, const registry::Registry& registry,
                   scenario::Diagnostics& diagnostics) {
  const sdk::WorldView world = empty_world(setup, models.class_diameters);
  for (const scenario::SensorSpec& spec : setup.sensors) {
    const registry::Entry* entry = registry.find(spec.model.kind, spec.model.name);
    if (entry == nullptr) continue;
    const sdk::ParameterSchema& parameters = entry->info.parameters;
    check_sensor_places(setup, models.bodies, spec, parameters, diagnostics);
    // One that is refused already need not be asked.
    if (diagnostics.has_error_below(spec.model.path)) continue;
    const auto sensor = registry.create_as<sdk::Sensor>(spec.model);
    check_wall_shear(setup, sides, spec, *sensor, diagnostics);
    check_sensor_surfaces(setup, models.bodies, spec, *sensor, diagnostics);
    check_first_look(setup, spec, parameters, *sensor, world, diagnostics);
  }
}

/// Where bodies, emitters, openings and sensors are, and how far laws reach.
void check_places(const scenario::ReadResult& read, const SideModels& sides,
                  const registry::Registry& registry, scenario::Diagnostics& diagnostics) {
  ParticleModels models = make_particle_models(read.setup, registry);
  check_numbers(read.setup, models, diagnostics);
  const auto first = first_grains(read.setup, models, has_openings(read.setup, read.dust));
  check_suctions(read.setup, models, diagnostics);
  check_suction_covers(read.setup, models, diagnostics);
  check_openings(read.setup, read.dust, models, first, diagnostics);
  // Every face of the sides is asked: only where there is a field of dust.
  const double wind = read.dust.field ? wind_speed(read.setup, sides) : 0.0;
  check_drift(read.setup, read.dust, wind, models, diagnostics);
  check_liberation(read.setup, read.dust, registry);
  check_feed_zones(read.setup, read.dust, models, first, diagnostics);
  check_feeds(read.setup, read.dust, read.start.from.has_value(), models, diagnostics);
  check_body_places(read.setup, models, diagnostics);
  check_mesh_sizes(read.setup, models, diagnostics);
  check_removals(read.setup, diagnostics);
  check_outlets(read.setup, models, diagnostics);
  check_resolved_at_thin_bodies(read.setup, models, diagnostics);
  check_bodies_at_periodic_sides(read.setup, models, diagnostics);
  check_belts(read.setup, models, diagnostics);
  check_feeds_on_belts(read.setup, models, first, diagnostics);
  check_reach(read.setup, models, diagnostics);
  check_histories(read.setup, read.dust, models, diagnostics);
  check_step_count(read.setup, models, diagnostics);
  check_energy_account(read.setup, models, diagnostics);
  check_cohesion(read.setup, models, registry, diagnostics);
  check_softness(read.setup, models, registry, diagnostics);
  check_release(read.setup, read.dust, models, first, diagnostics);
  check_sensors(read.setup, models, sides, registry, diagnostics);
}

/// Looks at what was read without errors.
Result checked(Result read, const registry::Registry& registry,
               scenario::Diagnostics& diagnostics) {
  if (!read) return read;
  const SideModelSet sides(read->setup, registry);
  check_sides(*read, sides.models(), diagnostics);
  check_fixed_step(read->setup, registry, diagnostics);
  if (!diagnostics.has_errors()) check_places(*read, sides.models(), registry, diagnostics);
  if (diagnostics.has_errors()) return std::nullopt;
  read->warnings = diagnostics.warning_lines();
  return read;
}

}  // namespace

scenario::ReadResult read_scenario(const std::filesystem::path& file,
                                   const std::vector<scenario::Override>& overrides,
                                   const registry::Registry& registry,
                                   const std::vector<std::filesystem::path>& set_files) {
  scenario::Diagnostics diagnostics;
  Result read = checked(scenario::read_file(file, overrides, registry, set_files, diagnostics),
                        registry, diagnostics);
  diagnostics.throw_errors();
  if (!read) throw std::logic_error("a scenario that cannot be read gave no error");
  return std::move(*read);
}

std::optional<scenario::ReadResult> read_tree(const scenario::Node& root,
                                              const std::filesystem::path& file,
                                              const registry::Registry& registry,
                                              scenario::Diagnostics& diagnostics) {
  return checked(scenario::read_tree(root, file, registry, diagnostics), registry, diagnostics);
}

}  // namespace dust::preflight
