// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/continuity.hpp"

#include "fluid/neighbour.hpp"
#include "fluid/parallel.hpp"
#include "fluid/step/step_rows.hpp"

#include <cmath>

namespace dust::fluid {
namespace {}  // namespace

void wrap_last_face(const Grid& grid, int d, std::vector<double>& values) {
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  for (int a = 0; a < grid.count[e]; ++a) {
    for (int b = 0; b < grid.count[f]; ++b) {
      const std::ptrdiff_t o = grid.index(0, 0, 0) + a * grid.stride[e] + b * grid.stride[f];
      values[o + grid.count[d] * grid.stride[d]] = values[o];
    }
  }
}

Continuity::Continuity(const Grid& grid, const Geometry& geometry, const Sides& sides,
                       const FaceProperties& properties, const Momentum& momentum)
    : grid_(grid),
      geometry_(geometry),
      sides_(sides),
      properties_(properties),
      momentum_(momentum),
      pattern_(find_pattern()),
      solver_(std::make_unique<PressureSolver>(grid, pattern_)),
      given_{CellField(grid.size, 0.0), {}, {}},
      residual_(grid.size, 0.0),
      increment_(grid.size, 0.0) {}

FaceField Continuity::find_pattern() const {
  FaceField open = passable_area(grid_, geometry_);
  for (int d = 0; d < 3; ++d) {
    auto& faces = open.component[d];
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const bool is_joined = sides_.kinds().is_periodic[d] && grid_.count[d] > 1;
    for (int high = 0; high < 2; ++high) {
      const bool is_closed = sides_.kinds().is_periodic[d]
                                 ? grid_.count[d] == 1
                                 : !is_pressure_side(sides_.kinds(), d, high);
      if (!is_closed) continue;
      for (int a = 0; a < grid_.count[e]; ++a) {
        for (int b = 0; b < grid_.count[f]; ++b) {
          faces[grid_.index(0, 0, 0) + a * grid_.stride[e] + b * grid_.stride[f] +
                high * grid_.count[d] * grid_.stride[d]] = 0.0;
        }
      }
    }
    if (is_joined) wrap_last_face(grid_, d, faces);
  }
  return open;
}

std::vector<std::int64_t> Continuity::open_cells() const {
  std::vector<std::int64_t> cells(grid_.size);
  for (std::size_t o = 0; o < grid_.size; ++o) {
    cells[o] = solver_->is_open(static_cast<std::ptrdiff_t>(o)) ? 1 : 0;
  }
  return cells;
}

void Continuity::was_open(const std::vector<std::int64_t>& cells) {
  was_open_.assign(cells.begin(), cells.end());
}

void Continuity::geometry_changed(CellField& pressure) {
  if (was_open_.empty()) {
    was_open_.resize(grid_.size);
    for (std::size_t o = 0; o < grid_.size; ++o) {
      was_open_[o] = solver_->is_open(static_cast<std::ptrdiff_t>(o)) ? 1 : 0;
    }
  }
  FaceField pattern = find_pattern();
  bool is_same = true;
  for (int d = 0; d < 3 && is_same; ++d) {
    const auto& a = pattern.component[d];
    const auto& b = pattern_.component[d];
    for (std::size_t o = 0; o < grid_.size && is_same; ++o) is_same = (a[o] > 0.0) == (b[o] > 0.0);
  }
  pattern_ = std::move(pattern);
  is_plain_ = false;
  if (!is_same) solver_ = std::make_unique<PressureSolver>(grid_, pattern_);
  const auto& n = grid_.count;
  for (int k = 0; k < n[2]; ++k) {
    for (int j = 0; j < n[1]; ++j) {
      for (int i = 0; i < n[0]; ++i) {
        const std::ptrdiff_t o = grid_.index(i, j, k);
        if (was_open_[o] != 0 || !solver_->is_open(o)) continue;
        double sum = 0.0;
        int count = 0;
        const std::array<int, 3> c = {i, j, k};
        for (int d = 0; d < 3; ++d) {
          for (const int step : {-1, 1}) {
            const std::ptrdiff_t q = neighbour(grid_, o, d, c[d], step);
            if (q < 0 || was_open_[q] == 0 || !(pattern_.component[d][step > 0 ? q : o] > 0.0))
              continue;
            sum += pressure[q];
            ++count;
          }
        }
        if (count > 0) pressure[o] = sum / count;
      }
    }
  }
  for (std::size_t o = 0; o < grid_.size; ++o) {
    was_open_[o] = solver_->is_open(static_cast<std::ptrdiff_t>(o)) ? 1 : 0;
  }
}

/// Shift of the velocity from the middle of a cut face to that of its open part.
void Continuity::find_open_parts(const FaceField& v) {
  for (int d = 0; d < 3; ++d) {
    const auto& parts = geometry_.open_part[d];
    open_part_shift_[d].resize(parts.size());
    for (std::size_t n = 0; n < parts.size(); ++n) {
      const OpenPart& f = parts[n];
      const auto& c = v.component[d];
      open_part_shift_[d][n] =
          f.weight[0] * (c[f.neighbour[0]] - c[f.at]) + f.weight[1] * (c[f.neighbour[1]] - c[f.at]);
    }
  }
}

/// residual = d(theta eps)/dt + div(eps u), per volume of the whole cell. The shift at cut faces is
/// that of the velocity before its last projection.
void Continuity::find_divergence(const FaceField& v, const CellField& eps) {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    std::copy_n(&given_.rate[o], grid_.count[0], &residual_[o]);
    for (int d = 0; d < 3; ++d) {
      if (grid_.count[d] == 1 && sides_.kinds().is_periodic[d]) continue;
      if (sides_.is_still(d)) continue;
      flux_difference_row(grid_.count[0], grid_.stride[d], 1.0 / grid_.spacing[d],
                          &geometry_.open_area.component[d][o], &eps[o], &v.component[d][o],
                          &residual_[o]);
    }
  });
  for (const Sink& sink : given_.sinks) residual_[sink.cell] += sink.rate;
  for (int d = 0; d < 3; ++d) {
    for (std::size_t n = 0; n < geometry_.open_part[d].size(); ++n) {
      const OpenPart& f = geometry_.open_part[d][n];
      const std::ptrdiff_t s = grid_.stride[d];
      const double flow = geometry_.open_area.component[d][f.at] * 0.5 *
                          (eps[f.at] + eps[f.at - s]) * open_part_shift_[d][n] / grid_.spacing[d];
      residual_[f.at] -= flow;
      residual_[f.below] += flow;
    }
  }
}

