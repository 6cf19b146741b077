// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sensor.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dust::model::minimum_fluidisation {

/// One moment of a ramp.
struct Point {
  double velocity = 0.0;  ///< [m/s] superficial
  double pressure = 0.0;  ///< [Pa] lost over the bed
  double height = 0.0;    ///< [m] of the bed
};

/// A straight line fitted by least squares, with what its place is uncertain by.
struct Line {
  double middle = 0.0;  ///< mean of x
  double mean = 0.0;    ///< y there
  double slope = 0.0;
  double variance = 0.0;  ///< of the points about the line
  double spread = 0.0;    ///< sum of (x - middle)^2
  std::size_t count = 0;

  [[nodiscard]] double at(double x) const { return mean + slope * (x - middle); }
  /// Squared standard error of the line at x, for points that are independent of each other.
  [[nodiscard]] double error2(double x) const {
    return variance * (1.0 / static_cast<double>(count) + (x - middle) * (x - middle) / spread);
  }
};

template <class Value>
Line fit(const std::vector<Point>& points, const Value& value) {
  Line line;
  line.count = points.size();
  if (points.empty()) return line;
  for (const Point& p : points) {
    line.middle += p.velocity / static_cast<double>(points.size());
    line.mean += value(p) / static_cast<double>(points.size());
  }
  double product = 0.0;
  for (const Point& p : points) {
    line.spread += (p.velocity - line.middle) * (p.velocity - line.middle);
    product += (p.velocity - line.middle) * (value(p) - line.mean);
  }
  line.slope = line.spread > 0.0 ? product / line.spread : 0.0;
  for (const Point& p : points) {
    const double rest = value(p) - line.at(p.velocity);
    line.variance += rest * rest / std::max(1.0, static_cast<double>(points.size()) - 2.0);
  }
  return line;
}

/// Where two lines cross; no number unless it is found.
struct Crossing {
  bool is_found = false;
  double velocity = sdk::k_no_value;     ///< [m/s]
  double error = sdk::k_nothing_passed;  ///< [m/s] one standard error
};

constexpr std::size_t k_min = 5;  ///< points of a line

inline Crossing crossing(const Line& low, const Line& high) {
  if (low.count < k_min || high.count < k_min || low.slope == high.slope) return {};
  if (!(low.spread > 0.0) || !(high.spread > 0.0)) return {};
  const double velocity = (high.at(0.0) - low.at(0.0)) / (low.slope - high.slope);
  if (!std::isfinite(velocity) || !(velocity > 0.0)) return {};
  const double error =
      std::sqrt(low.error2(velocity) + high.error2(velocity)) / std::abs(low.slope - high.slope);
  return {true, velocity, error};
}

/// What a ramp in one direction shows.
struct Ramp {
  Crossing by_pressure;
  Crossing by_height;
  double plateau = sdk::k_no_value;  ///< [Pa] mean pressure drop of the fluidised bed
};

/// The slowest points, up to the velocity where more than a few of them have reached `pressure`: a
/// bubbling bed swings below it too.
inline std::vector<Point> slow_points(std::vector<Point> points, double pressure) {
  constexpr double k_few = 0.05;
  std::stable_sort(points.begin(), points.end(),
                   [](const Point& a, const Point& b) { return a.velocity < b.velocity; });
  std::size_t above = 0;
  std::size_t packed = 0;
  for (std::size_t n = 0; n < points.size(); ++n) {
    above += points[n].pressure < pressure ? 0 : 1;
    if (static_cast<double>(above) <= k_few * static_cast<double>(n + 1)) packed = n + 1;
  }
  points.resize(packed);
  return points;
}

/// The lines of the packed bed (velocity below `fixed_share` of that at which a first line reaches
/// the plateau) and of the fluidised one (above `fluid_factor` times it), and where they cross. The
/// plateau is first guessed by the median over the fastest fifth of the ramp.
inline Ramp evaluate(const std::vector<Point>& points, double fixed_share, double fluid_factor) {
  Ramp ramp;
  if (points.size() < 2 * k_min) return ramp;
  double slowest = points.front().velocity;
  double fastest = slowest;
  for (const Point& p : points) {
    slowest = std::min(slowest, p.velocity);
    fastest = std::max(fastest, p.velocity);
  }
  std::vector<double> fast;
  for (const Point& p : points) {
    if (p.velocity >= fastest - 0.2 * (fastest - slowest)) fast.push_back(p.pressure);
  }
  std::nth_element(fast.begin(), fast.begin() + static_cast<std::ptrdiff_t>(fast.size() / 2),
                   fast.end());
  const double guess = fast[fast.size() / 2];
  if (!(guess > 0.0)) return ramp;
  const auto pressure = [](const Point& p) { return p.pressure; };
  const auto height = [](const Point& p) { return p.height; };
  std::vector<Point> packed = slow_points(points, fixed_share * guess);
  const Line rough = fit(packed, pressure);
  if (packed.size() < k_min || !(rough.slope > 0.0)) return ramp;
  const double first = rough.middle + (guess - rough.mean) / rough.slope;
  // Chosen by velocity: a choice by a pressure that swings would leave out the upper swings.
  packed.clear();
  for (const Point& p : points) {
    if (p.velocity < fixed_share * first) packed.push_back(p);
  }
  const Line bed = fit(packed, pressure);
  std::vector<Point> fluid;
  for (const Point& p : points) {
    if (p.velocity > fluid_factor * first) fluid.push_back(p);
  }
  const Line plateau = fit(fluid, pressure);
  if (!fluid.empty()) ramp.plateau = plateau.mean;
  // Lines that cross where nothing was measured tell of no change of state: a bed that compacts all
  // the way has two lines of height nearly in one.
  const auto seen = [&](const Crossing& c) {
    return c.velocity >= slowest && c.velocity <= fastest ? c : Crossing{};
  };
  ramp.by_pressure = seen(crossing(bed, plateau));
  ramp.by_height = seen(crossing(fit(packed, height), fit(fluid, height)));
  return ramp;
}

}  // namespace dust::model::minimum_fluidisation
