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
constexpr int k_most_sub_steps = 200;
/// Steps of velocity below this share of the largest speed are smooth for the limiter.
constexpr double k_smooth_share = 0.05;

std::string place_text(Vec3 p, double time) {
  char text[160];
  std::snprintf(text, sizeof text, "at [%.4g, %.4g, %.4g] m, t = %.6g s", p.x, p.y, p.z, time);
  return text;
}

}  // namespace

bool FluidSolver::Impl::is_uniform(const std::vector<double>& field, const std::array<int, 3>& n,
                                   double value) {
  const auto differs = [&](int j, int k) {
    const double* row = &field[grid.index(0, j, k)];
    bool all = true;
    for (int i = 0; i < n[0]; ++i) all &= row[i] == value;
    return all ? 0.0 : 1.0;
  };
  return max_rows(n[0], n[1], n[2], partial, differs) == 0.0;
}

bool FluidSolver::Impl::has_coefficient(const Exchange& exchange) {
  for (int d = 0; d < 3; ++d) {
    if (!is_uniform(exchange.coefficient.component[d], geometry.extent[d], 0.0)) return true;
  }
  return false;
}

void FluidSolver::Impl::set_eps(const CellField& before, const CellField& after, double share) {
  if (is_clean && eps_is_one) return;
  eps_is_one = is_clean;

  for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid.index(0, j, k);
    for (int i = 0; i < grid.count[0]; ++i) {
      eps[o + i] = (1.0 - share) * before[o + i] + share * after[o + i];
    }
  });
  sides.fill_cells(eps);
  if (properties.is_set_three()) properties.set_void_fraction(eps);
}

void FluidSolver::Impl::check_finite(double time, const Momentum::Rates& r) const {
  if (r.speed <= k_largest_speed) return;
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          const double v = u.component[d][grid.index(i, j, k)];
          if (std::abs(v) <= k_largest_speed) continue;
          throw sdk::ModelError(
              std::string("the fluid diverged: velocity component ") + "xyz"[d] +
              (std::isfinite(v) ? " beyond 1e4 m/s " : " is not a number ") +
              place_text(grid.face(d, i, j, k), time) +
              "; likely causes: a force of grains or a boundary value out of range, or a fluid "
              "step too long for it (shorten time.fluid_step)");
        }
      }
    }
  }
  throw sdk::ModelError("the fluid diverged outside the domain " + place_text(grid.origin, time));
}

void FluidSolver::Impl::convect(const FaceField& v, double smoothness, const FaceField* add_to,
                                double step) {
  momentum.find_flux(v, eps);
  for (int d = 0; d < 3; ++d) {
    if (!geometry.has_unknown[d]) continue;
    const auto& n = geometry.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      if (add_to == nullptr) {
        momentum.convection_row(v, eps, smoothness, d, j, k, &sum.component[d][o]);
        if (is_booked) book_convection(v, d, j, k, &sum.component[d][o], k_delta * step);
        return;
      }
      thread_local std::vector<double> row;
      row.resize(static_cast<std::size_t>(n[0]));
      momentum.convection_row(v, eps, smoothness, d, j, k, row.data());
      if (is_booked) book_convection(v, d, j, k, row.data(), (1.0 - k_delta) * step);
      second_stage_row(n[0], step, &add_to->component[d][o], row.data(), &right.component[d][o]);
    });
  }
}

void FluidSolver::Impl::book_convection(const FaceField& v, int d, int j, int k, const double* row,
                                        double time) {
  const std::ptrdiff_t o = grid.index(0, j, k);
  thread_local std::vector<double> outflow;
  outflow.resize(static_cast<std::size_t>(geometry.extent[d][0]));
  momentum.outflow_row(d, j, k, outflow.data());
  book->add_convection(d, o, time, &v.component[d][o], &eps[o], row, outflow.data());
}

void FluidSolver::Impl::begin_book(const CellField& before, const CellField& after,
                                   const Exchange& exchange, double step) {
  if (!book) {
    book = std::make_unique<MomentumBook>(grid, geometry, properties);
    mean_pressure.assign(grid.size, 0.0);
  }
  std::fill(mean_pressure.begin(), mean_pressure.end(), 0.0);
  set_eps(before, after, 0.0);
  book->begin(u, eps, exchange.source, step);
}

void FluidSolver::Impl::end_book(const Exchange& exchange, double step, double last) {
  find_stress_of(drag_velocity, mean_pressure);
  sides.fill_pressure(p, false);
  stress_is_known = true;
  book->end(u, eps, exchange, drag_velocity, stress, step, last);
}

void FluidSolver::Impl::add_drag_velocity(const FaceField& stage, double share) {
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      const double* from = &stage.component[d][o];
      double* to = &drag_velocity.component[d][o];
      for (int i = 0; i < n[0]; ++i) to[i] += share * from[i];
    });
  }
}

