// SPDX-License-Identifier: Apache-2.0
#include "scenario/reading/model_reader.hpp"

#include "bodies/shape.hpp"
#include "scenario/text/suggest.hpp"

#include <algorithm>
#include <filesystem>
#include <new>

namespace dust::scenario {
namespace {

/// A model or shape as the reader needs it.
struct Offer {
  const sdk::ParameterSchema* parameters = nullptr;
  std::function<std::unique_ptr<sdk::Model>(const std::vector<sdk::Value>&)> make;
};

const bodies::ShapeKind* find_shape(const std::string& name) {
  for (const auto& kind : bodies::shape_catalogue()) {
    if (kind.name == name) return &kind;
  }
  return nullptr;
}

std::optional<Offer> find_offer(const registry::Registry& registry, const std::string& kind,
                                const std::string& name, const std::string& place) {
  if (kind == "shape") {
    const auto* shape = find_shape(name);
    if (shape == nullptr) return std::nullopt;
    return Offer{&shape->parameters, [shape](const std::vector<sdk::Value>& values) {
                   shape->make(values);
                   return std::unique_ptr<sdk::Model>();
                 }};
  }
  const auto* entry = registry.find(kind, name);
  if (entry == nullptr) return std::nullopt;
  return Offer{&entry->info.parameters, [entry, place](const std::vector<sdk::Value>& values) {
                 return registry::make_model(*entry, values, place);
               }};
}

std::vector<std::string> offered(const registry::Registry& registry, const std::string& kind) {
  if (kind != "shape") return registry.names(kind);
  std::vector<std::string> names;
  for (const auto& shape : bodies::shape_catalogue()) names.push_back(shape.name);
  return names;
}

/// "; looked for in A, B": where a model that was not found might have been.
std::string searched(const registry::Registry& registry, const std::string& kind) {
  if (kind == "shape" || registry.folders().empty()) return "";
  std::vector<std::string> folders;
  for (const auto& folder : registry.folders()) folders.push_back(folder.string());
  return "; plugins were looked for in " + listed(folders) +
         " (--plugin-path and DUST_PLUGIN_PATH name more folders)";
}

/// "drag model", "shape", "motion".
std::string noun(const std::string& kind) {
  return kind == "shape" || kind == "motion" ? kind : kind + " model";
}

bool is_default(const sdk::Parameter& parameter, const sdk::Value& value) {
  return !parameter.is_required && parameter.default_value == value;
}

/// Where parameters of a model were given from elsewhere than its name (the command line, a file
/// laid over), the place of the first of them: one that names a file before others.
/// `only_files`: no others. `otherwise` where there is none.
Mark place_of_overrides(const Node& map, const sdk::ParameterSchema& schema, const Mark& otherwise,
                        bool only_files) {
  const Mark* other = nullptr;
  for (const sdk::Parameter& parameter : schema) {
    const Entry* entry = map.find(parameter.name);
    if (entry == nullptr || entry->value.where.file == otherwise.file) continue;
    if (parameter.refers == sdk::Refers::file) return entry->value.where;
    if (other == nullptr) other = &entry->value.where;
  }
  return other == nullptr || only_files ? otherwise : *other;
}

}  // namespace

int Names::index(const std::string& name) const {
  const auto found = std::find(all.begin(), all.end(), name);
  return found == all.end() ? -1 : static_cast<int>(found - all.begin());
}

bool Names::is_disabled(const std::string& name) const {
  return std::find(disabled.begin(), disabled.end(), name) != disabled.end();
}

ScenarioNames ScenarioNames::of(const Node& root) {
  const auto names = [&](const char* key) {
    Names result;
    const Entry* block = root.find(key);
    if (block == nullptr || !block->value.is_map()) return result;
    for (const Entry& entry : block->value.entries) {
      result.all.push_back(entry.key);
      const Entry* enabled = entry.value.find("enabled");
      if (enabled != nullptr && enabled->value.is_word("false")) {
        result.disabled.push_back(entry.key);
      }
    }
    return result;
  };
  std::vector<std::string> groups;
  const Entry* bodies = root.find("bodies");
  if (bodies != nullptr && bodies->value.is_map()) {
    for (const Entry& entry : bodies->value.entries) {
      const Entry* group = entry.value.find("group");
      if (group != nullptr && group->value.is_text()) groups.push_back(group->value.text);
    }
  }
  return {names("materials"), names("frames"), names("bodies"), names("emitters"), groups};
}

bool ModelReader::check_name(const Node& node, const std::string& path, sdk::Refers what,
                             const std::string& name, bool is_enabled) const {
  Names sides;
  sides.all.assign(k_side_names.begin(), k_side_names.end());
  const Names* known = &sides;
  std::string thing = "side";
  switch (what) {
    case sdk::Refers::nothing:
      return true;
    case sdk::Refers::material:
      known = &names_.materials, thing = "material";
      break;
    case sdk::Refers::body:
      known = &names_.bodies, thing = "body";
      break;
    case sdk::Refers::emitter:
      known = &names_.emitters, thing = "emitter";
      break;
    case sdk::Refers::boundary:
      break;
    case sdk::Refers::file:
      return true;
    case sdk::Refers::wall:
      if (sides.index(name) >= 0 && names_.bodies.index(name) >= 0) {
        diagnostics_.error(node.where, path + ": '" + name +
                                           "' is a side of the domain and a body; give the body "
                                           "another name");
        return false;
      }
      sides.all.insert(sides.all.end(), names_.bodies.all.begin(), names_.bodies.all.end());
      sides.all.insert(sides.all.end(), names_.groups.begin(), names_.groups.end());
      sides.disabled = names_.bodies.disabled;
      thing = "wall, body or group";
      break;
  }
  if (known->index(name) < 0) {
    diagnostics_.error(node.where, path + ": there is no " + thing + " '" + printable(name) + "'" +
                                       suggestion(name, known->all, "there are"));
    return false;
  }
  if (is_enabled && known->is_disabled(name)) {
    diagnostics_.error(
        node.where, path + ": the " + thing + " '" + name + "' is switched off (enabled: false)");
    return false;
  }
  return true;
}

void ModelReader::find_files(const MapReader& reader, const sdk::ParameterSchema& schema,
                             std::vector<sdk::Value>& values) {
  namespace fs = std::filesystem;
  for (std::size_t n = 0; n < schema.size(); ++n) {
    const Entry* entry = reader.node().find(schema[n].name);
    auto* text = std::get_if<std::string>(&values[n]);
    if (schema[n].refers != sdk::Refers::file || entry == nullptr || text == nullptr) continue;
    if (is_default(schema[n], values[n])) continue;
    // A value of the command line is seen from the working directory.
    const Mark& where = entry->value.where;
    const fs::path folder = where.line > 0 ? fs::path(where.file).parent_path() : fs::path();
    const fs::path file = fs::absolute(folder / *text).lexically_normal();
    if (!fs::is_regular_file(file)) {
      diagnostics_.error(where,
                         reader.path_of(schema[n].name) + ": there is no file " + file.string());
      continue;
    }
    *text = file.string();
    files_.push_back(*text);
  }
}

bool ModelReader::check_references(const MapReader& reader, const sdk::ParameterSchema& schema,
                                   const std::vector<sdk::Value>& values, bool is_enabled) const {
  bool is_good = true;
  for (std::size_t n = 0; n < schema.size(); ++n) {
    const sdk::Parameter& parameter = schema[n];
    const Entry* entry = reader.node().find(parameter.name);
    if (parameter.refers == sdk::Refers::nothing || entry == nullptr) continue;
    if (is_default(parameter, values[n])) continue;
    const std::string path = reader.path_of(parameter.name);
    if (const auto* text = std::get_if<std::string>(&values[n])) {
      is_good = check_name(entry->value, path, parameter.refers, *text, is_enabled) && is_good;
    } else if (const auto* texts = std::get_if<std::vector<std::string>>(&values[n])) {
      for (std::size_t i = 0; i < texts->size(); ++i) {
        is_good = check_name(entry->value.items[i], path + "[" + std::to_string(i) + "]",
                             parameter.refers, (*texts)[i], is_enabled) &&
                  is_good;
      }
    }
  }
  return is_good;
}

ReadModel ModelReader::read(MapReader& reader, const std::string& key, const std::string& kind,
                            bool is_enabled) {
  const auto names = offered(registry_, kind);
  const std::string available =
      names.empty() ? "no " + kind + " plugin was found; see 'engine plugins' and --plugin-path"
                    : noun(kind) + "s: " + listed(names);
  const Entry* entry = reader.required(key, available);
  if (entry == nullptr) {
    reader.keys_are_unknowable();
    return {};
  }
  const std::string path = reader.path_of(key);
  const Node& name = entry->value;
  if (!name.is_text()) {
    diagnostics_.error(name.where, path + ": the name of a " + noun(kind) + " is expected, not " +
                                       kind_text(name) + " (" + available + ")");
    reader.keys_are_unknowable();
    return {};
  }
  const auto offer =
      find_offer(registry_, kind, name.text, registry::error_prefix(name.where, reader.path()));
  if (!offer) {
    const std::string near = nearest(name.text, names);
    diagnostics_.error(name.where, path + ": unknown " + noun(kind) + " '" + printable(name.text) +
                                       "'" +
                                       (near.empty() ? "" : "; did you mean '" + near + "'?") +
                                       " (" + available + ")" + searched(registry_, kind));
    reader.keys_are_unknowable();
    return {};
  }
  const std::size_t errors_before = diagnostics_.error_count();
  ModelChoice choice{kind, name.text, reader.values(*offer->parameters), reader.path(),
                     place_of_overrides(reader.node(), *offer->parameters, name.where, true)};
  find_files(reader, *offer->parameters, choice.values);
  check_references(reader, *offer->parameters, choice.values, is_enabled);
  ReadModel result;
  result.written.push_back({key, {}, Node::make_text(name.text)});
  for (std::size_t n = 0; n < choice.values.size(); ++n) {
    if (std::holds_alternative<std::monostate>(choice.values[n])) continue;
    result.written.push_back({(*offer->parameters)[n].name, {}, written_value(choice.values[n])});
  }
  if (diagnostics_.error_count() == errors_before) {
    const Mark where = place_of_overrides(reader.node(), *offer->parameters, name.where, false);
    try {
      result.model = offer->make(choice.values);
    } catch (const std::bad_alloc&) {
      diagnostics_.error(where, reader.path() + ": " + kind + "/" + name.text +
                                    " needs more memory with these values than there is: ask "
                                    "for fewer cells, or for less");
    } catch (const std::exception& problem) {
      diagnostics_.error(where, reader.path() + ": " + std::string(problem.what()));
    } catch (...) {
      diagnostics_.error(where, reader.path() + ": " + kind + "/" + name.text +
                                    " throws something that is no std::exception");
    }
  }
  result.choice = std::move(choice);
  return result;
}

ReadModel ModelReader::read_optional(MapReader& reader, const std::string& key,
                                     const std::string& kind) {
  if (reader.optional(key) == nullptr) return {};
  return read(reader, key, kind);
}

}  // namespace dust::scenario
