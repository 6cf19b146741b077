// SPDX-License-Identifier: Apache-2.0
#include "airborne/transport.hpp"

#include "airborne/limiter.hpp"
#include "airborne/near_wall.hpp"
#include "dust/sdk/kernel.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <cmath>

namespace dust::airborne {
namespace {

using fluid::for_rows;
using fluid::max_rows;

/// Of a cell's gas, how much may leave in a stage: a limited slope makes a face's concentration up
/// to twice the cell's, which largest_rate() counts.
constexpr double k_largest_share = 0.95;
constexpr double k_no_gas = 1e-12;

std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

/// A row of faces for the kernels below.
struct FluxRow {
  int faces = 0;
  std::ptrdiff_t stride = 0;  ///< from cell to cell across the faces
  double inverse_h = 0.0;
  double diffusivity = 0.0;
  double half_turbulent_share = 0.0;
  const double* c = nullptr;
  const double* open = nullptr;
  const double* drive = nullptr;
  const double* passage = nullptr;
};

/// docs/theory/dust.md, eq. (1) and (4). `eddy` may be null without `has_eddies`.
template <bool has_eddies>
inline __attribute__((always_inline)) void flux_of_row(const FluxRow& row, const double* eddy,
                                                       double* flux) {
  const std::ptrdiff_t s = row.stride;
  const double *c = row.c, *open = row.open, *drive = row.drive, *passage = row.passage;
  const double inverse_h = row.inverse_h, diffusivity = row.diffusivity;
  const double half_share = row.half_turbulent_share;
#pragma GCC ivdep
  for (int i = 0; i < row.faces; ++i) {
    const double below = c[i - s];
    const double above = c[i];
    const double step = open[i] * (above - below);
    const double behind = open[i - s] * (below - c[i - 2 * s]);
    const double ahead = open[i + s] * (c[i + s] - above);
    const double g = drive[i];
    const bool is_up = g > 0.0;
    const double slope = limited_slope(is_up ? behind : ahead, step);
    const double face = (is_up ? below : above) + (is_up ? 0.5 : -0.5) * slope;
    // Not below zero but for rounding: the slope towards an empty cell takes all off the value.
    const double carried = face < 0.0 ? 0.0 : face;
    const double turbulent = has_eddies ? half_share * (eddy[i - s] + eddy[i]) : 0.0;
    flux[i] = g * carried - passage[i] * inverse_h * (diffusivity + turbulent) * step;
  }
}
DUST_KERNEL void drive_row(int n, double settling, const double* throughflow, const double* passage,
                           double* drive) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) drive[i] = throughflow[i] + settling * passage[i];
}
/// The drift by inertia along a row of faces.
struct InertiaRow {
  float time = 0.0F;  ///< [s] of the dust
  const float* acceleration = nullptr;
  const float* turn = nullptr;
  float* is_held = nullptr;  ///< out: 1 where the drift is held
};
/// With the drift by inertia; docs/theory/dust.md, section 1.
DUST_KERNEL void drive_with_inertia_row(int n, double settling, const double* throughflow,
                                        const double* passage, InertiaRow inertia, double* drive) {
  const auto [time, acceleration, turn, is_held] = inertia;
  constexpr auto k_share = static_cast<float>(k_largest_stokes_number);
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const float stokes = std::abs(time) * turn[i];
    const float held = -time * acceleration[i] * (stokes > k_share ? k_share / stokes : 1.0F);
    is_held[i] = stokes > k_share && acceleration[i] != 0.0F ? 1.0F : 0.0F;
    drive[i] = throughflow[i] + (settling + static_cast<double>(held)) * passage[i];
  }
}
/// Marks cells at whose faces along one direction, `stride` apart, the drift was held.
DUST_KERNEL void mark_row(int n, std::ptrdiff_t stride, const float* is_held, float* limited) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    limited[i] = is_held[i] + is_held[i + stride] > 0.0F ? 1.0F : limited[i];
  }
}
DUST_KERNEL void fluxes(const FluxRow& row, double* flux) {
  flux_of_row<false>(row, nullptr, flux);
}
DUST_KERNEL void fluxes_with_eddies(const FluxRow& row, const double* eddy, double* flux) {
  flux_of_row<true>(row, eddy, flux);
}

}  // namespace

Transport::Transport(const fluid::Grid& grid)
    : grid_(grid),
      c_(grid.size, 0.0),
      first_(grid.size, 0.0),
      volume_(grid.size, 0.0),
      scratch_(grid.size, 0.0),
      deposition_(grid.size, 0.0),
      drive_(grid),
      flux_(grid),
      is_open_(grid) {
  for (std::size_t d = 0; d < 3; ++d) {
    is_still_[d] = grid.count[d] == 1 && grid.is_periodic[d];
  }
}

