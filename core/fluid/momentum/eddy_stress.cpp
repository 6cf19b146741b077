// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum/eddy_stress.hpp"

#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <utility>
#include <vector>

namespace dust::fluid {
namespace {

/// Walls farther away than this many filter widths count as infinitely far.
constexpr double k_far = 10.0;

}  // namespace

EddyStress::EddyStress(const Grid& grid, const Geometry& geometry, const Sides& sides,
                       const FaceProperties& properties, const bodies::BodySet& bodies,
                       const sdk::TurbulenceModel& model)
    : grid_(grid),
      geometry_(geometry),
      sides_(sides),
      properties_(properties),
      model_(model),
      distance_(grid.size, std::numeric_limits<double>::infinity()),
      density_(grid.size, properties.density()),
      molecular_(grid.size, properties.viscosity()),
      rate_(grid.size, 0.0),
      viscosity_(grid.size, 0.0),
      force_(grid),
      mean_force_(grid),
      sum_(grid) {
  double volume = 1.0;
  int directions = 0;
  for (int d = 0; d < 3; ++d) {
    if (grid.count[d] == 1) continue;
    volume *= grid.spacing[d];
    ++directions;
  }
  filter_width_ = directions > 0 ? std::pow(volume, 1.0 / directions) : grid.spacing.x;
  if (!properties.by_place().is_uniform()) {
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const auto values = properties.by_place().at(grid.centre(i, j, k));
        density_[grid.index(i, j, k)] = values.density;
        molecular_[grid.index(i, j, k)] = values.viscosity;
      }
    });
  }
  walls_.body_distance.assign(grid.size, std::numeric_limits<double>::infinity());
  find_distances(bodies, 0.0);
  find_edges();
}

void EddyStress::bodies_moved(const bodies::BodySet& bodies, double time) {
  find_distances(bodies, time);
  find_edges();
}

bool EddyStress::is_in_body(int d, std::array<int, 3> face) const {
  for (int e = 0; e < 3; ++e) {
    const int n = grid_.count[e];
    if (grid_.is_periodic[e]) {
      face[e] = (face[e] + n) % n;
    } else if (face[e] < 0 || face[e] >= (e == d ? n + 1 : n)) {
      return false;
    }
  }
  return geometry_.kind[d][grid_.index(face[0], face[1], face[2])] == FaceKind::inside;
}

/// Whether the edge at the lower corner of a cell along d and e lies on a wall.
bool EddyStress::is_at_wall(int d, int e, const std::array<int, 3>& edge) const {
  for (const auto& [of, across] : {std::pair{d, e}, std::pair{e, d}}) {
    const bool is_on_side = edge[across] == 0 || edge[across] == grid_.count[across];
    const int high = edge[across] == 0 ? 0 : 1;
    if (is_on_side && ghost_rule(sides_.kinds(), of, across, high) == GhostRule::fixed) return true;
    std::array<int, 3> below = edge;
    below[across] -= 1;
    if (is_in_body(of, edge) || is_in_body(of, below)) return true;
  }
  return false;
}

void EddyStress::find_edges() {
  for (int f = 0; f < 3; ++f) {
    const int d = (f + 1) % 3;
    const int e = (f + 2) % 3;
    std::array<int, 3> n = grid_.count;
    n[d] += 1;
    n[e] += 1;
    walls_.edge[f].assign(grid_.size, 1.0);
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      for (int i = 0; i < n[0]; ++i) {
        if (is_at_wall(d, e, {i, j, k})) walls_.edge[f][grid_.index(i, j, k)] = 0.0;
      }
    });
    walls_.is_blocked[f].assign(grid_.size, 0);
  }
  for (const BlockedFace& face : geometry_.blocked) {
    const int d = face.axis;
    walls_.is_blocked[d][face.at] = 1;
    if (face.upper[d] == 0) walls_.is_blocked[d][face.at + grid_.count[d] * grid_.stride[d]] = 1;
  }
}

/// Those at which the fluid sticks and through most of whose faces none passes: one with a hood in
/// it is a wall, an inlet is none while it blows.
std::array<bool, 6> EddyStress::sides_that_are_walls(const FaceField& u) const {
  std::array<bool, 6> is_wall{};
  for (int side = 0; side < 6; ++side) {
    const int d = side / 2;
    const int high = side % 2;
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    if (ghost_rule(sides_.kinds(), e, d, high) != GhostRule::fixed) continue;
    if (ghost_rule(sides_.kinds(), d, d, high) != GhostRule::fixed) continue;
    int passed = 0;
    for (int a = 0; a < grid_.count[e]; ++a) {
      for (int b = 0; b < grid_.count[f]; ++b) {
        const std::ptrdiff_t o = grid_.index(0, 0, 0) + a * grid_.stride[e] + b * grid_.stride[f] +
                                 high * grid_.count[d] * grid_.stride[d];
        passed += u.component[d][o] != 0.0 ? 1 : 0;
      }
    }
    is_wall[side] = 2 * passed <= grid_.count[e] * grid_.count[f];
  }
  return is_wall;
}

void EddyStress::find_distances(const bodies::BodySet& bodies, double time) {
  const double reach = k_far * filter_width_;
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    std::vector<std::int32_t> parts;
    for (int i = 0; i < grid_.count[0]; ++i) {
      const sdk::Vec3 centre = grid_.centre(i, j, k);
      double least = std::numeric_limits<double>::infinity();
      for (const bodies::Body& body : bodies) {
        if (body.is_removed()) continue;
        const bodies::Placement at = body.placement(time);
        body.find_within(centre, reach, at, parts);
        if (parts.empty()) continue;
        least = std::min(least, std::max(0.0, body.nearest(centre, at).distance));
      }
      walls_.body_distance[grid_.index(i, j, k)] = least;
    }
  });
  add_sides();
}