void FluidSolver::Impl::add_pressure_drag(double step, const FaceField& drag, double share) {
  const FaceField& k_field = continuity.coefficients();
  const CellField& phi = continuity.increment();
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      pressure_drag_row(n[0], grid.stride[d], step, properties.inertia(d, o), 1.0 / grid.spacing[d],
                        share, &k_field.component[d][o], &drag.component[d][o], &phi[o],
                        &drag_velocity.component[d][o]);
    });
  }
}

void FluidSolver::Impl::sub_step(double time, double step, double share, double speed,
                                 const Exchange& exchange) {
  const bool is_plain = is_clean && !has_drag && !properties.is_varying();
  const double smoothness = std::pow(k_smooth_share * speed, 2) + 1e-30;
  const auto each_row = [&](const auto& body) {
    for (int d = 0; d < 3; ++d) {
      if (sides.is_still(d)) continue;
      const auto& n = geometry.extent[d];
      for_rows(n[0], n[1], n[2],
               [&](int j, int k) { body(d, grid.index(0, j, k), n[0], 1.0 / grid.spacing[d]); });
    }
  };
  momentum.prepare(k_gamma * step, exchange.coefficient, has_drag);
  const FaceField& source = is_booked ? book->source() : with_eddies(exchange.source);

  convect(u, smoothness, nullptr, step);
  sides.evaluate_pressure(time + step);
  sides.fill_pressure(p, false);
  each_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
    first_stage_row(n, grid.stride[d], step, properties.inertia(d, o), inverse_h,
                    &u.component[d][o], &sum.component[d][o], &p[o], &source.component[d][o],
                    &right.component[d][o]);
    std::copy_n(&u.component[d][o], n, &next.component[d][o]);
  });
  sides.evaluate_velocity(time + k_gamma * step, eps);
  solve_stage();
  if (has_drag) add_drag_velocity(next, (1.0 - k_gamma) * share);
  each_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
    between_stages_row(n, grid.stride[d], step, properties.inertia(d, o), inverse_h,
                       &u.component[d][o], &next.component[d][o], &right.component[d][o], &p[o],
                       &source.component[d][o], &sum.component[d][o]);
  });
  convect(next, smoothness, &sum, step);
  sides.evaluate_velocity(time + step, eps);
  solve_stage();
  if (has_drag) add_drag_velocity(next, k_gamma * share);
  std::swap(u, next);
  suction.set_sinks(continuity.sinks(), time + step);
  report.pressure_iterations +=
      continuity.project(u, eps, step, exchange.coefficient, is_plain, fluid.pressure_tolerance);
  fill_stage(u);
  if (has_drag) add_pressure_drag(step, exchange.coefficient, share);
  const CellField& phi = continuity.increment();
  for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid.index(0, j, k);
    for (int i = 0; i < grid.count[0]; ++i) p[o + i] += phi[o + i];
    if (!is_booked) return;
    for (int i = 0; i < grid.count[0]; ++i) mean_pressure[o + i] += share * p[o + i];
  });
}

void FluidSolver::Impl::find_first_pressure(double time, double step, const Exchange& exchange) {
  sides.evaluate_pressure(time);
  sides.fill_pressure(p, false);
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    const double inverse_h = 1.0 / grid.spacing[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        const double force = exchange.source.component[d][o + i] -
                             inverse_h * (p[o + i] - p[o + i - grid.stride[d]]);
        double& v = next.component[d][o + i];
        v = u.component[d][o + i];
        if (is_unknown(geometry.kind[d][o + i])) {
          v += step * properties.inverse_inertia_at(d, o + i) * force;
        }
      }
    });
  }
  momentum.extend(next, Ghosts::uncrossed);
  sides.fill_velocity(next);
  report.pressure_iterations +=
      continuity.project(next, eps, step, no_drag(), false, fluid.pressure_tolerance);
  const CellField& phi = continuity.increment();
  for (std::size_t o = 0; o < grid.size; ++o) p[o] += phi[o];
}

const FaceField& FluidSolver::Impl::with_eddies(const FaceField& source) {
  if (!eddies) return source;
  eddies->update(u);
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        all_sources.component[d][o + i] =
            source.component[d][o + i] + eddies->force().component[d][o + i];
      }
    });
  }
  return all_sources;
}

void FluidSolver::Impl::solve_stage() {
  sides.fill_for_sweeps(next);
  momentum.solve(right, next);
  momentum.extend(next, Ghosts::but_deep);
  fill_stage(next);
}

void FluidSolver::Impl::find_stress() {
  if (stress_is_known) return;
  stress_is_known = true;
  find_stress_of(u, p);
}

