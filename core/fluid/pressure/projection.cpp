// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/projection.hpp"

#include "fluid/parallel.hpp"

#include <algorithm>

namespace dust::fluid {

using Ghosts = Momentum::Ghosts;

Projection::Projection(const Grid& grid, const CutGrid& cut, Sides& sides,
                       const FaceProperties& properties, const Momentum& momentum, double tolerance)
    : grid_(grid),
      cut_(cut),
      sides_(sides),
      properties_(properties),
      momentum_(momentum),
      tolerance_(tolerance),
      continuity_(grid, cut.geometry(), sides, properties, momentum),
      p_(grid.size, 0.0) {
  ghost_pressure_.find(grid, cut.geometry(), continuity_.pattern());
}

void Projection::project(FaceField& u, const CellField& eps, const FaceField& drag, bool is_plain,
                         double step, double time) {
  cut_.set_sinks(continuity_.sinks(), time);
  iterations_ += continuity_.project(u, eps, step, drag, is_plain, tolerance_);
  const CellField& phi = continuity_.increment();
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) p_[o + i] += phi[o + i];
  });
  ghost_pressure_.fill(p_);
}

void Projection::add_throughflow(const FaceField& u, const CellField& eps, Interval part,
                                 double share) {
  if (mean_throughflow_.component[0].empty()) mean_throughflow_ = FaceField(grid_);
  FaceField last(grid_);
  find_part_throughflow(u, eps, part, last);
  for (int d = 0; d < 3; ++d) {
    auto& mean = mean_throughflow_.component[d];
    for (std::size_t o = 0; o < grid_.size; ++o) mean[o] += share * last.component[d][o];
  }
  std::vector<Continuity::Sink> sinks;
  cut_.set_mean_sinks(sinks, part);
  for (Continuity::Sink& sink : sinks) {
    sink.rate *= share;
    mean_sinks_.push_back(sink);
  }
}

void Projection::find_throughflow(const FaceField& u, const CellField& eps,
                                  FaceField& throughflow) {
  if (mean_throughflow_.component[0].empty()) {
    find_part_throughflow(u, eps, step_, throughflow);
  } else {
    throughflow = mean_throughflow_;
  }
}

std::vector<Continuity::Sink> Projection::mean_sinks() const {
  if (!mean_throughflow_.component[0].empty()) return mean_sinks_;
  std::vector<Continuity::Sink> sinks;
  cut_.set_mean_sinks(sinks, step_);
  return sinks;
}

/// The velocity at the end has the flows of the end. Where they vary, another one with their means
/// takes its place, which differs by the potential flow between both.
void Projection::find_part_throughflow(const FaceField& u, const CellField& eps, Interval part,
                                       FaceField& throughflow) {
  Sides::Inflow inflow = sides_.mean_inflow(part, eps);
  std::vector<Continuity::Sink> sinks;
  cut_.set_mean_sinks(sinks, part);
  const auto has_rate = [](const auto& a, const auto& b) { return a.rate == b.rate; };
  const auto& last = continuity_.sinks();
  if (inflow.is_empty() &&
      std::equal(sinks.begin(), sinks.end(), last.begin(), last.end(), has_rate)) {
    continuity_.find_throughflow(u, eps, throughflow);
    return;
  }
  FaceField mean = u;
  sides_.swap_inflow(inflow);
  continuity_.sinks().swap(sinks);
  sides_.fill_velocity(mean);
  correct(mean, eps, part.length());
  continuity_.find_throughflow(mean, eps, throughflow);
  continuity_.sinks().swap(sinks);
  sides_.swap_inflow(inflow);
}

/// Without drag and without a change of the pressure.
void Projection::correct(FaceField& u, const CellField& eps, double step) {
  if (zero_.component[0].empty()) zero_ = FaceField(grid_);
  iterations_ += continuity_.project(u, eps, step, zero_, false, tolerance_);
}

void Projection::make_consistent(FaceField& u, FaceField& scratch, const CellField& eps,
                                 const FaceField& source, double step, double time) {
  cut_.set_sinks(continuity_.sinks(), time);
  correct(u, eps, step);
  sides_.fill_velocity(u);
  find_first_pressure(u, scratch, eps, source, step, time);
  is_consistent_ = true;
}

void Projection::find_first_pressure(const FaceField& u, FaceField& next, const CellField& eps,
                                     const FaceField& source, double step, double time) {
  const Geometry& geometry = cut_.geometry();
  sides_.evaluate_pressure(time);
  sides_.fill_pressure(p_, false);
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    const double inverse_h = 1.0 / grid_.spacing[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        const double force =
            source.component[d][o + i] - inverse_h * (p_[o + i] - p_[o + i - grid_.stride[d]]);
        double& v = next.component[d][o + i];
        v = u.component[d][o + i];
        if (is_unknown(geometry.kind[d][o + i])) {
          v += step * properties_.inverse_inertia_at(d, o + i) * force;
        }
      }
    });
  }
  momentum_.extend(next, Ghosts::uncrossed);
  sides_.fill_velocity(next);
  correct(next, eps, step);
  const CellField& phi = continuity_.increment();
  for (std::size_t o = 0; o < grid_.size; ++o) p_[o] += phi[o];
  ghost_pressure_.fill(p_);
}

}  // namespace dust::fluid
