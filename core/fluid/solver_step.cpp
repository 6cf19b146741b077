// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/error.hpp"
#include "fluid/parallel.hpp"
#include "fluid/solver_impl.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::fluid {
namespace {

using Ghosts = Momentum::Ghosts;

/// Steps of velocity below this share of the largest speed are smooth for the limiter.
constexpr double k_smooth_share = 0.05;

/// Is the number everywhere in the rows of cells (of faces along d) that of `value`?
bool is_uniform(const Grid& grid, const std::vector<double>& field, const std::array<int, 3>& n,
                double value) {
  const auto differs = [&](int j, int k) {
    const double* row = &field[grid.index(0, j, k)];
    bool all = true;
    for (int i = 0; i < n[0]; ++i) all &= row[i] == value;
    return all ? 0.0 : 1.0;
  };
  std::vector<double> partial;
  return max_rows(n[0], n[1], n[2], partial, differs) == 0.0;
}

}  // namespace

void FluidSolver::Impl::advance(double time, double step, const CellField& before,
                                const CellField& after, const Exchange& exchange) {
  if (!(step > 0.0)) throw sdk::ModelError("the fluid step must be positive");
  const StepState s = begin_step(time, step, before, after, exchange);
  const int cuts = cut_.intervals(step);
  double last_share = 1.0;
  for (int cut = 0; cut < cuts; ++cut) {
    const double begin = static_cast<double>(cut) / cuts;
    const double end = cut + 1 == cuts ? 1.0 : (cut + 1.0) / cuts;
    last_share = advance_part(s, begin, end);
    if (cut + 1 == cuts) {
      // Before means of flows that vary change what continuity knows of cut faces.
      sides_.fill_velocity(u_);
      report_.divergence = projection_.continuity().largest_divergence(u_, void_fraction_.field());
    }
    if (cuts > 1) {
      const Interval part{time + begin * step, time + end * step};
      projection_.add_throughflow(u_, void_fraction_.field(), part, end - begin);
    }
  }
  end_step(s, last_share);
}

FluidSolver::Impl::StepState FluidSolver::Impl::begin_step(double time, double step,
                                                           const CellField& before,
                                                           const CellField& after,
                                                           const Exchange& exchange) {
  report_ = {};
  projection_.begin_step({time, time + step});
  const bool has_drag = has_coefficient(exchange);
  const bool is_clean = is_uniform(grid_, after, grid_.count, 1.0) &&
                        (&before == &after || is_uniform(grid_, before, grid_.count, 1.0));
  // Where particles act on one fluid whose grid stays.
  balance_.begin_step((has_drag || stages_.forcing() != nullptr) && !has_moving_bodies() &&
                      properties_.by_place().is_uniform());
  const bool keeps_mean = has_drag || balance_.is_kept();
  drag_velocity_.begin(keeps_mean);
  if (has_moving_bodies()) limits_.velocity_changed();
  return {time, step, before, after, exchange, is_clean, has_drag, keeps_mean};
}

/// From the shares `begin` to `end` of a fluid step, between two cuts of the grid; returns the
/// share of the last sub-step.
double FluidSolver::Impl::advance_part(const StepState& s, double begin, double end) {
  begin_part(s, begin, end);
  const double until = end < 1.0 ? end * s.step : s.step;
  double done = begin > 0.0 ? begin * s.step : 0.0;
  double last_share = 1.0;
  while (done < until) {
    const Momentum::Rates rates = limits_.find(u_, s.time + done);
    limits_.velocity_changed();
    const double left = until - done;
    if (eddies_) eddies_->update(u_);
    const double diffusion = eddies_ ? eddies_->rate() : 0.0;
    const int parts = limits_.sub_steps(u_, left, rates, diffusion, report_.sub_steps, s.time);
    const double dt = parts == 1 ? left : left / parts;
    set_void_fraction(s, parts == 1 ? end : (done + dt) / s.step);
    last_share = dt / s.step;
    sub_step(s, s.time + done, dt, rates.speed);
    report_.courant_number = std::max(report_.courant_number, dt * rates.courant);
    ++report_.sub_steps;
    done = parts == 1 ? until : done + dt;
  }
  return last_share;
}