void Continuity::find_throughflow(const FaceField& v, const CellField& eps,
                                  FaceField& throughflow) const {
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> n = grid_.count;
    n[d] += 1;
    const std::ptrdiff_t s = grid_.stride[d];
    const auto& area = geometry_.open_area.component[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      for (int i = 0; i < n[0]; ++i) {
        throughflow.component[d][o + i] =
            area[o + i] * 0.5 * (eps[o + i] + eps[o + i - s]) * v.component[d][o + i];
      }
    });
    for (std::size_t m = 0; m < open_part_shift_[d].size(); ++m) {
      const OpenPart& f = geometry_.open_part[d][m];
      throughflow.component[d][f.at] +=
          area[f.at] * 0.5 * (eps[f.at] + eps[f.at - s]) * open_part_shift_[d][m];
    }
    if (sides_.kinds().is_periodic[d]) wrap_last_face(grid_, d, throughflow.component[d]);
  }
}

/// Coefficients of the pressure equation at present; docs/theory/fluid.md, eq. (5).
void Continuity::prepare(const CellField& eps, double step, const FaceField& drag) {
  FaceField& k_field = solver_->coefficients();
  for (int d = 0; d < 3; ++d) {
    std::array<int, 3> n = grid_.count;
    n[d] += 1;
    const double h2 = 1.0 / (grid_.spacing[d] * grid_.spacing[d]);
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      coefficient_row(n[0], grid_.stride[d], step, properties_.inertia(d, o), h2,
                      &pattern_.component[d][o], &eps[o], &drag.component[d][o],
                      &k_field.component[d][o]);
    });
    if (sides_.kinds().is_periodic[d]) {
      wrap_last_face(grid_, d, k_field.component[d]);
    } else {
      // Half a cell between the centre and the pressure on the side.
      for (int high = 0; high < 2; ++high) {
        if (!is_pressure_side(sides_.kinds(), d, high)) continue;
        scale_side(k_field.component[d], d, high, 2.0);
      }
    }
  }
  solver_->prepare();
}

