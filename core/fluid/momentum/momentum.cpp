// SPDX-License-Identifier: Apache-2.0
#include "fluid/momentum/momentum.hpp"

#include "fluid/momentum/half_sweeps.hpp"
#include "fluid/momentum/momentum_rows.hpp"
#include "fluid/momentum/skew_convection.hpp"
#include "fluid/parallel.hpp"

#include <cmath>
#include <limits>

namespace dust::fluid {
namespace {

/// The error of the implicit solve, relative to the change over the step.
constexpr double k_sweep_tolerance = 1e-6;
constexpr int k_max_sweeps = 400;

}  // namespace

Momentum::Momentum(const Grid& grid, const Geometry& geometry, const Sides& sides,
                   const FaceProperties& properties)
    : grid_(grid),
      geometry_(geometry),
      sides_(sides),
      properties_(properties),
      flux_(grid),
      inverse_(grid) {
  geometry_changed();
}

void Momentum::geometry_changed() {
  for (int d = 0; d < 3; ++d) cut_inverse_[d].resize(geometry_.cut[d].size());
  is_plain_ = false;
}

void Momentum::find_flux(const FaceField& u, const CellField& eps) {
  // Rows of the padded block, but for the first plane, which has no lower neighbour.
  const int row = static_cast<int>(std::min(grid_.stride[1], grid_.stride[2]));
  const bool is_flat = sides_.is_idle(1);
  const bool passes_flat = is_flat && !sides_.is_still(1);  // the control volumes lose it
  const int first = is_flat ? Grid::k_halo : 0;
  const int ny = is_flat ? 1 : grid_.count[1] + 2 * Grid::k_halo;
  const int nz = grid_.count[2] + 2 * Grid::k_halo;
  for_rows(row, ny, nz - 1, [&](int j, int k) {
    const std::ptrdiff_t o = (j + first) * grid_.stride[1] + (k + 1) * grid_.stride[2];
    for (int d = 0; d < 3; ++d) {
      if (d == 1 && (is_flat || j == 0)) continue;  // has no lower neighbour, or does not count
      flux_row(row, grid_.stride[d], &eps[o], &u.component[d][o], &flux_.component[d][o]);
    }
    for (std::ptrdiff_t face = o; passes_flat && face <= o + grid_.stride[1];
         face += grid_.stride[1]) {
      flux_row(row, grid_.stride[1], &eps[face], &u.component[1][face], &flux_.component[1][face]);
    }
  });
}

void Momentum::convection_row(const FaceField& u, const CellField& eps, double smoothness, int d,
                              int j, int k, double* out) const {
  const int n = geometry_.extent[d][0];
  const std::ptrdiff_t o = grid_.index(0, j, k);
  const std::array<int, 3> c = {0, j, k};
  bool is_begun = false;
  double first = 0.0;
  double last = 0.0;
  // The component's own direction comes last: the ends of a row on open sides are taken out of it.
  for (const int e : {(d + 1) % 3, (d + 2) % 3, d}) {
    const auto& kinds = sides_.kinds();
    if (is_even(d, e)) continue;
    if (e == d) {
      if (d != 0 && !kinds.is_periodic[d] && (c[d] == 0 || c[d] == grid_.count[d])) continue;
      first = is_begun ? out[0] : 0.0;
      last = is_begun ? out[n - 1] : 0.0;
    }
    (is_begun ? convect_row : begin_convect_row)(n, grid_.stride[e], grid_.stride[d],
                                                 1.0 / grid_.spacing[e], smoothness,
                                                 &flux_.component[e][o], &u.component[d][o], out);
    is_begun = true;
  }
  if (!is_begun) std::fill_n(out, n, 0.0);
  if (d == 0 && !sides_.kinds().is_periodic[0]) {
    out[0] = first;
    out[n - 1] = last;
  }
  entering_row(u, d, j, k, out);
  divide_by_face_eps_row(n, grid_.stride[d], &eps[o], out);
  open_side_row(u, d, j, k, out);
  skew_row(u, eps, smoothness, d, j, k, out);
}

bool Momentum::is_even(int d, int e) const {
  const auto& kinds = sides_.kinds();
  return grid_.count[e] == 1 &&
         (kinds.is_periodic[e] || (e != d && ghost_rule(kinds, d, e, 0) == GhostRule::gradient &&
                                   ghost_rule(kinds, d, e, 1) == GhostRule::gradient));
}

double Momentum::neighbour_weight(double viscosity, int d, int e) const {
  return is_even(d, e) ? 0.0 : viscosity / (grid_.spacing[e] * grid_.spacing[e]);
}

void Momentum::skew_row(const FaceField& u, const CellField& eps, double smoothness, int d, int j,
                        int k, double* out) const {
  const std::size_t row = static_cast<std::size_t>(k) * geometry_.extent[d][1] + j;
  for (int n = geometry_.skew_begin[d][row]; n < geometry_.skew_begin[d][row + 1]; ++n) {
    const SkewFace& face = geometry_.skew[d][n];
    const int e = face.along;
    double along = 0.0;
    if (!is_even(d, e)) {
      convect_row(1, grid_.stride[e], grid_.stride[d], 1.0 / grid_.spacing[e], smoothness,
                  &flux_.component[e][face.at], &u.component[d][face.at], &along);
      along /= 0.5 * (eps[face.at] + eps[face.at - grid_.stride[d]]);
    }
    out[face.i] =
        along + convection_along_surface(grid_, geometry_, face, u, d, out[face.i] - along);
  }
}

RowFlux Momentum::row_flux(int d, int j, int k) const {
  const std::ptrdiff_t o = grid_.index(0, j, k);
  RowFlux flux{};
  for (std::size_t e = 0; e < 3; ++e) {
    flux.through[e] = &flux_.component[e][o];
    flux.stride[e] = grid_.stride[e];
    // Through one cell nothing flows in or out, unless its sides give it.
    const int dir = static_cast<int>(e);
    const bool is_closed = grid_.count[e] == 1 && (grid_.is_periodic[e] || sides_.is_still(dir));
    flux.per_length[e] = is_closed ? 0.0 : 1.0 / grid_.spacing[dir];
  }
  flux.across = grid_.stride[d];
  return flux;
}

void Momentum::open_side_row(const FaceField& u, int d, int j, int k, double* out) const {
  const auto& v = u.component[d];
  const std::array<int, 3> c = {0, j, k};
  for (int high = 0; high < 2; ++high) {
    if (!is_pressure_side(sides_.kinds(), d, high)) continue;
    if (d != 0 && c[d] != (high ? grid_.count[d] : 0)) continue;
    const int first = d == 0 ? (high ? grid_.count[0] : 0) : 0;
    const int last = d == 0 ? first + 1 : geometry_.extent[d][0];
    const double h = grid_.spacing[d];
    const std::ptrdiff_t inward = high ? -grid_.stride[d] : grid_.stride[d];
    const double sign = high ? -1.0 : 1.0;
    for (int i = first; i < last; ++i) {
      const std::ptrdiff_t o = grid_.index(i, j, k);
      const double in = sign * v[o];
      // Outflow: upstream difference. Inflow: nothing varies outside (pressure given), or the air
      // comes from rest, and half a cell of pressure gradient pays rho u^2 / 2 (total pressure).
      double own = 0.0;
      if (in < 0.0) {
        own = sign * v[o] * (v[o + inward] - v[o]) / h;
      } else if (sides_.is_total_pressure(2 * d + high)) {
        own = sign * v[o] * v[o] / h;
      }
      out[i] += own;
    }
  }
}

void Momentum::entering_row(const FaceField& u, int d, int j, int k, double* out) const {
  const std::array<int, 3> c = {0, j, k};
  for (int side = 0; side < 6; ++side) {
    const int e = side / 2;
    const bool is_high = side % 2 == 1;
    if (e == d || !sides_.enters_at_rest(side)) continue;
    const int edge = is_high ? grid_.count[e] - 1 : 0;
    if (e != 0 && c[e] != edge) continue;
    const int first = e == 0 ? edge : 0;
    const int last = e == 0 ? edge + 1 : geometry_.extent[d][0];
    const double inward = (is_high ? -1.0 : 1.0) / grid_.spacing[e];
    for (int i = first; i < last; ++i) {
      const std::ptrdiff_t o = grid_.index(i, j, k);
      const double* flux = &flux_.component[e][is_high ? o + grid_.stride[e] : o];
      const double in = inward * 0.5 * (flux[0] + flux[-grid_.stride[d]]);
      out[i] += std::max(in, 0.0) * u.component[d][o];
    }
  }
}

Momentum::RowWeights Momentum::row_weights(int d, int j, int k) const {
  RowWeights w{};
  const std::array<int, 3> c = {0, j, k};
  for (int e = 1; e < 3; ++e) {
    const double plain = neighbour_weight(1.0, d, e);
    double side_weight[2];
    for (int high = 0; high < 2; ++high) {
      side_weight[high] = plain;
      const int edge = high ? geometry_.extent[d][e] - 1 : 0;
      if (sides_.kinds().is_periodic[e] || c[e] != edge) continue;
      side_weight[high] =
          d != e && ghost_rule(sides_.kinds(), d, e, high) == GhostRule::fixed ? 2.0 * plain : 0.0;
    }
    (e == 1 ? w.y_low : w.z_low) = side_weight[0];
    (e == 1 ? w.y_high : w.z_high) = side_weight[1];
  }
  return w;
}

void Momentum::prepare(double implicit, const FaceField& coefficient, bool has_drag) {
  const bool is_plain = !has_drag && !properties_.is_varying();
  if (is_plain && is_plain_ && implicit == implicit_) return;
  is_plain_ = is_plain;
  implicit_ = implicit;
  const double nu = properties_.largest_kinematic_viscosity();
  double sum = 0.0;
  for (int e = 0; e < 3; ++e) {
    if (grid_.count[e] > 1) sum += 2.0 * nu * implicit / (grid_.spacing[e] * grid_.spacing[e]);
  }
  // Red-black over-relaxation with the spectral radius of the Jacobi iteration bounded by the sum
  // of the neighbours' weights (Young 1954); one in air at the steps of a grain simulation.
  const double jacobi = sum / (1.0 + sum);
  const double root = std::sqrt(1.0 - jacobi * jacobi);
  relaxation_ = 2.0 / (1.0 + root);
  const double rate = std::max(relaxation_ - 1.0, jacobi * jacobi);
  // One more, for the rate is not reached from the first sweep on: without it momentum is lost.
  sweeps_ = 1;
  if (rate > 1e-12) {
    sweeps_ += static_cast<int>(std::ceil(std::log(k_sweep_tolerance) / std::log(rate)));
  }
  // Where a step is many viscous times long the rest of the error decays over the next steps.
  sweeps_ = std::min(sweeps_, k_max_sweeps);

  for (int d = 0; d < 3; ++d) {
    const double ax = neighbour_weight(1.0, d, 0);
    const auto& e = geometry_.extent[d];
    for_rows(e[0], e[1], e[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      const RowWeights w = row_weights(d, j, k);
      const double weights = 2.0 * ax + w.y_low + w.y_high + w.z_low + w.z_high;
      const RowProperty inertia = properties_.inertia(d, o);
      if (inertia.each == nullptr) {
        inverse_row(e[0], implicit, nu * weights, 1.0 / inertia.one, &coefficient.component[d][o],
                    &geometry_.kind[d][o], &inverse_.component[d][o]);
      } else {
        inverse_row_each(e[0], implicit, weights, inertia.each, properties_.viscosity(d, o).each,
                         &coefficient.component[d][o], &geometry_.kind[d][o],
                         &inverse_.component[d][o]);
      }
    });
    for (std::size_t n = 0; n < geometry_.cut[d].size(); ++n) {
      const CutFace& face = geometry_.cut[d][n];
      double weights = 0.0;
      for (const double weight : face.weight) weights += weight;
      if (!properties_.is_varying()) {
        cut_inverse_[d][n] =
            1.0 / (1.0 + implicit * (coefficient.component[d][face.at] / properties_.density() +
                                     nu * weights));
        continue;
      }
      const double decay =
          coefficient.component[d][face.at] + properties_.viscosity_at(d, face.at) * weights;
      cut_inverse_[d][n] =
          1.0 / (1.0 + implicit * properties_.inverse_inertia_at(d, face.at) * decay);
    }
  }
}

void Momentum::solve(const FaceField& right, FaceField& u) {
  // Per viscosity over inertia where these vary.
  const double a = properties_.is_varying()
                       ? implicit_
                       : implicit_ * properties_.viscosity() / properties_.density();
  for (int d = 0; d < 3; ++d) {
    if (!geometry_.has_unknown[d]) continue;
    const HalfSweep sweep{d, a, neighbour_weight(a, d, 0), right.component[d].data(),
                          u.component[d].data()};
    const auto& e = geometry_.extent[d];
    const int halves = 2 * sweeps_;
    if (!sides_.is_any_periodic()) {
      for_half_sweeps(halves, e[0], e[1], e[2],
                      [&](int half, int j, int k) { sweep_row_and_cuts(sweep, half, j, k); });
      continue;
    }
    for (int half = 0; half < halves; ++half) {
      for_rows(e[0], e[1], e[2], [&](int j, int k) { sweep_row_and_cuts(sweep, half, j, k); });
      sides_.wrap(u.component[d], d);
    }
  }
}

/// A row of a half sweep, and the faces next to bodies in it.
void Momentum::sweep_row_and_cuts(const HalfSweep& s, int half, int j, int k) const {
  const int d = s.d;
  const double a = s.a;
  const bool is_varying = properties_.is_varying();
  const int n = geometry_.extent[d][0];
  const std::ptrdiff_t o = grid_.index(0, j, k);
  const std::ptrdiff_t sy = grid_.stride[1];
  const std::ptrdiff_t sz = grid_.stride[2];
  const int parity = (j + k + half) & 1;
  const RowWeights w = row_weights(d, j, k);
  const double* inverse = &inverse_.component[d][o];
  if (is_varying) {
    sweep_row_each(n, sy, sz, parity, relaxation_, s.ax, a * w.y_low, a * w.y_high, a * w.z_low,
                   a * w.z_high, properties_.inertia(d, o).each, properties_.viscosity(d, o).each,
                   s.right + o, inverse, s.u + o);
  } else if (w.y_low == 0.0 && w.y_high == 0.0) {
    flat_sweep_row(n, sz, parity, relaxation_, s.ax, a * w.z_low, a * w.z_high, s.right + o,
                   inverse, s.u + o);
  } else {
    sweep_row(n, sy, sz, parity, relaxation_, s.ax, a * w.y_low, a * w.y_high, a * w.z_low,
              a * w.z_high, s.right + o, inverse, s.u + o);
  }
  const std::ptrdiff_t offset[6] = {-1, 1, -sy, sy, -sz, sz};
  const std::size_t row = static_cast<std::size_t>(k) * geometry_.extent[d][1] + j;
  for (int c = geometry_.cut_begin[d][row]; c < geometry_.cut_begin[d][row + 1]; ++c) {
    const CutFace& face = geometry_.cut[d][c];
    if ((face.i + parity) & 1) continue;
    double t = s.right[face.at];
    const double b = is_varying ? a * properties_.viscosity_at(d, face.at) *
                                      properties_.inverse_inertia_at(d, face.at)
                                : a;
    for (int side = 0; side < 6; ++side) {
      const double value = face.wall_point[side] >= 0
                               ? geometry_.wall.velocity[d][face.wall_point[side]]
                               : s.u[face.at + offset[side]];
      t += b * face.weight[side] * value;
    }
    s.u[face.at] += relaxation_ * (t * cut_inverse_[d][c] - s.u[face.at]);
  }
}

void Momentum::viscous_force(const FaceField& u, FaceField& out) const {
  const double viscosity = properties_.is_varying() ? 1.0 : properties_.viscosity();
  const std::ptrdiff_t offset[6] = {
      -1, 1, -grid_.stride[1], grid_.stride[1], -grid_.stride[2], grid_.stride[2]};
  for (int d = 0; d < 3; ++d) {
    const auto& e = geometry_.extent[d];
    const auto& v = u.component[d];
    const double a[3] = {neighbour_weight(viscosity, d, 0), neighbour_weight(viscosity, d, 1),
                         neighbour_weight(viscosity, d, 2)};
    for_rows(e[0], e[1], e[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      laplace_row(e[0], grid_.stride[1], grid_.stride[2], a[0], a[1], a[2], &v[o],
                  &geometry_.kind[d][o], &out.component[d][o]);
      if (properties_.is_varying()) {
        scale_row(e[0], properties_.viscosity(d, o).each, &out.component[d][o]);
      }
      const std::size_t row = static_cast<std::size_t>(k) * e[1] + j;
      for (int n = geometry_.cut_begin[d][row]; n < geometry_.cut_begin[d][row + 1]; ++n) {
        const CutFace& face = geometry_.cut[d][n];
        double sum = 0.0;
        for (int s = 0; s < 6; ++s) {
          double value = v[face.at + offset[s]];
          if (face.wall_point[s] >= 0) {
            value = geometry_.wall.velocity[d][face.wall_point[s]];
          } else if (face.wall_point[s] == CutFace::k_side) {
            value = 0.5 * (value + v[face.at]);  // the halo holds the mirrored value here
          }
          sum += face.weight[s] * (value - v[face.at]);
        }
        out.component[d][face.at] = properties_.viscosity_at(d, face.at) * sum;
      }
    });
  }
}

void Momentum::extend(FaceField& u, Ghosts which) const {
  const bool all = which != Ghosts::uncrossed;
  for (int d = 0; d < 3; ++d) {
    auto& v = u.component[d];
    const auto& ghosts = geometry_.ghost[d];
    const auto& wall = geometry_.wall.velocity[d];
    const int count =
        static_cast<int>(which == Ghosts::all ? ghosts.size() : geometry_.deep_ghosts_begin[d]);
    // Images touch no other ghost, so the order does not matter.
    for_rows(64, (count + 63) / 64, 1, [&](int block, int) {
      for (int n = block * 64; n < std::min(count, (block + 1) * 64); ++n) {
        const GhostFace& g = ghosts[n];
        if (!all && g.is_partly_open) continue;
        if (g.is_blocked) {  // docs/theory/fluid.md, eq. (14)
          v[g.at] = normal_part(geometry_.wall, d, static_cast<std::size_t>(g.wall_point));
          continue;
        }
        const double w = wall[g.wall_point];
        double image = 0.0;
        if (g.factor > 0.0) {
          for (int c = 0; c < 8; ++c) image += g.weight[c] * v[g.node[c]];
        }
        v[g.at] = g.factor > 0.0 ? w - g.factor * (image - w) : w;
      }
    });
  }
}

Momentum::Rates Momentum::rates(const FaceField& u) {
  const auto& n = grid_.count;
  double inverse[3];
  // Round a periodic direction of one cell nothing varies; between walls one adds nothing.
  for (int e = 0; e < 3; ++e) {
    inverse[e] = n[e] > 1 || !grid_.is_periodic[e] ? 1.0 / grid_.spacing[e] : 0.0;
  }
  partial_speed_.assign(static_cast<std::size_t>(n[1]) * n[2], 0.0);
  const double courant = max_rows(n[0], n[1], n[2], partial_, [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    thread_local std::vector<double> row;
    row.resize(3 * static_cast<std::size_t>(n[0]));
    double* c = row.data();
    rate_row(n[0], grid_.stride[1], grid_.stride[2], inverse[0], inverse[1], inverse[2],
             &geometry_.kind[0][o], &geometry_.kind[1][o], &geometry_.kind[2][o],
             &u.component[0][o], &u.component[1][o], &u.component[2][o], c, c + n[0], c + 2 * n[0]);
    const RowRates r = largest_of(n[0], c, c + n[0], c + 2 * n[0]);
    const double infinite = std::numeric_limits<double>::infinity();
    partial_speed_[static_cast<std::size_t>(k) * n[1] + j] = r.bad == 0.0 ? r.speed : infinite;
    return r.bad == 0.0 ? r.courant : infinite;
  });
  double speed = 0.0;
  for (const double s : partial_speed_) speed = std::max(speed, s);
  return {courant, speed};
}

}  // namespace dust::fluid
