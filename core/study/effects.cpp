// SPDX-License-Identifier: Apache-2.0
#include "study/effects.hpp"

#include "base/text.hpp"
#include "study/runner.hpp"

#include <algorithm>
#include <cmath>
#include <map>

namespace dust::study {
namespace {

/// An effect below this many standard errors may be noise.
constexpr double k_clear = 2.0;

struct Sum {
  double sum = 0.0;
  std::size_t count = 0;
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

std::optional<double> value_of(const Results& results, std::size_t point, std::size_t output) {
  const Outcome& outcome = results.outcomes[point];
  if (output >= outcome.outputs.size()) return std::nullopt;
  return outcome.outputs[output].value;
}

/// Error of a mean over `count` runs.
double error_of_mean(const std::optional<double>& noise, std::size_t count) {
  return noise && count > 0 ? *noise / std::sqrt(static_cast<double>(count)) : -1.0;
}

double together(double a, double b) { return a < 0.0 || b < 0.0 ? -1.0 : std::hypot(a, b); }

std::vector<LevelMean> level_means(const Spec& spec, const Results& results, std::size_t input,
                                   std::size_t output) {
  const InputColumn& column = results.plan.inputs[input];
  const std::size_t count = spec.axes[column.axis].levels.size();
  std::vector<LevelMean> levels(count);
  std::vector<Sum> sums(count);
  for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
    const Point& point = results.plan.points[n];
    const std::size_t level = point.levels[column.axis];
    levels[level].label = point.inputs[input].text;
    levels[level].input = point.inputs[input].number;
    levels[level].level = level;
    if (const auto value = value_of(results, n, output)) {
      sums[level].sum += *value;
      ++sums[level].count;
    }
  }
  const auto noise = noise_of(results, output);
  std::vector<LevelMean> known;
  for (std::size_t k = 0; k < count; ++k) {
    if (sums[k].count == 0) continue;
    levels[k].mean = sums[k].mean();
    levels[k].points = sums[k].count;
    levels[k].error = error_of_mean(noise, sums[k].count);
    known.push_back(levels[k]);
  }
  if (!column.is_text) {
    std::stable_sort(known.begin(), known.end(),
                     [](const LevelMean& a, const LevelMean& b) { return a.input < b.input; });
  }
  return known;
}

/// Means of an output over replicates at one level of an axis, by the levels of the others.
std::map<std::vector<std::size_t>, Sum> by_other_levels(const Results& results, std::size_t axis,
                                                        std::size_t level, std::size_t output) {
  std::map<std::vector<std::size_t>, Sum> sums;
  for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
    std::vector<std::size_t> others = results.plan.points[n].levels;
    if (others[axis] != level) continue;
    const auto value = value_of(results, n, output);
    if (!value) continue;
    others[axis] = 0;
    Sum& sum = sums[others];
    sum.sum += *value;
    ++sum.count;
  }
  return sums;
}

/// Standard error of the change between two levels of an axis by its scatter over the levels of the
/// others; negative where there are fewer than three that both have.
double scatter_of_change(const Results& results, std::size_t axis, std::size_t output,
                         const LevelMean& from, const LevelMean& to) {
  const auto before = by_other_levels(results, axis, from.level, output);
  const auto after = by_other_levels(results, axis, to.level, output);
  std::vector<double> changes;
  double mean = 0.0;
  for (const auto& [others, sum] : before) {
    const auto there = after.find(others);
    if (there == after.end()) continue;
    changes.push_back(there->second.mean() - sum.mean());
    mean += changes.back();
  }
  if (changes.size() < 3) return -1.0;
  const auto n = static_cast<double>(changes.size());
  mean /= n;
  double squares = 0.0;
  for (const double change : changes) squares += (change - mean) * (change - mean);
  return std::sqrt(squares / (n * (n - 1.0)));
}

struct Change {
  double size = 0.0;
  double error = -1.0;
};

/// From one level of an axis to another: its error by that of the levels, or else by its scatter.
Change change_between(const Results& results, std::size_t axis, std::size_t output,
                      const LevelMean& from, const LevelMean& to) {
  const double error = together(from.error, to.error);
  return {to.mean - from.mean,
          error < 0.0 ? scatter_of_change(results, axis, output, from, to) : error};
}

/// The change along a fitted line over the range of a scattered input, with its standard error.
void fit_line(const std::vector<LevelMean>& levels, MainEffect& effect) {
  const auto n = static_cast<double>(levels.size());
  double mean_x = 0.0;
  double mean_y = 0.0;
  for (const LevelMean& l : levels) {
    mean_x += l.input / n;
    mean_y += l.mean / n;
  }
  double xx = 0.0;
  double xy = 0.0;
  for (const LevelMean& l : levels) {
    xx += (l.input - mean_x) * (l.input - mean_x);
    xy += (l.input - mean_x) * (l.mean - mean_y);
  }
  const double range = levels.back().input - levels.front().input;
  if (!(xx > 0.0)) return;
  const double slope = xy / xx;
  effect.change = slope * range;
  if (levels.size() < 3) return;
  double rest = 0.0;
  for (const LevelMean& l : levels) {
    const double r = l.mean - mean_y - slope * (l.input - mean_x);
    rest += r * r;
  }
  effect.error = std::sqrt(rest / (n - 2.0) / xx) * range;
}

/// The points at which all these inputs are held, with what came of them; of a point its levels and
/// inputs alone.
struct PointsAt {
  Plan plan;
  std::vector<Outcome> outcomes;