void Transport::prepare(const Flow& flow, const GasAcceleration* acceleration) {
  inertia_.gas = acceleration;
  small_cells_.find(grid_, flow);
  wall_rate_.assign(flow.walls.size(), 0.0);
  for (std::size_t d = 0; d < 3; ++d) {
    const auto n = faces(static_cast<int>(d));
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        const bool is_side = !grid_.is_periodic[d] && ((d == 0 && (i == 0 || i == n[0] - 1)) ||
                                                       (d == 1 && (j == 0 || j == n[1] - 1)) ||
                                                       (d == 2 && (k == 0 || k == n[2] - 1)));
        // Slopes look from cell to cell, not beyond a side.
        is_open_.component[d][at(o + i)] =
            !is_side && flow.passage.component[d][at(o + i)] > 0.0 ? 1.0 : 0.0;
      }
    });
    if (grid_.is_periodic[d]) wrap_faces(d, is_open_.component[d]);
  }
}

/// Gives a field on faces along d, periodic, one more face beyond either end.
void Transport::wrap_faces(std::size_t d, std::vector<double>& values) const {
  const std::ptrdiff_t s = grid_.stride[d];
  const std::ptrdiff_t length = s * grid_.count[d];
  for (int b = 0; b < grid_.count[(d + 2) % 3]; ++b) {
    for (int a = 0; a < grid_.count[(d + 1) % 3]; ++a) {
      const std::ptrdiff_t first =
          grid_.index(0, 0, 0) + a * grid_.stride[(d + 1) % 3] + b * grid_.stride[(d + 2) % 3];
      values[at(first - s)] = values[at(first + length - s)];
      values[at(first + length + s)] = values[at(first + s)];
    }
  }
}

void Transport::set_volume(const Flow& flow, double share) {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      volume_[at(o + i)] =
          (1.0 - share) * flow.volume_before[at(o + i)] + share * flow.volume_after[at(o + i)];
    }
  });
}

void Transport::concentration(const fluid::Grid& grid, const fluid::CellField& mass,
                              const fluid::CellField& volume, fluid::CellField& c) {
  for_rows(grid.count[0], grid.count[1], grid.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid.index(0, j, k);
    for (int i = 0; i < grid.count[0]; ++i) {
      const double v = volume[at(o + i)];
      c[at(o + i)] = v > k_no_gas ? mass[at(o + i)] / v : 0.0;
    }
  });
}

/// [1/s] The gas that comes in through the side which a piece of wall belongs to, over the volume
/// of the cell; negative: goes out.
double Transport::inflow_at(const Flow& flow, const WallPiece& piece) const {
  if (piece.face < 0) return 0.0;
  const int d = piece.surface / 2;
  const double along = flow.throughflow.component[at(d)][at(piece.face)];
  return (piece.surface % 2 == 0 ? along : -along) / grid_.spacing[d];
}

/// At walls the gas is at rest, and there is no drift by inertia towards them. A side that holds
/// grains and lets gas in takes only what settles faster than that.
void Transport::find_drive(const Flow& flow, const DustClass& dust) {
  const bool has_inertia = inertia_.gas != nullptr && dust.inertia_time != 0.0;
  if (has_inertia) {
    inertia_.limited.assign(grid_.size, 0.0F);
    inertia_.is_held.resize(grid_.size);
  }
  for (std::size_t d = 0; d < 3; ++d) {
    const auto n = faces(static_cast<int>(d));
    const double settling = dust.drift[static_cast<int>(d)];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::size_t o = at(grid_.index(0, j, k));
      const double* throughflow = &flow.throughflow.component[d][o];
      const double* passage = &flow.passage.component[d][o];
      double* drive = &drive_.component[d][o];
      if (has_inertia) {
        drive_with_inertia_row(n[0], settling, throughflow, passage,
                               {static_cast<float>(dust.inertia_time), &inertia_.gas->field(d)[o],
                                &inertia_.gas->turn(d)[o], &inertia_.is_held[o]},
                               drive);
      } else {
        drive_row(n[0], settling, throughflow, passage, drive);
      }
    });
    if (!has_inertia) continue;
    for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
      const std::size_t o = at(grid_.index(0, j, k));
      mark_row(grid_.count[0], grid_.stride[d], &inertia_.is_held[o], &inertia_.limited[o]);
    });
  }
  std::fill(deposition_.begin(), deposition_.end(), 0.0);
  for (std::size_t n = 0; n < flow.walls.size(); ++n) {
    const WallPiece& piece = flow.walls[n];
    const double inflow = inflow_at(flow, piece);
    const double on_edges = norm(dust.drift) * piece.cancelled;
    wall_rate_[n] = std::max(0.0, dot(dust.drift, piece.area) - std::max(0.0, inflow)) + on_edges;
    const double area = norm(piece.area);
    if (flow.smooth_wall_viscosity > 0.0 && area > 0.0 && inflow == 0.0) {
      wall_rate_[n] =
          area * deposition_velocity(dust, dot(dust.drift, piece.area) / area,
                                     flow.friction_velocity[n], flow.smooth_wall_viscosity) +
          on_edges;
    }
    deposition_[at(piece.cell)] += wall_rate_[n];
  }
}

