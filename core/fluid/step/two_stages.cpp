// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/two_stages.hpp"

#include "fluid/parallel.hpp"
#include "fluid/step/step_rows.hpp"

#include <algorithm>
#include <utility>
#include <vector>

namespace dust::fluid {

TwoStages::TwoStages(const Grid& grid, const Geometry& geometry, Sides& sides,
                     const FaceProperties& properties, Momentum& momentum)
    : grid_(grid),
      geometry_(geometry),
      sides_(sides),
      properties_(properties),
      momentum_(momentum),
      next_(grid),
      right_(grid),
      sum_(grid) {}

template <class Body>
void TwoStages::each_moving_row(const Body& body) const {
  for (int d = 0; d < 3; ++d) {
    if (sides_.is_still(d)) continue;
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2],
             [&](int j, int k) { body(d, grid_.index(0, j, k), n[0], 1.0 / grid_.spacing[d]); });
  }
}

void TwoStages::advance(const SubStep& part, const CellField& eps, bool fills_halos,
                        CellField& pressure, FaceField& u) {
  const double step = part.step;
  momentum_.prepare(k_gamma * step, part.drag, part.has_drag);
  convect_first(part, u, eps);
  // The mean over the step to second order, as it acts on both stages alike.
  sides_.evaluate_pressure(part.time + 0.5 * step);
  sides_.fill_pressure(pressure, false);
  each_moving_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
    first_stage_row(n, grid_.stride[d], step, properties_.inertia(d, o), inverse_h,
                    &u.component[d][o], &sum_.component[d][o], &pressure[o],
                    &part.source.component[d][o], &right_.component[d][o]);
    std::copy_n(&u.component[d][o], n, &next_.component[d][o]);
  });
  sides_.evaluate_velocity(part.time + k_gamma * step, eps);
  solve(fills_halos);
  if (part.drag_velocity != nullptr) {
    part.drag_velocity->add_stage(geometry_, next_, (1.0 - k_gamma) * part.share);
  }
  each_moving_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
    between_stages_row(n, grid_.stride[d], step, properties_.inertia(d, o), inverse_h,
                       &u.component[d][o], &next_.component[d][o], &right_.component[d][o],
                       &pressure[o], &part.source.component[d][o], &sum_.component[d][o]);
  });
  convect_second(part, eps);
  sides_.evaluate_velocity(part.time + step, eps);
  solve(fills_halos);
  if (part.drag_velocity != nullptr) {
    part.drag_velocity->add_stage(geometry_, next_, k_gamma * part.share);
  }
  std::swap(u, next_);
}

/// Convection of `u` into the sum.
void TwoStages::convect_first(const SubStep& part, const FaceField& u, const CellField& eps) {
  momentum_.find_flux(u, eps);
  for (int d = 0; d < 3; ++d) {
    if (!geometry_.has_unknown[d]) continue;
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      double* sum = &sum_.component[d][grid_.index(0, j, k)];
      momentum_.convection_row(u, eps, part.smoothness, d, j, k, sum);
      balance_row(part, u, eps, d, j, k, sum, k_delta * part.step);
    });
  }
}

/// Convection of the first stage, as part of the second right side.
void TwoStages::convect_second(const SubStep& part, const CellField& eps) {
  momentum_.find_flux(next_, eps);
  for (int d = 0; d < 3; ++d) {
    if (!geometry_.has_unknown[d]) continue;
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      thread_local std::vector<double> row;
      row.resize(static_cast<std::size_t>(n[0]));
      momentum_.convection_row(next_, eps, part.smoothness, d, j, k, row.data());
      balance_row(part, next_, eps, d, j, k, row.data(), (1.0 - k_delta) * part.step);
      second_stage_row(n[0], part.step, &sum_.component[d][o], row.data(), &right_.component[d][o]);
    });
  }
}

/// Adds a row's convection, which acted for `time` [s], to the balance.
void TwoStages::balance_row(const SubStep& part, const FaceField& v, const CellField& eps, int d,
                            int j, int k, const double* row, double time) const {
  if (part.balance == nullptr) return;
  const std::ptrdiff_t o = grid_.index(0, j, k);
  part.balance->add_convection(d, o, time, &v.component[d][o], &eps[o], row,
                               momentum_.row_flux(d, j, k));
}

/// Solves for the next stage with the sides' present values and completes it.
void TwoStages::solve(bool fills_halos) {
  sides_.fill_for_sweeps(next_);
  momentum_.solve(right_, next_);
  momentum_.extend(next_, Momentum::Ghosts::but_deep);
  fill(next_, fills_halos);
}

}  // namespace dust::fluid
