// SPDX-License-Identifier: Apache-2.0
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::io {

namespace {

using nlohmann::json;

struct Cost {
  std::string name;
  double seconds = 0.0;
};

void collect_costs(const std::string& path, const json& value, std::vector<Cost>& costs) {
  if (value.is_number()) costs.push_back({path, value.get<double>()});
  if (!value.is_object()) return;
  for (const auto& [key, part] : value.items()) {
    // The whole of the DEM nodes, which are listed one by one.
    if (key == "dem_cycle") continue;
    collect_costs(path.empty() ? key : path + "/" + key, part, costs);
  }
}

constexpr double k_small_cost = 0.005;  ///< nodes below this share of the time are one line

void gather_small(std::vector<Cost>& costs, double limit) {
  const auto first = std::find_if(costs.begin(), costs.end(),
                                  [&](const Cost& cost) { return cost.seconds < limit; });
  if (costs.end() - first < 2) return;
  Cost others{std::to_string(costs.end() - first) + " other nodes", 0.0};
  for (auto cost = first; cost != costs.end(); ++cost) others.seconds += cost->seconds;
  costs.erase(first, costs.end());
  costs.push_back(others);
}

}  // namespace

std::string cost_html(const RunText& run) {
  const auto wall = number_at(run.summary, "wall_s");
  const auto simulated = number_at(run.summary, "simulated_s");
  const auto steps = number_at(run.summary, "particle_steps");
  std::vector<Cost> costs;
  collect_costs("", object_at(run.summary, "timers_s"), costs);
  if (costs.empty()) collect_costs("", object_at(run.report, "timers_s"), costs);
  if (!wall && costs.empty()) return {};
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost& a, const Cost& b) { return a.seconds > b.seconds; });
  std::string text = "<section id=\"cost\"><h2>What it cost</h2>\n<dl class=\"tiles small\">\n";
  const auto tile = [&](const char* name, const std::string& value) {
    text += tile_html(name, value);
  };
  const json& timers = object_at(run.summary, "timers_s");
  double dem_time = 0.0;
  for (const char* node : {"contact", "force", "integration", "neighbour"}) {
    dem_time += number_at(timers, node).value_or(0.0);
  }
  if (wall && simulated && *simulated > 0.0) {
    tile("Computing time per simulated second", duration_html(*wall / *simulated));
  }
  if (steps && dem_time > 0.0) {
    tile("Grain-steps per second of DEM time",
         number_html(*steps / dem_time / 1e6, 3) + "\u202f<span class=\"unit\">million</span>");
  } else if (wall && steps && *wall > 0.0) {
    tile("Grain-steps per second", number_html(*steps / *wall, 3));
  }
  const auto fluid_time = number_at(timers, "fluid");
  const auto fluid_steps = number_at(run.summary, "fluid_steps");
  if (fluid_time && fluid_steps && *fluid_steps > 0.0) {
    tile("Air, time per step", quantity_html(*fluid_time / *fluid_steps, -1.0, "s"));
  }
  const auto cpu = number_at(run.summary, "cpu_s");
  if (wall && cpu && *wall > 0.0) {
    const auto threads = number_at(run.summary, "threads");
    tile("Processors busy, on average",
         number_html(*cpu / *wall, 3) + (threads ? " of " + count_html(*threads) : std::string()));
  }
  if (const auto memory = number_at(run.summary, "peak_rss_bytes")) {
    tile("Memory at most", number_html(*memory / 1e6, 4) + "\u202f<span class=\"unit\">MB</span>");
  }
  text += "</dl>\n";
  if (!costs.empty()) {
    const double longest = std::max(costs.front().seconds, 1e-300);
    double whole = wall.value_or(0.0);
    for (const Cost& cost : costs) whole = std::max(whole, cost.seconds);
    gather_small(costs, k_small_cost * whole);
    text +=
        "<div class=\"scroll\"><table class=\"bars\"><thead><tr><th>Node</th><th "
        "class=\"n\">Time</th>"
        "<th class=\"n\">Share of the wall time</th><th "
        "aria-hidden=\"true\"></th></tr></thead>\n<tbody>\n";
    for (const Cost& cost : costs) {
      text += "<tr><th scope=\"row\">" + escape_html(words(cost.name)) + "</th><td class=\"n\">" +
              number_html(cost.seconds, 3) + "\u202fs</td><td class=\"n\">" +
              percent_of_whole(whole > 0.0 ? cost.seconds / whole : 0.0) +
              "\u202f%</td><td class=\"bar\"><i style=\"width:" +
              percent_of_whole(cost.seconds / longest) + "%\"></i></td></tr>\n";
    }
    text +=
        "</tbody></table></div>\n<p class=\"note\">Wall-clock time of each kind of node; nodes "
        "that "
        "run side by side may add up to more than the whole. DEM time is that of contact, force, "
        "integration and neighbour; a grain-step is one grain moved on by one step.</p>\n";
  }
  const std::string graph = text_at(run.report, "graph_dot");
  if (!graph.empty()) {
    text +=
        "<details id=\"graph\"><summary>The task graph with its times</summary><div "
        "id=\"graph-picture\"></div><pre>" +
        escape_html(graph) + "</pre></details>\n";
  }
  return text + "</section>\n";
}

}  // namespace dust::io
