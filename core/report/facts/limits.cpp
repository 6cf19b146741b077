// SPDX-License-Identifier: Apache-2.0
#include "report/facts/limits.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::report {

namespace {

using nlohmann::json;

enum class Bound { at_most, at_least };

/// An entry of "health" with the range in which the models behind it hold.
struct Rule {
  const char* key;
  Bound bound;
  double value;
};

// Rounding of a ratio computed from lengths in mm shall not cross a limit.
constexpr double k_rounding = 1e-9;

constexpr const char* k_ratio = "largest_diameter_over_spacing";
constexpr const char* k_ratio_limit = "limit_of_diameter_over_spacing";
constexpr const char* k_any_overlap = "largest_overlap_over_radius";
constexpr const char* k_coarse_overlap = "largest_overlap_over_radius_coarse";
constexpr const char* k_fine_overlap = "largest_overlap_over_radius_fine";

constexpr std::array k_rules{Rule{k_ratio, Bound::at_most, 0.5},
                             Rule{"smallest_void_fraction", Bound::at_least, 0.35},
                             Rule{k_any_overlap, Bound::at_most, 0.05},
                             Rule{k_coarse_overlap, Bound::at_most, 0.05},
                             Rule{k_fine_overlap, Bound::at_most, 0.05},
                             Rule{"contacts_seen_late", Bound::at_most, 0.0},
                             Rule{"entries_waiting", Bound::at_most, 0.0},
                             Rule{"largest_momentum_imbalance", Bound::at_most, 1e-9},
                             Rule{"last_courant_number", Bound::at_most, 1.0}};

json limit_of(const Rule& rule, double reached) {
  const double room = k_rounding * std::abs(rule.value);
  const bool is_at_most = rule.bound == Bound::at_most;
  const bool is_touched = is_at_most ? reached > rule.value + room : reached < rule.value - room;
  return {{"key", rule.key},
          {"reached", reached},
          {"bound", is_at_most ? "at_most" : "at_least"},
          {"value", rule.value},
          {"is_touched", is_touched}};
}

/// Width between two walls over the largest diameter; negative where no walls face each other.
double width_over_diameter(const json& report) {
  const json& setting = object_at(report, "setting");
  const json& min = list_at(object_at(setting, "domain"), "min");
  const json& max = list_at(object_at(setting, "domain"), "max");
  double largest = 0.0;
  for (const json& d : list_at(report, "classes")) {
    if (d.is_number()) largest = std::max(largest, d.get<double>());
  }
  const json& sides = list_at(setting, "sides");
  if (!(largest > 0.0) || min.size() != 3 || max.size() != 3 || sides.size() != 6) return -1.0;
  double smallest = -1.0;
  for (std::size_t d = 0; d < 3; ++d) {
    const bool are_walls =
        text_at(sides[2 * d], "grains") == "wall" && text_at(sides[2 * d + 1], "grains") == "wall";
    if (!are_walls || !min[d].is_number() || !max[d].is_number()) continue;
    const double ratio = (max[d].get<double>() - min[d].get<double>()) / largest;
    smallest = smallest < 0.0 ? ratio : std::min(smallest, ratio);
  }
  return smallest;
}

}  // namespace

double crushed_overlap(const RunText& run) {
  const auto reached = number_at(object_at(run.summary, "health"), k_fine_overlap);
  for (const Rule& rule : k_rules) {
    if (std::string(rule.key) == k_fine_overlap && reached && *reached > rule.value)
      return *reached;
  }
  return 0.0;
}

json limits_json(const RunText& run) {
  json limits = json::array();
  const json& health = object_at(run.summary, "health");
  const bool tells_apart = number_at(health, k_fine_overlap).has_value();
  for (const Rule& rule : k_rules) {
    const std::string key = rule.key;
    // The larger of both repeats one of them; runs without fine grains have none to tell of.
    if (key == k_any_overlap && tells_apart) continue;
    if (key == k_fine_overlap && !(number_at(health, k_fine_overlap).value_or(0.0) > 0.0)) continue;
    const auto reached = number_at(health, rule.key);
    if (!reached) continue;
    Rule own = rule;
    // Each voidage rule has its own.
    if (key == k_ratio) own.value = number_at(health, k_ratio_limit).value_or(rule.value);
    limits.push_back(limit_of(own, *reached));
  }
  if (const double ratio = width_over_diameter(run.report); ratio > 0.0) {
    limits.push_back(limit_of({"width_over_diameter", Bound::at_least, 10.0}, ratio));
  }
  return limits;
}

}  // namespace dust::report
