// SPDX-License-Identifier: Apache-2.0
#include "scenario/reader.hpp"

#include "bodies/body_set.hpp"
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/motion.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "scenario/blocks.hpp"
#include "scenario/checks.hpp"
#include "scenario/derived.hpp"
#include "scenario/flow_check.hpp"
#include "scenario/model_reader.hpp"
#include "scenario/overlay.hpp"
#include "scenario/suggest.hpp"
#include "scenario/units.hpp"

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>

namespace dust::scenario {
namespace {

namespace fs = std::filesystem;

/// Least distance of periodic sides in diameters of the largest grain: above 2, a pair of grains
/// can touch through one side only; the rest is what neighbour lists look ahead.
constexpr double k_least_period = 3.0;

bool is_name(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !text.empty() && (is_letter(text.front()) || text.front() == '_') &&
         std::all_of(text.begin(), text.end(), [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

/// A folder name that works everywhere: other characters of a file's stem become '_'.
std::string name_from_file(const fs::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    if (!is_name(std::string("a") + c)) c = '_';
  }
  return is_name(name) ? name : "scenario_" + name;
}

/// Reads a merged tree into a Setup and, side by side, into the resolved tree.
class SetupReader {
 public:
  SetupReader(const Node& root, const fs::path& file, const registry::Registry& registry,
              Diagnostics& diagnostics)
      : root_(root),
        file_(file),
        registry_(registry),
        diagnostics_(diagnostics),
        names_(ScenarioNames::of(root)),
        models_(registry, names_, diagnostics) {
    const Entry* fluid = root.find("fluid");
    has_fluid_ = fluid != nullptr && !fluid->value.is_word("none");
  }

  void read() {
    MapReader top(root_, "", root_.where, diagnostics_);
    read_general(top);
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
    read_sensors(top);
    top.optional("include");
    top.finish();
    if (pairs_are_read_) {
      const Entry* interactions = root_.find("interactions");
      check_pairs(setup_, interactions ? interactions->where : root_.where, diagnostics_);
    }
    check_voidage();
    check_emitters();
    check_periods();
    if (diagnostics_.error_count() == 0) {
      check_fixed_step(setup_, registry_, dem_step_where_, diagnostics_);
    }
    SideModels sides{};
    for (std::size_t n = 0; n < 6; ++n) {
      sides[n] = static_cast<const sdk::BoundaryCondition*>(air_[n].get());
    }
    check_flow(setup_, sides, diagnostics_);
    if (setup_.emitters.empty() && !setup_.fluid) {
      diagnostics_.warning(root_.where, "nothing moves: no emitter takes part and fluid is none");
    }
  }
  Setup take_setup() { return std::move(setup_); }
  [[nodiscard]] const Node& resolved() const { return out_; }

 private:
  // Values of a block as its struct; wrong ones keep their initial value, the problem is told.
  template <class Block>
  Block block(MapReader& reader, std::vector<sdk::Value>* values_out = nullptr) {
    auto values = reader.values(Block::schema());
    Block result = sdk::parameters_from<Block>(Block::schema(), values);
    if (values_out != nullptr) *values_out = std::move(values);
    return result;
  }
  template <class Block>
  static Node written_block(const std::vector<sdk::Value>& values) {
    Node map = Node::make_map();
    for (std::size_t n = 0; n < values.size(); ++n) {
      map.add(Block::schema()[n].name, written_value(values[n]));
    }
    return map;
  }
  static void append(Node& map, std::vector<Entry> entries) {
    for (Entry& e : entries) map.entries.push_back(std::move(e));
  }
  void error(const Mark& where, const std::string& text) { diagnostics_.error(where, text); }
  Mark mark_of(const Node& map, const char* key) const {
    const Entry* entry = map.find(key);
    return entry == nullptr ? map.where : entry->value.where;
  }
  /// Calls `each(entry, path)` for all things of a block of names.
  template <class Each>
  void for_each_named(MapReader& top, const std::string& key, Each each) {
    const Entry* entry = top.optional(key);
    if (entry == nullptr) return;
    if (!entry->value.is_map()) {
      error(entry->value.where,
            key + ": a map of names is expected, not " + kind_text(entry->value));
      return;
    }
    for (const Entry& thing : entry->value.entries) {
      const std::string path = key + "." + printable(thing.key);
      if (!is_name(thing.key)) {
        error(thing.where, path + ": a name consists of letters, digits, '_' and '-' and begins " +
                               "with a letter");
      }
      each(thing, path);
    }
  }

  void read_general(MapReader& top) {
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

  void read_time(MapReader& top) {
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
                   .rates_single = time.rates == "single"};
    const Node& map = entry->value;
    dem_step_where_ = mark_of(map, "dem_step");
    check_time(setup_.time,
               {mark_of(map, "fluid_step"), mark_of(map, "output_every"),
                mark_of(map, "checkpoint_every"), mark_of(map, "dem_step"), mark_of(map, "end")},
               diagnostics_);
    out_.add("time", written_block<TimeBlock>(values));
  }

  void read_domain(MapReader& top) {
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
    if (const Entry* sides =
            reader.required("boundaries", "left, right, front, back, bottom, top")) {
      written.add("boundaries", read_sides(*sides));
    }
    reader.finish();
    out_.add("domain", std::move(written));
  }

  Node read_sides(const Entry& entry) {
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

  Node read_side(const Entry& entry, std::size_t n, bool& is_read, bool& has_air,
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
        if (entry.value.find("material") == nullptr) {
          error(entry.where, reader.path() + ": missing key 'material' (of the wall)");
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
      Node map = Node::make_map();
      append(map, std::move(model.written));
      written.add("air", std::move(map));
      if (has_fluid_) {
        side.air = std::move(model.choice);
        air_[n] = std::move(model.model);
      }
    }
    reader.finish();
    return written;
  }

  void read_materials(MapReader& top) {
    Node written = Node::make_map();
    for_each_named(top, "materials", [&](const Entry& entry, const std::string& path) {
      MapReader reader(entry.value, path, entry.where, diagnostics_);
      std::vector<sdk::Value> values;
      const auto material = block<MaterialBlock>(reader, &values);
      reader.finish();
      setup_.materials.push_back(
          {entry.key, {material.density, material.young_modulus, material.poisson_ratio}});
      written.add(entry.key, written_block<MaterialBlock>(values));
    });
    if (!written.entries.empty()) out_.add("materials", std::move(written));
  }

  void read_interactions(MapReader& top) {
    const Entry* entry = top.optional("interactions");
    if (entry == nullptr) return;
    if (!entry->value.is_list()) {
      pairs_are_read_ = false;
      error(entry->value.where, "interactions: a list of '- between: [a, b]' is expected, not " +
                                    kind_text(entry->value));
      return;
    }
    Node written = Node::make_list();
    for (std::size_t n = 0; n < entry->value.items.size(); ++n) {
      written.items.push_back(
          read_interaction(entry->value.items[n], "interactions[" + std::to_string(n) + "]"));
    }
    out_.add("interactions", std::move(written));
  }

  Node read_interaction(const Node& node, const std::string& path) {
    MapReader reader(node, path, node.where, diagnostics_);
    std::vector<sdk::Value> values;
    const auto read = block<InteractionBlock>(reader, &values);
    InteractionSpec spec;
    spec.where = node.where;
    bool has_pair = reader.is_good() &&
                    models_.check_references(reader, InteractionBlock::schema(), values, true);
    if (reader.is_good() && read.between.size() != 2) {
      error(mark_of(node, "between"), path + ".between: two materials are expected, not " +
                                          std::to_string(read.between.size()));
      has_pair = false;
    }
    Node written = written_block<InteractionBlock>(values);
    ReadModel contact = read_part(reader, "contact", true, written);
    ReadModel rolling = read_part(reader, "rolling", false, written);
    ReadModel cohesion = read_part(reader, "cohesion", false, written);
    reader.finish();
    if (!has_pair) {
      pairs_are_read_ = false;
      return written;
    }
    spec.material_i = names_.materials.index(read.between[0]);
    spec.material_j = names_.materials.index(read.between[1]);
    for (const InteractionSpec& other : setup_.interactions) {
      const bool is_same = std::minmax(other.material_i, other.material_j) ==
                           std::minmax(spec.material_i, spec.material_j);
      if (is_same) {
        error(node.where, path + ": the pair [" + read.between[0] + ", " + read.between[1] +
                              "] is already given in line " + std::to_string(other.where.line));
      }
    }
    spec.contact = contact.choice.value_or(ModelChoice{});
    check_laws(spec, contact, cohesion);
    spec.rolling = std::move(rolling.choice);
    spec.cohesion = std::move(cohesion.choice);
    setup_.interactions.push_back(std::move(spec));
    return written;
  }

  /// Does the cohesive law fit the materials and the contact law?
  void check_laws(const InteractionSpec& spec, const ReadModel& contact,
                  const ReadModel& cohesion) {
    if (!contact.model || !cohesion.model) return;
    const auto& i = setup_.materials[static_cast<std::size_t>(spec.material_i)].properties;
    const auto& j = setup_.materials[static_cast<std::size_t>(spec.material_j)].properties;
    if (!(i.young_modulus > 0.0 && j.young_modulus > 0.0)) return;  // told where it stands
    auto& law = static_cast<sdk::CohesionLaw&>(*cohesion.model);
    const ModelChoice& choice = *cohesion.choice;
    if (law.needs_hertz_force() &&
        !static_cast<sdk::ContactLaw&>(*contact.model).has_hertz_force()) {
      error(choice.where, choice.path + ": '" + choice.name +
                              "' replaces the Hertz force, which the contact law '" +
                              contact.choice->name +
                              "' does not have: choose another contact law or another cohesion");
    }
    try {
      law.prepare(i, j);
    } catch (const sdk::ParameterError& problem) {
      error(choice.where, choice.path + ": " + problem.what());
    }
  }

  /// A part of a block that is a model of the kind of the part's name: `drag: {model: ...}`.
  ReadModel read_part(MapReader& reader, const std::string& key, bool is_required, Node& written) {
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

  void read_frames(MapReader& top) {
    Node written = Node::make_map();
    for_each_named(top, "frames", [&](const Entry& entry, const std::string& path) {
      MapReader reader(entry.value, path, entry.where, diagnostics_);
      std::vector<sdk::Value> values;
      const auto frame = block<FrameBlock>(reader, &values);
      if (reader.is_good() && !(norm(frame.axis) > 0.0)) {
        error(mark_of(entry.value, "axis"), path + ".axis: the axis has no direction");
      }
      reader.finish();
      setup_.frames.push_back({entry.key, frame.origin, frame.axis, frame.angle});
      written.add(entry.key, written_block<FrameBlock>(values));
    });
    if (!written.entries.empty()) out_.add("frames", std::move(written));
  }

  /// Material and frame of a body or emitter.
  struct Placed {
    bool is_enabled = true;
    int material = -1;
    int frame = -1;
    Node written = Node::make_map();
  };
  Placed read_placed(MapReader& reader) {
    std::vector<sdk::Value> values;
    const auto read = block<PlacedBlock>(reader, &values);
    Placed placed;
    placed.is_enabled = read.enabled;
    placed.written.add("enabled", written_value(read.enabled));
    if (!read.frame.empty()) {
      placed.frame = names_.frames.index(read.frame);
      if (placed.frame < 0) {
        error(mark_of(reader.node(), "frame"),
              reader.path_of("frame") + ": there is no frame '" + printable(read.frame) + "'" +
                  suggestion(read.frame, names_.frames.all, "there are"));
      }
      placed.written.add("frame", written_value(read.frame));
    }
    models_.check_references(reader, PlacedBlock::schema(), values, true);
    placed.material = names_.materials.index(read.material);
    if (placed.material < 0) pairs_are_read_ = false;
    placed.written.add("material", written_value(read.material));
    return placed;
  }

  /// `motion: NAME` with its parameters beside it, or `motions:` with a list of models.
  std::vector<ReadModel> read_motions(MapReader& reader, Node& written) {
    std::vector<ReadModel> all;
    const Entry* list = reader.optional("motions");
    if (reader.node().find("motion") != nullptr || list == nullptr) {
      ReadModel motion = models_.read_optional(reader, "motion", "motion");
      if (motion.choice) all.push_back(std::move(motion));
      if (list != nullptr) {
        error(list->where, reader.path() + ": give motion or motions, not both");
      }
      return all;
    }
    if (!list->value.is_list()) {
      error(list->value.where, reader.path_of("motions") + ": a list of '- model: ...' is " +
                                   "expected, not " + kind_text(list->value));
      return all;
    }
    Node items = Node::make_list();
    for (std::size_t n = 0; n < list->value.items.size(); ++n) {
      const Node& item = list->value.items[n];
      MapReader inner(item, reader.path_of("motions") + "[" + std::to_string(n) + "]", item.where,
                      diagnostics_);
      if (!item.is_map()) continue;
      all.push_back(models_.read(inner, "model", "motion"));
      inner.finish();
      Node map = Node::make_map();
      append(map, std::exchange(all.back().written, {}));
      items.items.push_back(std::move(map));
    }
    written.add("motions", std::move(items));
    return all;
  }

  std::optional<RemovalSpec> read_removal(MapReader& reader, Node& written) {
    const Entry* entry = reader.optional("remove");
    if (entry == nullptr) return std::nullopt;
    MapReader inner(entry->value, reader.path_of("remove"), entry->where, diagnostics_);
    if (!entry->value.is_map()) return std::nullopt;
    std::vector<sdk::Value> values;
    const auto read = block<RemovalBlock>(inner, &values);
    inner.finish();
    const bool has_time = entry->value.find("at") != nullptr;
    const bool has_energy = entry->value.find("when_kinetic_energy_per_grain_below") != nullptr;
    if (inner.is_good() && has_time == has_energy) {
      error(entry->where, reader.path_of("remove") + ": give at or " +
                              "when_kinetic_energy_per_grain_below" +
                              (has_time ? ", not both" : ""));
    } else if (has_time && entry->value.find("after") != nullptr) {
      error(entry->where, reader.path_of("remove") + ": after belongs to " +
                              "when_kinetic_energy_per_grain_below, not to at");
    }
    Node map = Node::make_map();
    for (std::size_t n = 0; n < values.size(); ++n) {
      const std::string& name = RemovalBlock::schema()[n].name;
      if (entry->value.find(name) != nullptr) map.add(name, written_value(values[n]));
    }
    written.add("remove", std::move(map));
    return RemovalSpec{read.at, read.kinetic_energy_per_grain, read.after};
  }

  /// What only the made body knows. The air is cut by the bodies once, where they are at the start.
  void check_body(const BodySpec& spec, std::vector<ReadModel> motions) {
    std::vector<std::unique_ptr<sdk::Motion>> made;
    for (ReadModel& motion : motions) {
      made.emplace_back(static_cast<sdk::Motion*>(motion.model.release()));
    }
    const bodies::Body body = bodies::make_body(setup_, spec, std::move(made));
    const std::string path = "bodies." + spec.name;
    if (has_fluid_ && body.displaces()) {
      error(spec.motions.front().where,
            path + ": the body moves through the air, which is cut by the bodies only once: run " +
                "grains alone (fluid: none), or let only its surface move (motion: belt)");
    }
    for (const std::string& warning : body.shape->warnings()) {
      diagnostics_.warning(spec.shape.where, path + ": " + warning);
    }
    if (has_fluid_ && !body.shape->is_solid()) {
      error(spec.shape.where, path + ": the air cannot be cut by a sheet without thickness: give " +
                                  "thickness, or run grains alone (fluid: none)");
    }
    if (has_fluid_ && spec.removal) {
      error(spec.where, path +
                            ".remove: the air is cut by the bodies only once: run grains alone " +
                            "(fluid: none)");
    }
  }

  void read_bodies(MapReader& top) {
    Node written = Node::make_map();
    for_each_named(top, "bodies", [&](const Entry& entry, const std::string& path) {
      MapReader reader(entry.value, path, entry.where, diagnostics_);
      if (!entry.value.is_map()) return;
      const std::size_t errors_before = diagnostics_.error_count();
      Placed placed = read_placed(reader);
      const auto own = block<BodyBlock>(reader);
      if (!own.group.empty()) placed.written.add("group", written_value(own.group));
      ReadModel shape = models_.read(reader, "shape", "shape");
      append(placed.written, shape.written);
      std::vector<ReadModel> motions = read_motions(reader, placed.written);
      const auto removal = read_removal(reader, placed.written);
      reader.finish();
      BodySpec spec{.name = entry.key,
                    .shape = shape.choice.value_or(ModelChoice{}),
                    .motions = {},
                    .material = placed.material,
                    .frame = placed.frame,
                    .group = own.group,
                    .removal = removal,
                    .where = entry.where};
      for (ReadModel& motion : motions) {
        for (const Entry& a : shape.written) {
          for (const Entry& b : motion.written) {
            if (a.key != b.key) continue;
            error(entry.where, path + ": the key '" + a.key + "' belongs to the shape and to the " +
                                   "motion: give the motion as motions: [{model: ...}]");
          }
        }
        append(placed.written, std::move(motion.written));
        if (motion.choice) spec.motions.push_back(*motion.choice);
      }
      written.add(entry.key, std::move(placed.written));
      if (!placed.is_enabled) return;
      if (diagnostics_.error_count() == errors_before) check_body(spec, std::move(motions));
      setup_.bodies.push_back(std::move(spec));
    });
    if (!written.entries.empty()) out_.add("bodies", std::move(written));
  }

  void read_emitters(MapReader& top) {
    Node written = Node::make_map();
    for_each_named(top, "emitters", [&](const Entry& entry, const std::string& path) {
      MapReader reader(entry.value, path, entry.where, diagnostics_);
      if (!entry.value.is_map()) return;
      Placed placed = read_placed(reader);
      ReadModel model = models_.read(reader, "model", "emitter", placed.is_enabled);
      reader.finish();
      append(placed.written, std::move(model.written));
      written.add(entry.key, std::move(placed.written));
      if (!placed.is_enabled) return;
      std::vector<int> more;
      if (model.model) {
        for (const auto& name : static_cast<const sdk::Emitter&>(*model.model).materials()) {
          more.push_back(names_.materials.index(name));
        }
        emitters_.push_back(std::move(model.model));
      }
      setup_.emitters.push_back({.name = entry.key,
                                 .model = model.choice.value_or(ModelChoice{}),
                                 .material = placed.material,
                                 .frame = placed.frame,
                                 .more_materials = std::move(more)});
    });
    if (!written.entries.empty()) out_.add("emitters", std::move(written));
  }

  void read_fluid(MapReader& top) {
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
    if (!regions.entries.empty()) written.add("regions", std::move(regions));
    out_.add("fluid", std::move(written));
  }

  Node read_region(const Entry& entry, const std::string& path, FluidSpec& spec) {
    MapReader reader(entry.value, path, entry.where, diagnostics_);
    std::vector<sdk::Value> values;
    const auto read = block<RegionBlock>(reader, &values);
    if (reader.is_good()) check_region(entry, path, read);
    reader.finish();
    spec.regions.push_back({entry.key, read.min, read.max, read.density, read.viscosity});
    return written_block<RegionBlock>(values);
  }
  void check_region(const Entry& entry, const std::string& path, const RegionBlock& region) {
    for (int d = 0; d < 3; ++d) {
      const std::string axis(1, "xyz"[d]);
      if (!(region.max[d] > region.min[d])) {
        error(mark_of(entry.value, "max"), path + ".max: " + axis + " is not above that of min");
      } else if (region.max[d] <= setup_.domain.min[d] || region.min[d] >= setup_.domain.max[d]) {
        error(entry.where, path + ": the region lies outside the domain along " + axis);
      }
    }
  }

  void read_coupling(MapReader& top) {
    const Entry* entry = top.optional("coupling");
    const Node empty = Node::make_map();
    MapReader reader(entry ? entry->value : empty, "coupling", entry ? entry->where : root_.where,
                     diagnostics_);
    std::vector<sdk::Value> values;
    const auto coupling = block<CouplingBlock>(reader, &values);
    reader.finish();
    if (setup_.fluid) setup_.fluid->is_one_way = coupling.one_way;
    out_.add("coupling", written_block<CouplingBlock>(values));
  }

  void read_drag_and_voidage(MapReader& top) {
    const bool is_needed = has_fluid_ && !names_.emitters.all.empty() &&
                           names_.emitters.disabled.size() < names_.emitters.all.size();
    ReadModel drag = read_part(top, "drag", is_needed, out_);
    ReadModel voidage = read_part(top, "voidage", is_needed, out_);
    if (!has_fluid_) return;
    setup_.drag = std::move(drag.choice);
    setup_.voidage = std::move(voidage.choice);
    voidage_ = std::move(voidage.model);
  }

  void read_sensors(MapReader& top) {
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
      if (!sensor.enabled) return;
      setup_.sensors.push_back({entry.key, model.choice.value_or(ModelChoice{})});
    });
    if (!written.entries.empty()) out_.add("sensors", std::move(written));
  }

  /// A rule of the void fraction is valid up to a size of grains relative to the cells.
  void check_voidage() {
    if (!voidage_ || !setup_.fluid) return;
    double spacing = std::numeric_limits<double>::infinity();
    for (int d = 0; d < 3; ++d) {
      const double width = setup_.domain.max[d] - setup_.domain.min[d];
      spacing = std::min(spacing, width / setup_.fluid->cells[static_cast<std::size_t>(d)]);
    }
    double largest = 0.0;
    for (const auto& emitter : emitters_) {
      const auto diameters = static_cast<const sdk::Emitter&>(*emitter).diameters();
      for (const double d : diameters) largest = std::max(largest, d);
    }
    const double limit =
        static_cast<const sdk::VoidageRule&>(*voidage_).largest_diameter_over_spacing();
    if (!(spacing > 0.0) || largest <= limit * spacing) return;
    error(setup_.voidage->where, "voidage: the largest grain is " +
                                     number_text(std::round(100 * largest / spacing) / 100) +
                                     " of the smallest cell's edges wide; '" +
                                     setup_.voidage->name + "' is valid up to " +
                                     number_text(limit) + ": take fewer cells or another rule");
  }

  /// Two grains must not touch through both sides at once: a pair of grains has one contact.
  void check_periods() {
    double largest = 0.0;
    for (const auto& emitter : emitters_) {
      for (const double d : static_cast<const sdk::Emitter&>(*emitter).diameters()) {
        largest = std::max(largest, d);
      }
    }
    for (int d = 0; d < 3; ++d) {
      const SideSpec& side = setup_.domain.sides[static_cast<std::size_t>(2 * d)];
      const double extent = setup_.domain.max[d] - setup_.domain.min[d];
      if (side.grains != GrainSide::periodic || extent > k_least_period * largest) continue;
      error(side.where, "domain: " + number_text(extent) + " m between the periodic sides " +
                            k_side_names[static_cast<std::size_t>(2 * d)] + " and " +
                            k_side_names[static_cast<std::size_t>(2 * d + 1)] + " are less than " +
                            number_text(k_least_period) + " diameters of the largest grain, " +
                            number_text(largest) +
                            " m: grains would touch each other on both sides; widen the domain");
    }
  }

  /// Some contradictions need the density of the grains: an empty interval makes emitters look.
  void check_emitters() {
    if (diagnostics_.has_errors()) return;
    for (std::size_t n = 0; n < emitters_.size(); ++n) {
      const EmitterSpec& spec = setup_.emitters[n];
      sdk::EmitterContext context;
      context.grain_density =
          setup_.materials[static_cast<std::size_t>(spec.material)].properties.density;
      context.gravity = setup_.gravity;
      std::vector<sdk::Seed> seeds;
      try {
        static_cast<sdk::Emitter&>(*emitters_[n]).propose(context, seeds);
      } catch (const std::exception& problem) {
        error(spec.model.where, spec.model.path + ": " + problem.what());
      }
    }
  }

  const Node& root_;
  const fs::path& file_;
  const registry::Registry& registry_;
  Diagnostics& diagnostics_;
  ScenarioNames names_;
  ModelReader models_;
  Mark dem_step_where_;
  bool has_fluid_ = false;
  std::array<std::unique_ptr<sdk::Model>, 6> air_;
  bool pairs_are_read_ = true;
  std::vector<std::unique_ptr<sdk::Model>> emitters_;
  std::unique_ptr<sdk::Model> voidage_;
  Setup setup_;
  Node out_ = Node::make_map();
};

}  // namespace

ReadResult read_scenario(const fs::path& file, const std::vector<Override>& overrides,
                         const registry::Registry& registry,
                         const std::vector<fs::path>& set_files) {
  Diagnostics diagnostics;
  auto root = read_with_includes(file, diagnostics);
  for (const fs::path& set_file : set_files) {
    auto over = read_with_includes(set_file, diagnostics);
    if (root && over) merge(*root, std::move(*over));
  }
  // Without a tree there is nothing more to find.
  if (!root) diagnostics.throw_errors();
  if (!root) throw std::logic_error("a file that cannot be read gave no error");
  if (root->where.line == 0) root->where = {file.generic_string(), 1, 1};
  for (const Override& override : overrides) apply_override(*root, override, diagnostics);
  SetupReader reader(*root, file, registry, diagnostics);
  reader.read();
  diagnostics.throw_errors();
  ReadResult result;
  result.setup = reader.take_setup();
  result.resolved_yaml =
      "# Resolved scenario: includes merged, settings applied, defaults written out, all in SI.\n" +
      emit_yaml(reader.resolved());
  result.warnings = diagnostics.warning_lines();
  return result;
}

}  // namespace dust::scenario
