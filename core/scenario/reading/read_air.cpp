// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "scenario/force_check.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::scenario {
namespace {

/// Cells and faces are counted in 32 bits, several per cell.
constexpr double k_max_cells = 2e8;
/// [kg/m3] Fluids below this are gases, whose viscosity [Pa s] hardly differs.
constexpr double k_densest_gas = 30.0;
constexpr double k_thinnest_gas = 5e-6;
constexpr double k_thickest_gas = 2e-4;
/// [kg/m3], [Pa s] Liquids, hot water among them, have more.
constexpr double k_lightest_liquid = 300.0;
constexpr double k_thinnest_liquid = 5e-5;

/// Each by itself may be usual: 18 in place of 18e-6, but of no gas, and 1200 in place of 1.2, but
/// of no fluid as thin as air.
void check_gas(Reading& reading, const Node& block, const FluidBlock& fluid) {
  if (fluid.density >= k_densest_gas) {
    if (fluid.density < k_lightest_liquid || fluid.viscosity >= k_thinnest_liquid) return;
    reading.diagnostics.warning(mark_of(block, "density"),
                                "fluid.density: " + number_text(fluid.density) +
                                    " kg/m3 is far from that of a gas, which a viscosity of " +
                                    number_text(fluid.viscosity) +
                                    " Pa s speaks for (air has 1.2): is its unit right?");
    return;
  }
  if (fluid.viscosity >= k_thinnest_gas && fluid.viscosity <= k_thickest_gas) return;
  reading.diagnostics.warning(
      mark_of(block, "viscosity"),
      "fluid.viscosity: " + number_text(fluid.viscosity) +
          " Pa s is far from that of a gas, which " + number_text(fluid.density) +
          " kg/m3 speaks for (" + number_text(k_thinnest_gas) + " to " +
          number_text(k_thickest_gas) + " Pa s; air has 1.8e-05): is its unit right?");
}

void check_region(Reading& reading, const Entry& entry, const std::string& path,
                  const RegionBlock& region) {
  for (int d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    if (!(region.max[d] > region.min[d])) {
      reading.error(mark_of(entry.value, "max"),
                    path + ".max: " + axis + " is not above that of min");
    } else if (!reading.has_domain) {
      continue;
    } else if (region.max[d] <= reading.setup.domain.min[d] ||
               region.min[d] >= reading.setup.domain.max[d]) {
      reading.error(entry.where, path + ": the region lies outside the domain along " + axis);
    }
  }
}

Node read_region(Reading& reading, const Entry& entry, const std::string& path, FluidSpec& spec) {
  MapReader reader(entry.value, path, entry.where, reading.diagnostics);
  std::vector<sdk::Value> values;
  const auto read = block<RegionBlock>(reader, &values);
  if (reader.is_good()) check_region(reading, entry, path, read);
  reader.finish();
  spec.regions.push_back({entry.key, read.min, read.max, read.density, read.viscosity});
  return written_block<RegionBlock>(values);
}

/// The closed forms are those of an open flow in three directions. Without it nothing is taken off
/// by itself; who asks for it is told.
void check_disturbance_correction(Reading& reading, Mark where) {
  constexpr int k_min = 4;
  for (int d = 0; d < 3; ++d) {
    if (reading.setup.fluid->cells[static_cast<std::size_t>(d)] >= k_min) continue;
    reading.error(where,
                  "coupling.self_disturbance: the flow around a grain is only known in three "
                  "directions, and fluid.cells has fewer than 4 along " +
                      std::string(1, "xyz"[d]) + ": use more cells, or leave the correction out");
  }
}

}  // namespace

void read_fluid(Reading& reading, MapReader& top) {
  const Entry* entry = top.required("fluid", "cells, density, viscosity; or fluid: none");
  if (entry == nullptr) return;
  if (!reading.has_fluid) {
    add(reading.written, "fluid", Node::make_text("none"));
    return;
  }
  if (entry->value.is_text()) {
    reading.error(entry->value.where,
                  "fluid: a map of keys or none is expected, not " + kind_text(entry->value));
    return;
  }
  MapReader reader(entry->value, "fluid", entry->where, reading.diagnostics);
  std::vector<sdk::Value> values;
  const auto fluid = block<FluidBlock>(reader, &values);
  FluidSpec spec;
  Node turbulence = Node::make_map();
  reading.setup.turbulence = read_part(reading, reader, "turbulence", false, turbulence).choice;
  Node regions = Node::make_map();
  for_each_named(reading, reader, "regions", [&](const Entry& region, const std::string& path) {
    add(regions, region.key, read_region(reading, region, "fluid." + path, spec));
  });
  reader.finish();
  for (int d = 0; d < 3; ++d) {
    spec.cells[static_cast<std::size_t>(d)] = static_cast<int>(fluid.cells[d]);
    if (fluid.cells[d] == std::floor(fluid.cells[d])) continue;
    reading.error(mark_of(entry->value, "cells"), "fluid.cells: " + number_text(fluid.cells[d]) +
                                                      " is not a whole number of cells");
  }
  if (const double count = fluid.cells.x * fluid.cells.y * fluid.cells.z; count > k_max_cells) {
    reading.error(mark_of(entry->value, "cells"), "fluid.cells: " + number_text(count) +
                                                      " cells; at most " +
                                                      number_text(k_max_cells) + " can be counted");
  }
  if (reader.is_good()) check_gas(reading, entry->value, fluid);
  spec.density = fluid.density;
  spec.viscosity = fluid.viscosity;
  spec.momentum_set = fluid.momentum_set;
  spec.initial_velocity = fluid.initial_velocity;
  spec.pressure_tolerance = fluid.pressure_tolerance;
  spec.largest_cfl = fluid.largest_cfl;
  spec.where = entry->where;
  if (fluid.momentum_set == "III") {
    reading.diagnostics.warning(
        mark_of(entry->value, "momentum_set"),
        "fluid.momentum_set: III holds for steady uniform suspensions only; I "
        "and II, which are one here, hold everywhere");
  }
  reading.setup.fluid = spec;
  Node written = written_block<FluidBlock>(values);
  append(written, std::move(turbulence.entries));
  if (!regions.entries.empty()) add(written, "regions", std::move(regions));
  add(reading.written, "fluid", std::move(written));
}

