// SPDX-License-Identifier: Apache-2.0
#include "fluid/fluid_solver.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/plugin.hpp"
#include "fluid/eddy_stress.hpp"
#include "fluid/geometry.hpp"
#include "fluid/momentum.hpp"
#include "fluid/parallel.hpp"
#include "fluid/pressure_solver.hpp"
#include "fluid/sides.hpp"
#include "fluid/step_rows.hpp"

#include <cmath>
#include <cstdio>
#include <numbers>
#include <string>

namespace dust::fluid {
namespace {

using sdk::Vec3;

constexpr double k_largest_speed = 1e4;  ///< [m/s] beyond this the flow has blown up
constexpr int k_most_sub_steps = 200;
/// Steps of velocity below this share of the largest speed are smooth for the limiter.
constexpr double k_smooth_share = 0.05;
/// Net given inflow over the sum of the given flows that counts as zero in a closed domain.
constexpr double k_flux_balance = 1e-6;

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
        geometry(Geometry::build(grid, bodies, sides.kinds(), properties)),
        momentum(grid, geometry, sides, properties),
        pressure_solver(grid, open_pattern),
        u(grid),
        next(grid),
        right(grid),
        sum(grid),
        stress(grid),
        drag_velocity(grid),
        p(grid.size, 0.0),
        phi(grid.size, 0.0),
        residual(grid.size, 0.0),
        eps(grid.size, 1.0),
        rate(grid.size, 0.0) {
    sides.fill_cells(geometry.open_fraction);
    geometry.wall.evaluate(bodies, 0.0);
    sides.set_flow_data(geometry.open_area, properties.by_place());
    sides.evaluate_velocity(0.0, eps);
    sides.evaluate_pressure(0.0);
    for (int d = 0; d < 3; ++d) {
      std::fill(u.component[d].begin(), u.component[d].end(), f.initial_velocity[d]);
    }
    momentum.extend(u, true);
    sides.fill_velocity(u);
  }

  /// Faces that fluid may pass and whose flux the pressure can change.
  FaceField pattern() const {
    FaceField open = geometry.open_area;
    for (int d = 0; d < 3; ++d) {
      const int e = (d + 1) % 3;
      const int f = (d + 2) % 3;
      for (int high = 0; high < 2; ++high) {
        const bool is_closed = sides.kinds().is_periodic[d]
                                   ? grid.count[d] == 1
                                   : !sides.kinds().is_pressure_side(d, high);
        if (!is_closed) continue;
        for (int a = 0; a < grid.count[e]; ++a) {
          for (int b = 0; b < grid.count[f]; ++b) {
            open.component[d][grid.index(0, 0, 0) + a * grid.stride[e] + b * grid.stride[f] +
                              high * grid.count[d] * grid.stride[d]] = 0.0;
          }
        }
      }
    }
    return open;
  }