  PointsAt(const std::vector<HeldInput>& at, const Results& results)
      : plan{results.plan.inputs, results.plan.outputs, {}} {
    for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
      const Point& point = results.plan.points[n];
      const bool is_held = std::all_of(at.begin(), at.end(), [&](const HeldInput& h) {
        return point.levels[h.axis] == h.index;
      });
      if (!is_held) continue;
      Point& here = plan.points.emplace_back();
      here.inputs = point.inputs;
      here.levels = point.levels;
      outcomes.push_back(results.outcomes[n]);
    }
  }
};

}  // namespace

std::string amount_text(double value, double error, const std::string& unit) {
  std::string text;
  if (error > 0.0 && std::isfinite(error)) {
    // Two digits of the error, and the value cut at the same place.
    const int decimals = std::max(0, 1 - static_cast<int>(std::floor(std::log10(error))));
    text = base::fixed_text(value, decimals) + " +- " + base::fixed_text(error, decimals);
  } else {
    text = short_number(value);
  }
  return unit.empty() || unit == "1" ? text : text + " " + unit;
}

std::optional<double> noise_of(const Results& results, std::size_t output) {
  std::map<std::vector<std::size_t>, std::vector<double>> groups;
  double squares = 0.0;
  std::size_t reported = 0;
  for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
    const auto value = value_of(results, n, output);
    if (!value) continue;
    groups[results.plan.points[n].levels].push_back(*value);
    const double error = results.outcomes[n].outputs[output].error;
    if (error < 0.0) continue;
    squares += error * error;
    ++reported;
  }
  double scatter = 0.0;
  std::size_t freedom = 0;
  for (const auto& [levels, values] : groups) {
    double mean = 0.0;
    for (const double v : values) mean += v / static_cast<double>(values.size());
    for (const double v : values) scatter += (v - mean) * (v - mean);
    freedom += values.size() - 1;
  }
  if (freedom > 0) return std::sqrt(scatter / static_cast<double>(freedom));
  if (reported > 0) return std::sqrt(squares / static_cast<double>(reported));
  return std::nullopt;
}

std::vector<MainEffect> main_effects(const Spec& spec, const Results& results) {
  std::vector<MainEffect> effects;
  if (spec.axes.empty()) return effects;
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    for (std::size_t i = 0; i < results.plan.inputs.size(); ++i) {
      MainEffect effect;
      effect.input = i;
      effect.output = o;
      effect.levels = level_means(spec, results, i, o);
      if (effect.levels.size() < 2) continue;
      const std::size_t axis = results.plan.inputs[i].axis;
      effect.is_scattered = spec.axes[axis].kind == AxisKind::samples;
      if (effect.is_scattered) {
        fit_line(effect.levels, effect);
      } else {
        const Change change =
            change_between(results, axis, o, effect.levels.front(), effect.levels.back());
        effect.change = change.size;
        effect.error = change.error;
      }
      effects.push_back(std::move(effect));
    }
  }
  return effects;
}

std::string place_text(const Expectation& expectation) {
  std::string text;
  for (const HeldInput& h : expectation.at) {
    text += (text.empty() ? "at " : ", ") + h.path + " " + h.level;
  }
  return text;
}

Verdict assess(const Expectation& e, const Spec& spec, const Results& all) {
  Verdict verdict;
  const PointsAt here(e.at, all);
  const Results results{here.plan, here.outcomes};
  const auto effects = main_effects(spec, results);
  const auto found = std::find_if(effects.begin(), effects.end(), [&](const MainEffect& m) {
    return results.plan.outputs[m.output].name == e.output &&
           results.plan.inputs[m.input].name == e.input;
  });
  verdict.text = "not enough points finished";
  if (found == effects.end()) return verdict;
  verdict.change = found->change;
  verdict.error = found->error;
  if (!e.from.empty()) {
    const auto level = [&](const std::string& name) {
      return std::find_if(found->levels.begin(), found->levels.end(),
                          [&](const LevelMean& l) { return l.label == name; });
    };
    const auto from = level(e.from);
    const auto to = level(e.to);
    if (from == found->levels.end() || to == found->levels.end()) return verdict;
    const std::size_t axis = results.plan.inputs[found->input].axis;
    const Change change = change_between(results, axis, found->output, *from, *to);
    verdict.change = change.size;
    verdict.error = change.error;
  }
  const double wanted = e.then == "rises" ? 1.0 : -1.0;
  const std::string unit = results.plan.outputs[found->output].unit;
  const std::string size = amount_text(verdict.change, verdict.error, unit);
  if (verdict.change == 0.0) {
    // Both say the same to the last digit: as a rule both say nothing, no grain has come so far.
    verdict.kind = Verdict::Kind::unresolved;
    verdict.text = "no change: " + size;
    return verdict;
  }
  if (verdict.error >= 0.0 && std::abs(verdict.change) <= k_clear * verdict.error) {
    verdict.kind = Verdict::Kind::unresolved;
    verdict.text = "not told from noise: " + size;
  } else if (wanted * verdict.change > 0.0) {
    verdict.kind = Verdict::Kind::as_expected;
    verdict.text = "as expected: " + size;
  } else {
    verdict.kind = Verdict::Kind::against;
    verdict.text = "against the expectation: " + size;
  }
  if (verdict.error < 0.0) verdict.text += " (no error is known)";
  return verdict;
}

}  // namespace dust::study