/// [1/s] The largest share of its gas that a cell may give off per time, faces at twice the cell's
/// concentration; docs/theory/dust.md, eq. (5).
double Transport::largest_rate(const Flow& flow, const DustClass& dust) {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      const std::size_t cell = at(o + i);
      volume_[cell] = std::min(flow.volume_before[cell], flow.volume_after[cell]);
      double out = deposition_[cell];
      for (std::size_t d = 0; d < 3; ++d) {
        if (is_still(static_cast<int>(d))) continue;
        const std::size_t up = at(o + i + grid_.stride[d]);
        const double h = 1.0 / grid_.spacing[static_cast<int>(d)];
        const double low = -drive_.component[d][cell];
        const double high = drive_.component[d][up];
        out += 2.0 * h * (std::max(low, 0.0) + std::max(high, 0.0));
        const double eddy =
            flow.eddy_diffusivity.empty() ? 0.0 : turbulent_share_ * flow.eddy_diffusivity[cell];
        // Neighbours may be more turbulent: twice the mean of both, at most.
        out += 2.0 * h * h * (dust.diffusivity + eddy) *
               (flow.passage.component[d][cell] + flow.passage.component[d][up]);
      }
      scratch_[cell] = out;
    }
  });
  for (const Sink& sink : flow.sinks) scratch_[at(sink.cell)] += std::max(sink.rate, 0.0);
  small_cells_.join_rates(scratch_, volume_);
  return max_rows(grid_.count[0], grid_.count[1], grid_.count[2], partial_, [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    double largest = 0.0;
    for (int i = 0; i < grid_.count[0]; ++i) {
      const double v = volume_[at(o + i)];
      if (v > k_no_gas) largest = std::max(largest, scratch_[at(o + i)] / v);
    }
    return largest;
  });
}

void Transport::fill_halo() {
  for (std::size_t d = 0; d < 3; ++d) {
    if (!grid_.is_periodic[d] || is_still(static_cast<int>(d))) continue;
    const std::size_t e = (d + 1) % 3;
    const std::size_t f = (d + 2) % 3;
    const std::ptrdiff_t s = grid_.stride[d];
    const std::ptrdiff_t length = s * grid_.count[d];
    const std::ptrdiff_t origin = grid_.index(0, 0, 0);
    for (int b = 0; b < grid_.count[f]; ++b) {
      for (int a = 0; a < grid_.count[e]; ++a) {
        const std::ptrdiff_t first = origin + a * grid_.stride[e] + b * grid_.stride[f];
        for (int h = 1; h <= 2; ++h) {
          c_[at(first - h * s)] = c_[at(first + length - h * s)];
          c_[at(first + length + (h - 1) * s)] = c_[at(first + (h - 1) * s)];
        }
      }
    }
  }
}

/// The fluxes [kg/(m2 s)] through the lower faces of a row.
void Transport::flux_row(const Flow& flow, const DustClass& dust, int dir, int j, int k) {
  const auto d = static_cast<std::size_t>(dir);
  const std::ptrdiff_t o = grid_.index(0, j, k);
  const FluxRow row{.faces = faces(dir)[0],
                    .stride = grid_.stride[d],
                    .inverse_h = 1.0 / grid_.spacing[dir],
                    .diffusivity = dust.diffusivity,
                    .half_turbulent_share = 0.5 * turbulent_share_,
                    .c = c_.data() + o,
                    .open = is_open_.component[d].data() + o,
                    .drive = drive_.component[d].data() + o,
                    .passage = flow.passage.component[d].data() + o};
  double* flux = flux_.component[d].data() + o;
  if (flow.eddy_diffusivity.empty()) {
    fluxes(row, flux);
  } else {
    fluxes_with_eddies(row, flow.eddy_diffusivity.data() + o, flux);
  }
}

