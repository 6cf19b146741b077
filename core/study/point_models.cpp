// SPDX-License-Identifier: Apache-2.0
#include "study/point_models.hpp"

#include "base/error.hpp"

#include <nlohmann/json.hpp>

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

}  // namespace dust::study
