// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/error.hpp"
#include "fluid/parallel.hpp"
#include "fluid/solver_impl.hpp"
#include "fluid/step_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <string>

namespace dust::fluid {
namespace {

using sdk::Vec3;
using Ghosts = Momentum::Ghosts;

constexpr double k_largest_speed = 1e4;  ///< [m/s] beyond this the flow has blown up
constexpr int k_max_sub_steps = 200;
/// Steps of velocity below this share of the largest speed are smooth for the limiter.
constexpr double k_smooth_share = 0.05;

std::string place_text(Vec3 p, double time) {
  char text[160];
  std::snprintf(text, sizeof text, "at [%.4g, %.4g, %.4g] m, t = %.6g s", p.x, p.y, p.z, time);
  return text;
}

/// stress -= grad p, at unknown faces, and the force of eddies where there are any.
void subtract_gradient(int n, std::ptrdiff_t s, double inverse_h, const FaceKind* kind,
                       const double* p, const double* eddies, double* stress) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double force = inverse_h * (p[i] - p[i - s]);
    const double next = stress[i] - force;
    stress[i] = is_unknown(kind[i]) ? next : stress[i];
  }
  if (eddies == nullptr) return;
  for (int i = 0; i < n; ++i) {
    if (is_unknown(kind[i])) stress[i] += eddies[i];
  }
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
  }
  end_step(s, last_share);
}

FluidSolver::Impl::StepState FluidSolver::Impl::begin_step(double time, double step,
                                                           const CellField& before,
                                                           const CellField& after,
                                                           const Exchange& exchange) {
  report_ = {};
  const bool has_drag = has_coefficient(exchange);
  const bool is_clean = is_uniform(after, grid_.count, 1.0) &&
                        (&before == &after || is_uniform(before, grid_.count, 1.0));
  // Where particles act on one fluid whose grid stays.
  is_balanced_ =
      (has_drag || forcing_ != nullptr) && !has_movers() && properties_.by_place().is_uniform();
  const bool keeps_mean = has_drag || is_balanced_;
  drag_velocity_.begin(keeps_mean);
  if (has_movers()) rates_.invalidate();
  return {time, step, before, after, exchange, is_clean, has_drag, is_balanced_, keeps_mean};
}

/// From the shares `begin` to `end` of a fluid step, between two cuts of the grid; returns the
/// share of the last sub-step.
double FluidSolver::Impl::advance_part(const StepState& s, double begin, double end) {
  begin_part(s, begin, end);
  const double until = end < 1.0 ? end * s.step : s.step;
  double done = begin > 0.0 ? begin * s.step : 0.0;
  double last_share = 1.0;
  while (done < until) {
    const Momentum::Rates rates =
        rates_.get([this](Momentum::Rates& r) { r = momentum_.rates(u_); });
    rates_.invalidate();
    check_finite(s.time + done, rates);
    const double left = until - done;
    const int parts = parts_of(s, left, rates);
    const double dt = parts == 1 ? left : left / parts;
    set_void_fraction(s, parts == 1 ? end : (done + dt) / s.step);
    last_share = dt / s.step;
    sub_step(s, {s.time + done, dt, last_share, std::pow(k_smooth_share * rates.speed, 2) + 1e-30});
    report_.courant_number = std::max(report_.courant_number, dt * rates.courant);
    ++report_.sub_steps;
    done = parts == 1 ? until : done + dt;
  }
  return last_share;
}

void FluidSolver::Impl::begin_part(const StepState& s, double begin, double end) {
  const double until = end < 1.0 ? end * s.step : s.step;
  const double done = begin > 0.0 ? begin * s.step : 0.0;
  if (has_movers()) {
    recut(s.time + done, s.time + until);
  } else {
    cut_.evaluate_walls(s.time + until);
  }
  cut_.set_deep_ghosts(u_, stages_.next);
  cut_.set_rate(s.before, s.after, begin, end, s.step, continuity_);
  if (!is_consistent_) {
    make_consistent(s, s.time);
  } else {
    momentum_.extend(u_, Ghosts::uncrossed);
    if (has_movers()) sides_.fill_velocity(u_);
  }
  if (s.is_balanced) begin_balance(s);
}