void FluidSolver::Impl::begin_part(const StepState& s, double begin, double end) {
  const double until = end < 1.0 ? end * s.step : s.step;
  const double done = begin > 0.0 ? begin * s.step : 0.0;
  if (has_moving_bodies()) {
    recut(s.time + done, s.time + until);
  } else {
    cut_.evaluate_walls(s.time + until);
  }
  cut_.set_deep_ghosts(u_, stages_.other());
  cut_.set_rate(s.before, s.after, begin, end, s.step, projection_.continuity());
  if (!projection_.is_consistent()) {
    make_consistent(s);
  } else {
    momentum_.extend(u_, Ghosts::uncrossed);
    if (has_moving_bodies()) {
      // Asked for again: a resumed run does not know what they gave last.
      set_void_fraction(s, begin);
      sides_.evaluate_velocity(s.time + done, void_fraction_.field());
      sides_.fill_velocity(u_);
    }
  }
  if (!balance_.is_kept()) return;
  set_void_fraction(s, 0.0);
  balance_.begin(u_, void_fraction_, s.exchange.source, s.step);
}

/// The first field may not obey continuity: corrected before it makes pressure.
void FluidSolver::Impl::make_consistent(const StepState& s) {
  set_void_fraction(s, 0.0);
  const CellField& eps = void_fraction_.field();
  sides_.evaluate_velocity(s.time, eps);
  momentum_.extend(u_, Ghosts::all);
  sides_.fill_velocity(u_);
  projection_.make_consistent(u_, stages_.other(), eps, s.exchange.source, s.step, s.time);
  limits_.velocity_changed();
}

/// Of `step` [s] from `time` [s] on, `speed` the largest at its beginning.
void FluidSolver::Impl::sub_step(const StepState& s, double time, double step, double speed) {
  const CellField& eps = void_fraction_.field();
  const double share = step / s.step;
  const bool is_first = report_.sub_steps == 0;
  MomentumBalance* balance = balance_.kept();
  const FaceField& given = balance != nullptr ? balance->source() : s.exchange.source;
  const FaceField& stirred = eddies_ ? eddies_->add_to(given) : given;
  VelocityForcing* const forcing = stages_.forcing();
  const ForcedPart forced{time + step - s.time, step, share};
  const FaceField& source =
      forcing != nullptr ? forcing->add_to(stirred, forced_fluid(), forced) : stirred;
  if (eddies_ && balance != nullptr) eddies_->add_to_mean(share, is_first);

  const FaceField& drag = s.exchange.coefficient;
  const double smoothness = std::pow(k_smooth_share * speed, 2) + 1e-30;
  const bool fills_halos = eddies_ != nullptr;
  stages_.advance({time, step, share, smoothness, source, drag, s.has_drag,
                   s.keeps_mean ? &drag_velocity_ : nullptr, balance},
                  eps, fills_halos, projection_.pressure(), u_);
  if (forcing != nullptr) {
    forcing->force(u_, forced_fluid(), forced);
    stages_.fill(u_, fills_halos);
  }

  const bool is_plain = s.is_clean && !s.has_drag && !properties_.is_varying();
  projection_.project(u_, eps, drag, is_plain, step, time + step);
  stages_.fill(u_, fills_halos);
  if (s.keeps_mean) {
    drag_velocity_.add_pressure(geometry(), projection_.continuity(), properties_, step, drag,
                                share);
  }
  if (balance != nullptr) balance_.add_pressure(pressure(), share, is_first);
}

void FluidSolver::Impl::end_step(const StepState& s, double last_share) {
  const CellField& eps = void_fraction_.field();
  sides_.fill_velocity(u_);
  report_.largest_speed = limits_.find(u_, s.time + s.step).speed;
  report_.pressure_iterations = projection_.iterations();
  if (s.keeps_mean) drag_velocity_.end(sides_);
  stress_.flow_changed();
  if (!balance_.is_kept()) return;
  const FaceField& mean_velocity = drag_velocity_.field();
  const FaceField& stress = stress_.of_mean(mean_velocity, balance_.mean_pressure(), eddies_.get());
  sides_.fill_pressure(projection_.pressure(), false);
  const FaceField& given = s.exchange.source;
  VelocityForcing* const forcing = stages_.forcing();
  const FaceField& source = forcing != nullptr ? forcing->add_mean_to(given, eps) : given;
  balance_.kept()->end(u_, eps, {source, s.exchange.coefficient}, mean_velocity, stress, s.step,
                       last_share);
}

void FluidSolver::Impl::set_void_fraction(const StepState& s, double share) {
  void_fraction_.set(grid_, sides_, s.before, s.after, share, s.is_clean, properties_);
}

bool FluidSolver::Impl::has_coefficient(const Exchange& exchange) const {
  for (int d = 0; d < 3; ++d) {
    if (!is_uniform(grid_, exchange.coefficient.component[d], geometry().extent[d], 0.0)) {
      return true;
    }
  }
  return false;
}

}  // namespace dust::fluid
