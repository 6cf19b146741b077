// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"
#include "registry/registry.hpp"
#include "scenario/text/values.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dust::scenario {

/// The names a scenario gives to its things, with those that are switched off.
struct Names {
  std::vector<std::string> all;
  std::vector<std::string> disabled;
  [[nodiscard]] int index(const std::string& name) const;
  [[nodiscard]] bool is_disabled(const std::string& name) const;
};

/// All names of a scenario that its parts may refer to.
struct ScenarioNames {
  Names materials, frames, bodies, emitters;
  std::vector<std::string> groups;  ///< of bodies, one entry per body that has one
  static ScenarioNames of(const Node& root);
};

/// A model read from a scenario. `model` is null where something was wrong, and for shapes.
struct ReadModel {
  std::optional<ModelChoice> choice;
  std::unique_ptr<sdk::Model> model;
  std::vector<Entry> written;  ///< its name and all parameters in SI
};

/// Reads models: finds them by name, reads their parameters, checks what these refer to and makes
/// the model once, so that parameters which contradict each other are found too.
class ModelReader {
 public:
  ModelReader(const registry::Registry& registry, const ScenarioNames& names,
              Diagnostics& diagnostics)
      : registry_(registry), names_(names), diagnostics_(diagnostics) {}

  /// The model that `key` of `reader` names; its parameters stand beside it.
  ReadModel read(MapReader& reader, const std::string& key, const std::string& kind,
                 bool is_enabled = true);
  /// As above, where the key may be absent.
  ReadModel read_optional(MapReader& reader, const std::string& key, const std::string& kind);
  /// Checks the names in `values`; false when one is unknown.
  bool check_references(const MapReader& reader, const sdk::ParameterSchema& schema,
                        const std::vector<sdk::Value>& values, bool is_enabled) const;
  /// Gives parameters that name files their full paths; tells those that are not there.
  void find_files(const MapReader& reader, const sdk::ParameterSchema& schema,
                  std::vector<sdk::Value>& values);
  [[nodiscard]] const ScenarioNames& names() const { return names_; }
  /// Full paths of the files that the models read so far name.
  [[nodiscard]] const std::vector<std::string>& files() const { return files_; }

 private:
  bool check_name(const Node& node, const std::string& path, sdk::Refers what,
                  const std::string& name, bool is_enabled) const;

  const registry::Registry& registry_;
  const ScenarioNames& names_;
  Diagnostics& diagnostics_;
  std::vector<std::string> files_;
};

}  // namespace dust::scenario
