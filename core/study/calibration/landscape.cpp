// SPDX-License-Identifier: Apache-2.0
#include "study/calibration/landscape.hpp"

#include "study/calibration/cloud.hpp"
#include "study/runner.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>

namespace dust::study {
namespace {

/// Places per direction, by the number of parameters: few enough to predict within a second.
constexpr std::size_t k_per_direction[] = {0, 401, 101, 31, 15};
/// The grid tells a density of which it holds as many places as this, counted by their weights, in
/// all and along each direction, and whose best place it comes near: within this of the logarithm.
constexpr double k_enough = 6.0;
constexpr double k_enough_along = 2.0;
constexpr double k_near = 0.5;
/// So many of the grid's best places are looked from for a better one between them.
constexpr std::size_t k_starts = 6;
/// A parameter whose region covers more of its interval than this is not pinned down.
constexpr double k_wide = 0.5;
/// Correlations beyond this make a combination better known than either parameter.
constexpr double k_tied = 0.9;
/// Misfits rarer than this by chance say that the model does not give the goals anywhere.
constexpr double k_unlikely = 0.99;

std::string with_unit(double value, const std::string& unit) {
  return short_number(value) + (unit.empty() || unit == "1" ? "" : " " + unit);
}

double in_units(const Freedom& p, double share) { return p.low + share * (p.high - p.low); }

/// Standard normal quantile (Acklam's rational approximation would be overkill: bisection of erfc).
double normal_quantile(double probability) {
  double low = -10.0;
  double high = 10.0;
  for (int n = 0; n < 80; ++n) {
    const double middle = 0.5 * (low + high);
    (0.5 * std::erfc(-middle / std::sqrt(2.0)) < probability ? low : high) = middle;
  }
  return 0.5 * (low + high);
}

/// Sums over the density: what is needed for means, deviations and correlations.
struct Moments {
  std::vector<double> mean;
  std::vector<std::vector<double>> covariance;
};

Moments moments_of(const WeighedPlaces& l, std::size_t dimensions) {
  Moments m{std::vector<double>(dimensions, 0.0),
            std::vector(dimensions, std::vector<double>(dimensions, 0.0))};
  double total = 0.0;
  for (std::size_t n = 0; n < l.places.size(); ++n) {
    total += l.weight[n];
    for (std::size_t d = 0; d < dimensions; ++d) m.mean[d] += l.weight[n] * l.places[n][d];
  }
  for (double& v : m.mean) v /= total;
  for (std::size_t n = 0; n < l.places.size(); ++n) {
    const double weight = l.weight[n] / total;
    for (std::size_t a = 0; a < dimensions; ++a) {
      for (std::size_t b = 0; b < dimensions; ++b) {
        m.covariance[a][b] += weight * (l.places[n][a] - m.mean[a]) * (l.places[n][b] - m.mean[b]);
      }
    }
  }
  return m;
}

}  // namespace

double chi_square_quantile(double probability, double freedom) {
  const double k = 2.0 / (9.0 * freedom);
  return freedom * std::pow(1.0 - k + normal_quantile(probability) * std::sqrt(k), 3);
}

Fit fit_of(const CalibrationSettings& settings, const std::vector<Prediction>& predictions) {
  Fit fit;
  for (std::size_t g = 0; g < settings.goals.size(); ++g) {
    const double variance =
        settings.goals[g].error * settings.goals[g].error + predictions[g].variance;
    const double miss = predictions[g].mean - settings.goals[g].value;
    fit.misfit += miss * miss / variance;
    fit.minus_log += 0.5 * (miss * miss / variance + std::log(variance));
  }
  return fit;
}

namespace {

/// All places of the grid with what the surrogates say there.
Landscape grid_of(const CalibrationSettings& settings, const Surrogates& surrogates) {
  Landscape l;
  const std::size_t dimensions = settings.parameters.size();
  l.per_direction = k_per_direction[dimensions];
  std::size_t count = 1;
  for (std::size_t d = 0; d < dimensions; ++d) count *= l.per_direction;
  l.predictions.assign(surrogates.size(), std::vector<Prediction>(count));
  for (std::size_t n = 0; n < count; ++n) {
    std::vector<double> place(dimensions);
    std::size_t rest = n;
    for (std::size_t d = 0; d < dimensions; ++d) {
      place[d] =
          static_cast<double>(rest % l.per_direction) / static_cast<double>(l.per_direction - 1);
      rest /= l.per_direction;
    }
    const auto here = predictions_at(surrogates, place);
    for (std::size_t g = 0; g < surrogates.size(); ++g) l.predictions[g][n] = here[g];
    l.places.push_back(std::move(place));
    l.minus_log.push_back(fit_of(settings, here).minus_log);
  }
  return l;
}

/// Looks from the likeliest places for a better one between them.
void refine_best(const CalibrationSettings& settings, const Surrogates& surrogates,
                 const WeighedPlaces& from, double step, Landscape& l) {
  std::vector<std::size_t> order(from.places.size());
  std::iota(order.begin(), order.end(), 0);
  const std::size_t starts = std::min(k_starts, order.size());
  std::partial_sort(
      order.begin(), order.begin() + static_cast<std::ptrdiff_t>(starts), order.end(),
      [&](std::size_t a, std::size_t b) { return from.minus_log[a] < from.minus_log[b]; });
  const auto minus_log_at = [&](const std::vector<double>& place) {
    return fit_of(settings, predictions_at(surrogates, place)).minus_log;
  };
  for (std::size_t n = 0; n < starts; ++n) {
    auto place = refined(settings, surrogates, from.places[order[n]], step);
    if (l.best.empty() || minus_log_at(place) < minus_log_at(l.best)) l.best = std::move(place);
  }
}

/// How many of these count: the square of the weights' sum over the sum of their squares.
double counting(const std::vector<double>& weights) {
  double sum = 0.0;
  double squares = 0.0;
  for (const double weight : weights) {
    sum += weight;
    squares += weight * weight;
  }
  return sum * sum / squares;
}

/// Whether the grid's places are near enough to each other for this density: as a whole, and along
/// every direction.
bool is_fine_enough(const Landscape& l, double least) {
  const double nearest = *std::min_element(l.minus_log.begin(), l.minus_log.end());
  if (nearest - least > k_near) return false;
  std::vector<double> weights;
  for (const double v : l.minus_log) weights.push_back(std::exp(nearest - v));
  if (counting(weights) < k_enough) return false;
  std::size_t stride = 1;
  for (std::size_t d = 0; d < l.best.size(); ++d) {
    std::vector<double> along(l.per_direction, 0.0);
    for (std::size_t n = 0; n < weights.size(); ++n) {
      along[n / stride % l.per_direction] += weights[n];
    }
    if (counting(along) < k_enough_along) return false;
    stride *= l.per_direction;
  }
  return true;
}

/// The level below which the density holds the wanted probability.
double level_of(const WeighedPlaces& l, double confidence) {
  std::vector<std::size_t> order(l.places.size());
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
            [&](std::size_t a, std::size_t b) { return l.minus_log[a] < l.minus_log[b]; });
  double total = 0.0;
  for (const std::size_t n : order) total += l.weight[n];
  double sum = 0.0;
  for (const std::size_t n : order) {
    sum += l.weight[n];
    if (sum >= confidence * total) return l.minus_log[n];
  }
  return l.minus_log[order.back()];
}

}  // namespace