void Transport::find_fluxes(const Flow& flow, const DustClass& dust) {
  fill_halo();
  for (int d = 0; d < 3; ++d) {
    if (is_still(d)) continue;
    const auto n = faces(d);
    for_rows(n[0], n[1], n[2], [&](int j, int k) { flux_row(flow, dust, d, j, k); });
  }
}

/// Books what passes the sides in `amount` [s], and empties the fluxes that come in: clean gas.
void Transport::take_from_sides(double amount, Losses& losses, const Flow& flow) const {
  for (std::size_t d = 0; d < 3; ++d) {
    if (grid_.is_periodic[d]) continue;
    const std::size_t e = (d + 1) % 3;
    const std::size_t f = (d + 2) % 3;
    for (int high = 0; high < 2; ++high) {
      const std::size_t side = 2 * d + static_cast<std::size_t>(high);
      const double sign = high != 0 ? 1.0 : -1.0;
      const auto& outlet = flow.side_outlet[side];
      const std::ptrdiff_t first =
          grid_.index(0, 0, 0) + (high != 0 ? grid_.count[d] * grid_.stride[d] : 0);
      const double scale = sign * amount / grid_.spacing[static_cast<int>(d)];
      // The stage's sum by itself: a total that grows face by face rounds a thousand times as
      // often.
      double through_side = 0.0;
      for (int b = 0; b < grid_.count[f]; ++b) {
        for (int a = 0; a < grid_.count[e]; ++a) {
          const std::ptrdiff_t face = first + a * grid_.stride[e] + b * grid_.stride[f];
          const double left = scale * flux_.component[d][at(face)];
          const std::size_t n = static_cast<std::size_t>(b) * grid_.count[e] + a;
          const std::int32_t hood = outlet.empty() ? -1 : outlet[n];
          (hood >= 0 ? losses.outlets[static_cast<std::size_t>(hood)] : through_side) += left;
        }
      }
      losses.sides[side] += through_side;
    }
  }
}

/// mass += dt L(c), with c of the present; counts what leaves with `weight`.
void Transport::euler(const Flow& flow, const std::vector<double>& source, double dt, double weight,
                      fluid::CellField& mass, Losses& losses) {
  take_from_sides(weight * dt, losses, flow);
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      const std::size_t cell = at(o + i);
      double change = -deposition_[cell] * c_[cell];
      for (std::size_t d = 0; d < 3; ++d) {
        if (is_still(static_cast<int>(d))) continue;
        const auto& flux = flux_.component[d];
        change -=
            (flux[at(o + i + grid_.stride[d])] - flux[cell]) / grid_.spacing[static_cast<int>(d)];
      }
      mass[cell] += dt * change;
    }
  });
  for (const Sink& sink : flow.sinks) {
    // A blown opening brings clean gas.
    const double gone = dt * std::max(sink.rate, 0.0) * c_[at(sink.cell)];
    mass[at(sink.cell)] -= gone;
    losses.outlets[static_cast<std::size_t>(sink.outlet)] += weight * gone;
  }
  for (std::size_t n = 0; n < wall_rate_.size(); ++n) {
    losses.walls[n] += weight * dt * wall_rate_[n] * c_[at(flow.walls[n].cell)];
  }
  if (source.empty()) return;
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) mass[at(o + i)] += dt * source[at(o + i)];
  });
}

int Transport::advance(const Flow& flow, const DustClass& dust, double turbulent_share,
                       const std::vector<double>& source, double step, fluid::CellField& mass,
                       Losses& losses) {
  turbulent_share_ = turbulent_share;
  losses.walls.resize(flow.walls.size(), 0.0);
  find_drive(flow, dust);
  const int parts =
      std::max(1, static_cast<int>(std::ceil(step * largest_rate(flow, dust) / k_largest_share)));
  const double dt = step / parts;
  for (int part = 0; part < parts; ++part) {
    set_volume(flow, static_cast<double>(part) / parts);
    small_cells_.mix(mass, volume_);
    concentration(grid_, mass, volume_, c_);
    find_fluxes(flow, dust);
    first_ = mass;
    euler(flow, source, dt, 0.5, mass, losses);
    set_volume(flow, part + 1 == parts ? 1.0 : (part + 1.0) / parts);
    small_cells_.mix(mass, volume_);
    concentration(grid_, mass, volume_, c_);
    find_fluxes(flow, dust);
    euler(flow, source, dt, 0.5, mass, losses);
    for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < grid_.count[0]; ++i) {
        mass[at(o + i)] = 0.5 * (first_[at(o + i)] + mass[at(o + i)]);
      }
    });
  }
  small_cells_.mix(mass, flow.volume_after);
  return parts;
}

}  // namespace dust::airborne
