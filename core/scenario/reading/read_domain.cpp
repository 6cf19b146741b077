// SPDX-License-Identifier: Apache-2.0
#include "scenario/checks.hpp"
#include "scenario/reader.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/units.hpp"
#include "setup/draws_out.hpp"

#include <algorithm>

namespace dust::scenario {
namespace {

/// An air condition with a volume flow through a box is an opening; what it draws out may be dust.
void note_opening(Reading& reading, int side, const std::optional<ModelChoice>& air) {
  const registry::Entry* entry = air ? reading.registry.find(air->kind, air->name) : nullptr;
  if (entry == nullptr) return;
  const auto value_of = [&](const char* name, sdk::Dimension dimension) -> const sdk::Value* {
    const auto& parameters = entry->info.parameters;
    for (std::size_t n = 0; n < parameters.size() && n < air->values.size(); ++n) {
      if (parameters[n].name == name && parameters[n].dimension == dimension) {
        return &air->values[n];
      }
    }
    return nullptr;
  };
  const sdk::Value* flow = value_of("flow", sdk::dimension::volume_flow);
  const sdk::Value* min = value_of("min", sdk::dimension::length);
  const sdk::Value* max = value_of("max", sdk::dimension::length);
  const sdk::Value* factors = value_of("factors", sdk::dimension::none);
  if (flow == nullptr || min == nullptr || max == nullptr) return;
  const auto* rate = std::get_if<double>(flow);
  const auto* low = std::get_if<sdk::Vec3>(min);
  const auto* high = std::get_if<sdk::Vec3>(max);
  const auto* values = factors != nullptr ? std::get_if<std::vector<double>>(factors) : nullptr;
  if (rate == nullptr || low == nullptr || high == nullptr) return;
  if (!draws_out(*rate, values != nullptr ? *values : std::vector<double>())) return;
  reading.dust.openings.push_back({side, *low, *high, *rate});
}

Node read_side(Reading& reading, const Entry& entry, std::size_t n, bool& is_read, bool& has_air,
               bool& is_air_periodic) {
  SideSpec& side = reading.setup.domain.sides[n];
  side.where = entry.where;
  MapReader reader(entry.value, std::string("domain.boundaries.") + k_side_names[n], entry.where,
                   reading.diagnostics);
  std::vector<sdk::Value> values;
  const auto read = block<SideBlock>(reader, &values);
  is_read = reader.is_good();
  Node written = Node::make_map();
  add(written, "grains", written_value(read.grains));
  if (read.grains == "wall") {
    side.grains = GrainSide::wall;
    if (read.material.empty()) {
      const Entry* material = entry.value.find("material");
      if (material == nullptr) {
        reading.error(entry.where, reader.path() + ": missing key 'material' (of the wall)");
      } else if (reader.is_good()) {
        reading.error(material->value.where, reader.path_of("material") + ": is empty");
      }
      reading.pairs_are_read = false;
    }
  } else {
    side.grains = read.grains == "periodic" ? GrainSide::periodic : GrainSide::open;
    if (const Entry* material = entry.value.find("material")) {
      reading.error(material->where,
                    reader.path_of("material") + ": only grains: wall has a material");
    }
  }
  if (!read.material.empty()) {
    reading.models.check_references(reader, SideBlock::schema(), values, true);
    side.material = reading.names.materials.index(read.material);
    add(written, "material", written_value(read.material));
  }
  const bool needs_air = reading.has_fluid && side.grains != GrainSide::periodic && is_read;
  const Entry* air = needs_air ? reader.required("air", "condition of the air: {model: ...}")
                               : reader.optional("air");
  has_air = air != nullptr;
  is_air_periodic = has_air && air->value.is_word("periodic");
  if (is_air_periodic) {
    add(written, "air", Node::make_text("periodic"));
  } else if (has_air && air->value.is_text()) {
    reading.error(air->value.where, reader.path_of("air") +
                                        ": {model: NAME} or periodic is expected, " + "not " +
                                        kind_text(air->value) +
                                        ": write {model: " + printable(air->value.text) + "}");
  } else if (has_air) {
    MapReader inner(air->value, reader.path_of("air"), air->where, reading.diagnostics);
    auto model = reading.models.read(inner, "model", "boundary");
    inner.finish();
    note_opening(reading, static_cast<int>(n), model.choice);
    Node map = Node::make_map();
    append(map, std::move(model.written));
    add(written, "air", std::move(map));
    if (reading.has_fluid) side.air = std::move(model.choice);
  }
  reader.finish();
  return written;
}

Node read_sides(Reading& reading, const Entry& entry) {
  MapReader reader(entry.value, "domain.boundaries", entry.where, reading.diagnostics);
  Node written = Node::make_map();
  std::array<bool, 6> is_read{};
  std::array<bool, 6> has_air{};
  std::array<bool, 6> is_air_periodic{};
  for (std::size_t n = 0; n < 6; ++n) {
    const Entry* side = reader.required(
        k_side_names[n], "a side: {grains: open, wall or periodic, air: {model: ...}}");
    if (side == nullptr) continue;
    add(written, k_side_names[n],
        read_side(reading, *side, n, is_read[n], has_air[n], is_air_periodic[n]));
  }
  reader.finish();
  check_sides(reading.setup.domain, is_read, has_air, is_air_periodic, reading.diagnostics);
  return written;
}

}  // namespace

void read_general(Reading& reading, MapReader& top) {
  const auto general = block<GeneralBlock>(top);
  reading.setup.name = general.name;
  const Entry* name = reading.root.find("name");
  if (name == nullptr) {
    reading.setup.name = name_from_file(reading.file);
  } else if (name->value.is_text() && !is_name(general.name)) {
    reading.error(name->value.where,
                  "name: '" + printable(general.name) +
                      "' is also a folder's name: use letters, digits, '_' and '-'");
  }
  reading.setup.seed = static_cast<std::uint64_t>(general.seed);
  reading.setup.gravity = general.gravity;
  add(reading.written, "name", written_value(reading.setup.name));
  add(reading.written, "seed", written_value(general.seed));
}

void read_time(Reading& reading, MapReader& top) {
  const Entry* entry = top.required("time", "end, fluid_step, output_every");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "time", entry->where, reading.diagnostics);
  std::vector<sdk::Value> values;
  const auto time = block<TimeBlock>(reader, &values);
  reader.finish();
  reading.setup.time = {.end = time.end,
                        .fluid_step = time.fluid_step,
                        .output_every = time.output_every,
                        .checkpoint_every = time.checkpoint_every,
                        .dem_step = time.dem_step,
                        .expected_speed = time.expected_speed,
                        .rates_single = time.rates == "single",
                        .dem_step_where = mark_of(entry->value, "dem_step")};
  const Node& map = entry->value;
  check_time(reading.setup.time,
             {mark_of(map, "fluid_step"), mark_of(map, "output_every"),
              mark_of(map, "checkpoint_every"), mark_of(map, "dem_step"), mark_of(map, "end")},
             reading.diagnostics);
  check_multiple("time.keep_every", time.keep_every, time.fluid_step, mark_of(map, "keep_every"),
                 reading.diagnostics);
  reading.start.keep_every = time.keep_every;
  reading.start.end_where = mark_of(map, "end");
  Node written = written_block<TimeBlock>(values);
  // Left out where it says nothing: studies know their points by what is written.
  if (!(time.keep_every > 0.0)) {
    std::erase_if(written.entries, [](const Entry& e) { return e.key == "keep_every"; });
  }
  add(reading.written, "time", std::move(written));
}

void read_domain(Reading& reading, MapReader& top) {
  const Entry* entry = top.required("domain", "min, max, boundaries");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "domain", entry->where, reading.diagnostics);
  std::vector<sdk::Value> values;
  const auto domain = block<DomainBlock>(reader, &values);
  const bool has_corners = reader.is_good();
  Node written = written_block<DomainBlock>(values);
  reading.setup.domain.min = domain.min;
  reading.setup.domain.max = domain.max;
  reading.has_domain = has_corners;
  for (int d = 0; d < 3 && has_corners; ++d) {
    if (domain.max[d] > domain.min[d]) continue;
    reading.has_domain = false;
    reading.error(mark_of(entry->value, "max"),
                  std::string("domain.max: ") + "xyz"[d] + " = " + number_text(domain.max[d]) +
                      " m is not above that of domain.min, " + number_text(domain.min[d]) + " m");
  }
  if (const Entry* sides = reader.required("boundaries", "left, right, front, back, bottom, top")) {
    add(written, "boundaries", read_sides(reading, *sides));
  }
  reader.finish();
  add(reading.written, "domain", std::move(written));
}

}  // namespace dust::scenario
