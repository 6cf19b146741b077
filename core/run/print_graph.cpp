// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "preflight/reader.hpp"
#include "run/run_options.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <nlohmann/json.hpp>

#include <cstdio>
#include <fstream>

namespace dust::run {

int print_graph(const RunOptions& options, const std::optional<std::filesystem::path>& run_folder) {
  if (run_folder) {
    std::ifstream file(*run_folder / "report.json");
    const auto json = nlohmann::json::parse(file, nullptr, false);
    if (json.is_discarded() || !json.contains("graph_dot")) {
      throw base::UserError("error: " + run_folder->string() +
                            " holds no report.json of a run; give the folder of a run that ended");
    }
    std::fputs(json["graph_dot"].get<std::string>().c_str(), stdout);
    return 0;
  }
  registry::Registry registry;
  registry.load(registry::Registry::search_path(options.plugin_path));
  const auto read =
      preflight::read_scenario(options.scenario, options.overrides, registry, options.set_files);
  const Simulation simulation(read.setup, make_models(read.setup, registry, read.dust), 0,
                              read.dust);
  std::fputs(graph_dot(simulation).c_str(), stdout);
  return 0;
}

}  // namespace dust::run
