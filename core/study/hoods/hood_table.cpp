// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "study/hoods/hood_results.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::study {
namespace {

using Row = std::vector<std::string>;

/// Flows of one table, all in the unit that suits the largest.
class FlowUnit {
 public:
  explicit FlowUnit(const HoodResults& results) {
    // From here on three digits of l/min would be written with a power of ten.
    constexpr double k_large = 0.9995 / 60.0;  // m3/s
    for (const HoodPlace& place : results.places) {
      for (const HoodTrial& trial : place.trials) is_large_ = is_large_ || trial.flow >= k_large;
    }
  }
  [[nodiscard]] std::string text(double flow) const {
    if (!is_large_) return base::digits_text(6e4 * flow, 3) + " l/min";
    const double per_hour = 3600.0 * flow;
    return (per_hour < 100.0 ? base::digits_text(per_hour, 3) : base::fixed_text(per_hour, 0)) +
           " m3/h";
  }

 private:
  bool is_large_ = false;
};

/// "0.12 ± 0.03", both to the second digit of the error.
std::string estimate_text(const Uncertain& estimate, double factor) {
  const double value = factor * estimate.value;
  const double error = factor * estimate.error;
  if (!(estimate.error > 0.0)) return base::digits_text(value, 3);
  const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
  return decimals > 6
             ? base::digits_text(value, 3) + " ± " + base::digits_text(error, 2)
             : base::fixed_text(value, decimals) + " ± " + base::fixed_text(error, decimals);
}

std::string capture_text(const HoodTrial& trial) {
  const auto capture = trial.capture();
  if (!capture) return "no dust seen";
  const bool is_few = trial.computed >= 0.0 && trial.computed < k_few_drawn;
  if (is_few && trial.computed > 0.0) {
    const auto grains = static_cast<int>(std::lround(trial.computed));
    return base::digits_text(100.0 * capture->value, 2) + " % (by " + std::to_string(grains) +
           (grains == 1 ? " grain)" : " grains)");
  }
  return estimate_text(*capture, 100.0) + " %";
}

/// Characters, not bytes: the sign of an error has two.
std::size_t width_of(const std::string& text) {
  return static_cast<std::size_t>(std::count_if(text.begin(), text.end(), [](char c) {
    return (static_cast<unsigned char>(c) & 0xC0) != 0x80;
  }));
}

std::string aligned(const std::vector<Row>& rows) {
  std::vector<std::size_t> widths(rows.front().size(), 0);
  for (const Row& row : rows) {
    for (std::size_t c = 0; c < row.size(); ++c) widths[c] = std::max(widths[c], width_of(row[c]));
  }
  std::string text;
  for (const Row& row : rows) {
    std::string line;
    for (std::size_t c = 0; c < row.size(); ++c) {
      line += row[c];
      if (c + 1 < row.size()) line.append(widths[c] - width_of(row[c]) + 2, ' ');
    }
    text += line.substr(0, line.find_last_not_of(' ') + 1) + '\n';
  }
  return text;
}

std::string needed_text(const HoodPlace& place, double wanted, const FlowUnit& unit) {
  const auto needed = needed_flow(place, wanted);
  if (needed && needed->is_bound) return place.name + ": " + unit.text(needed->flow) + " or less";
  if (needed) return place.name + ": " + unit.text(needed->flow);
  const HoodTrial* best = nullptr;
  for (const HoodTrial& trial : place.trials) {
    const auto capture = trial.capture();
    if (capture && (best == nullptr || capture->value > best->capture()->value)) best = &trial;
  }
  if (best == nullptr) return place.name + ": no dust was seen";
  return place.name + ": not reached (at most " + capture_text(*best) + ", at " +
         unit.text(best->flow) + ")";
}

}  // namespace

std::string hood_table(const HoodResults& results, double wanted) {
  const HoodScale scale(results);
  const FlowUnit unit(results);
  // Hoods that stand there anyway have a column where there are any.
  const bool has_others = results.has_others();
  const std::string unit_text = " [" + scale.unit() + "]";
  std::vector<Row> rows;
  const auto add = [&](Row row, std::string by_others, std::string escapes, std::string capture) {
    if (has_others) row.push_back(std::move(by_others));
    row.push_back(std::move(escapes));
    row.push_back(std::move(capture));
    rows.push_back(std::move(row));
  };
  const auto add_trial = [&](Row row, const HoodTrial& trial, std::string capture) {
    const double factor = scale.factor(trial);
    add(std::move(row), estimate_text(trial.drawn_by_others, factor),
        estimate_text(trial.escaping, factor), std::move(capture));
  };
  add({"place", "flow", "drawn out" + unit_text}, "by other hoods" + unit_text,
      "escapes" + unit_text, has_others ? "capture by all" : "capture");
  if (results.plain) {
    add_trial({"plain", "-", "-"}, *results.plain, has_others ? capture_text(*results.plain) : "-");
  }
  for (const HoodPlace& place : results.places) {
    for (const HoodTrial& trial : place.trials) {
      const std::string drawn = estimate_text(trial.drawn, scale.factor(trial));
      add_trial({place.name, unit.text(trial.flow), drawn}, trial, capture_text(trial));
    }
  }
  std::string text = aligned(rows) + "\nSmallest flow that captures " +
                     base::digits_text(100.0 * wanted, 4) + " % of the dust:\n";
  for (const HoodPlace& place : results.places)
    text += "  " + needed_text(place, wanted, unit) + '\n';
  return text;
}

}  // namespace dust::study
