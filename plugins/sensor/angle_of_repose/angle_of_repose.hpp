// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <span>
#include <unordered_map>
#include <vector>

namespace dust::model::angle_of_repose {

/// A grain of the free surface: how far down the slope, how high its top, and in which strip or
/// sector it lies.
struct SurfacePoint {
  double along = 0.0;   ///< [m]
  double height = 0.0;  ///< [m]
  int sector = 0;
};

/// Strips (planar) or sectors (conical, crater) that are fitted one by one for the uncertainty.
inline constexpr int k_sectors = 8;

/// The highest grain over each cell of a level grid. Cells of equal area see equally many grains,
/// so that the noise of the highest one is the same all over the slope; taking that grain's own
/// place, not the cell's, leaves no shift towards the upper edge.
class FreeSurface {
 public:
  explicit FreeSurface(double edge) : edge_(edge) {}
  /// `u`, `v` [m]: place in the level plane.
  void add(double u, double v, const SurfacePoint& point) {
    const auto i = static_cast<std::int64_t>(std::floor(u / edge_));
    const auto j = static_cast<std::int64_t>(std::floor(v / edge_));
    const auto key =
        static_cast<std::uint64_t>(i + (1 << 30)) << 32 | static_cast<std::uint64_t>(j + (1 << 30));
    const auto [at, is_new] = place_.try_emplace(key, points_.size());
    if (is_new) {
      points_.push_back(point);
    } else if (point.height > points_[at->second].height) {
      points_[at->second] = point;
    }
  }
  [[nodiscard]] const std::vector<SurfacePoint>& points() const { return points_; }

 private:
  double edge_;
  std::unordered_map<std::uint64_t, std::size_t> place_;
  std::vector<SurfacePoint> points_;
};

/// Fewer grains have no line.
inline constexpr std::size_t k_min_points = 3;

/// height = top + slope * along.
struct Line {
  double top = 0.0;
  double slope = 0.0;
  double residual = 0.0;  ///< [m] root mean square
  std::size_t points = 0;
  [[nodiscard]] double angle() const { return std::atan(std::abs(slope)); }
};

/// Least squares over the points with `low` <= along <= `high`, of one sector or of all (< 0).
inline Line fit(std::span<const SurfacePoint> points, double low, double high, int sector = -1) {
  double n = 0.0;
  double sx = 0.0;
  double sy = 0.0;
  const auto takes = [&](const SurfacePoint& p) {
    return p.along >= low && p.along <= high && (sector < 0 || p.sector == sector);
  };
  for (const SurfacePoint& p : points) {
    if (!takes(p)) continue;
    n += 1.0;
    sx += p.along;
    sy += p.height;
  }
  Line line;
  line.points = static_cast<std::size_t>(n);
  if (line.points < k_min_points) return line;
  double xx = 0.0;
  double xy = 0.0;
  for (const SurfacePoint& p : points) {
    if (!takes(p)) continue;
    xx += (p.along - sx / n) * (p.along - sx / n);
    xy += (p.along - sx / n) * (p.height - sy / n);
  }
  if (!(xx > 0.0)) return line;
  line.slope = xy / xx;
  line.top = sy / n - line.slope * sx / n;
  for (const SurfacePoint& p : points) {
    if (!takes(p)) continue;
    const double off = p.height - line.top - line.slope * p.along;
    line.residual += off * off / n;
  }
  line.residual = std::sqrt(line.residual);
  return line;
}

/// The angle [rad] with one standard error (negative: none) and the line behind it.
struct Repose {
  double angle = 0.0;
  double error = -1.0;
  Line line;
  double low = 0.0, high = 0.0;  ///< [m] part of the slope that was fitted
};

/// Fits the part of the slope between the shares `from` and `to` of its height. That part is cut
/// along the slope, not by height: cutting noisy heights would tilt the line. A first line from a
/// cut by height finds where the shares are met; two more rounds settle it. The error is the
/// scatter of the angles of the sectors over the root of their number.
inline Repose repose(std::span<const SurfacePoint> points, double from, double to) {
  Repose out;
  if (points.size() < k_min_points) return out;
  double floor = points.front().height;
  double peak = floor;
  double first = points.front().along;
  double last = first;
  for (const SurfacePoint& p : points) {
    floor = std::min(floor, p.height);
    peak = std::max(peak, p.height);
    first = std::min(first, p.along);
    last = std::max(last, p.along);
  }
  const double low_height = floor + from * (peak - floor);
  const double high_height = floor + to * (peak - floor);
  std::vector<SurfacePoint> middle;
  for (const SurfacePoint& p : points) {
    if (p.height >= low_height && p.height <= high_height) middle.push_back(p);
  }
  out.line = fit(middle, first, last);
  out.low = first;
  out.high = last;
  for (int round = 0; round < 3 && out.line.slope != 0.0; ++round) {
    const double a = (low_height - out.line.top) / out.line.slope;
    const double b = (high_height - out.line.top) / out.line.slope;
    out.low = std::max(first, std::min(a, b));
    out.high = std::min(last, std::max(a, b));
    out.line = fit(points, out.low, out.high);
  }
  if (out.line.slope == 0.0) return out;
  out.angle = out.line.angle();
  double sum = 0.0;
  double squares = 0.0;
  double count = 0.0;
  for (int s = 0; s < k_sectors; ++s) {
    const Line line = fit(points, out.low, out.high, s);
    if (line.points < 5) continue;
    count += 1.0;
    sum += line.angle();
    squares += line.angle() * line.angle();
  }
  if (count < 3.0) return out;
  const double variance = std::max(0.0, (squares - sum * sum / count) / (count - 1.0));
  out.error = std::sqrt(variance / count);
  return out;
}

}  // namespace dust::model::angle_of_repose
