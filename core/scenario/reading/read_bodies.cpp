// SPDX-License-Identifier: Apache-2.0
#include "bodies/belt/running_parts.hpp"
#include "bodies/body_set.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/motion.hpp"
#include "dust/sdk/table.hpp"
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"
#include "scenario/text/suggest.hpp"

#include <utility>

namespace dust::scenario {
namespace {

/// `motion: NAME` with its parameters beside it, or `motions:` with a list of models.
std::vector<ReadModel> read_motions(Reading& reading, MapReader& reader, Node& written) {
  std::vector<ReadModel> all;
  const Entry* list = reader.optional("motions");
  if (reader.node().find("motion") != nullptr || list == nullptr) {
    ReadModel motion = reading.models.read_optional(reader, "motion", "motion");
    if (motion.choice) all.push_back(std::move(motion));
    if (list != nullptr) {
      reading.error(list->where, reader.path() + ": give motion or motions, not both");
    }
    return all;
  }
  if (!list->value.is_list()) {
    reading.error(list->value.where, reader.path_of("motions") + ": a list of '- model: ...' is " +
                                         "expected, not " + kind_text(list->value));
    return all;
  }
  Node items = Node::make_list();
  for (std::size_t n = 0; n < list->value.items.size(); ++n) {
    const Node& item = list->value.items[n];
    MapReader inner(item, reader.path_of("motions") + "[" + std::to_string(n) + "]", item.where,
                    reading.diagnostics);
    if (!item.is_map()) continue;
    all.push_back(reading.models.read(inner, "model", "motion"));
    inner.finish();
    Node map = Node::make_map();
    append(map, std::exchange(all.back().written, {}));
    items.items.push_back(std::move(map));
  }
  add(written, "motions", std::move(items));
  return all;
}

std::optional<RemovalSpec> read_removal(Reading& reading, MapReader& reader, Node& written) {
  const Entry* entry = reader.optional("remove");
  if (entry == nullptr) return std::nullopt;
  MapReader inner(entry->value, reader.path_of("remove"), entry->where, reading.diagnostics);
  if (!entry->value.is_map()) return std::nullopt;
  std::vector<sdk::Value> values;
  const auto read = block<RemovalBlock>(inner, &values);
  inner.finish();
  const bool has_time = entry->value.find("at") != nullptr;
  const bool has_energy = entry->value.find("when_kinetic_energy_per_grain_below") != nullptr;
  if (inner.is_good() && has_time == has_energy) {
    reading.error(entry->where, reader.path_of("remove") + ": give at or " +
                                    "when_kinetic_energy_per_grain_below" +
                                    (has_time ? ", not both" : ""));
  } else if (inner.is_good() && has_energy && !(read.kinetic_energy_per_grain > 0.0)) {
    // Zero stands for "not given" and is let through by the block itself.
    reading.error(mark_of(entry->value, "when_kinetic_energy_per_grain_below"),
                  reader.path_of("remove") +
                      ".when_kinetic_energy_per_grain_below: 0 is never reached; " +
                      "give an energy above 0 J");
  } else if (has_time && entry->value.find("after") != nullptr) {
    reading.error(entry->where, reader.path_of("remove") + ": after belongs to " +
                                    "when_kinetic_energy_per_grain_below, not to at");
  }
  Node map = Node::make_map();
  for (std::size_t n = 0; n < values.size(); ++n) {
    const std::string& name = RemovalBlock::schema()[n].name;
    if (entry->value.find(name) != nullptr) add(map, name, written_value(values[n]));
  }
  add(written, "remove", std::move(map));
  return RemovalSpec{read.at, read.kinetic_energy_per_grain, read.after};
}

/// A flat box will do on a flat face; an edge or a point is no opening.
void check_opening(Reading& reading, const SuctionBlock& read, Mark where,
                   const std::string& path) {
  std::string flat;
  int count = 0;
  for (int d = 0; d < 3; ++d) {
    if (read.max[d] < read.min[d]) {
      reading.error(where, path + ".max: " + "xyz"[d] + " is below that of min");
      return;
    }
    if (read.max[d] > read.min[d]) continue;
    flat += std::string(flat.empty() ? "" : " and ") + "xyz"[d];
    ++count;
  }
  if (count < 2) return;
  reading.error(where, path + ": the opening has no width along " + flat +
                           ": 'max' must lie above 'min' along two axes at least");
}

std::optional<SuctionSpec> read_suction(Reading& reading, MapReader& reader, Node& written) {
  const Entry* entry = reader.optional("suction");
  if (entry == nullptr) return std::nullopt;
  MapReader inner(entry->value, reader.path_of("suction"), entry->where, reading.diagnostics);
  if (!entry->value.is_map()) return std::nullopt;
  std::vector<sdk::Value> values;
  const auto read = block<SuctionBlock>(inner, &values);
  inner.finish();
  if (inner.is_good()) {
    check_opening(reading, read, mark_of(entry->value, "max"), reader.path_of("suction"));
    try {
      static_cast<void>(sdk::Table(read.times, read.factors, "times", "factors"));
    } catch (const sdk::ParameterError& e) {
      reading.error(entry->where, reader.path_of("suction") + ": " + e.what());
    }
  }
  add(written, "suction", written_block<SuctionBlock>(values));
  return SuctionSpec{read.flow, read.min, read.max, read.times, read.factors, entry->where};
}

/// What only the made body knows.
void check_body(Reading& reading, const BodySpec& spec, std::vector<ReadModel> motions) {
  std::vector<std::unique_ptr<sdk::Motion>> made;
  made.reserve(motions.size());
  for (ReadModel& motion : motions) {
    made.emplace_back(static_cast<sdk::Motion*>(motion.model.release()));
  }
  const bodies::Body body = bodies::make_body(reading.setup, spec, std::move(made));
  const std::string path = "bodies." + spec.name;
  if (const std::string conflict = bodies::motion_conflict(body); !conflict.empty()) {
    reading.error(spec.shape.where, path + ": " + conflict);
  }
  for (const std::string& warning : body.shape->warnings()) {
    reading.diagnostics.warning(spec.shape.where, path + ": " + warning);
  }
}

}  // namespace

void read_frames(Reading& reading, MapReader& top) {
  Node written = Node::make_map();
  for_each_named(reading, top, "frames", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, path, entry.where, reading.diagnostics);
    std::vector<sdk::Value> values;
    const auto frame = block<FrameBlock>(reader, &values);
    if (reader.is_good() && !(norm(frame.axis) > 0.0)) {
      reading.error(mark_of(entry.value, "axis"), path + ".axis: the axis has no direction");
    }
    reader.finish();
    reading.setup.frames.push_back({entry.key, frame.origin, frame.axis, frame.angle});
    add(written, entry.key, written_block<FrameBlock>(values));
  });
  if (!written.entries.empty()) add(reading.written, "frames", std::move(written));
}