void EddyStress::add_sides() {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    for (int i = 0; i < grid_.count[0]; ++i) {
      const sdk::Vec3 centre = grid_.centre(i, j, k);
      const std::ptrdiff_t o = grid_.index(i, j, k);
      double least = walls_.body_distance[o];
      for (int side = 0; side < 6; ++side) {
        if (!walls_.is_side[side]) continue;
        const int d = side / 2;
        const double end = grid_.origin[d] + (side % 2) * grid_.count[d] * grid_.spacing[d];
        least = std::min(least, std::abs(centre[d] - end));
      }
      distance_[o] = least;
    }
  });
}

/// [1/s] Of the mean of a component's two faces of cell o, which are `own` apart, along e: over two
/// cells, or to the one that no thin body keeps apart.
double EddyStress::slope(const std::vector<double>& v, std::ptrdiff_t o, std::ptrdiff_t own,
                         int e) const {
  const std::ptrdiff_t t = grid_.stride[e];
  const std::ptrdiff_t down = walls_.is_blocked[e][o] != 0 ? 0 : t;
  const std::ptrdiff_t up = walls_.is_blocked[e][o + t] != 0 ? 0 : t;
  const int cells = (down != 0 ? 1 : 0) + (up != 0 ? 1 : 0);
  if (cells == 0) return 0.0;
  return 0.5 * ((v[o + up] + v[o + up + own]) - (v[o - down] + v[o - down + own])) /
         (cells * grid_.spacing[e]);
}

void EddyStress::find_viscosity(const FaceField& u) {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t row = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      const std::ptrdiff_t o = row + i;
      double sum = 0.0;  // 2 S_ij S_ij
      for (int d = 0; d < 3; ++d) {
        const auto& v = u.component[d];
        const std::ptrdiff_t s = grid_.stride[d];
        const double own = (v[o + s] - v[o]) / grid_.spacing[d];
        sum += 2.0 * own * own;
        const int e = (d + 1) % 3;
        const std::ptrdiff_t t = grid_.stride[e];
        const double across = slope(v, o, s, e);
        const double back = slope(u.component[e], o, t, d);
        sum += (across + back) * (across + back);
      }
      rate_[o] = std::sqrt(sum);
    }
    model_.evaluate({static_cast<std::size_t>(grid_.count[0]), filter_width_, &rate_[row],
                     &distance_[row], &density_[row], &molecular_[row], &viscosity_[row]});
    for (int i = 0; i < grid_.count[0]; ++i) {
      if (!(geometry_.open_fraction[row + i] > 0.0)) viscosity_[row + i] = 0.0;
    }
  });
  sides_.fill_cells(viscosity_);
}

void EddyStress::force_row(const FaceField& u, int d, int j, int k) {
  const std::ptrdiff_t s = grid_.stride[d];
  const double h = grid_.spacing[d];
  const auto& v = u.component[d];
  const std::ptrdiff_t row = grid_.index(0, j, k);
  for (int i = 0; i < geometry_.extent[d][0]; ++i) {
    const std::ptrdiff_t o = row + i;
    double& force = force_.component[d][o];
    force = 0.0;
    if (!is_unknown(geometry_.kind[d][o])) continue;
    const double above = 2.0 * viscosity_[o] * (v[o + s] - v[o]) / h;
    const double below = 2.0 * viscosity_[o - s] * (v[o] - v[o - s]) / h;
    force = (above - below) / h;
    for (int e = 0; e < 3; ++e) {
      if (e == d) continue;
      const std::ptrdiff_t t = grid_.stride[e];
      const auto& w = u.component[e];
      // Stress on the edge at the lower corner of face o along e.
      const auto& is_open = walls_.edge[3 - d - e];
      const auto edge = [&](std::ptrdiff_t at) {
        const double mean =
            0.25 * is_open[at] *
            ((viscosity_[at] + viscosity_[at - s]) + (viscosity_[at - t] + viscosity_[at - t - s]));
        return mean * ((v[at] - v[at - t]) / grid_.spacing[e] + (w[at] - w[at - s]) / h);
      };
      force += (edge(o + t) - edge(o)) / grid_.spacing[e];
    }
  }
}

void EddyStress::update(const FaceField& u) {
  const std::array<bool, 6> is_side = sides_that_are_walls(u);
  if (is_side != walls_.is_side) {
    walls_.is_side = is_side;
    add_sides();
  }
  find_viscosity(u);
  for (int d = 0; d < 3; ++d) {
    if (!geometry_.has_unknown[d]) continue;
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) { force_row(u, d, j, k); });
  }
}

double EddyStress::rate() const {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) {
    if (grid_.count[d] > 1) sum += 1.0 / (grid_.spacing[d] * grid_.spacing[d]);
  }
  const auto& n = grid_.count;
  thread_local std::vector<double> of_rows;
  // [m2/s]
  const double largest = max_rows(n[0], n[1], n[2], of_rows, [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    double of_row = 0.0;
    for (int i = 0; i < n[0]; ++i) {
      of_row = std::max(of_row, viscosity_[o + i] / density_[o + i]);
    }
    return of_row;
  });
  return 8.0 * sum * largest;
}

const FaceField& EddyStress::add_to(const FaceField& source) {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        sum_.component[d][o + i] = source.component[d][o + i] + force_.component[d][o + i];
      }
    });
  }
  return sum_;
}

void EddyStress::add_to_mean(double share, bool is_first) {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        double& mean = mean_force_.component[d][o + i];
        mean = (is_first ? 0.0 : mean) + share * force_.component[d][o + i];
      }
    });
  }
}

}  // namespace dust::fluid