/// The first field may not obey continuity: mended before it makes pressure.
void FluidSolver::Impl::make_consistent(const StepState& s, double time) {
  set_void_fraction(s, 0.0);
  sides_.evaluate_velocity(time, void_fraction_.field());
  momentum_.extend(u_, Ghosts::all);
  sides_.fill_velocity(u_);
  cut_.set_sinks(continuity_.sinks(), time);
  report_.pressure_iterations += continuity_.project(u_, void_fraction_.field(), s.step, no_drag(),
                                                     false, fluid_.pressure_tolerance);
  sides_.fill_velocity(u_);
  find_first_pressure(s, time);
  is_consistent_ = true;
  rates_.invalidate();
}

/// The pressure that keeps the present velocity free of divergence under the sides' pressures and
/// the sources: else these would act in the first step as a blow that nothing holds.
void FluidSolver::Impl::find_first_pressure(const StepState& s, double time) {
  sides_.evaluate_pressure(time);
  sides_.fill_pressure(p_, false);
  FaceField& next = stages_.next;
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry().extent[d];
    const double inverse_h = 1.0 / grid_.spacing[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        const double force = s.exchange.source.component[d][o + i] -
                             inverse_h * (p_[o + i] - p_[o + i - grid_.stride[d]]);
        double& v = next.component[d][o + i];
        v = u_.component[d][o + i];
        if (is_unknown(geometry().kind[d][o + i])) {
          v += s.step * properties_.inverse_inertia_at(d, o + i) * force;
        }
      }
    });
  }
  momentum_.extend(next, Ghosts::uncrossed);
  sides_.fill_velocity(next);
  report_.pressure_iterations += continuity_.project(next, void_fraction_.field(), s.step,
                                                     no_drag(), false, fluid_.pressure_tolerance);
  const CellField& phi = continuity_.increment();
  for (std::size_t o = 0; o < grid_.size; ++o) p_[o] += phi[o];
}

/// Sub-steps for the rest of the part, `left` [s], by the Courant number.
int FluidSolver::Impl::parts_of(const StepState& s, double left,
                                const Momentum::Rates& rates) const {
  const int parts =
      std::max(1, static_cast<int>(std::ceil(left * rates.courant / fluid_.largest_cfl - 1e-9)));
  if (report_.sub_steps + parts <= k_max_sub_steps) return parts;
  char text[200];
  std::snprintf(text, sizeof text,
                "the fluid needs more than %d sub-steps in the step from t = %.6g s: largest "
                "speed %.4g m/s; it is diverging, or time.fluid_step is far too long",
                k_max_sub_steps, s.time, rates.speed);
  throw sdk::ModelError(text);
}

template <class Body>
void FluidSolver::Impl::each_moving_row(const Body& body) const {
  for (int d = 0; d < 3; ++d) {
    if (sides_.is_still(d)) continue;
    const auto& n = geometry().extent[d];
    for_rows(n[0], n[1], n[2],
             [&](int j, int k) { body(d, grid_.index(0, j, k), n[0], 1.0 / grid_.spacing[d]); });
  }
}

void FluidSolver::Impl::sub_step(const StepState& s, const SubStep& part) {
  auto& [next, right, sum] = stages_;
  const double step = part.step;
  momentum_.prepare(k_gamma * step, s.exchange.coefficient, s.has_drag);
  const FaceField& given = s.is_balanced ? balance_->source() : s.exchange.source;
  const FaceField& stirred = eddies_ ? eddies_->add_to(given, u_) : given;
  const FaceField& source =
      forcing_ ? forcing_->add_to(stirred, forced_fluid(), forced(s, part)) : stirred;
  if (eddies_ && s.is_balanced) eddies_->add_to_mean(part.share, report_.sub_steps == 0);

  convect(s, part, u_, nullptr);
  sides_.evaluate_pressure(part.time + step);
  sides_.fill_pressure(p_, false);
  each_moving_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
    first_stage_row(n, grid_.stride[d], step, properties_.inertia(d, o), inverse_h,
                    &u_.component[d][o], &stages_.sum.component[d][o], &p_[o],
                    &source.component[d][o], &stages_.right.component[d][o]);
    std::copy_n(&u_.component[d][o], n, &stages_.next.component[d][o]);
  });
  sides_.evaluate_velocity(part.time + k_gamma * step, void_fraction_.field());
  solve_stage();
  if (s.keeps_mean) drag_velocity_.add_stage(geometry(), next, (1.0 - k_gamma) * part.share);
  each_moving_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
    between_stages_row(n, grid_.stride[d], step, properties_.inertia(d, o), inverse_h,
                       &u_.component[d][o], &stages_.next.component[d][o],
                       &stages_.right.component[d][o], &p_[o], &source.component[d][o],
                       &stages_.sum.component[d][o]);
  });
  convect(s, part, next, &sum);
  sides_.evaluate_velocity(part.time + step, void_fraction_.field());
  solve_stage();
  if (s.keeps_mean) drag_velocity_.add_stage(geometry(), next, k_gamma * part.share);
  std::swap(u_, next);
  if (forcing_) {
    forcing_->force(u_, forced_fluid(), forced(s, part));
    fill_stage(u_);
  }
  project(s, part);
}

