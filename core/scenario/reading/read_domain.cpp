// SPDX-License-Identifier: Apache-2.0
#include "scenario/checks.hpp"
#include "scenario/reading/setup_reader.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>

namespace dust::scenario {
namespace {

/// A folder name that works everywhere: other characters of a file's stem become '_'.
std::string name_from_file(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    if (!is_name(std::string("a") + c)) c = '_';
  }
  return is_name(name) ? name : "scenario_" + name;
}

}  // namespace

void SetupReader::read_general(MapReader& top) {
  const auto general = block<GeneralBlock>(top);
  setup_.name = general.name;
  const Entry* name = root_.find("name");
  if (name == nullptr) {
    setup_.name = name_from_file(file_);
  } else if (name->value.is_text() && !is_name(general.name)) {
    error(name->value.where, "name: '" + printable(general.name) +
                                 "' is also a folder's name: use letters, digits, '_' and '-'");
  }
  setup_.seed = static_cast<std::uint64_t>(general.seed);
  setup_.gravity = general.gravity;
  out_.add("name", written_value(setup_.name));
  out_.add("seed", written_value(general.seed));
}

void SetupReader::read_time(MapReader& top) {
  const Entry* entry = top.required("time", "end, fluid_step, output_every");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "time", entry->where, diagnostics_);
  std::vector<sdk::Value> values;
  const auto time = block<TimeBlock>(reader, &values);
  reader.finish();
  setup_.time = {.end = time.end,
                 .fluid_step = time.fluid_step,
                 .output_every = time.output_every,
                 .checkpoint_every = time.checkpoint_every,
                 .dem_step = time.dem_step,
                 .expected_speed = time.expected_speed,
                 .rates_single = time.rates == "single",
                 .dem_step_where = mark_of(entry->value, "dem_step")};
  const Node& map = entry->value;
  check_time(setup_.time,
             {mark_of(map, "fluid_step"), mark_of(map, "output_every"),
              mark_of(map, "checkpoint_every"), mark_of(map, "dem_step"), mark_of(map, "end")},
             diagnostics_);
  check_multiple("time.keep_every", time.keep_every, time.fluid_step, mark_of(map, "keep_every"),
                 diagnostics_);
  start_.keep_every = time.keep_every;
  start_.end_where = mark_of(map, "end");
  Node written = written_block<TimeBlock>(values);
  // Left out where it says nothing: studies know their points by what is written.
  if (!(time.keep_every > 0.0)) {
    std::erase_if(written.entries, [](const Entry& e) { return e.key == "keep_every"; });
  }
  out_.add("time", std::move(written));
}

void SetupReader::read_domain(MapReader& top) {
  const Entry* entry = top.required("domain", "min, max, boundaries");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "domain", entry->where, diagnostics_);
  std::vector<sdk::Value> values;
  const auto domain = block<DomainBlock>(reader, &values);
  const bool has_corners = reader.is_good();
  Node written = written_block<DomainBlock>(values);
  setup_.domain.min = domain.min;
  setup_.domain.max = domain.max;
  for (int d = 0; d < 3 && has_corners; ++d) {
    if (domain.max[d] > domain.min[d]) continue;
    error(mark_of(entry->value, "max"),
          std::string("domain.max: ") + "xyz"[d] + " = " + number_text(domain.max[d]) +
              " m is not above that of domain.min, " + number_text(domain.min[d]) + " m");
  }
  if (const Entry* sides = reader.required("boundaries", "left, right, front, back, bottom, top")) {
    written.add("boundaries", read_sides(*sides));
  }
  reader.finish();
  out_.add("domain", std::move(written));
}

Node SetupReader::read_sides(const Entry& entry) {
  MapReader reader(entry.value, "domain.boundaries", entry.where, diagnostics_);
  Node written = Node::make_map();
  std::array<bool, 6> is_read{};
  std::array<bool, 6> has_air{};
  std::array<bool, 6> is_air_periodic{};
  for (std::size_t n = 0; n < 6; ++n) {
    const Entry* side = reader.required(
        k_side_names[n], "a side: {grains: open, wall or periodic, air: {model: ...}}");
    if (side == nullptr) continue;
    written.add(k_side_names[n], read_side(*side, n, is_read[n], has_air[n], is_air_periodic[n]));
  }
  reader.finish();
  check_sides(setup_.domain, is_read, has_air, is_air_periodic, diagnostics_);
  return written;
}

/// An air condition with a volume flow through a box is an opening; what it draws out may be dust.
void SetupReader::note_opening(int side, const std::optional<ModelChoice>& air) {
  const registry::Entry* entry = air ? registry_.find(air->kind, air->name) : nullptr;
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
  if (flow == nullptr || min == nullptr || max == nullptr) return;
  const auto* rate = std::get_if<double>(flow);
  const auto* low = std::get_if<sdk::Vec3>(min);
  const auto* high = std::get_if<sdk::Vec3>(max);
  if (rate == nullptr || low == nullptr || high == nullptr || !(*rate > 0.0)) return;
  dust_.openings.push_back({side, *low, *high});
}

Node SetupReader::read_side(const Entry& entry, std::size_t n, bool& is_read, bool& has_air,
                            bool& is_air_periodic) {
  SideSpec& side = setup_.domain.sides[n];
  side.where = entry.where;
  MapReader reader(entry.value, std::string("domain.boundaries.") + k_side_names[n], entry.where,
                   diagnostics_);
  std::vector<sdk::Value> values;
  const auto read = block<SideBlock>(reader, &values);
  is_read = reader.is_good();
  Node written = Node::make_map();
  written.add("grains", written_value(read.grains));
  if (read.grains == "wall") {
    side.grains = GrainSide::wall;
    if (read.material.empty()) {
      const Entry* material = entry.value.find("material");
      if (material == nullptr) {
        error(entry.where, reader.path() + ": missing key 'material' (of the wall)");
      } else if (reader.is_good()) {
        error(material->value.where, reader.path_of("material") + ": is empty");
      }
      pairs_are_read_ = false;
    }
  } else {
    side.grains = read.grains == "periodic" ? GrainSide::periodic : GrainSide::open;
    if (const Entry* material = entry.value.find("material")) {
      error(material->where, reader.path_of("material") + ": only grains: wall has a material");
    }
  }
  if (!read.material.empty()) {
    models_.check_references(reader, SideBlock::schema(), values, true);
    side.material = names_.materials.index(read.material);
    written.add("material", written_value(read.material));
  }
  const bool needs_air = has_fluid_ && side.grains != GrainSide::periodic && is_read;
  const Entry* air = needs_air ? reader.required("air", "condition of the air: {model: ...}")
                               : reader.optional("air");
  has_air = air != nullptr;
  is_air_periodic = has_air && air->value.is_word("periodic");
  if (is_air_periodic) {
    written.add("air", Node::make_text("periodic"));
  } else if (has_air && air->value.is_text()) {
    error(air->value.where, reader.path_of("air") + ": {model: NAME} or periodic is expected, " +
                                "not " + kind_text(air->value));
  } else if (has_air) {
    MapReader inner(air->value, reader.path_of("air"), air->where, diagnostics_);
    auto model = models_.read(inner, "model", "boundary");
    inner.finish();
    note_opening(static_cast<int>(n), model.choice);
    Node map = Node::make_map();
    append(map, std::move(model.written));
    written.add("air", std::move(map));
    if (has_fluid_) side.air = std::move(model.choice);
  }
  reader.finish();
  return written;
}

}  // namespace dust::scenario
