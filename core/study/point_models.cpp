// SPDX-License-Identifier: Apache-2.0
#include "study/point_models.hpp"

#include "base/error.hpp"
#include "io/input_files.hpp"

#include <nlohmann/json.hpp>

#include <filesystem>
#include <fstream>
#include <map>
#include <tuple>

namespace dust::study {
namespace {

/// What a point's run says of itself; null where there is nothing that is gone on with.
nlohmann::json summary_of(const std::filesystem::path& folder) {
  std::ifstream stream(folder / "summary.json", std::ios::binary);
  if (!stream) return nullptr;
  auto json = nlohmann::json::parse(stream, nullptr, false);
  if (!json.is_object() || json.value("status", "") == "failed") return nullptr;
  return json;
}

}  // namespace

void refuse_changed_models(const Plan& plan, const PointStore& store,
                           const registry::Registry& registry) {
  std::map<std::tuple<std::string, std::string, std::string>, std::size_t> changed;
  for (const Point& point : plan.points) {
    const nlohmann::json summary = summary_of(store.results_of(point));
    if (!summary.is_object() || !summary.contains("plugins")) continue;
    for (const auto& plugin : summary["plugins"]) {
      const std::string kind = plugin.value("kind", "");
      const std::string name = plugin.value("name", "");
      const std::string version = plugin.value("version", "");
      const registry::Entry* entry = registry.find(kind, name);
      if (entry != nullptr && entry->info.version != version) ++changed[{kind, name, version}];
    }
  }
  std::string lines;
  for (const auto& [model, points] : changed) {
    const auto& [kind, name, version] = model;
    const registry::Entry& entry = *registry.find(kind, name);
    lines += (lines.empty() ? "error: " : "\nerror: ") + store.folder().string() + ": " +
             std::to_string(points) + (points == 1 ? " point was" : " points were") + " run with " +
             kind + "/" + name + " of version " + version + ", which is " + entry.info.version +
             " here" + (entry.file.empty() ? std::string() : " (" + entry.file.string() + ")") +
             ": one study would mix both; go on with the plugin of version " + version +
             " (--plugin-path), begin again with --force, or give another -o";
  }
  if (!lines.empty()) throw base::UserError(lines);
}

std::vector<std::string> rebuilt_models(const Plan& plan, const PointStore& store,
                                        const registry::Registry& registry) {
  std::map<std::filesystem::path, std::string> libraries;
  std::map<const registry::Entry*, std::size_t> rebuilt;
  for (const Point& point : plan.points) {
    const nlohmann::json summary = summary_of(store.results_of(point));
    if (!summary.is_object() || !summary.contains("plugins")) continue;
    for (const auto& plugin : summary["plugins"]) {
      const std::string then = plugin.value("sha256", "");
      const auto* entry = registry.find(plugin.value("kind", ""), plugin.value("name", ""));
      if (then.empty() || entry == nullptr || entry->is_shipped || entry->file.empty()) continue;
      const auto [library, is_new] = libraries.try_emplace(entry->file);
      if (is_new) library->second = io::content_sha256(entry->file);
      if (library->second != then) ++rebuilt[entry];
    }
  }
  std::vector<std::string> lines;
  for (const auto& [entry, points] : rebuilt) {
    lines.push_back(store.folder().string() + ": " + std::to_string(points) +
                    (points == 1 ? " point was" : " points were") +
                    " run with another library of " + entry->info.kind + "/" + entry->info.name +
                    " " + entry->info.version + " than " + entry->file.string() +
                    ": where its law differs, give it another version and begin again with "
                    "--force");
  }
  return lines;
}

}  // namespace dust::study
