// SPDX-License-Identifier: Apache-2.0
#include "scenario/reader.hpp"

#include "dust/sdk/emitter.hpp"
#include "scenario/checks.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reference_curves.hpp"
#include "scenario/text/overlay.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <utility>

namespace dust::scenario {
namespace {

namespace fs = std::filesystem;

/// Least distance of periodic sides in diameters of the largest grain: above 2, a pair of grains
/// can touch through one side only; the rest is what neighbour lists look ahead.
constexpr double k_min_period = 3.0;

/// Some contradictions need the density of the grains: an empty interval makes emitters look.
void check_emitters(Reading& reading) {
  if (reading.diagnostics.has_errors()) return;
  for (std::size_t n = 0; n < reading.emitters.size(); ++n) {
    const EmitterSpec& spec = reading.setup.emitters[n];
    sdk::EmitterContext context;
    context.grain_density =
        reading.setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
    context.gravity = reading.setup.gravity;
    std::vector<sdk::InsertionRequest> requests;
    try {
      static_cast<sdk::Emitter&>(*reading.emitters[n]).propose(context, requests);
    } catch (const std::exception& problem) {
      reading.error(spec.model.where, spec.model.path + ": " + problem.what());
    }
  }
}

/// Two grains must not touch through both sides at once: a pair of grains has one contact.
void check_periods(Reading& reading) {
  if (!reading.has_domain) return;
  double largest = 0.0;
  for (const auto& emitter : reading.emitters) {
    for (const double d : static_cast<const sdk::Emitter&>(*emitter).diameters()) {
      largest = std::max(largest, d);
    }
  }
  for (int d = 0; d < 3; ++d) {
    const SideSpec& side = reading.setup.domain.sides[static_cast<std::size_t>(2 * d)];
    const double extent = reading.setup.domain.max[d] - reading.setup.domain.min[d];
    if (side.grains != GrainSide::periodic || extent >= (k_min_period - 1e-9) * largest) continue;
    reading.error(side.where,
                  "domain: " + number_text(extent) + " m between the periodic sides " +
                      k_side_names[static_cast<std::size_t>(2 * d)] + " and " +
                      k_side_names[static_cast<std::size_t>(2 * d + 1)] + " are less than " +
                      number_text(k_min_period) + " diameters of the largest grain, " +
                      number_text(largest) +
                      " m: grains would touch each other on both sides; widen the domain");
  }
}

/// Sensors whose means begin when the run has ended.
void check_means(const Reading& reading, const Entry& sensor, const std::string& path,
                 const std::optional<ModelChoice>& choice) {
  const auto* plugin = choice ? reading.registry.find("sensor", choice->name) : nullptr;
  if (plugin == nullptr) return;
  const sdk::ParameterSchema& parameters = plugin->info.parameters;
  for (const char* key : {"steady_after", "averaging_after"}) {
    for (std::size_t n = 0; n < choice->values.size(); ++n) {
      const auto* begin = std::get_if<double>(&choice->values[n]);
      if (begin == nullptr || parameters[n].name != key) continue;
      check_begin_of_means(path + "." + key, *begin, reading.setup.time.end,
                           mark_of(sensor.value, key), reading.diagnostics);
    }
  }
}

void read_sensors(Reading& reading, MapReader& top) {
  Node written = Node::make_map();
  for_each_named(reading, top, "sensors", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, path, entry.where, reading.diagnostics);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto sensor = block<SensorBlock>(reader, &values);
    ReadModel model = reading.models.read(reader, "model", "sensor", sensor.enabled);
    reader.finish();
    Node map = written_block<SensorBlock>(values);
    append(map, std::move(model.written));
    add(written, entry.key, std::move(map));
    try {
      reading.figures.push_back(figures_of(entry.key, sensor.enabled, model.model.get()));
    } catch (const std::exception& problem) {
      reading.diagnostics.error(entry.where,
                                path + ": its figures cannot be asked for: " + problem.what());
      return;
    }
    if (!sensor.enabled) return;
    check_means(reading, entry, path, model.choice);
    reading.setup.sensors.push_back({entry.key, model.choice.value_or(ModelChoice{})});
  });
  if (!written.entries.empty()) add(reading.written, "sensors", std::move(written));
}