Landscape make_landscape(const CalibrationSettings& settings, const Surrogates& surrogates) {
  Landscape l = grid_of(settings, surrogates);
  const double cell = 1.0 / static_cast<double>(l.per_direction - 1);
  refine_best(settings, surrogates, l, 0.5 * cell, l);
  const auto least_of = [&] {
    return fit_of(settings, predictions_at(surrogates, l.best)).minus_log;
  };
  if (!is_fine_enough(l, least_of())) {
    l.cloud = draw_cloud(settings, surrogates);
    refine_best(settings, surrogates, l.cloud, 0.5 * cell, l);
  }
  const double least = least_of();
  for (double& v : l.minus_log) v -= least;
  for (double& v : l.cloud.minus_log) v -= least;
  for (const double v : l.minus_log) l.weight.push_back(std::exp(-v));
  l.region_level = level_of(l.density(), settings.confidence);
  return l;
}

std::size_t pieces_of_region(const Landscape& l, std::size_t dimensions) {
  std::vector<bool> is_open(l.places.size());
  for (std::size_t n = 0; n < is_open.size(); ++n) is_open[n] = l.minus_log[n] <= l.region_level;
  std::size_t pieces = 0;
  std::vector<std::size_t> stack;
  for (std::size_t start = 0; start < is_open.size(); ++start) {
    if (!is_open[start]) continue;
    ++pieces;
    is_open[start] = false;
    stack.push_back(start);
    while (!stack.empty()) {
      const std::size_t at = stack.back();
      stack.pop_back();
      std::size_t stride = 1;
      for (std::size_t d = 0; d < dimensions; ++d) {
        const std::size_t along = at / stride % l.per_direction;
        if (along > 0 && is_open[at - stride]) {
          is_open[at - stride] = false;
          stack.push_back(at - stride);
        }
        if (along + 1 < l.per_direction && is_open[at + stride]) {
          is_open[at + stride] = false;
          stack.push_back(at + stride);
        }
        stride *= l.per_direction;
      }
    }
  }
  return pieces;
}

