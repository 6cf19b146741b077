// SPDX-License-Identifier: Apache-2.0
#include "fluid/fluid_solver.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/plugin.hpp"
#include "fluid/body_suction.hpp"
#include "fluid/continuity.hpp"
#include "fluid/eddy_stress.hpp"
#include "fluid/geometry.hpp"
#include "fluid/momentum.hpp"
#include "fluid/parallel.hpp"
#include "fluid/sides.hpp"
#include "fluid/step_rows.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace dust::fluid {
namespace {

using sdk::Vec3;
using Ghosts = Momentum::Ghosts;

constexpr double k_largest_speed = 1e4;  ///< [m/s] beyond this the flow has blown up
constexpr int k_most_sub_steps = 200;
/// Steps of velocity below this share of the largest speed are smooth for the limiter.
constexpr double k_smooth_share = 0.05;
/// Way of a moving body, in cells, after which the grid is cut anew.
constexpr double k_most_way = 0.5;

std::string place_text(Vec3 p, double time) {
  char text[160];
  std::snprintf(text, sizeof text, "at [%.4g, %.4g, %.4g] m, t = %.6g s", p.x, p.y, p.z, time);
  return text;
}

}  // namespace

struct FluidSolver::Impl {
  Impl(const Grid& g, const scenario::FluidSpec& f, const bodies::BodySet& b,
       const Boundaries& boundaries)
      : grid(g),
        fluid(f),
        bodies(b),
        sides(grid, boundaries),
        properties(grid, fluid),
        standing(standing_part()),
        geometry(Geometry::build(grid, bodies, sides.kinds(), properties, {}, standing.get())),
        suction(bodies),
        momentum(grid, geometry, sides, properties),
        continuity(grid, geometry, sides, properties, momentum),
        u(grid),
        next(grid),
        right(grid),
        sum(grid),
        stress(grid),
        drag_velocity(grid),
        p(grid.size, 0.0),
        eps(grid.size, 1.0) {
    complete_geometry(0.0);
    sides.set_flow_data(geometry.open_area, properties.by_place());
    sides.evaluate_velocity(0.0, eps);
    sides.evaluate_pressure(0.0);
    for (int d = 0; d < 3; ++d) {
      std::fill(u.component[d].begin(), u.component[d].end(), f.initial_velocity[d]);
    }
    momentum.extend(u, Ghosts::all);
    sides.fill_velocity(u);
  }

  /// The geometry of the bodies that stand, if there are others.
  [[nodiscard]] std::unique_ptr<Geometry> standing_part() const {
    const bool has_movers = std::any_of(bodies.begin(), bodies.end(), [](const bodies::Body& b) {
      return !b.is_removed() && b.displaces();
    });
    if (!has_movers) return nullptr;
    return std::make_unique<Geometry>(
        Geometry::build_standing(grid, bodies, sides.kinds(), properties));
  }

  /// What follows from the bodies' places at `time`.
  void complete_geometry(double time) {
    sides.fill_cells(geometry.open_fraction);
    open_ahead = geometry.open_fraction;
    suction.find_cells(grid, bodies, geometry, time);
    evaluate_walls(time);
  }
  void evaluate_walls(double time) {
    const auto last = geometry.wall.velocity;
    geometry.wall.evaluate(bodies, time);
    suction.add_to(geometry.wall, bodies, time);
    walls_have_changed = walls_have_changed || geometry.wall.velocity != last;
  }

