// SPDX-License-Identifier: Apache-2.0
#include "fluid/parallel.hpp"
#include "fluid/solver_impl.hpp"

#include <algorithm>
#include <cmath>

namespace dust::fluid {
namespace {

/// Way of a moving body, in cells, after which the grid is cut anew.
constexpr double k_most_way = 0.5;

}  // namespace

std::unique_ptr<Geometry> FluidSolver::Impl::standing_part() const {
  const bool has_movers = std::any_of(bodies.begin(), bodies.end(), [](const bodies::Body& b) {
    return !b.is_removed() && b.displaces();
  });
  if (!has_movers) return nullptr;
  return std::make_unique<Geometry>(
      Geometry::build_standing(grid, bodies, sides.kinds(), properties));
}

void FluidSolver::Impl::complete_geometry(double time) {
  sides.fill_cells(geometry.open_fraction);
  open_ahead = geometry.open_fraction;
  suction.find_cells(grid, bodies, geometry, time);
  evaluate_walls(time);
}

void FluidSolver::Impl::evaluate_walls(double time) {
  const auto last = geometry.wall.velocity;
  geometry.wall.evaluate(bodies, time);
  suction.add_to(geometry.wall, bodies, time);
  walls_have_changed = walls_have_changed || geometry.wall.velocity != last;
}

void FluidSolver::Impl::set_deep_ghosts() {
  if (!walls_have_changed && !standing) return;
  walls_have_changed = false;
  for (int d = 0; d < 3; ++d) {
    const auto& ghosts = geometry.ghost[d];
    for (std::size_t n = geometry.deep_ghosts_begin[d]; n < ghosts.size(); ++n) {
      const double w = geometry.wall.velocity[d][static_cast<std::size_t>(ghosts[n].wall_point)];
      u.component[d][ghosts[n].at] = w;
      next.component[d][ghosts[n].at] = w;
    }
  }
}

void FluidSolver::Impl::cut_anew(double begin, double end) {
  open_before = geometry.open_fraction;
  geometry = Geometry::build(grid, bodies, sides.kinds(), properties, {begin, end}, standing.get());
  momentum.geometry_changed();
  complete_geometry(end);
  continuity.geometry_changed(p);
  if (eddies) eddies->bodies_moved(bodies, end);
}

int FluidSolver::Impl::cuts_per_step(double step) const {
  if (!standing) return 1;
  double speed = 0.0;
  for (const auto& body : bodies) {
    if (!body.is_removed()) speed = std::max(speed, body.largest_displacing_speed());
  }
  double least = 0.0;
  for (int d = 0; d < 3; ++d) {
    if (grid.count[d] > 1 && (least == 0.0 || grid.spacing[d] < least)) least = grid.spacing[d];
  }
  if (least == 0.0) return 1;
  return std::max(1, static_cast<int>(std::ceil(speed * step / (k_most_way * least) - 1e-9)));
}

void FluidSolver::Impl::set_rate(const CellField& before, const CellField& after, double from,
                                 double to, double step) {
  CellField& rate = continuity.rate();
  if (!standing) {
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) {
        rate[o + i] = geometry.open_fraction[o + i] * (after[o + i] - before[o + i]) / step;
      }
    });
    return;
  }
  const double inverse = 1.0 / ((to - from) * step);
  double net = 0.0;
  double gross = 0.0;
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::ptrdiff_t o = grid.index(i, j, k);
        const double jump = after[o] - before[o];
        const double theta0 = open_before[o];
        const double theta1 = geometry.open_fraction[o];
        rate[o] = inverse * (theta1 * (before[o] + to * jump) - theta0 * (before[o] + from * jump));
        const double change = inverse * (theta1 - theta0) * grid.cell_volume();
        net += change;
        gross += std::abs(change);
      }
    }
  }
  continuity.set_moved(net, gross);
  hand_on_closed(rate);
}

void FluidSolver::Impl::hand_on_closed(CellField& rate) const {
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::ptrdiff_t o = grid.index(i, j, k);
        if (rate[o] == 0.0 || continuity.is_open(o)) continue;
        const std::array<int, 3> c = {i, j, k};
        std::ptrdiff_t best = -1;
        for (int d = 0; d < 3; ++d) {
          for (const int side : {-1, 1}) {
            const int to = c[d] + side;
            const std::ptrdiff_t q = o + side * grid.stride[d];
            if (to < 0 || to >= grid.count[d] || !continuity.is_open(q)) continue;
            if (best < 0 || geometry.open_fraction[q] > geometry.open_fraction[best]) best = q;
          }
        }
        if (best >= 0) rate[best] += rate[o];
        rate[o] = 0.0;
      }
    }
  }
}

}  // namespace dust::fluid
