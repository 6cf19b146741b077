// SPDX-License-Identifier: Apache-2.0
#include "fluid/cut_grid.hpp"

#include "fluid/neighbour.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace dust::fluid {
namespace {

/// Way of a moving body, in cells, after which the grid is cut anew.
constexpr double k_max_way = 0.5;

}  // namespace

CutGrid::CutGrid(const Grid& grid, const bodies::BodySet& bodies, const Sides& sides,
                 const FaceProperties& properties)
    : grid_(grid),
      bodies_(bodies),
      sides_(sides),
      properties_(properties),
      static_geometry_(static_part()),
      geometry_(
          build_geometry(grid, bodies, sides.kinds(), properties, {}, static_geometry_.get())),
      suction_(bodies),
      thin_bodies_(grid) {}

std::unique_ptr<Geometry> CutGrid::static_part() const {
  const bool has_moving_bodies =
      std::any_of(bodies_.begin(), bodies_.end(),
                  [](const bodies::Body& b) { return !b.is_removed() && b.displaces(); });
  if (!has_moving_bodies) return nullptr;
  return std::make_unique<Geometry>(
      build_static_geometry(grid_, bodies_, sides_.kinds(), properties_));
}

void CutGrid::complete(double time) {
  sides_.fill_cells(geometry_.open_fraction);
  open_ahead_ = geometry_.open_fraction;
  suction_.find_cells(grid_, bodies_, geometry_, time);
  thin_bodies_.set(geometry_);
  evaluate_walls(time);
}

void CutGrid::evaluate_walls(double time) {
  const auto last = geometry_.wall.velocity;
  evaluate(geometry_.wall, bodies_, time);
  suction_.add_to(geometry_, bodies_, time);
  have_walls_changed_ = have_walls_changed_ || geometry_.wall.velocity != last;
}

void CutGrid::set_deep_ghosts(FaceField& u, FaceField& next) {
  if (!have_walls_changed_ && !has_moving_bodies()) return;
  have_walls_changed_ = false;
  for (int d = 0; d < 3; ++d) {
    const auto& ghosts = geometry_.ghost[d];
    for (std::size_t n = geometry_.deep_ghosts_begin[d]; n < ghosts.size(); ++n) {
      const double w = geometry_.wall.velocity[d][static_cast<std::size_t>(ghosts[n].wall_point)];
      u.component[d][ghosts[n].at] = w;
      next.component[d][ghosts[n].at] = w;
    }
  }
}

void CutGrid::bodies_changed() { static_geometry_ = static_part(); }

void CutGrid::cut(double begin, double end) {
  open_before_ = geometry_.open_fraction;
  geometry_ = build_geometry(grid_, bodies_, sides_.kinds(), properties_, {begin, end},
                             static_geometry_.get());
}

void CutGrid::predict(double time) {
  if (!has_moving_bodies()) return;
  open_ahead_ =
      open_fractions(grid_, bodies_, sides_.kinds(), properties_, time, *static_geometry_);
  sides_.fill_cells(open_ahead_);
}

int CutGrid::intervals(double step) const {
  if (!has_moving_bodies()) return 1;
  double speed = 0.0;
  for (const auto& body : bodies_) {
    if (!body.is_removed()) speed = std::max(speed, body.largest_displacing_speed());
  }
  double least = 0.0;
  for (int d = 0; d < 3; ++d) {
    if (grid_.count[d] > 1 && (least == 0.0 || grid_.spacing[d] < least)) least = grid_.spacing[d];
  }
  if (least == 0.0) return 1;
  return std::max(1, static_cast<int>(std::ceil(speed * step / (k_max_way * least) - 1e-9)));
}

void CutGrid::set_static_rate(const CellField& before, const CellField& after, double step,
                              CellField& rate) const {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      rate[o + i] = geometry_.open_fraction[o + i] * (after[o + i] - before[o + i]) / step;
    }
  });
}

void CutGrid::set_rate(const CellField& before, const CellField& after, double from, double to,
                       double step, Continuity& continuity) const {
  CellField& rate = continuity.rate();
  if (!has_moving_bodies()) {
    set_static_rate(before, after, step, rate);
    continuity.moved().clear();
    return;
  }
  const double inverse = 1.0 / ((to - from) * step);
  CellField& moved = continuity.moved();
  moved.assign(grid_.size, 0.0);
  for (int k = 0; k < grid_.count[2]; ++k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        const double jump = after[o] - before[o];
        const double theta0 = open_before_[o];
        const double theta1 = geometry_.open_fraction[o];
        rate[o] = inverse * (theta1 * (before[o] + to * jump) - theta0 * (before[o] + from * jump));
        moved[o] = inverse * (theta1 - theta0);
      }
    }
  }
  redistribute_closed(continuity, rate);
  redistribute_closed(continuity, moved);
}

/// What a cell that has closed still held goes to the widest open neighbour.
void CutGrid::redistribute_closed(const Continuity& continuity, CellField& rate) const {
  for (int k = 0; k < grid_.count[2]; ++k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      for (int i = 0; i < grid_.count[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        if (rate[o] == 0.0 || continuity.is_open(o)) continue;
        const std::array<int, 3> c = {i, j, k};
        std::ptrdiff_t best = -1;
        for (int d = 0; d < 3; ++d) {
          for (const int side : {-1, 1}) {
            const std::ptrdiff_t q = neighbour(grid_, o, d, c[d], side);
            if (q < 0 || !continuity.is_open(q)) continue;
            if (best < 0 || geometry_.open_fraction[q] > geometry_.open_fraction[best]) best = q;
          }
        }
        if (best >= 0) rate[best] += rate[o];
        rate[o] = 0.0;
      }
    }
  }
}

}  // namespace dust::fluid