namespace {

/// Ends of the region along a direction, in shares of the interval.
std::pair<double, double> ends_of_region(const Landscape& l, std::size_t d) {
  const WeighedPlaces& density = l.density();
  double low = l.best[d];
  double high = l.best[d];
  for (std::size_t n = 0; n < density.places.size(); ++n) {
    if (density.minus_log[n] > l.region_level) continue;
    low = std::min(low, density.places[n][d]);
    high = std::max(high, density.places[n][d]);
  }
  // A cell of the grid belongs to the region as a whole; the outermost of a thousand places lie
  // about a hundredth of the width within it.
  const double margin =
      l.cloud.places.empty() ? 0.5 / static_cast<double>(l.per_direction - 1) : 0.01 * (high - low);
  return {std::max(0.0, low - margin), std::min(1.0, high + margin)};
}

void estimate(const CalibrationSettings& settings, Calibration& c) {
  const Landscape& l = c.landscape;
  const std::size_t dimensions = settings.parameters.size();
  const Moments moments = moments_of(l.density(), dimensions);
  c.estimates.assign(dimensions, {});
  for (std::size_t d = 0; d < dimensions; ++d) {
    const Freedom& p = settings.parameters[d];
    const auto [low, high] = ends_of_region(l, d);
    c.estimates[d] = {in_units(p, l.best[d]),
                      in_units(p, moments.mean[d]),
                      std::sqrt(moments.covariance[d][d]) * (p.high - p.low),
                      in_units(p, low),
                      in_units(p, high),
                      high - low < k_wide && low > 0.0 && high < 1.0};
  }
  c.correlation.assign(dimensions, std::vector<double>(dimensions, 1.0));
  for (std::size_t a = 0; a < dimensions; ++a) {
    for (std::size_t b = 0; b < dimensions; ++b) {
      const double scale = std::sqrt(moments.covariance[a][a] * moments.covariance[b][b]);
      c.correlation[a][b] = scale > 0.0 ? moments.covariance[a][b] / scale : 0.0;
    }
  }
  c.misfit = fit_of(settings, c.at_best).misfit;
  c.is_met =
      c.misfit <= chi_square_quantile(k_unlikely, static_cast<double>(settings.goals.size()));
  c.is_pinned = std::all_of(c.estimates.begin(), c.estimates.end(),
                            [](const Estimate& e) { return e.is_pinned; });
}

void print_misfit(const CalibrationSettings& settings, Calibration& c) {
  std::string text = "No values in the given ranges meet the targets";
  for (std::size_t g = 0; g < settings.goals.size(); ++g) {
    const Goal& goal = settings.goals[g];
    text += (g == 0 ? ": at the nearest, " : "; ") + goal.name + " is " +
            with_unit(c.at_best[g].mean, goal.unit) + " instead of " +
            with_unit(goal.value, goal.unit) + " +- " + with_unit(goal.error, goal.unit);
  }
  c.statements.push_back(text + ". Widen the ranges, free another parameter, or doubt the model.");
}

/// Where the values that the answer rests on tell no errors, or have not settled.
void print_run_errors(const CalibrationSettings& settings, Calibration& c) {
  for (std::size_t g = 0; g < c.run_errors.size(); ++g) {
    const RunErrors& e = c.run_errors[g];
    const std::string of = " of " + std::to_string(e.points) + " points";
    if (e.unsteady > 0) {
      c.statements.push_back(settings.goals[g].name + " is not steady in " +
                             std::to_string(e.unsteady) + of +
                             ": it may still change by more than it scatters. "
                             "Observe longer.");
    }
    if (e.without > 0) {
      c.statements.push_back(settings.goals[g].name + " has no error in " +
                             std::to_string(e.without) + of +
                             ": what they scatter about the surrogate stands for "
                             "it.");
    }
  }
}

void print_parameters(const CalibrationSettings& settings, Calibration& c) {
  const std::string percent = short_number(100.0 * settings.confidence) + " %";
  for (std::size_t d = 0; d < settings.parameters.size(); ++d) {
    const Freedom& p = settings.parameters[d];
    const Estimate& e = c.estimates[d];
    const std::string interval =
        short_number(e.low) + " to " + with_unit(e.high, p.unit) + " (" + percent + ")";
    if (e.is_pinned) {
      c.statements.push_back(p.name + " = " + with_unit(e.best, p.unit) + ", from " + interval +
                             ".");
      continue;
    }
    const bool is_low = e.low <= p.low;
    const bool is_high = e.high >= p.high;
    std::string text = "The targets do not pin down " + p.name + ": " + interval + " fits";
    if (is_low && is_high) {
      text += ", the whole range";
    } else if (is_low || is_high) {
      text += std::string(", up to the ") + (is_low ? "lower" : "upper") +
              " end of the range; what lies beyond was not tried";
    }
    c.statements.push_back(text + ".");
  }
}

}  // namespace