  /// Faces deep in bodies, in both fields that take turns in holding the velocity.
  void set_deep_ghosts() {
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

  /// Cuts the grid by the bodies as they move over the interval.
  void cut_anew(double begin, double end) {
    open_before = geometry.open_fraction;
    geometry =
        Geometry::build(grid, bodies, sides.kinds(), properties, {begin, end}, standing.get());
    momentum.geometry_changed();
    complete_geometry(end);
    continuity.geometry_changed(p);
    if (eddies) eddies->bodies_moved(bodies, end);
  }

  /// Intervals in which the grid is cut anew over `step`.
  [[nodiscard]] int cuts_per_step(double step) const {
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

  /// d(theta eps)/dt of cells over an interval of a fluid step, from shares `from` to `to` of it.
  void set_rate(const CellField& before, const CellField& after, double from, double to,
                double step) {
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
          rate[o] =
              inverse * (theta1 * (before[o] + to * jump) - theta0 * (before[o] + from * jump));
          const double change = inverse * (theta1 - theta0) * grid.cell_volume();
          net += change;
          gross += std::abs(change);
        }
      }
    }
    continuity.set_moved(net, gross);
    hand_on_closed(rate);
  }

  /// What a cell that has closed still held goes to the widest open neighbour.
  void hand_on_closed(CellField& rate) const {
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

  /// Is the number everywhere in the rows of cells (of faces along d) that of `value`?
  [[nodiscard]] bool is_uniform(const std::vector<double>& field, const std::array<int, 3>& n,
                                double value) {
    const auto differs = [&](int j, int k) {
      const double* row = &field[grid.index(0, j, k)];
      bool all = true;
      for (int i = 0; i < n[0]; ++i) all &= row[i] == value;
      return all ? 0.0 : 1.0;
    };
    return max_rows(n[0], n[1], n[2], partial, differs) == 0.0;
  }
  [[nodiscard]] bool has_coefficient(const Exchange& exchange) {
    for (int d = 0; d < 3; ++d) {
      if (!is_uniform(exchange.coefficient.component[d], geometry.extent[d], 0.0)) return true;
    }
    return false;
  }

  void set_eps(const CellField& before, const CellField& after, double share) {
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

  void check_finite(double time, const Momentum::Rates& r) const {
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

  void convect(const FaceField& v, double smoothness, const FaceField* add_to, double step) {
    momentum.find_flux(v, eps);
    for (int d = 0; d < 3; ++d) {
      if (!geometry.has_unknown[d]) continue;
      const auto& n = geometry.extent[d];
      for_rows(n[0], n[1], n[2], [&](int j, int k) {
        const std::ptrdiff_t o = grid.index(0, j, k);
        if (add_to == nullptr) {
          momentum.convection_row(v, eps, smoothness, d, j, k, &sum.component[d][o]);
          return;
        }
        thread_local std::vector<double> row;
        row.resize(static_cast<std::size_t>(n[0]));
        momentum.convection_row(v, eps, smoothness, d, j, k, row.data());
        second_stage_row(n[0], step, &add_to->component[d][o], row.data(), &right.component[d][o]);
      });
    }
  }

  /// Adds what drag acted on in a stage of weight `share` of the whole fluid step.
  void add_drag_velocity(const FaceField& stage, double share) {
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
  void add_pressure_drag(double step, const FaceField& drag, double share) {
    const FaceField& k_field = continuity.coefficients();
    const CellField& phi = continuity.increment();
    for (int d = 0; d < 3; ++d) {
      const auto& n = geometry.extent[d];
      for_rows(n[0], n[1], n[2], [&](int j, int k) {
        const std::ptrdiff_t o = grid.index(0, j, k);
        pressure_drag_row(n[0], grid.stride[d], step, properties.inertia(d, o),
                          1.0 / grid.spacing[d], share, &k_field.component[d][o],
                          &drag.component[d][o], &phi[o], &drag_velocity.component[d][o]);
      });
    }
  }

  /// `share`: of this sub-step in the whole fluid step.
  void sub_step(double time, double step, double share, double speed, const Exchange& exchange) {
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
    const FaceField& source = with_eddies(exchange.source);

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
    });
  }

  /// The pressure that keeps the present velocity free of divergence under the sides' pressures and
  /// the sources: else these would act in the first step as a blow that nothing holds.
  void find_first_pressure(double time, double step, const Exchange& exchange) {
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

  /// The source with the stress of the eddies of the present velocity.
  const FaceField& with_eddies(const FaceField& source) {
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

  /// Solves for `next` with the sides' present values and completes it.
  void solve_stage() {
    sides.fill_for_sweeps(next);
    momentum.solve(right, next);
    momentum.extend(next, Ghosts::but_deep);
    fill_stage(next);
  }

  /// Halos as far as the steps themselves need them.
  void fill_stage(FaceField& v) const { eddies ? sides.fill_velocity(v) : sides.fill_varying(v); }

  void find_stress() {
    if (stress_is_known) return;
    stress_is_known = true;
    sides.fill_pressure(p, false);
    momentum.viscous_force(u, stress);
    if (eddies) eddies->update(u);
    for (int d = 0; d < 3; ++d) {
      const auto& n = geometry.extent[d];
      const double inverse_h = 1.0 / grid.spacing[d];
      const std::ptrdiff_t s = grid.stride[d];
      for_rows(n[0], n[1], n[2], [&](int j, int k) {
        const std::ptrdiff_t o = grid.index(0, j, k);
        for (int i = 0; i < n[0]; ++i) {
          if (!is_unknown(geometry.kind[d][o + i])) continue;
          stress.component[d][o + i] -= inverse_h * (p[o + i] - p[o + i - s]);
          if (eddies) stress.component[d][o + i] += eddies->force().component[d][o + i];
        }
      });
      if (sides.kinds().is_periodic[d]) wrap_last_face(grid, d, stress.component[d]);
    }
  }

  void advance(double time, double step, const CellField& before, const CellField& after,
               const Exchange& exchange) {
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
  }

  /// From the shares `begin` to `end` of a fluid step, between two cuts of the grid.
  void advance_part(double time, double step, double begin, double end, const CellField& before,
                    const CellField& after, const Exchange& exchange) {
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
      sub_step(time + done, dt, dt / step, rates.speed, exchange);
      report.courant_number = std::max(report.courant_number, dt * rates.courant);
      ++report.sub_steps;
      done = parts == 1 ? until : done + dt;
    }
  }

  const FaceField& no_drag() {
    if (zero.component[0].empty()) zero = FaceField(grid);
    return zero;
  }

  Grid grid;
  scenario::FluidSpec fluid;
  const bodies::BodySet& bodies;
  Sides sides;
  FaceProperties properties;
  std::unique_ptr<Geometry> standing;  ///< only if bodies move
  Geometry geometry;
  BodySuction suction;
  Momentum momentum;
  Continuity continuity;
  FaceField u;
  FaceField next;
  FaceField right;
  FaceField sum;
  FaceField stress;
  FaceField drag_velocity;
  FaceField zero;
  CellField p;
  CellField eps;
  CellField open_before;  ///< open fractions at the beginning of the interval between two cuts
  CellField open_ahead;   ///< what open_fraction() tells
  std::unique_ptr<EddyStress> eddies;  ///< null: laminar
  FaceField all_sources;
  std::vector<double> partial;
  Momentum::Rates rates;  ///< of u at the end of the last step
  bool rates_are_known = false;
  bool stress_is_known = true;
  bool drag_velocity_is_set = false;
  bool has_drag = false;    ///< in this step
  bool is_clean = false;    ///< no solids anywhere in this step
  bool eps_is_one = false;  ///< now, halos included
  bool walls_have_changed = true;
  bool is_consistent = false;
  FluidReport report;
};

FluidSolver::FluidSolver(const Grid& grid, const scenario::FluidSpec& fluid,
                         const bodies::BodySet& bodies, const Boundaries& boundaries)
    : impl_(std::make_unique<Impl>(grid, fluid, bodies, boundaries)) {}

FluidSolver::~FluidSolver() = default;

void FluidSolver::use(const sdk::TurbulenceModel& turbulence) {
  Impl& s = *impl_;
  s.all_sources = FaceField(s.grid);
  s.eddies = std::make_unique<EddyStress>(s.grid, s.geometry, s.sides, s.properties, s.bodies,
                                          turbulence, s.u);
}
const CellField* FluidSolver::eddy_viscosity() const {
  return impl_->eddies ? &impl_->eddies->eddy_viscosity() : nullptr;
}

void FluidSolver::advance(double time, double step, const CellField& before, const CellField& after,
                          const Exchange& exchange) {
  impl_->advance(time, step, before, after, exchange);
}

const FaceField& FluidSolver::velocity() const { return impl_->u; }
const FaceField& FluidSolver::drag_velocity() const { return impl_->drag_velocity; }
const CellField& FluidSolver::pressure() const { return impl_->p; }
const FaceField& FluidSolver::stress_divergence() const {
  impl_->find_stress();
  return impl_->stress;
}
const CellField& FluidSolver::open_fraction() const { return impl_->open_ahead; }
const FluidReport& FluidSolver::report() const { return impl_->report; }

bool FluidSolver::has_moving_bodies() const { return impl_->standing != nullptr; }

void FluidSolver::look_ahead(double time) {
  Impl& s = *impl_;
  if (!s.standing) return;
  s.open_ahead =
      Geometry::open_fractions(s.grid, s.bodies, s.sides.kinds(), s.properties, time, *s.standing);
  s.sides.fill_cells(s.open_ahead);
}

void FluidSolver::bodies_changed(double time) {
  Impl& s = *impl_;
  s.standing = s.standing_part();
  s.geometry = Geometry::build(s.grid, s.bodies, s.sides.kinds(), s.properties, {time, time},
                               s.standing.get());
  s.momentum.geometry_changed();
  s.complete_geometry(time);
  s.continuity.geometry_changed(s.p);
  if (s.eddies) s.eddies->bodies_moved(s.bodies, time);
  s.momentum.extend(s.u, Ghosts::all);
  s.sides.fill_velocity(s.u);
  s.rates_are_known = false;
}

void FluidSolver::set_velocity(const std::function<Vec3(Vec3)>& velocity) {
  Impl& s = *impl_;
  for (int d = 0; d < 3; ++d) {
    for (int k = 0; k < s.geometry.extent[d][2]; ++k) {
      for (int j = 0; j < s.geometry.extent[d][1]; ++j) {
        for (int i = 0; i < s.geometry.extent[d][0]; ++i) {
          s.u.component[d][s.grid.index(i, j, k)] = velocity(s.grid.face(d, i, j, k))[d];
        }
      }
    }
  }
  s.momentum.extend(s.u, Ghosts::all);
  s.sides.fill_velocity(s.u);
  s.is_consistent = false;
  s.rates_are_known = false;
}

void FluidSolver::save(sdk::ArchiveWriter& archive) const {
  Impl& s = *impl_;
  s.find_stress();
  archive.numbers("velocity_x", s.u.component[0]);
  archive.numbers("velocity_y", s.u.component[1]);
  archive.numbers("velocity_z", s.u.component[2]);
  archive.numbers("pressure", s.p);
  archive.numbers("stress_x", s.stress.component[0]);
  archive.numbers("stress_y", s.stress.component[1]);
  archive.numbers("stress_z", s.stress.component[2]);
  archive.integer("is_consistent", s.is_consistent ? 1 : 0);
  if (s.standing) archive.integers("open_cells", s.continuity.open_cells());
}

void FluidSolver::load(sdk::ArchiveReader& archive, double time) {
  Impl& s = *impl_;
  // The bodies may have moved or gone since the start.
  const bool has_changed =
      s.standing || std::any_of(s.bodies.begin(), s.bodies.end(),
                                [](const bodies::Body& b) { return b.is_removed(); });
  if (has_changed) bodies_changed(time);
  if (s.standing) s.continuity.was_open(archive.integers("open_cells"));
  const auto take = [&](const char* name, std::vector<double>& into) {
    auto values = archive.numbers(name);
    if (values.size() != s.grid.size) {
      throw sdk::ModelError(std::string("the checkpoint's fluid field ") + name +
                            " belongs to another grid");
    }
    into = std::move(values);
  };
  take("velocity_x", s.u.component[0]);
  take("velocity_y", s.u.component[1]);
  take("velocity_z", s.u.component[2]);
  take("pressure", s.p);
  take("stress_x", s.stress.component[0]);
  take("stress_y", s.stress.component[1]);
  take("stress_z", s.stress.component[2]);
  s.is_consistent = archive.integer("is_consistent") != 0;
  s.rates_are_known = false;
  s.walls_have_changed = true;
  s.stress_is_known = true;
}

}  // namespace dust::fluid
