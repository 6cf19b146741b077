// SPDX-License-Identifier: Apache-2.0
#include "run/branch/air_transfer.hpp"

#include "base/text.hpp"
#include "run/branch/changed_archive.hpp"
#include "run/branch/dust_places.hpp"

#include <algorithm>
#include <array>
#include <string_view>

namespace dust::run {
namespace {

/// Whether what grains and fluid owe each other is still meant: it is of the step before.
bool is_coupled_as_before(const Comparison& both) {
  static constexpr std::array<std::string_view, 4> k_ways = {"fluid_forces", "voidage", "drag",
                                                             "coupling"};
  const auto& changes = both.changes_of_models();
  const bool is_changed_way =
      std::any_of(changes.begin(), changes.end(), [](const ChangedModel& c) {
        return c.now.kind == "drag" || c.now.kind == "voidage" || c.now.kind == "fluid_force";
      });
  return !is_changed_way && both.origin().state().has("coupling", "grain_ids") &&
         both.same("materials") && both.same("fluid") &&
         std::all_of(k_ways.begin(), k_ways.end(),
                     [&](std::string_view way) { return both.same(way); });
}

bool keeps_dust(const Comparison& both) {
  static constexpr std::array<std::string_view, 6> k_free_of_field = {
      "dust.field.clouds",     "dust.field.sources",
      "dust.field.cohesion",   "dust.field.emission_coefficient",
      "dust.field.deposition", "dust.field.schmidt_number"};
  // What lies where is stored in two ways.
  return both.is_same_grid() && both.origin().state().has("dust", "volume") &&
         both.same("dust.field", k_free_of_field) &&
         has_running_surfaces(both.now().setup) ==
             has_running_surfaces(both.origin().scenario().setup);
}

}  // namespace

void report_what_air_drops(const Comparison& both, bool is_same_world, const Warn& warn) {
  const scenario::Setup& setup = both.now().setup;
  if (setup.fluid && !both.is_same_grid()) {
    warn("the fluid has another grid, or there was none: it starts with fluid.initial_velocity");
  } else if (setup.fluid && !is_same_world && !is_coupled_as_before(both) &&
             both.origin().state().has("coupling", "grain_ids")) {
    warn(
        "fluid, drag, voidage or the other forces are set otherwise: what grains and fluid owe "
        "each other from the step before is dropped");
  }
  if (both.now().dust.field && !keeps_dust(both)) {
    warn(
        "dust.field has another grid or other classes, bodies move where none did or none where "
        "some did, or there was none: its air starts as the scenario says");
  }
}

void transfer_fluid(const Comparison& both, const Simulation::Owners& to, bool is_same_world) {
  const io::StoredState& state = both.origin().state();
  FluidStage& fluid = *to.fluid;
  const double time = both.origin().time();
  const bool has_grains = fluid.coupling() != nullptr;
  if (!both.is_same_grid()) {
    if (has_grains) fluid.start(to.particles.rows());
    return;
  }
  LoadParts parts;
  fluid.add_parts(
      parts, [time] { return time; }, [] {});
  const bool had_moving_bodies = state.has("fluid", "open_cells");
  const bool is_coupled_so = is_coupled_as_before(both);
  for (const auto& [name, load] : parts) {
    if (name == "fluid" && had_moving_bodies != fluid.solver().has_moving_bodies()) {
      state.read({{name, [&](sdk::ArchiveReader& a) { fluid.load_velocity(a); }}});
      continue;
    }
    if (name == "coupling" && !is_coupled_so) continue;
    if (name == "held_fluid" && !state.has(name, "pressure")) continue;
    state.read({{name, load}});
  }
  if (is_same_world) return;
  fluid.adapt_velocity(time);
  if (has_grains) fluid.start(to.particles.rows());
}

void transfer_dust(const Comparison& both, const Simulation::Owners& to, bool is_same_world,
                   const Warn& warn) {
  const io::StoredState& state = both.origin().state();
  if (!keeps_dust(both)) {
    to.dust->start();
    return;
  }
  DustPlaces places(both.origin().scenario(), both.now());
  state.read({{"dust", [&](sdk::ArchiveReader& a) { places.find_dropped(a); }}});
  if (places.dropped() > 0.0) {
    warn(base::digits_text(places.dropped(), 3) +
         " kg of dust that bodies or openings had taken which are gone are in no balance from "
         "here on: `released` is without them");
  }
  const auto change = [&](std::string_view name, auto& values) { places.change(name, values); };
  LoadParts parts;
  to.dust->add_parts(parts);
  for (const auto& part : parts) {
    state.read({{part.first, [&](sdk::ArchiveReader& a) {
                   ChangedArchive changed(a, change, change);
                   part.second(changed);
                 }}});
  }
  if (!is_same_world) to.dust->adapt_to_bodies();
}

}  // namespace dust::run