void conclude(const CalibrationSettings& settings, Calibration& c) {
  c.statements.clear();
  estimate(settings, c);
  if (!c.is_met) {
    print_misfit(settings, c);
    print_run_errors(settings, c);
    return;
  }
  print_parameters(settings, c);
  print_run_errors(settings, c);
  const std::size_t dimensions = settings.parameters.size();
  for (std::size_t a = 0; a < dimensions; ++a) {
    for (std::size_t b = 0; b < a; ++b) {
      if (std::abs(c.correlation[a][b]) < k_tied) continue;
      c.statements.push_back(
          settings.parameters[b].name + " and " + settings.parameters[a].name +
          " are tied (correlation " + short_number(c.correlation[a][b]) +
          "): the targets know a combination of them better than either; another target would "
          "part them.");
    }
  }
  const bool is_drawn = !c.landscape.cloud.places.empty();
  const std::size_t pieces = is_drawn ? 1 : pieces_of_region(c.landscape, dimensions);
  if (is_drawn) {
    c.statements.push_back(
        "The region is narrower than a grid of " + std::to_string(c.landscape.per_direction) +
        " places per direction: it is told by " + std::to_string(c.landscape.cloud.places.size()) +
        " places drawn from it, and not whether it has separate pieces.");
  }
  if (pieces > 1) {
    c.statements.push_back("The region has " + std::to_string(pieces) +
                           " separate pieces: different sets of values fit.");
  }
  std::string text = "At the likeliest values";
  for (std::size_t d = 0; d < dimensions; ++d) {
    const Freedom& p = settings.parameters[d];
    text += (d == 0 ? " (" : ", ") + p.name + " = " + with_unit(c.estimates[d].best, p.unit);
  }
  for (std::size_t g = 0; g < settings.goals.size(); ++g) {
    const Goal& goal = settings.goals[g];
    text += (g == 0 ? ") " : ", ") + goal.name + " is expected at " +
            with_unit(c.at_best[g].mean, goal.unit) + " (target " +
            with_unit(goal.value, goal.unit) + " +- " + with_unit(goal.error, goal.unit) + ")";
  }
  c.statements.push_back(text + ".");
}

}  // namespace dust::study