/// Reads all blocks, then what only the whole can show.
void read_setup(Reading& reading) {
  MapReader top(reading.root, "", reading.root.where, reading.diagnostics);
  read_general(reading, top);
  read_start(reading, top);
  read_time(reading, top);
  add(reading.written, "gravity", written_value(reading.setup.gravity));
  read_domain(reading, top);
  read_materials(reading, top);
  read_interactions(reading, top);
  read_frames(reading, top);
  read_bodies(reading, top);
  read_emitters(reading, top);
  read_fluid(reading, top);
  read_coupling(reading, top);
  read_drag_and_voidage(reading, top);
  read_fluid_forces(reading, top);
  read_sensors(reading, top);
  read_dust(reading, top);
  read_audit(reading, top);
  reading.references = read_references(top, reading.figures, reading.written, reading.diagnostics);
  reading.reference_curves =
      read_reference_curves(top, reading.figures, reading.written, reading.diagnostics);
  top.optional("include");
  top.finish();
  if (reading.pairs_are_read) {
    const Entry* interactions = reading.root.find("interactions");
    check_pairs(reading.setup, interactions ? interactions->where : reading.root.where,
                reading.diagnostics);
  }
  check_voidage(reading);
  check_resolved(reading);
  check_audit(reading);
  check_emitters(reading);
  check_periods(reading);
  if (reading.setup.emitters.empty() && !reading.setup.fluid && !reading.diagnostics.has_errors()) {
    reading.diagnostics.warning(reading.root.where,
                                "nothing moves: no emitter takes part and fluid is none");
  }
}

/// Rather than one error for each key of a study.
bool is_study(const Node& root, const fs::path& file, Diagnostics& diagnostics) {
  const Entry* const base = root.find("base");
  if (base == nullptr) return false;
  if (root.find("measure") == nullptr && root.find("calibrate") == nullptr) return false;
  diagnostics.error(base->where,
                    "this is a study, which varies the scenario of its 'base': engine study " +
                        file.generic_string() + " runs it, with --dry-run it is only checked");
  return true;
}

}  // namespace

std::optional<ReadResult> read_file(const fs::path& file, const std::vector<Override>& overrides,
                                    const registry::Registry& registry,
                                    const std::vector<fs::path>& set_files,
                                    Diagnostics& diagnostics) {
  auto root = read_with_includes(file, diagnostics);
  for (const fs::path& set_file : set_files) {
    auto over = read_with_includes(set_file, diagnostics);
    // Without it keys would be missed that it gives.
    if (!over) return std::nullopt;
    if (root) merge_scenario(*root, std::move(*over));
  }
  if (!root || is_study(*root, file, diagnostics)) return std::nullopt;
  if (root->where.line == 0) root->where = {file.generic_string(), 1, 1};
  for (const Override& override : overrides) apply_override(*root, override, diagnostics);
  auto read = read_tree(*root, file, registry, diagnostics);
  if (read) read->documents = diagnostics.documents();
  return read;
}

std::optional<ReadResult> read_tree(const Node& root, const fs::path& file,
                                    const registry::Registry& registry, Diagnostics& diagnostics) {
  Reading reading(root, file, registry, diagnostics);
  read_setup(reading);
  if (diagnostics.has_errors()) return std::nullopt;
  ReadResult result;
  result.setup = std::move(reading.setup);
  result.dust = std::move(reading.dust);
  result.start = std::move(reading.start);
  result.references = std::move(reading.references);
  result.reference_curves = std::move(reading.reference_curves);
  result.files = reading.models.files();
  result.resolved_yaml = k_resolved_heading + emit_yaml(reading.written);
  result.warnings = diagnostics.warning_lines();
  return result;
}

}  // namespace dust::scenario
