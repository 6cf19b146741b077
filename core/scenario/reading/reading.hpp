// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/reading/model_reader.hpp"
#include "scenario/references.hpp"
#include "scenario/text/suggest.hpp"
#include "setup/dust_setup.hpp"
#include "setup/reference_curve.hpp"
#include "setup/reference_spec.hpp"
#include "setup/setup.hpp"
#include "setup/start_setup.hpp"

#include <filesystem>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dust::scenario {

/// Letters, digits, '_' and '-', beginning with a letter or '_'.
bool is_name(const std::string& text);

/// One reading of a merged tree: what the readers of its blocks (block_readers.hpp) look at, and
/// what they have made of it so far.
struct Reading {
  Reading(const Node& root, const std::filesystem::path& file, const registry::Registry& registry,
          Diagnostics& diagnostics);
  Reading(const Reading&) = delete;
  Reading& operator=(const Reading&) = delete;

  void error(const Mark& where, const std::string& text) const { diagnostics.error(where, text); }

  const Node& root;
  const std::filesystem::path& file;
  const registry::Registry& registry;
  Diagnostics& diagnostics;
  ScenarioNames names;
  ModelReader models;
  bool has_fluid = false;             ///< the scenario asks for one
  bool has_domain = false;            ///< its corners are understood
  bool pairs_are_read = true;         ///< all that is said of pairs of materials is understood
  std::vector<std::string> bridging;  ///< materials whose moisture makes liquid bridges

  // Models that later blocks ask.
  std::vector<std::unique_ptr<sdk::Model>> emitters;
  std::unique_ptr<sdk::Model> voidage;
  std::vector<SensorFigures> figures;

  Setup setup;
  DustSetup dust;
  StartSetup start;
  std::vector<ReferenceSpec> references;
  std::vector<ReferenceCurve> reference_curves;
  Node written = Node::make_map();  ///< the resolved tree
};

/// Values of a block as its struct; wrong ones keep their initial value, the problem is told.
template <class Block>
Block block(MapReader& reader, std::vector<sdk::Value>* values_out = nullptr) {
  auto values = reader.values(Block::schema());
  Block result = sdk::parameters_from<Block>(Block::schema(), values);
  if (values_out != nullptr) *values_out = std::move(values);
  return result;
}

/// A block as the resolved tree has it.
template <class Block>
Node written_block(const std::vector<sdk::Value>& values) {
  Node map = Node::make_map();
  for (std::size_t n = 0; n < values.size(); ++n) {
    add(map, Block::schema()[n].name, written_value(values[n]));
  }
  return map;
}

void append(Node& map, std::vector<Entry> entries);

/// Where a key of `map` stands, or the map itself where there is none.
Mark mark_of(const Node& map, const char* key);

/// Calls `each(entry, path)` for all things of a block of names.
template <class Each>
void for_each_named(const Reading& reading, MapReader& top, const std::string& key, Each each) {
  const Entry* entry = top.optional(key);
  if (entry == nullptr) return;
  if (!entry->value.is_map()) {
    reading.error(entry->value.where,
                  key + ": a map of names is expected, not " + kind_text(entry->value));
    return;
  }
  for (const Entry& thing : entry->value.entries) {
    const std::string path = key + "." + printable(thing.key);
    if (!is_name(thing.key)) {
      reading.error(thing.where, path + ": a name consists of letters, digits, '_' and '-' and " +
                                     "begins with a letter");
    }
    each(thing, path);
  }
}

/// A part of a block that is a model of the kind of the part's name: `drag: {model: ...}`.
ReadModel read_part(Reading& reading, MapReader& reader, const std::string& key, bool is_required,
                    Node& written);

/// Material and frame of a body or emitter.
struct Placed {
  bool is_enabled = true;
  int material = -1;
  int frame = -1;
  Node written = Node::make_map();
};
Placed read_placed(Reading& reading, MapReader& reader);

}  // namespace dust::scenario
