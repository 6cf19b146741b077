// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "scenario/force_check.hpp"
#include "scenario/reading/setup_reader.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::scenario {
namespace {

/// Cells and faces are counted in 32 bits, several per cell.
constexpr double k_max_cells = 2e8;

}  // namespace

void SetupReader::read_fluid(MapReader& top) {
  const Entry* entry = top.required("fluid", "cells, density, viscosity; or fluid: none");
  if (entry == nullptr) return;
  if (!has_fluid_) {
    out_.add("fluid", Node::make_text("none"));
    return;
  }
  if (entry->value.is_text()) {
    error(entry->value.where,
          "fluid: a map of keys or none is expected, not " + kind_text(entry->value));
    return;
  }
  MapReader reader(entry->value, "fluid", entry->where, diagnostics_);
  std::vector<sdk::Value> values;
  const auto fluid = block<FluidBlock>(reader, &values);
  FluidSpec spec;
  Node turbulence = Node::make_map();
  setup_.turbulence = read_part(reader, "turbulence", false, turbulence).choice;
  Node regions = Node::make_map();
  for_each_named(reader, "regions", [&](const Entry& region, const std::string& path) {
    regions.add(region.key, read_region(region, "fluid." + path, spec));
  });
  reader.finish();
  for (int d = 0; d < 3; ++d) {
    spec.cells[static_cast<std::size_t>(d)] = static_cast<int>(fluid.cells[d]);
    if (fluid.cells[d] == std::floor(fluid.cells[d])) continue;
    error(mark_of(entry->value, "cells"),
          "fluid.cells: " + number_text(fluid.cells[d]) + " is not a whole number of cells");
  }
  if (const double count = fluid.cells.x * fluid.cells.y * fluid.cells.z; count > k_max_cells) {
    error(mark_of(entry->value, "cells"), "fluid.cells: " + number_text(count) +
                                              " cells; at most " + number_text(k_max_cells) +
                                              " can be counted");
  }
  spec.density = fluid.density;
  spec.viscosity = fluid.viscosity;
  spec.momentum_set = fluid.momentum_set;
  spec.initial_velocity = fluid.initial_velocity;
  spec.pressure_tolerance = fluid.pressure_tolerance;
  spec.largest_cfl = fluid.largest_cfl;
  spec.where = entry->where;
  if (fluid.momentum_set == "III") {
    diagnostics_.warning(mark_of(entry->value, "momentum_set"),
                         "fluid.momentum_set: III holds for steady uniform suspensions only; I "
                         "and II, which are one here, hold everywhere");
  }
  setup_.fluid = spec;
  Node written = written_block<FluidBlock>(values);
  append(written, std::move(turbulence.entries));
  if (!regions.entries.empty()) written.add("regions", std::move(regions));
  out_.add("fluid", std::move(written));
}

Node SetupReader::read_region(const Entry& entry, const std::string& path, FluidSpec& spec) {
  MapReader reader(entry.value, path, entry.where, diagnostics_);
  std::vector<sdk::Value> values;
  const auto read = block<RegionBlock>(reader, &values);
  if (reader.is_good()) check_region(entry, path, read);
  reader.finish();
  spec.regions.push_back({entry.key, read.min, read.max, read.density, read.viscosity});
  return written_block<RegionBlock>(values);
}

void SetupReader::check_region(const Entry& entry, const std::string& path,
                               const RegionBlock& region) {
  for (int d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    if (!(region.max[d] > region.min[d])) {
      error(mark_of(entry.value, "max"), path + ".max: " + axis + " is not above that of min");
    } else if (region.max[d] <= setup_.domain.min[d] || region.min[d] >= setup_.domain.max[d]) {
      error(entry.where, path + ": the region lies outside the domain along " + axis);
    }
  }
}

void SetupReader::read_coupling(MapReader& top) {
  const Entry* entry = top.optional("coupling");
  const Node empty = Node::make_map();
  MapReader reader(entry ? entry->value : empty, "coupling", entry ? entry->where : root_.where,
                   diagnostics_);
  std::vector<sdk::Value> values;
  auto coupling = block<CouplingBlock>(reader, &values);
  const bool is_known =
      !reader.is_good() || models_.check_references(reader, CouplingBlock::schema(), values, true);
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
  if (setup_.fluid) {
    setup_.fluid->is_one_way = coupling.one_way;
    const bool is_on = coupling.self_disturbance == "on";
    setup_.fluid->disturbance_correction = is_on ? DisturbanceCorrection::taken_off
                                           : coupling.self_disturbance == "off"
                                               ? DisturbanceCorrection::felt
                                               : DisturbanceCorrection::automatic;
    setup_.fluid->overlaps_grains = coupling.overlap;
    if (is_on) check_disturbance_correction(entry->where);
  }
  if (is_known) read_resolved(coupling, entry);
  out_.add("coupling", written_block<CouplingBlock>(values));
}

