// SPDX-License-Identifier: Apache-2.0
#include "scenario/reader.hpp"

#include "dust/sdk/emitter.hpp"
#include "scenario/checks.hpp"
#include "scenario/reading/setup_reader.hpp"
#include "scenario/text/overlay.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>

namespace dust::scenario {
namespace {

namespace fs = std::filesystem;

/// Least distance of periodic sides in diameters of the largest grain: above 2, a pair of grains
/// can touch through one side only; the rest is what neighbour lists look ahead.
constexpr double k_min_period = 3.0;

}  // namespace

bool is_name(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !text.empty() && (is_letter(text.front()) || text.front() == '_') &&
         std::all_of(text.begin(), text.end(), [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

void SetupReader::read() {
  MapReader top(root_, "", root_.where, diagnostics_);
  read_general(top);
  read_start(top);
  read_time(top);
  out_.add("gravity", written_value(setup_.gravity));
  read_domain(top);
  read_materials(top);
  read_interactions(top);
  read_frames(top);
  read_bodies(top);
  read_emitters(top);
  read_fluid(top);
  read_coupling(top);
  read_drag_and_voidage(top);
  read_fluid_forces(top);
  read_sensors(top);
  read_dust(top);
  read_audit(top);
  references_.numbers = read_references(top, figures_, out_, diagnostics_);
  references_.curves = read_reference_curves(top, figures_, out_, diagnostics_);
  top.optional("include");
  top.finish();
  if (pairs_are_read_) {
    const Entry* interactions = root_.find("interactions");
    check_pairs(setup_, interactions ? interactions->where : root_.where, diagnostics_);
  }
  check_voidage();
  check_resolved();
  check_audit();
  check_emitters();
  check_periods();
  if (setup_.emitters.empty() && !setup_.fluid) {
    diagnostics_.warning(root_.where, "nothing moves: no emitter takes part and fluid is none");
  }
}

ReadModel SetupReader::read_part(MapReader& reader, const std::string& key, bool is_required,
                                 Node& written) {
  const Entry* entry = is_required ? reader.required(key, "{model: ...}") : reader.optional(key);
  if (entry == nullptr) return {};
  MapReader inner(entry->value, reader.path_of(key), entry->where, diagnostics_);
  if (!entry->value.is_map()) return {};
  ReadModel model = models_.read(inner, "model", key);
  inner.finish();
  Node map = Node::make_map();
  append(map, model.written);
  written.add(key, std::move(map));
  return model;
}

void SetupReader::read_sensors(MapReader& top) {
  Node written = Node::make_map();
  for_each_named(top, "sensors", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, path, entry.where, diagnostics_);
    if (!entry.value.is_map()) return;
    std::vector<sdk::Value> values;
    const auto sensor = block<SensorBlock>(reader, &values);
    ReadModel model = models_.read(reader, "model", "sensor", sensor.enabled);
    reader.finish();
    Node map = written_block<SensorBlock>(values);
    append(map, std::move(model.written));
    written.add(entry.key, std::move(map));
    figures_.push_back(figures_of(entry.key, sensor.enabled, model.model.get()));
    if (!sensor.enabled) return;
    setup_.sensors.push_back({entry.key, model.choice.value_or(ModelChoice{})});
  });
  if (!written.entries.empty()) out_.add("sensors", std::move(written));
}

void SetupReader::check_periods() {
  double largest = 0.0;
  for (const auto& emitter : emitters_) {
    for (const double d : static_cast<const sdk::Emitter&>(*emitter).diameters()) {
      largest = std::max(largest, d);
    }
  }
  for (int d = 0; d < 3; ++d) {
    const SideSpec& side = setup_.domain.sides[static_cast<std::size_t>(2 * d)];
    const double extent = setup_.domain.max[d] - setup_.domain.min[d];
    if (side.grains != GrainSide::periodic || extent > k_min_period * largest) continue;
    error(side.where, "domain: " + number_text(extent) + " m between the periodic sides " +
                          k_side_names[static_cast<std::size_t>(2 * d)] + " and " +
                          k_side_names[static_cast<std::size_t>(2 * d + 1)] + " are less than " +
                          number_text(k_min_period) + " diameters of the largest grain, " +
                          number_text(largest) +
                          " m: grains would touch each other on both sides; widen the domain");
  }
}

void SetupReader::check_emitters() {
  if (diagnostics_.has_errors()) return;
  for (std::size_t n = 0; n < emitters_.size(); ++n) {
    const EmitterSpec& spec = setup_.emitters[n];
    sdk::EmitterContext context;
    context.grain_density =
        setup_.materials[static_cast<std::size_t>(spec.material)].properties.density;
    context.gravity = setup_.gravity;
    std::vector<sdk::InsertionRequest> requests;
    try {
      static_cast<sdk::Emitter&>(*emitters_[n]).propose(context, requests);
    } catch (const std::exception& problem) {
      error(spec.model.where, spec.model.path + ": " + problem.what());
    }
  }
}

std::optional<ReadResult> read_file(const fs::path& file, const std::vector<Override>& overrides,
                                    const registry::Registry& registry,
                                    const std::vector<fs::path>& set_files,
                                    Diagnostics& diagnostics) {
  auto root = read_with_includes(file, diagnostics);
  for (const fs::path& set_file : set_files) {
    auto over = read_with_includes(set_file, diagnostics);
    if (root && over) merge_scenario(*root, std::move(*over));
  }
  if (!root) return std::nullopt;
  if (root->where.line == 0) root->where = {file.generic_string(), 1, 1};
  for (const Override& override : overrides) apply_override(*root, override, diagnostics);
  return read_tree(*root, file, registry, diagnostics);
}

std::optional<ReadResult> read_tree(const Node& root, const fs::path& file,
                                    const registry::Registry& registry, Diagnostics& diagnostics) {
  SetupReader reader(root, file, registry, diagnostics);
  reader.read();
  if (diagnostics.has_errors()) return std::nullopt;
  ReadResult result;
  result.setup = reader.take_setup();
  result.dust = reader.take_dust();
  result.start = reader.take_start();
  result.references = reader.take_references();
  result.reference_curves = reader.take_reference_curves();
  result.resolved_yaml =
      "# Resolved scenario: includes merged, settings applied, defaults written out, all in SI.\n" +
      emit_yaml(reader.resolved());
  result.warnings = diagnostics.warning_lines();
  return result;
}

}  // namespace dust::scenario