void FluidSolver::Impl::find_stress_of(const FaceField& v, CellField& pressure) {
  sides.fill_pressure(pressure, false);
  momentum.viscous_force(v, stress);
  if (eddies) eddies->update(v);
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry.extent[d];
    const double inverse_h = 1.0 / grid.spacing[d];
    const std::ptrdiff_t s = grid.stride[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        if (!is_unknown(geometry.kind[d][o + i])) continue;
        stress.component[d][o + i] -= inverse_h * (pressure[o + i] - pressure[o + i - s]);
        if (eddies) stress.component[d][o + i] += eddies->force().component[d][o + i];
      }
    });
    if (sides.kinds().is_periodic[d]) wrap_last_face(grid, d, stress.component[d]);
  }
}

void FluidSolver::Impl::advance(double time, double step, const CellField& before,
                                const CellField& after, const Exchange& exchange) {
  if (!(step > 0.0)) throw sdk::ModelError("the fluid step must be positive");
  report = {};
  has_drag = has_coefficient(exchange);
  is_clean = is_uniform(after, grid.count, 1.0) &&
             (&before == &after || is_uniform(before, grid.count, 1.0));
  if (has_drag || drag_velocity_is_set) {
    for (auto& component : drag_velocity.component) {
      std::fill(component.begin(), component.end(), 0.0);
    }
  }
  drag_velocity_is_set = has_drag;
  is_booked = keeps_book();
  if (standing) rates_are_known = false;
  const int cuts = cuts_per_step(step);
  for (int cut = 0; cut < cuts; ++cut) {
    const double begin = static_cast<double>(cut) / cuts;
    const double end = cut + 1 == cuts ? 1.0 : (cut + 1.0) / cuts;
    advance_part(time, step, begin, end, before, after, exchange);
  }
  sides.fill_velocity(u);
  rates = momentum.rates(u);
  rates_are_known = true;
  check_finite(time + step, rates);
  report.largest_speed = rates.speed;
  report.divergence = continuity.largest_divergence(u, eps);
  if (has_drag) sides.fill_velocity(drag_velocity);
  stress_is_known = false;
  if (is_booked) end_book(exchange, step, last_share);
}

void FluidSolver::Impl::advance_part(double time, double step, double begin, double end,
                                     const CellField& before, const CellField& after,
                                     const Exchange& exchange) {
  const double until = end < 1.0 ? end * step : step;
  double done = begin > 0.0 ? begin * step : 0.0;
  if (standing) {
    cut_anew(time + done, time + until);
  } else {
    evaluate_walls(time + until);
  }
  set_deep_ghosts();
  set_rate(before, after, begin, end, step);
  if (!is_consistent) {
    // The first field may not obey continuity: mend it before it makes pressure.
    set_eps(before, after, 0.0);
    sides.evaluate_velocity(time, eps);
    momentum.extend(u, Ghosts::all);
    sides.fill_velocity(u);
    suction.set_sinks(continuity.sinks(), time);
    report.pressure_iterations +=
        continuity.project(u, eps, step, no_drag(), false, fluid.pressure_tolerance);
    sides.fill_velocity(u);
    find_first_pressure(time, step, exchange);
    is_consistent = true;
    rates_are_known = false;
  } else {
    momentum.extend(u, Ghosts::uncrossed);
    if (standing) sides.fill_velocity(u);
  }
  if (is_booked) begin_book(before, after, exchange, step);
  while (done < until) {
    if (!rates_are_known) rates = momentum.rates(u);
    rates_are_known = false;
    check_finite(time + done, rates);
    const double left = until - done;
    const int parts =
        std::max(1, static_cast<int>(std::ceil(left * rates.courant / fluid.largest_cfl - 1e-9)));
    if (report.sub_steps + parts > k_most_sub_steps) {
      char text[200];
      std::snprintf(text, sizeof text,
                    "the fluid needs more than %d sub-steps in the step from t = %.6g s: largest "
                    "speed %.4g m/s; it is diverging, or time.fluid_step is far too long",
                    k_most_sub_steps, time, rates.speed);
      throw sdk::ModelError(text);
    }
    const double dt = parts == 1 ? left : left / parts;
    set_eps(before, after, parts == 1 ? end : (done + dt) / step);
    last_share = dt / step;
    sub_step(time + done, dt, last_share, rates.speed, exchange);
    report.courant_number = std::max(report.courant_number, dt * rates.courant);
    ++report.sub_steps;
    done = parts == 1 ? until : done + dt;
  }
}

const FaceField& FluidSolver::Impl::no_drag() {
  if (zero.component[0].empty()) zero = FaceField(grid);
  return zero;
}

}  // namespace dust::fluid