/// The closed forms are those of an open flow in three directions. Without it nothing is taken off
/// by itself; who asks for it is told.
void SetupReader::check_disturbance_correction(Mark where) {
  constexpr int k_min = 4;
  for (int d = 0; d < 3; ++d) {
    if (setup_.fluid->cells[static_cast<std::size_t>(d)] >= k_min) continue;
    error(where,
          "coupling.self_disturbance: the flow around a grain is only known in three "
          "directions, and fluid.cells has fewer than 4 along " +
              std::string(1, "xyz"[d]) + ": use more cells, or leave the correction out");
  }
}

void SetupReader::read_drag_and_voidage(MapReader& top) {
  const bool is_needed =
      has_fluid_ && std::any_of(setup_.emitters.begin(), setup_.emitters.end(),
                                [this](const EmitterSpec& e) { return !is_resolved(e); });
  ReadModel drag = read_part(top, "drag", is_needed, out_);
  ReadModel voidage = read_part(top, "voidage", is_needed, out_);
  if (!has_fluid_) return;
  setup_.drag = std::move(drag.choice);
  setup_.voidage = std::move(voidage.choice);
  voidage_ = std::move(voidage.model);
}

void SetupReader::read_fluid_forces(MapReader& top) {
  const Entry* list = top.optional("fluid_forces");
  if (list == nullptr) return;
  if (!list->value.is_list()) {
    error(list->value.where,
          "fluid_forces: a list of '- model: ...' is expected, not " + kind_text(list->value));
    return;
  }
  Node written = Node::make_list();
  std::vector<std::unique_ptr<sdk::Model>> made;
  std::vector<const sdk::FluidForce*> models;
  for (std::size_t n = 0; n < list->value.items.size(); ++n) {
    const Node& item = list->value.items[n];
    MapReader reader(item, "fluid_forces[" + std::to_string(n) + "]", item.where, diagnostics_);
    if (!item.is_map()) continue;
    ReadModel force = models_.read(reader, "model", "fluid_force");
    reader.finish();
    Node map = Node::make_map();
    append(map, std::move(force.written));
    written.items.push_back(std::move(map));
    if (!force.choice) continue;
    setup_.fluid_forces.push_back(*force.choice);
    models.push_back(static_cast<const sdk::FluidForce*>(force.model.get()));
    made.push_back(std::move(force.model));
  }
  check_forces(setup_, models, diagnostics_);
  if (!has_fluid_) setup_.fluid_forces.clear();
  if (!written.items.empty()) out_.add("fluid_forces", std::move(written));
}

void SetupReader::check_voidage() {
  if (!voidage_ || !setup_.fluid) return;
  double spacing = std::numeric_limits<double>::infinity();
  for (int d = 0; d < 3; ++d) {
    const double width = setup_.domain.max[d] - setup_.domain.min[d];
    spacing = std::min(spacing, width / setup_.fluid->cells[static_cast<std::size_t>(d)]);
  }
  double largest = 0.0;
  for (std::size_t n = 0; n < emitters_.size(); ++n) {
    if (is_resolved(setup_.emitters[n])) continue;
    const auto diameters = static_cast<const sdk::Emitter&>(*emitters_[n]).diameters();
    for (const double d : diameters) largest = std::max(largest, d);
  }
  const double limit =
      static_cast<const sdk::VoidageRule&>(*voidage_).largest_diameter_over_spacing();
  if (!(spacing > 0.0) || largest <= limit * spacing) return;
  error(setup_.voidage->where,
        "voidage: the largest grain is " + number_text(std::round(100 * largest / spacing) / 100) +
            " of the smallest cell's edges wide; '" + setup_.voidage->name + "' is valid up to " +
            number_text(limit) + ": take fewer cells or another rule");
}

}  // namespace dust::scenario