/// Makes the velocity obey continuity, and adds the increment to the pressure.
void FluidSolver::Impl::project(const StepState& s, const SubStep& part) {
  const bool is_plain = s.is_clean && !s.has_drag && !properties_.is_varying();
  cut_.set_sinks(continuity_.sinks(), part.time + part.step);
  report_.pressure_iterations +=
      continuity_.project(u_, void_fraction_.field(), part.step, s.exchange.coefficient, is_plain,
                          fluid_.pressure_tolerance);
  fill_stage(u_);
  if (s.keeps_mean) {
    drag_velocity_.add_pressure(geometry(), continuity_, properties_, part.step,
                                s.exchange.coefficient, part.share);
  }
  const CellField& phi = continuity_.increment();
  const bool is_first = report_.sub_steps == 0;
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) p_[o + i] += phi[o + i];
    if (!s.is_balanced) return;
    for (int i = 0; i < grid_.count[0]; ++i) {
      const double before = is_first ? 0.0 : mean_pressure_[o + i];
      mean_pressure_[o + i] = before + part.share * p_[o + i];
    }
  });
}

/// Convection of `v`: into Stages::sum, or as part of the second right side, with `add_to`.
void FluidSolver::Impl::convect(const StepState& s, const SubStep& part, const FaceField& v,
                                const FaceField* add_to) {
  const CellField& eps = void_fraction_.field();
  const double step = part.step;
  momentum_.find_flux(v, eps);
  for (int d = 0; d < 3; ++d) {
    if (!geometry().has_unknown[d]) continue;
    const auto& n = geometry().extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      if (add_to == nullptr) {
        double* sum = &stages_.sum.component[d][o];
        momentum_.convection_row(v, eps, part.smoothness, d, j, k, sum);
        if (s.is_balanced) balance_convection(v, d, j, k, sum, k_delta * step);
        return;
      }
      thread_local std::vector<double> row;
      row.resize(static_cast<std::size_t>(n[0]));
      momentum_.convection_row(v, eps, part.smoothness, d, j, k, row.data());
      if (s.is_balanced) balance_convection(v, d, j, k, row.data(), (1.0 - k_delta) * step);
      second_stage_row(n[0], step, &add_to->component[d][o], row.data(),
                       &stages_.right.component[d][o]);
    });
  }
}

/// Solves for the next stage with the sides' present values and completes it.
void FluidSolver::Impl::solve_stage() {
  FaceField& next = stages_.next;
  sides_.fill_for_sweeps(next);
  momentum_.solve(stages_.right, next);
  momentum_.extend(next, Ghosts::but_deep);
  fill_stage(next);
}

void FluidSolver::Impl::end_step(const StepState& s, double last_share) {
  sides_.fill_velocity(u_);
  const Momentum::Rates& rates = rates_.write() = momentum_.rates(u_);
  check_finite(s.time + s.step, rates);
  report_.largest_speed = rates.speed;
  report_.divergence = continuity_.largest_divergence(u_, void_fraction_.field());
  if (s.keeps_mean) drag_velocity_.end(sides_);
  stress_.invalidate();
  if (!s.is_balanced) return;
  const FaceField& mean_velocity = drag_velocity_.field();
  FaceField& stress = stress_.write();
  find_stress(mean_velocity, mean_pressure_, stress, eddies_ ? &eddies_->mean_force() : nullptr);
  sides_.fill_pressure(p_, false);
  const CellField& eps = void_fraction_.field();
  const FaceField& given = s.exchange.source;
  const FaceField& source = forcing_ ? forcing_->add_mean_to(given, eps) : given;
  balance_->end(u_, eps, {source, s.exchange.coefficient}, mean_velocity, stress, s.step,
                last_share);
}

