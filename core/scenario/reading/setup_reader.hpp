// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/blocks.hpp"
#include "scenario/reading/model_reader.hpp"
#include "scenario/reference_curves.hpp"
#include "scenario/references.hpp"
#include "scenario/text/suggest.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"
#include "setup/start_setup.hpp"

#include <array>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace dust::scenario {

/// Letters, digits, '_' and '-', beginning with a letter or '_'.
bool is_name(const std::string& text);

/// Reads a merged tree into a Setup and, side by side, into the resolved tree. Each file
/// read_*.cpp holds the blocks of one subject.
class SetupReader {
 public:
  SetupReader(const Node& root, const std::filesystem::path& file,
              const registry::Registry& registry, Diagnostics& diagnostics)
      : root_(root),
        file_(file),
        registry_(registry),
        diagnostics_(diagnostics),
        names_(ScenarioNames::of(root)),
        models_(registry, names_, diagnostics) {
    const Entry* fluid = root.find("fluid");
    has_fluid_ = fluid != nullptr && !fluid->value.is_word("none");
  }

  void read();
  Setup take_setup() { return std::move(setup_); }
  DustSetup take_dust() { return std::move(dust_); }
  StartSetup take_start() { return std::move(start_); }
  std::vector<ReferenceSpec> take_references() { return std::move(references_.numbers); }
  std::vector<ReferenceCurve> take_reference_curves() { return std::move(references_.curves); }
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

  void read_general(MapReader& top);
  void read_time(MapReader& top);
  void read_start(MapReader& top);
  void read_domain(MapReader& top);
  Node read_sides(const Entry& entry);
  Node read_side(const Entry& entry, std::size_t n, bool& is_read, bool& has_air,
                 bool& is_air_periodic);

  void note_opening(int side, const std::optional<ModelChoice>& air);

  void read_materials(MapReader& top);
  void read_interactions(MapReader& top);
  Node read_interaction(const Node& node, const std::string& path);
  /// Does the cohesive law fit the materials and the contact law?
  void check_laws(const InteractionSpec& spec, const ReadModel& contact, const ReadModel& cohesion);
  void read_emitters(MapReader& top);

  void read_frames(MapReader& top);
  /// Material and frame of a body or emitter.
  struct Placed {
    bool is_enabled = true;
    int material = -1;
    int frame = -1;
    Node written = Node::make_map();
  };
  Placed read_placed(MapReader& reader);
  /// `motion: NAME` with its parameters beside it, or `motions:` with a list of models.
  std::vector<ReadModel> read_motions(MapReader& reader, Node& written);
  std::optional<SuctionSpec> read_suction(MapReader& reader, Node& written);
  std::optional<RemovalSpec> read_removal(MapReader& reader, Node& written);
  /// What only the made body knows.
  void check_body(const BodySpec& spec, std::vector<ReadModel> motions);
  void read_bodies(MapReader& top);

  void read_fluid(MapReader& top);
  Node read_region(const Entry& entry, const std::string& path, FluidSpec& spec);
  void check_region(const Entry& entry, const std::string& path, const RegionBlock& region);
  void read_coupling(MapReader& top);
  void check_disturbance_correction(Mark where);
  /// `coupling.resolved`: spheres whose flow the grid resolves.
  void read_resolved(const CouplingBlock& coupling, const Entry* entry);
  void check_resolved();
  [[nodiscard]] bool is_resolved(const EmitterSpec& emitter) const;
  void read_drag_and_voidage(MapReader& top);
  void read_fluid_forces(MapReader& top);
  /// A rule of the void fraction is valid up to a size of grains relative to the cells.
  void check_voidage();

  void read_sensors(MapReader& top);
  /// Accounts that the run keeps.
  void read_audit(MapReader& top);
  void check_audit();
  /// What counts as dust, by size and material, and through what it gets out.
  void read_dust(MapReader& top);
  DustSpec dust_spec_of(const Entry& entry, const DustBlock& read, bool has_field);
  /// Of the sensors that `dust.openings` lists those that take part.
  std::vector<std::string> enabled_openings(const Node& node,
                                            const std::vector<std::string>& sensors);
  std::vector<std::string> known_hoods(const Node& node, const std::vector<std::string>& hoods);
  void check_dust_is_emitted(const Mark& where);
  /// `dust.field`: concentrations on the fluid's grid.
  void read_dust_field(MapReader& dust, Node& written);
  Node read_clouds(MapReader& field, DustFieldSpec& spec);
  Node read_dust_sources(MapReader& field, DustFieldSpec& spec);
  void check_dust_field(const Node& node, const DustFieldSpec& spec);
  /// `dust.liberation`: how the dust on grains becomes airborne.
  void read_liberation(MapReader& dust, Node& written);
  /// `dust_load` and `moisture` of materials, against field and law; of a law that could not be
  /// read all is told already.
  void check_dust_loads(const sdk::Model* law, bool is_law_read = true);
  /// A part of a block that is a model of the kind of the part's name: `drag: {model: ...}`.
  ReadModel read_part(MapReader& reader, const std::string& key, bool is_required, Node& written);
  /// Some contradictions need the density of the grains: an empty interval makes emitters look.
  void check_emitters();
  /// Two grains must not touch through both sides at once: a pair of grains has one contact.
  void check_periods();

  const Node& root_;
  const std::filesystem::path& file_;
  const registry::Registry& registry_;
  Diagnostics& diagnostics_;
  ScenarioNames names_;
  ModelReader models_;
  bool has_fluid_ = false;
  bool pairs_are_read_ = true;
  std::vector<std::unique_ptr<sdk::Model>> emitters_;
  std::unique_ptr<sdk::Model> voidage_;
  std::vector<SensorFigures> figures_;
  struct {
    std::vector<ReferenceSpec> numbers;
    std::vector<ReferenceCurve> curves;
  } references_;
  Setup setup_;
  DustSetup dust_;
  StartSetup start_;
  Node out_ = Node::make_map();
};

}  // namespace dust::scenario
