// SPDX-License-Identifier: Apache-2.0
#include "scenario/reading/reading.hpp"

#include "scenario/reader.hpp"

#include <algorithm>

namespace dust::scenario {

bool is_name(const std::string& text) {
  const auto is_letter = [](char c) { return (c >= 'a' && c <= 'z') || (c >= 'A' && c <= 'Z'); };
  return !text.empty() && (is_letter(text.front()) || text.front() == '_') &&
         std::all_of(text.begin(), text.end(), [&](char c) {
           return is_letter(c) || (c >= '0' && c <= '9') || c == '_' || c == '-';
         });
}

std::string name_from_file(const std::filesystem::path& file) {
  std::string name = file.stem().string();
  for (char& c : name) {
    if (!is_name(std::string("a") + c)) c = '_';
  }
  return is_name(name) ? name : "scenario_" + name;
}

Reading::Reading(const Node& root_node, const std::filesystem::path& scenario_file,
                 const registry::Registry& models_known, Diagnostics& problems)
    : root(root_node),
      file(scenario_file),
      registry(models_known),
      diagnostics(problems),
      names(ScenarioNames::of(root)),
      models(registry, names, diagnostics) {
  const Entry* fluid = root.find("fluid");
  has_fluid = fluid != nullptr && !fluid->value.is_word("none");
}

void append(Node& map, std::vector<Entry> entries) {
  for (Entry& e : entries) map.entries.push_back(std::move(e));
}

Mark mark_of(const Node& map, const char* key) {
  const Entry* entry = map.find(key);
  return entry == nullptr ? map.where : entry->value.where;
}

ReadModel read_part(Reading& reading, MapReader& reader, const std::string& key, bool is_required,
                    Node& written) {
  const Entry* entry = is_required ? reader.required(key, "{model: ...}") : reader.optional(key);
  if (entry == nullptr) return {};
  MapReader inner =
      MapReader::of_model(entry->value, reader.path_of(key), entry->where, reading.diagnostics);
  if (!entry->value.is_map()) return {};
  ReadModel model = reading.models.read(inner, "model", key);
  inner.finish();
  Node map = Node::make_map();
  append(map, model.written);
  add(written, key, std::move(map));
  return model;
}

}  // namespace dust::scenario