void FluidSolver::Impl::begin_balance(const StepState& s) {
  if (!balance_) {
    balance_ = std::make_unique<MomentumBalance>(grid_, geometry(), properties_);
    mean_pressure_.assign(grid_.size, 0.0);
  }
  set_void_fraction(s, 0.0);
  balance_->begin(u_, void_fraction_, s.exchange.source, s.step);
}

/// Adds a row's convection, which acted for `time` [s], to the balance.
void FluidSolver::Impl::balance_convection(const FaceField& v, int d, int j, int k,
                                           const double* row, double time) {
  const std::ptrdiff_t o = grid_.index(0, j, k);
  balance_->add_convection(d, o, time, &v.component[d][o], &void_fraction_.field()[o], row,
                           momentum_.row_flux(d, j, k));
}

/// stress = -grad pressure + div tau of the velocity `v`, halos filled, with the force of `eddies`
/// (null: none).
void FluidSolver::Impl::find_stress(const FaceField& v, CellField& pressure, FaceField& stress,
                                    const FaceField* eddies) {
  sides_.fill_pressure(pressure, false);
  momentum_.viscous_force(v, stress);
  if (eddies_) eddies_->update(v);
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry().extent[d];
    const double inverse_h = 1.0 / grid_.spacing[d];
    const std::ptrdiff_t s = grid_.stride[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      subtract_gradient(n[0], s, inverse_h, &geometry().kind[d][o], &pressure[o],
                        eddies ? &eddies->component[d][o] : nullptr, &stress.component[d][o]);
    });
    if (sides_.kinds().is_periodic[d]) wrap_last_face(grid_, d, stress.component[d]);
  }
}

void FluidSolver::Impl::set_void_fraction(const StepState& s, double share) {
  void_fraction_.set(grid_, sides_, s.before, s.after, share, s.is_clean, properties_);
}

/// Is the number everywhere in the rows of cells (of faces along d) that of `value`?
bool FluidSolver::Impl::is_uniform(const std::vector<double>& field, const std::array<int, 3>& n,
                                   double value) {
  const auto differs = [&](int j, int k) {
    const double* row = &field[grid_.index(0, j, k)];
    bool all = true;
    for (int i = 0; i < n[0]; ++i) all &= row[i] == value;
    return all ? 0.0 : 1.0;
  };
  return max_rows(n[0], n[1], n[2], partial_, differs) == 0.0;
}

bool FluidSolver::Impl::has_coefficient(const Exchange& exchange) {
  for (int d = 0; d < 3; ++d) {
    if (!is_uniform(exchange.coefficient.component[d], geometry().extent[d], 0.0)) return true;
  }
  return false;
}

void FluidSolver::Impl::check_finite(double time, const Momentum::Rates& r) const {
  if (r.speed <= k_largest_speed) return;
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry().extent[d];
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          const double v = u_.component[d][grid_.index(i, j, k)];
          if (std::abs(v) <= k_largest_speed) continue;
          throw sdk::ModelError(
              std::string("the fluid diverged: velocity component ") + "xyz"[d] +
              (std::isfinite(v) ? " beyond 1e4 m/s " : " is not a number ") +
              place_text(grid_.face(d, i, j, k), time) +
              "; likely causes: a force of grains or a boundary value out of range, or a fluid "
              "step too long for it (shorten time.fluid_step)");
        }
      }
    }
  }
  throw sdk::ModelError("the fluid diverged outside the domain " + place_text(grid_.origin, time));
}

const FaceField& FluidSolver::Impl::no_drag() {
  if (zero_.component[0].empty()) zero_ = FaceField(grid_);
  return zero_;
}

}  // namespace dust::fluid