  void set_eps(const CellField& before, const CellField& after, double share) {
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) {
        eps[o + i] = (1.0 - share) * before[o + i] + share * after[o + i];
      }
    });
    sides.fill_cells(eps);
    if (properties.is_set_three()) properties.set_void_fraction(eps);
  }

  /// Shift of the velocity from the middle of a cut face to that of its open part.
  void find_open_parts(const FaceField& v) {
    for (int d = 0; d < 3; ++d) {
      const auto& parts = geometry.open_part[d];
      open_part_shift[d].resize(parts.size());
      for (std::size_t n = 0; n < parts.size(); ++n) {
        const OpenPart& f = parts[n];
        const auto& c = v.component[d];
        open_part_shift[d][n] = f.weight[0] * (c[f.neighbour[0]] - c[f.at]) +
                                f.weight[1] * (c[f.neighbour[1]] - c[f.at]);
      }
    }
  }

  /// residual = d(eps)/dt + div(eps u), per volume of the whole cell. The shift at cut faces is
  /// that of the velocity before its last projection.
  void find_divergence(const FaceField& v) {
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      std::copy_n(&rate[o], grid.count[0], &residual[o]);
      for (int d = 0; d < 3; ++d) {
        if (grid.count[d] == 1 && sides.kinds().is_periodic[d]) continue;
        flux_difference_row(grid.count[0], grid.stride[d], 1.0 / grid.spacing[d],
                            &geometry.open_area.component[d][o], &eps[o], &v.component[d][o],
                            &residual[o]);
      }
    });
    for (int d = 0; d < 3; ++d) {
      for (std::size_t n = 0; n < geometry.open_part[d].size(); ++n) {
        const OpenPart& f = geometry.open_part[d][n];
        const std::ptrdiff_t s = grid.stride[d];
        const double flow = geometry.open_area.component[d][f.at] * 0.5 *
                            (eps[f.at] + eps[f.at - s]) * open_part_shift[d][n] / grid.spacing[d];
        residual[f.at] -= flow;
        residual[f.below] += flow;
      }
    }
  }

  /// Coefficients of the pressure equation for the present void fraction.
  void prepare_pressure(double step, const FaceField& drag) {
    FaceField& k_field = pressure_solver.coefficients();
    const FaceField& open = open_pattern;
    for (int d = 0; d < 3; ++d) {
      std::array<int, 3> n = grid.count;
      n[d] += 1;
      const double h2 = 1.0 / (grid.spacing[d] * grid.spacing[d]);
      for_rows(n[0], n[1], n[2], [&](int j, int k) {
        const std::ptrdiff_t o = grid.index(0, j, k);
        coefficient_row(n[0], grid.stride[d], step, properties.inertia(d, o), h2,
                        &open.component[d][o], &eps[o], &drag.component[d][o],
                        &k_field.component[d][o]);
      });
      if (sides.kinds().is_periodic[d]) {
        wrap_last_face(k_field.component[d], d);
      } else {
        // Half a cell between the centre and the pressure on the side.
        for (int high = 0; high < 2; ++high) {
          if (!sides.kinds().is_pressure_side(d, high)) continue;
          scale_side(k_field.component[d], d, high, 2.0);
        }
      }
    }
    pressure_solver.prepare();
  }

  void wrap_last_face(std::vector<double>& v, int d) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    for (int a = 0; a < grid.count[e]; ++a) {
      for (int b = 0; b < grid.count[f]; ++b) {
        const std::ptrdiff_t o = grid.index(0, 0, 0) + a * grid.stride[e] + b * grid.stride[f];
        v[o + grid.count[d] * grid.stride[d]] = v[o];
      }
    }
  }

  void scale_side(std::vector<double>& v, int d, int high, double factor) const {
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const std::ptrdiff_t shift = high * grid.count[d] * grid.stride[d];
    for (int a = 0; a < grid.count[e]; ++a) {
      for (int b = 0; b < grid.count[f]; ++b) {
        v[grid.index(0, 0, 0) + a * grid.stride[e] + b * grid.stride[f] + shift] *= factor;
      }
    }
  }

  /// Makes `v` obey continuity over `step`; phi = pressure increment.
  void project(FaceField& v, double step, const FaceField& drag, double tolerance) {
    find_open_parts(v);
    find_divergence(v);
    check_balance(v);
    const double scale = -fluid.density / step;
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) {
        residual[o + i] = pressure_solver.is_open(o + i) ? scale * residual[o + i] : 0.0;
      }
    });
    prepare_pressure(step, drag);
    report.pressure_iterations += pressure_solver.solve(residual, tolerance, phi).iterations;
    sides.fill_pressure(phi, true);
    const FaceField& k_field = pressure_solver.coefficients();
    for (int d = 0; d < 3; ++d) {
      const auto& n = geometry.extent[d];
      for_rows(n[0], n[1], n[2], [&](int j, int k) {
        const std::ptrdiff_t o = grid.index(0, j, k);
        correct_row(n[0], grid.stride[d], step, properties.inertia(d, o), 1.0 / grid.spacing[d],
                    &k_field.component[d][o], &drag.component[d][o], &phi[o], &v.component[d][o]);
      });
    }
    momentum.extend(v, false);
    sides.fill_velocity(v);
  }

  /// A closed domain can only take in what it gives off.
  void check_balance(const FaceField& v) const {
    if (!pressure_solver.is_singular()) return;
    double net = 0.0;
    double gross = 0.0;
    for (int d = 0; d < 3; ++d) {
      if (sides.kinds().is_periodic[d]) continue;
      const int e = (d + 1) % 3;
      const int f = (d + 2) % 3;
      for (int high = 0; high < 2; ++high) {
        if (sides.kinds().is_pressure_side(d, high)) return;
        for (int a = 0; a < grid.count[e]; ++a) {
          for (int b = 0; b < grid.count[f]; ++b) {
            const std::ptrdiff_t o = grid.index(0, 0, 0) + a * grid.stride[e] + b * grid.stride[f] +
                                     high * grid.count[d] * grid.stride[d];
            const double area =
                grid.spacing[e] * grid.spacing[f] * geometry.open_area.component[d][o];
            const double flow = area * 0.5 * (eps[o] + eps[o - grid.stride[d]]) * v.component[d][o];
            net += high ? -flow : flow;
            gross += std::abs(flow);
          }
        }
      }
    }
    if (std::abs(net) <= k_flux_balance * gross) return;
    char text[200];
    std::snprintf(
        text, sizeof text,
        "the sides let %.4g m3/s more air in than out and none of them gives way; make one "
        "a total_pressure or zero_gradient side",
        net);
    throw sdk::ModelError(text);
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
    const FaceField& k_field = pressure_solver.coefficients();
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
    const double smoothness = std::pow(k_smooth_share * speed, 2) + 1e-30;
    const auto each_row = [&](const auto& body) {
      for (int d = 0; d < 3; ++d) {
        const auto& n = geometry.extent[d];
        for_rows(n[0], n[1], n[2],
                 [&](int j, int k) { body(d, grid.index(0, j, k), n[0], 1.0 / grid.spacing[d]); });
      }
    };
    momentum.prepare(k_gamma * step, exchange.coefficient);
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
    add_drag_velocity(next, (1.0 - k_gamma) * share);
    each_row([&](int d, std::ptrdiff_t o, int n, double inverse_h) {
      between_stages_row(n, grid.stride[d], step, properties.inertia(d, o), inverse_h,
                         &u.component[d][o], &next.component[d][o], &right.component[d][o], &p[o],
                         &source.component[d][o], &sum.component[d][o]);
    });
    convect(next, smoothness, &sum, step);
    sides.evaluate_velocity(time + step, eps);
    solve_stage();
    add_drag_velocity(next, k_gamma * share);
    std::swap(u, next);
    project(u, step, exchange.coefficient, fluid.pressure_tolerance);
    add_pressure_drag(step, exchange.coefficient, share);
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) p[o + i] += phi[o + i];
    });
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
    momentum.extend(next, true);
    sides.fill_velocity(next);
  }

  void find_stress() {
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
      if (sides.kinds().is_periodic[d]) wrap_last_face(stress.component[d], d);
    }
  }

  void advance(double time, double step, const CellField& before, const CellField& after,
               const Exchange& exchange) {
    if (!(step > 0.0)) throw sdk::ModelError("the fluid step must be positive");
    report = {};
    geometry.wall.evaluate(bodies, time + step);
    for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      for (int i = 0; i < grid.count[0]; ++i) {
        rate[o + i] = geometry.open_fraction[o + i] * (after[o + i] - before[o + i]) / step;
      }
    });
    if (!is_consistent) {
      // The first field may not obey continuity: mend it before it makes pressure.
      set_eps(before, after, 0.0);
      sides.evaluate_velocity(time, eps);
      momentum.extend(u, true);
      sides.fill_velocity(u);
      project(u, step, no_drag(), fluid.pressure_tolerance);
      is_consistent = true;
    } else {
      momentum.extend(u, false);
    }
    for (auto& component : drag_velocity.component) {
      std::fill(component.begin(), component.end(), 0.0);
    }
    double done = 0.0;
    while (done < step) {
      const auto rates = momentum.rates(u);
      check_finite(time + done, rates);
      const double left = step - done;
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
      set_eps(before, after, parts == 1 ? 1.0 : (done + dt) / step);
      sub_step(time + done, dt, dt / step, rates.speed, exchange);
      report.courant_number = std::max(report.courant_number, dt * rates.courant);
      ++report.sub_steps;
      done = parts == 1 ? step : done + dt;
    }
    const auto rates = momentum.rates(u);
    check_finite(time + step, rates);
    report.largest_speed = rates.speed;
    find_divergence(u);
    report.divergence =
        max_rows(grid.count[0], grid.count[1], grid.count[2], partial, [&](int j, int k) {
          const std::ptrdiff_t o = grid.index(0, j, k);
          double largest = 0.0;
          for (int i = 0; i < grid.count[0]; ++i) {
            if (pressure_solver.is_open(o + i)) {
              largest = std::max(largest, std::abs(residual[o + i]));
            }
          }
          return largest;
        });
    sides.fill_velocity(drag_velocity);
    find_stress();
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
  Geometry geometry;
  Momentum momentum;
  FaceField open_pattern = pattern();
  PressureSolver pressure_solver;
  FaceField u;
  FaceField next;
  FaceField right;
  FaceField sum;
  FaceField stress;
  FaceField drag_velocity;
  FaceField zero;
  CellField p;
  CellField phi;
  CellField residual;
  CellField eps;
  CellField rate;
  std::unique_ptr<EddyStress> eddies;  ///< null: laminar
  FaceField all_sources;
  std::array<std::vector<double>, 3> open_part_shift;
  std::vector<double> partial;
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
const FaceField& FluidSolver::stress_divergence() const { return impl_->stress; }
const CellField& FluidSolver::open_fraction() const { return impl_->geometry.open_fraction; }
const FluidReport& FluidSolver::report() const { return impl_->report; }

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
  s.momentum.extend(s.u, true);
  s.sides.fill_velocity(s.u);
  s.is_consistent = false;
}

void FluidSolver::save(sdk::ArchiveWriter& archive) const {
  const Impl& s = *impl_;
  archive.numbers("velocity_x", s.u.component[0]);
  archive.numbers("velocity_y", s.u.component[1]);
  archive.numbers("velocity_z", s.u.component[2]);
  archive.numbers("pressure", s.p);
  archive.numbers("stress_x", s.stress.component[0]);
  archive.numbers("stress_y", s.stress.component[1]);
  archive.numbers("stress_z", s.stress.component[2]);
  archive.integer("is_consistent", s.is_consistent ? 1 : 0);
}

void FluidSolver::load(sdk::ArchiveReader& archive) {
  Impl& s = *impl_;
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
}

}  // namespace dust::fluid
