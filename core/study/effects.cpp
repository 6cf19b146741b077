// SPDX-License-Identifier: Apache-2.0
#include "study/effects.hpp"

#include "base/text.hpp"
#include "study/runner.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <set>

namespace dust::study {
namespace {

/// Values nearer to each other than this, over their size, are the same.
constexpr double k_rounding = 1e-12;

struct Sum {
  double sum = 0.0;
  std::size_t count = 0;
  std::size_t unsteady = 0;
  std::map<std::uint64_t, double> by_seed;
  [[nodiscard]] double mean() const { return sum / static_cast<double>(count); }
};

std::optional<double> value_of(const Results& results, std::size_t point, std::size_t output) {
  const Outcome& outcome = results.outcomes[point];
  if (output >= outcome.outputs.size()) return std::nullopt;
  return outcome.outputs[output].value;
}

/// Levels of the other axes.
using Others = std::vector<std::size_t>;
/// Values of an output, replicates together, by the levels of the other axes.
using ByOthers = std::map<Others, Sum>;

/// What is known of one level of an axis.
struct LevelValues {
  LevelMean head;
  ByOthers by_others;
  std::size_t planned = 0;  ///< runs

  [[nodiscard]] std::size_t known() const {
    std::size_t count = 0;
    for (const auto& [others, sum] : by_others) count += sum.count;
    return count;
  }
};

/// All levels of an input's axis, in the order of the study file.
std::vector<LevelValues> values_of_levels(const Spec& spec, const Results& results,
                                          std::size_t input, std::size_t output) {
  const std::size_t axis = results.plan.inputs[input].axis;
  std::vector<LevelValues> levels(spec.axes[axis].levels.size());
  for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
    const Point& point = results.plan.points[n];
    LevelValues& level = levels[point.levels[axis]];
    level.head.label = point.inputs[input].text;
    level.head.input = point.inputs[input].number;
    level.head.level = point.levels[axis];
    ++level.planned;
    const auto value = value_of(results, n, output);
    if (!value) continue;
    Others others = point.levels;
    others[axis] = 0;
    Sum& sum = level.by_others[others];
    sum.sum += *value;
    ++sum.count;
    sum.by_seed[point.seed] = *value;
    if (is_unsteady(results.outcomes[n].outputs[output])) ++sum.unsteady;
  }
  return levels;
}

/// The combinations of other inputs at which something finished.
std::set<Others> combinations(const std::vector<LevelValues>& levels) {
  std::set<Others> all;
  for (const LevelValues& level : levels) {
    for (const auto& [others, sum] : level.by_others) all.insert(others);
  }
  return all;
}

/// Those of them that every level has.
std::set<Others> common_to(const std::vector<LevelValues>& levels) {
  std::set<Others> common = combinations(levels);
  for (const LevelValues& level : levels) {
    std::erase_if(common, [&](const Others& o) { return !level.by_others.contains(o); });
  }
  return common;
}

/// The mean of a level over these combinations, each counted once.
void take_mean(const LevelValues& level, const std::set<Others>& over,
               const std::optional<Noise>& noise, LevelMean& mean) {
  if (over.empty()) return;
  const auto n = static_cast<double>(over.size());
  double variance = 0.0;
  mean.mean = 0.0;
  for (const Others& others : over) {
    const Sum& sum = level.by_others.at(others);
    mean.mean += sum.mean() / n;
    variance += 1.0 / static_cast<double>(sum.count);
    mean.points += sum.count;
    mean.unsteady += sum.unsteady;
  }
  if (noise && mean.unsteady == 0) mean.error = noise->deviation * std::sqrt(variance) / n;
}

/// Levels at which anything finished, each over the same combinations of the other inputs: else a
/// level at which the heavy ones failed would look light. Of a sample, whose levels are many, those
/// levels are kept that have them all.
std::vector<LevelMean> level_means(std::vector<LevelValues> levels, bool is_scattered,
                                   const std::optional<Noise>& noise) {
  std::erase_if(levels, [](const LevelValues& l) { return l.by_others.empty(); });
  if (is_scattered) {
    const std::size_t all = combinations(levels).size();
    std::erase_if(levels, [&](const LevelValues& l) { return l.by_others.size() < all; });
  }
  const std::set<Others> common = common_to(levels);
  std::vector<LevelMean> means;
  for (const LevelValues& level : levels) {
    means.push_back(level.head);
    take_mean(level, common, noise, means.back());
  }
  return means;
}

struct Change {
  double size = 0.0;
  double error = -1.0;
  double freedom = k_free;
  Coverage coverage;
  std::vector<double> of_others;  ///< one for each combination of the other inputs
};

/// The change of every seed, as the mean over the combinations of the other inputs; nothing unless
/// both levels have the same two seeds or more at each of them.
std::vector<double> changes_by_seed(const LevelValues& from, const LevelValues& to) {
  std::map<std::uint64_t, std::vector<double>> changes;
  std::size_t combinations = 0;
  for (const auto& [others, before] : from.by_others) {
    const auto there = to.by_others.find(others);
    if (there == to.by_others.end()) continue;
    const Sum& after = there->second;
    if (before.by_seed.size() != before.count || after.by_seed.size() != after.count) return {};
    ++combinations;
    for (const auto& [seed, value] : before.by_seed) {
      const auto same = after.by_seed.find(seed);
      if (same == after.by_seed.end()) return {};
      changes[seed].push_back(same->second - value);
    }
    if (after.count != before.count || changes.size() != before.count) return {};
  }
  std::vector<double> means;
  if (changes.size() < 2) return means;
  for (const auto& [seed, values] : changes) {
    if (values.size() != combinations) return {};
    double mean = 0.0;
    for (const double v : values) mean += v / static_cast<double>(combinations);
    means.push_back(mean);
  }
  return means;
}

/// Whether they are the same but for rounding. Counts are, by chance: that tells no error of 0.
bool are_equal(const std::vector<double>& values) {
  const auto [low, high] = std::minmax_element(values.begin(), values.end());
  return *high - *low <= k_rounding * std::max(std::abs(*low), std::abs(*high));
}

/// The error of a change: by what it is for each seed, which both levels begin with and which they
/// share a part of their noise by; else by noise of single runs, `variance` of these; else by its
/// scatter over the other inputs, of three or more.
void take_error(const std::vector<double>& by_seed, const std::optional<Noise>& noise,
                double variance, Change& change) {
  const auto n = static_cast<double>(change.of_others.size());
  if (by_seed.size() > 1 && !are_equal(by_seed)) {
    change.error = error_of_mean(by_seed);
    change.freedom = static_cast<double>(by_seed.size() - 1);
  } else if (noise) {
    change.error = noise->deviation * std::sqrt(variance) / n;
    change.freedom = noise->freedom;
  } else if (change.of_others.size() > 2) {
    change.error = error_of_mean(change.of_others);
    change.freedom = n - 1.0;
  }
  // How far a mean still drifts no scatter knows.
  if (change.coverage.unsteady > 0) change.error = -1.0;
}

/// From one level of an axis to another, over the combinations of the other inputs that both have.
Change change_between(const LevelValues& from, const LevelValues& to,
                      const std::optional<Noise>& noise) {
  Change change;
  double variance = 0.0;
  for (const auto& [others, before] : from.by_others) {
    const auto there = to.by_others.find(others);
    if (there == to.by_others.end()) continue;
    const Sum& after = there->second;
    change.of_others.push_back(after.mean() - before.mean());
    variance += 1.0 / static_cast<double>(before.count) + 1.0 / static_cast<double>(after.count);
    change.coverage.used += before.count + after.count;
    change.coverage.unsteady += before.unsteady + after.unsteady;
  }
  change.coverage.planned = from.planned + to.planned;
  change.coverage.left_out = from.known() + to.known() - change.coverage.used;
  const auto n = static_cast<double>(change.of_others.size());
  for (const double c : change.of_others) change.size += c / n;
  take_error(changes_by_seed(from, to), noise, variance, change);
  return change;
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
  effect.freedom = n - 2.0;
}

/// The points at which all these inputs are held, with what came of them; of a point its levels,
/// inputs and seed alone.
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
      here.seed = point.seed;
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

namespace {

void take_change(const Change& change, MainEffect& effect) {
  effect.change = change.size;
  effect.error = change.error;
  effect.freedom = change.freedom;
  effect.coverage = change.coverage;
}

/// Of a scattered input a line through its levels; of any other the change from its first level to
/// its last. Nothing where fewer than two levels finished.
std::optional<MainEffect> effect_of(const Spec& spec, const Results& results, std::size_t input,
                                    std::size_t output) {
  const InputColumn& column = results.plan.inputs[input];
  const auto noise = noise_of(results, output);
  auto values = values_of_levels(spec, results, input, output);
  if (!column.is_text) {
    std::stable_sort(values.begin(), values.end(), [](const LevelValues& a, const LevelValues& b) {
      return a.head.input < b.head.input;
    });
  }
  MainEffect effect;
  effect.input = input;
  effect.output = output;
  effect.is_scattered = spec.axes[column.axis].kind == AxisKind::samples;
  effect.levels = level_means(values, effect.is_scattered, noise);
  if (effect.levels.size() < 2) return std::nullopt;
  if (effect.is_scattered) {
    fit_line(effect.levels, effect);
    std::size_t known = 0;
    for (const LevelValues& l : values) {
      effect.coverage.planned += l.planned;
      known += l.known();
    }
    for (const LevelMean& l : effect.levels) {
      effect.coverage.used += l.points;
      effect.coverage.unsteady += l.unsteady;
    }
    effect.coverage.left_out = known - effect.coverage.used;
    if (effect.coverage.unsteady > 0) effect.error = -1.0;
    return effect;
  }
  const auto has_value = [](const LevelValues& l) { return !l.by_others.empty(); };
  const auto first = std::find_if(values.begin(), values.end(), has_value);
  const auto last = std::find_if(values.rbegin(), values.rend(), has_value);
  take_change(change_between(*first, *last, noise), effect);
  // Ends at which nothing finished are missing, too.
  for (auto l = values.begin(); l != first; ++l) effect.coverage.planned += l->planned;
  for (auto l = values.rbegin(); l != last; ++l) effect.coverage.planned += l->planned;
  return effect;
}

}  // namespace

std::string coverage_text(const Coverage& coverage) {
  const std::size_t missing = coverage.planned - coverage.used - coverage.left_out;
  if (missing == 0 && coverage.left_out == 0) return {};
  std::string text = std::to_string(missing) + " of " + std::to_string(coverage.planned) +
                     (missing == 1 ? " points is missing" : " points are missing");
  if (coverage.left_out > 0) {
    text += ", " + std::to_string(coverage.left_out) +
            " left out: nothing finished to compare them with";
  }
  return text;
}

std::string unsteady_text(const Coverage& coverage) {
  if (coverage.unsteady == 0) return {};
  return std::to_string(coverage.unsteady) + " of " + std::to_string(coverage.used) +
         " points not steady";
}

bool is_clear(const MainEffect& effect) {
  return effect.error >= 0.0 &&
         std::abs(effect.change) > clear_limit(effect.freedom) * effect.error;
}

std::vector<MainEffect> main_effects(const Spec& spec, const Results& results) {
  std::vector<MainEffect> effects;
  if (spec.axes.empty()) return effects;
  for (std::size_t o = 0; o < results.plan.outputs.size(); ++o) {
    for (std::size_t i = 0; i < results.plan.inputs.size(); ++i) {
      if (auto effect = effect_of(spec, results, i, o)) effects.push_back(std::move(*effect));
    }
  }
  return effects;
}

std::string valueless_text(const Results& results, const std::string& output) {
  std::map<std::string, std::size_t> by_reason;
  for (const Outcome& outcome : results.outcomes) {
    for (std::size_t k = 0; k < outcome.outputs.size(); ++k) {
      const OutputValue& v = outcome.outputs[k];
      if (results.plan.outputs[k].name != output || v.value || v.no_error.empty()) continue;
      ++by_reason[v.no_error];
    }
  }
  std::string text;
  for (const auto& [reason, count] : by_reason) {
    text += (text.empty() ? "" : ", ") + std::to_string(count) + " of " +
            std::to_string(results.outcomes.size()) + " points without a value: " + reason;
  }
  return text;
}

std::string place_text(const Expectation& expectation) {
  std::string text;
  for (const HeldInput& h : expectation.at) {
    text += (text.empty() ? "at " : ", ") + h.path + " " + h.level;
  }
  return text;
}

namespace {

/// The effect an expectation speaks of; between two cases, if it names them. Nothing where points
/// are missing for it.
std::optional<MainEffect> effect_expected(const Expectation& e, const Spec& spec,
                                          const Results& results) {
  const auto effects = main_effects(spec, results);
  const auto found = std::find_if(effects.begin(), effects.end(), [&](const MainEffect& m) {
    return results.plan.outputs[m.output].name == e.output &&
           results.plan.inputs[m.input].name == e.input;
  });
  if (found == effects.end()) return std::nullopt;
  MainEffect effect = *found;
  if (e.from.empty()) return effect;
  const auto levels = values_of_levels(spec, results, effect.input, effect.output);
  const auto level = [&](const std::string& name) {
    return std::find_if(levels.begin(), levels.end(),
                        [&](const LevelValues& l) { return l.head.label == name; });
  };
  const auto from = level(e.from);
  const auto to = level(e.to);
  if (from == levels.end() || to == levels.end()) return std::nullopt;
  take_change(change_between(*from, *to, noise_of(results, effect.output)), effect);
  return effect;
}

/// What the sign of a change says about the one that was expected.
void assess_change(const std::string& then, const MainEffect& effect, const std::string& size,
                   Verdict& verdict) {
  const double wanted = then == "rises" ? 1.0 : -1.0;
  verdict.kind = Verdict::Kind::unresolved;
  if (effect.coverage.unsteady > 0) {
    verdict.text = "open: " + unsteady_text(effect.coverage) + ": " + size;
    return;
  }
  if (effect.change == 0.0) {
    // Both say the same to the last digit: as a rule both say nothing, no grain has come so far.
    verdict.text = "no change: " + size;
    return;
  }
  if (effect.error >= 0.0 && !is_clear(effect)) {
    verdict.text = "not told from noise: " + size;
    const double limit = clear_limit(effect.freedom);
    if (limit > clear_limit(k_free)) {
      verdict.text += ", of so few values " + short_number(limit) + " times the error tells";
    }
    return;
  }
  const bool is_good = wanted * effect.change > 0.0;
  verdict.kind = is_good ? Verdict::Kind::as_expected : Verdict::Kind::against;
  verdict.text = (is_good ? "as expected: " : "against the expectation: ") + size;
  if (effect.error < 0.0) verdict.text += " (no error is known)";
}

}  // namespace

Verdict assess(const Expectation& e, const Spec& spec, const Results& all) {
  Verdict verdict;
  const PointsAt here(e.at, all);
  const Results results{here.plan, here.outcomes};
  const auto found = effect_expected(e, spec, results);
  // Points that have finished may have nothing to tell.
  const std::string valueless = valueless_text(results, e.output);
  verdict.text = valueless.empty() ? "not enough points finished" : "open: " + valueless;
  if (!found) return verdict;
  const std::string coverage = coverage_text(found->coverage);
  if (found->coverage.used == 0) {
    verdict.text += coverage.empty() ? "" : " (" + coverage + ")";
    return verdict;
  }
  verdict.change = found->change;
  verdict.error = found->error;
  const std::string unit = results.plan.outputs[found->output].unit;
  assess_change(e.then, *found, amount_text(verdict.change, verdict.error, unit), verdict);
  if (!coverage.empty()) verdict.text += " (" + coverage + ")";
  return verdict;
}

}  // namespace dust::study
