// SPDX-License-Identifier: Apache-2.0
#include "report/facts/run_facts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr double k_closure = 1e-9;  ///< relative; round-off of sums of 1e6 to 1e7 masses in double

struct Cost {
  std::string name;
  double seconds = 0.0;
};

/// The timers, but those of whole groups, whose nodes are listed one by one.
std::vector<Cost> costs_of(const json& timers, const json& groups) {
  std::vector<Cost> costs;
  for (const auto& [key, value] : timers.items()) {
    // A phase that the run has not stands at 0.
    const double seconds = value.is_number() ? value.get<double>() : 0.0;
    if (seconds > 0.0 && !groups.contains(key)) costs.push_back({key, seconds});
  }
  return costs;
}

/// What the particles cost by themselves; nothing where the summary does not say.
std::optional<double> particle_seconds(const json& timers, const json& groups) {
  std::optional<double> sum;
  for (const json& name : list_at(groups, "particles")) {
    if (!name.is_string()) continue;
    const auto time = number_at(timers, name.get<std::string>().c_str());
    if (time) sum = sum.value_or(0.0) + *time;
  }
  return sum;
}

json nodes_json(std::vector<Cost> costs, double wall) {
  std::stable_sort(costs.begin(), costs.end(),
                   [](const Cost& a, const Cost& b) { return a.seconds > b.seconds; });
  double whole = wall;
  for (const Cost& cost : costs) whole = std::max(whole, cost.seconds);
  json nodes = json::array();
  for (const Cost& cost : costs) {
    nodes.push_back({{"name", cost.name},
                     {"seconds", cost.seconds},
                     {"share", whole > 0.0 ? cost.seconds / whole : 0.0}});
  }
  return nodes;
}

json ratio(std::optional<double> above, std::optional<double> below) {
  if (!above || !below || !(*below > 0.0)) return nullptr;
  return *above / *below;
}

}  // namespace

json balance_json(const json& summary) {
  json list = json::array();
  for (const auto& [key, is_exact] :
       {std::pair{"particles", true}, std::pair{"real_particles", false},
        std::pair{"mass_kg", false}}) {
    const json& parts = object_at(summary, key);
    const auto emitted = number_at(parts, "emitted");
    if (!emitted) continue;
    json row = {{"of", key}, {"emitted", *emitted}};
    double difference = *emitted;
    for (const char* part : {"in_domain", "left", "removed"}) {
      const double value = number_at(parts, part).value_or(0.0);
      row[part] = value;
      difference -= value;
    }
    row["difference"] = difference;
    row["is_closed"] =
        is_exact ? difference == 0.0 : std::abs(difference) <= k_closure * std::abs(*emitted);
    list.push_back(std::move(row));
  }
  return list;
}

json references_json(const json& summary) {
  json list = json::array();
  for (json entry : list_at(summary, "references")) {
    const auto ours = number_at(entry, "ours");
    const auto theirs = number_at(entry, "value");
    entry["difference_share"] = nullptr;
    entry["in_errors"] = nullptr;
    if (ours && theirs && *theirs != 0.0) {
      entry["difference_share"] = (*ours - *theirs) / std::abs(*theirs);
    }
    // Without theirs the errors of the difference are not known: ours alone would make much of it.
    const auto their_error = number_at(entry, "uncertainty");
    const double error =
        std::hypot(number_at(entry, "our_uncertainty").value_or(0.0), their_error.value_or(0.0));
    if (ours && theirs && their_error && error > 0.0) {
      entry["in_errors"] = (*ours - *theirs) / error;
    }
    list.push_back(std::move(entry));
  }
  return list;
}

json cost_json(const RunText& run) {
  const auto wall = number_at(run.summary, "wall_s");
  const json& timers = object_at(run.summary, "timers_s");
  const json& groups = object_at(run.summary, "timer_groups");
  std::vector<Cost> costs = costs_of(timers, groups);
  if (!wall && costs.empty()) return nullptr;
  const auto dem_time = particle_seconds(timers, groups);
  // Of a branch what it has done itself.
  const json& start = object_at(run.summary, "start_from");
  const auto own = [&](const char* name, const char* before) {
    auto all = number_at(run.summary, name);
    if (all) *all -= number_at(start, before).value_or(0.0);
    return all;
  };
  const auto steps = own("particle_steps", "particle_steps");
  return {{"wall_per_simulated", ratio(wall, own("simulated_s", "time_s"))},
          {"grain_steps_per_dem_second", ratio(steps, dem_time)},
          {"grain_steps_per_second", ratio(steps, wall)},
          {"air_step_s", ratio(number_at(timers, "fluid"), own("fluid_steps", "fluid_steps"))},
          {"processors_busy", ratio(number_at(run.summary, "cpu_s"), wall)},
          {"nodes", nodes_json(std::move(costs), wall.value_or(0.0))}};
}

}  // namespace dust::report