void Continuity::scale_side(std::vector<double>& v, int d, int high, double factor) const {
  const int e = (d + 1) % 3;
  const int f = (d + 2) % 3;
  const std::ptrdiff_t shift = high * grid_.count[d] * grid_.stride[d];
  for (int a = 0; a < grid_.count[e]; ++a) {
    for (int b = 0; b < grid_.count[f]; ++b) {
      v[grid_.index(0, 0, 0) + a * grid_.stride[e] + b * grid_.stride[f] + shift] *= factor;
    }
  }
}

int Continuity::project(FaceField& v, const CellField& eps, double step, const FaceField& drag,
                        bool is_plain, double tolerance) {
  find_open_parts(v);
  find_divergence(v, eps);
  check_balance(v, eps);
  const double scale = -properties_.density() / step;
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      residual_[o + i] = solver_->is_open(o + i) ? scale * residual_[o + i] : 0.0;
    }
  });
  if (!(is_plain && is_plain_)) prepare(eps, step, drag);
  is_plain_ = is_plain;
  const int iterations = solver_->solve(residual_, tolerance, increment_).iterations;
  sides_.fill_pressure(increment_, true);
  const FaceField& k_field = solver_->coefficients();
  for (int d = 0; d < 3; ++d) {
    if (sides_.is_still(d)) continue;
    const auto& n = geometry_.extent[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      correct_row(n[0], grid_.stride[d], step, properties_.inertia(d, o), 1.0 / grid_.spacing[d],
                  &k_field.component[d][o], &drag.component[d][o], &increment_[o],
                  &v.component[d][o]);
    });
  }
  momentum_.extend(v, Momentum::Ghosts::uncrossed);
  return iterations;
}

double Continuity::largest_divergence(const FaceField& v, const CellField& eps) {
  find_divergence(v, eps);
  return max_rows(grid_.count[0], grid_.count[1], grid_.count[2], partial_, [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    double largest = 0.0;
    for (int i = 0; i < grid_.count[0]; ++i) {
      if (solver_->is_open(o + i)) largest = std::max(largest, std::abs(residual_[o + i]));
    }
    return largest;
  });
}

/// A room without a pressure from outside can only take in what it gives off, and keeps its volume.
void Continuity::check_balance(const FaceField& v, const CellField& eps) const {
  if (!solver_->is_singular()) return;
  RoomFlows flows(grid_, *solver_);
  add_side_flows(v, eps, flows);
  for (const Sink& sink : given_.sinks) flows.add_sink(sink.cell, sink.rate * grid_.cell_volume());
  if (!given_.moved.empty()) {
    flows.add_moved(given_.moved);
    add_sheet_flows(v, flows);
  }
  flows.check();
}

/// What passes the sides whose velocity is given.
void Continuity::add_side_flows(const FaceField& v, const CellField& eps, RoomFlows& flows) const {
  for (int d = 0; d < 3; ++d) {
    if (sides_.kinds().is_periodic[d]) continue;
    const int e = (d + 1) % 3;
    const int f = (d + 2) % 3;
    const double face = grid_.spacing[e] * grid_.spacing[f];
    const std::ptrdiff_t s = grid_.stride[d];
    for (int high = 0; high < 2; ++high) {
      if (is_pressure_side(sides_.kinds(), d, high)) continue;
      for (int a = 0; a < grid_.count[e]; ++a) {
        for (int b = 0; b < grid_.count[f]; ++b) {
          const std::ptrdiff_t o = grid_.index(0, 0, 0) + a * grid_.stride[e] +
                                   b * grid_.stride[f] + high * grid_.count[d] * s;
          const double area = face * geometry_.open_area.component[d][o];
          const double flow = area * 0.5 * (eps[o] + eps[o - s]) * v.component[d][o];
          flows.add_given(high ? o - s : o, high ? -flow : flow);
        }
      }
    }
  }
}

/// The volume that thin bodies which move take from the cell on their one side and give to that on
/// the other.
void Continuity::add_sheet_flows(const FaceField& v, RoomFlows& flows) const {
  for (const BlockedFace& face : geometry_.blocked) {
    const int d = face.axis;
    const std::ptrdiff_t o = face.at;
    const double area =
        grid_.cell_volume() / grid_.spacing[d] * geometry_.open_area.component[d][o];
    const double flow = area * v.component[d][o];
    if (flow == 0.0) continue;
    flows.add_pushed(o, flow);
    std::array<int, 3> lower = face.upper;
    if (--lower[d] < 0) lower[d] += grid_.count[d];
    flows.add_pushed(grid_.index(lower[0], lower[1], lower[2]), -flow);
  }
}

}  // namespace dust::fluid