Placed read_placed(Reading& reading, MapReader& reader) {
  std::vector<sdk::Value> values;
  const auto read = block<PlacedBlock>(reader, &values);
  Placed placed;
  placed.is_enabled = read.enabled;
  add(placed.written, "enabled", written_value(read.enabled));
  if (read.frame.empty() && reader.node().find("frame") != nullptr && reader.is_good()) {
    reading.error(mark_of(reader.node(), "frame"), reader.path_of("frame") + ": is empty");
  }
  if (!read.frame.empty()) {
    placed.frame = reading.names.frames.index(read.frame);
    if (placed.frame < 0) {
      reading.error(mark_of(reader.node(), "frame"),
                    reader.path_of("frame") + ": there is no frame '" + printable(read.frame) +
                        "'" + suggestion(read.frame, reading.names.frames.all, "there are"));
    }
    add(placed.written, "frame", written_value(read.frame));
  }
  reading.models.check_references(reader, PlacedBlock::schema(), values, true);
  placed.material = reading.names.materials.index(read.material);
  if (placed.material < 0) reading.pairs_are_read = false;
  add(placed.written, "material", written_value(read.material));
  return placed;
}

void read_bodies(Reading& reading, MapReader& top) {
  Node written = Node::make_map();
  for_each_named(reading, top, "bodies", [&](const Entry& entry, const std::string& path) {
    MapReader reader(entry.value, path, entry.where, reading.diagnostics);
    if (!entry.value.is_map()) return;
    const std::size_t errors_before = reading.diagnostics.error_count();
    Placed placed = read_placed(reading, reader);
    const auto own = block<BodyBlock>(reader);
    if (!own.group.empty()) add(placed.written, "group", written_value(own.group));
    ReadModel shape = reading.models.read(reader, "shape", "shape");
    append(placed.written, shape.written);
    std::vector<ReadModel> motions = read_motions(reading, reader, placed.written);
    const auto removal = read_removal(reading, reader, placed.written);
    const auto suction = read_suction(reading, reader, placed.written);
    reader.finish();
    BodySpec spec{.name = entry.key,
                  .shape = shape.choice.value_or(ModelChoice{}),
                  .motions = {},
                  .material = placed.material,
                  .frame = placed.frame,
                  .group = own.group,
                  .removal = removal,
                  .suction = suction,
                  .where = entry.where};
    for (ReadModel& motion : motions) {
      for (const Entry& a : shape.written) {
        for (const Entry& b : motion.written) {
          if (a.key != b.key) continue;
          reading.error(entry.where, path + ": the key '" + a.key +
                                         "' belongs to the shape and to the " +
                                         "motion: give the motion as motions: [{model: ...}]");
        }
      }
      append(placed.written, std::move(motion.written));
      if (motion.choice) spec.motions.push_back(*motion.choice);
    }
    add(written, entry.key, std::move(placed.written));
    if (!placed.is_enabled) return;
    if (reading.diagnostics.error_count() == errors_before)
      check_body(reading, spec, std::move(motions));
    reading.setup.bodies.push_back(std::move(spec));
  });
  if (!written.entries.empty()) add(reading.written, "bodies", std::move(written));
}

}  // namespace dust::scenario