void read_coupling(Reading& reading, MapReader& top) {
  const Entry* entry = top.optional("coupling");
  const Node empty = Node::make_map();
  MapReader reader(entry ? entry->value : empty, "coupling",
                   entry ? entry->where : reading.root.where, reading.diagnostics);
  std::vector<sdk::Value> values;
  auto coupling = block<CouplingBlock>(reader, &values);
  const bool is_known = !reader.is_good() || reading.models.check_references(
                                                 reader, CouplingBlock::schema(), values, true);
  reader.finish();
  const Node& given = entry ? entry->value : empty;
  if (given.find("correct_own_disturbance") != nullptr &&
      given.find("self_disturbance") == nullptr) {
    coupling.self_disturbance = coupling.correct_disturbance_correction ? "on" : "off";
    for (std::size_t n = 0; n < values.size(); ++n) {
      const bool is_it = CouplingBlock::schema()[n].name == "self_disturbance";
      if (is_it) values[n] = coupling.self_disturbance;
    }
  }
  if (reading.setup.fluid) {
    reading.setup.fluid->is_one_way = coupling.one_way;
    const bool is_on = coupling.self_disturbance == "on";
    reading.setup.fluid->disturbance_correction = is_on ? DisturbanceCorrection::taken_off
                                                  : coupling.self_disturbance == "off"
                                                      ? DisturbanceCorrection::felt
                                                      : DisturbanceCorrection::automatic;
    reading.setup.fluid->overlaps_grains = coupling.overlap;
    if (is_on) check_disturbance_correction(reading, entry->where);
  }
  if (is_known) read_resolved(reading, coupling, entry);
  add(reading.written, "coupling", written_block<CouplingBlock>(values));
}

void read_drag_and_voidage(Reading& reading, MapReader& top) {
  const bool is_needed =
      reading.has_fluid &&
      std::any_of(reading.setup.emitters.begin(), reading.setup.emitters.end(),
                  [&](const EmitterSpec& e) { return !is_resolved(reading, e); });
  ReadModel drag = read_part(reading, top, "drag", is_needed, reading.written);
  ReadModel voidage = read_part(reading, top, "voidage", is_needed, reading.written);
  if (!reading.has_fluid) return;
  reading.setup.drag = std::move(drag.choice);
  reading.setup.voidage = std::move(voidage.choice);
  reading.voidage = std::move(voidage.model);
}

void read_fluid_forces(Reading& reading, MapReader& top) {
  const Entry* list = top.optional("fluid_forces");
  if (list == nullptr) return;
  if (!list->value.is_list()) {
    reading.error(list->value.where, "fluid_forces: a list of '- model: ...' is expected, not " +
                                         kind_text(list->value));
    return;
  }
  Node written = Node::make_list();
  std::vector<std::unique_ptr<sdk::Model>> made;
  std::vector<const sdk::FluidForce*> models;
  for (std::size_t n = 0; n < list->value.items.size(); ++n) {
    const Node& item = list->value.items[n];
    MapReader reader = MapReader::of_model(item, "fluid_forces[" + std::to_string(n) + "]",
                                           item.where, reading.diagnostics);
    if (!item.is_map()) continue;
    ReadModel force = reading.models.read(reader, "model", "fluid_force");
    reader.finish();
    Node map = Node::make_map();
    append(map, std::move(force.written));
    written.items.push_back(std::move(map));
    if (!force.choice) continue;
    reading.setup.fluid_forces.push_back(*force.choice);
    models.push_back(static_cast<const sdk::FluidForce*>(force.model.get()));
    made.push_back(std::move(force.model));
  }
  check_forces(reading.setup, models, reading.diagnostics);
  if (!reading.has_fluid) reading.setup.fluid_forces.clear();
  if (!written.items.empty()) add(reading.written, "fluid_forces", std::move(written));
}

void check_voidage(Reading& reading) {
  if (!reading.voidage || !reading.setup.fluid || !reading.has_domain) return;
  double spacing = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d) {
    const double width = reading.setup.domain.max[d] - reading.setup.domain.min[d];
    spacing = std::min(spacing, width / reading.setup.fluid->cells[static_cast<std::size_t>(d)]);
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < reading.emitters.size(); ++n) {
    if (is_resolved(reading, reading.setup.emitters[n])) continue;
    const auto diameters = static_cast<const sdk::Emitter&>(*reading.emitters[n]).diameters();
    for (const double d : diameters) largest = std::max(largest, d);
  }
  const double limit =
      static_cast<const sdk::VoidageRule&>(*reading.voidage).largest_diameter_over_spacing();
  if (!(spacing > 0.0) || largest <= limit * spacing) return;
  reading.error(
      reading.setup.voidage->where,
      "voidage: the largest grain is " + number_text(std::round(100 * largest / spacing) / 100) +
          " of the smallest cell's edges wide; '" + reading.setup.voidage->name +
          "' is valid up to " + number_text(limit) + ": take fewer cells or another rule");
}

}  // namespace dust::scenario
