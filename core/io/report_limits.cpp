// SPDX-License-Identifier: Apache-2.0
#include "io/report_limits.hpp"

#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::io {

namespace {

using nlohmann::json;

enum class Bound { at_most, at_least };

/// An entry of "health" with the range in which the models behind it hold.
struct Rule {
  const char* key;
  const char* name;
  Bound bound;
  double value;
  const char* consequence;
};

// Rounding of a ratio computed from lengths in mm shall not cross a limit.
constexpr double k_rounding = 1e-9;

constexpr const char* k_ratio = "largest_diameter_over_spacing";
constexpr const char* k_ratio_limit = "limit_of_diameter_over_spacing";
constexpr const char* k_any_overlap = "largest_overlap_over_radius";
constexpr const char* k_coarse_overlap = "largest_overlap_over_radius_coarse";
constexpr const char* k_fine_overlap = "largest_overlap_over_radius_fine";

constexpr std::array k_rules{
    Rule{k_ratio, "Largest diameter over cell spacing, D/dx", Bound::at_most, 0.5,
         "Volumes spread over cells need cells of two diameters; above, the void fraction of a "
         "cell is noise. Use larger cells or a voidage rule for large grains."},
    Rule{"smallest_void_fraction", "Smallest void fraction of a cell", Bound::at_least, 0.35,
         "Drag laws are fitted down to a random packing (about 0.36); below, they extrapolate."},
    Rule{k_any_overlap, "Largest overlap over the smaller radius", Bound::at_most, 0.05,
         "Contact laws hold for small overlaps: grains are softer here than real ones, and a small "
         "grain pressed by a large one sinks in. Raise the Young's modulus, or check what the "
         "smallest class does in contact."},
    Rule{k_coarse_overlap, "Largest overlap over the smaller radius, coarse grains", Bound::at_most,
         0.05,
         "Contact laws hold for small overlaps, and grains are softer here than real ones: raise "
         "the Young's modulus, or see that the speeds met are those expected."},
    Rule{k_fine_overlap, "Largest overlap over the smaller radius, fine grains", Bound::at_most,
         0.05, "Fine grains are crushed between coarse ones: see below what that does."},
    Rule{"contacts_seen_late", "Contacts between grains that began unseen", Bound::at_most, 0.0,
         "Somebody was thrown farther off its course than the lists foresee, and its first overlap "
         "counted from the step it was seen at. Shorten the DEM step."},
    Rule{"entries_waiting", "Grains that never found room to enter", Bound::at_most, 0.0,
         "The feed is denser than its opening allows: less came than asked."},
    Rule{"largest_momentum_imbalance", "Largest momentum imbalance, grains and air", Bound::at_most,
         1e-9, "What grains lose, the air must gain, to rounding."},
    Rule{"last_courant_number", "Courant number at the end", Bound::at_most, 1.0,
         "The flow crosses more than a cell in a sub-step."},
};

Limit limit_of(const Rule& rule, double reached) {
  const double room = k_rounding * std::abs(rule.value);
  const bool is_touched =
      rule.bound == Bound::at_most ? reached > rule.value + room : reached < rule.value - room;
  const std::string valid =
      rule.value == 0.0 ? std::string("none")
                        : std::string(rule.bound == Bound::at_most ? "at most " : "at least ") +
                              number_html(rule.value, 3);
  return {rule.name, reached, valid, is_touched, rule.consequence};
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

bool is_limit_key(const std::string& key) {
  return std::any_of(k_rules.begin(), k_rules.end(),
                     [&](const Rule& rule) { return key == rule.key; });
}

double crushed_overlap(const RunText& run) {
  const auto reached = number_at(object_at(run.summary, "health"), k_fine_overlap);
  for (const Rule& rule : k_rules) {
    if (std::string(rule.key) == k_fine_overlap && reached && *reached > rule.value)
      return *reached;
  }
  return 0.0;
}

std::vector<Limit> limits_of(const RunText& run) {
  std::vector<Limit> limits;
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
    limits.push_back(
        limit_of({"", "Width between walls over largest diameter, W/D", Bound::at_least, 10.0,
                  "Closer walls carry part of the load and shape the packing."},
                 ratio));
  }
  return limits;
}

}  // namespace dust::io
