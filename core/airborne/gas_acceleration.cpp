// SPDX-License-Identifier: Apache-2.0
#include "airborne/gas_acceleration.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/kernel.hpp"
#include "fluid/cells_beside.hpp"
#include "fluid/parallel.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <utility>

namespace dust::airborne {
namespace {

using fluid::for_rows;

/// Share of a face below which nothing passes.
constexpr double k_closed = 1e-9;
/// Solids fraction from which on the gas's changes of velocity count as the grains' doing.
constexpr double k_crowded = 0.01;

std::size_t at(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

DUST_KERNEL void velocity_row(int n, const double* throughflow, const double* passage,
                              double* velocity) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    velocity[i] = passage[i] > k_closed ? throughflow[i] / passage[i] : 0.0;
  }
}

/// How clear of grains what passes is, of the fuller one of two cells; 0: nothing passes.
DUST_KERNEL void clear_row(int n, const double* below, const double* above, const double* passage,
                           double* clear) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double eps = below[i] < above[i] ? below[i] : above[i];
    const double share = 1.0 - (1.0 - eps) / k_crowded;
    clear[i] = passage[i] > k_closed && share > 0.0 ? share : 0.0;
  }
}

DUST_KERNEL void mean_row(int n, double share, const double* velocity, const double* clear,
                          double* has_past, double* past) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    // Among grains there is no past to tell from.
    const double towards = share + (1.0 - share) * (1.0 - clear[i]);
    const double on = past[i] + towards * (velocity[i] - past[i]);
    past[i] = has_past[i] > 0.0 ? on : velocity[i];
    has_past[i] = clear[i] > 0.0 ? 1.0 : 0.0;
  }
}

/// A direction that the velocity along a row's faces changes in.
struct Across {
  std::ptrdiff_t stride = 0;
  double inverse_h = 0.0;            ///< 0: nothing varies
  const double* velocity = nullptr;  ///< on this direction's faces
};

/// The past of a row's faces.
struct PastRow {
  double rate = 0.0;                 ///< [1/s] of what its mean is behind: made up for in the step
  const double* velocity = nullptr;  ///< [m/s] its mean
  const double* is_known = nullptr;
};

/// Slope of v at i from the neighbours, as far as each is clear.
inline __attribute__((always_inline)) double slope(const double* v, const double* clear, int i,
                                                   std::ptrdiff_t s, double inverse_h) {
  const double below = clear[i - s];
  const double above = clear[i + s];
  const double both = below + above;
  const double change = below * (v[i] - v[i - s]) + above * (v[i + s] - v[i]);
  return inverse_h * change / (both > 0.0 ? both : 1.0);
}

/// A row of faces that looks across `own`, and the two other directions.
struct AccelerationRow {
  Across own, e, f;
  PastRow past;
  const double* clear = nullptr;  ///< [-] 1: no grains, 0: closed or among them
};

DUST_KERNEL void acceleration_row(int n, const AccelerationRow& row, float* acceleration,
                                  float* turn) {
  const auto& [own, e, f, past, clear] = row;
  const double *v = own.velocity, *ve = e.velocity, *vf = f.velocity;
  const std::ptrdiff_t s = own.stride, se = e.stride, sf = f.stride;
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double u = v[i];
    const double across_e = 0.25 * (ve[i] + ve[i - s] + ve[i + se] + ve[i + se - s]);
    const double across_f = 0.25 * (vf[i] + vf[i - s] + vf[i + sf] + vf[i + sf - s]);
    const double along = slope(v, clear, i, s, own.inverse_h);
    const double aside_e = slope(v, clear, i, se, e.inverse_h);
    const double aside_f = slope(v, clear, i, sf, f.inverse_h);
    const double carried = u * along + across_e * aside_e + across_f * aside_f;
    // A face that a body or grains have just set free has no past: nothing there was sped up.
    const double gained = past.is_known[i] > 0.0 ? u - past.velocity[i] : 0.0;
    acceleration[i] = static_cast<float>(clear[i] * (gained * past.rate + carried));
    turn[i] = static_cast<float>(std::sqrt(along * along + aside_e * aside_e + aside_f * aside_f));
  }
}

std::array<int, 3> faces(const fluid::Grid& grid, std::size_t d) {
  std::array<int, 3> n = grid.count;
  n[d] += 1;
  return n;
}

}  // namespace

GasAcceleration::GasAcceleration(const fluid::Grid& grid, double memory)
    : grid_(grid), velocity_(grid), past_(grid), has_past_(grid), clear_(grid), memory_(memory) {
  for (auto* fields : {&acceleration_, &turn_}) {
    for (std::vector<float>& field : *fields) field.assign(grid.size, 0.0F);
  }
}

void GasAcceleration::find_velocity(const Flow& flow) {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto n = faces(grid_, d);
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::size_t o = at(grid_.index(0, j, k));
      velocity_row(n[0], &flow.throughflow.component[d][o], &flow.passage.component[d][o],
                   &velocity_.component[d][o]);
    });
    wrap(velocity_.component[d], d);
  }
}

void GasAcceleration::find_clear(const Flow& flow) {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto n = faces(grid_, d);
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      const double* passage = &flow.passage.component[d][at(o)];
      double* clear = &clear_.component[d][at(o)];
      const double* eps = flow.void_fraction.data();
      const auto row = [&](int first, int count, int along) {
        const fluid::CellsBeside cells = fluid::cells_beside(grid_, d, along);
        clear_row(count, eps + o + first + cells.below, eps + o + first + cells.above,
                  passage + first, clear + first);
      };
      if (d == 0) {
        row(0, 1, 0);
        row(1, n[0] - 2, 1);
        row(n[0] - 1, 1, n[0] - 1);
      } else {
        row(0, n[0], d == 1 ? j : k);
      }
    });
    wrap(clear_.component[d], d);
  }
}

void GasAcceleration::wrap(std::vector<double>& values, std::size_t component) const {
  const auto n = faces(grid_, component);
  for (std::size_t d = 0; d < 3; ++d) {
    if (!grid_.is_periodic[d]) continue;
    const std::size_t e = (d + 1) % 3;
    const std::size_t f = (d + 2) % 3;
    const std::ptrdiff_t s = grid_.stride[d];
    const std::ptrdiff_t length = s * grid_.count[d];
    // The last face along its own direction is the first one.
    const std::ptrdiff_t end = d == component ? length + s : length;
    for (int b = 0; b < n[f]; ++b) {
      for (int a = 0; a < n[e]; ++a) {
        const std::ptrdiff_t first =
            grid_.index(0, 0, 0) + a * grid_.stride[e] + b * grid_.stride[f];
        values[at(first - s)] = values[at(first - s + length)];
        values[at(first + end)] = values[at(first + end - length)];
      }
    }
  }
}

void GasAcceleration::find_row(int dir, int j, int k, double rate) {
  const auto d = static_cast<std::size_t>(dir);
  const std::ptrdiff_t o = grid_.index(0, j, k);
  const auto across = [&](std::size_t e) {
    return Across{grid_.stride[e],
                  grid_.count[e] > 1 ? 1.0 / grid_.spacing[static_cast<int>(e)] : 0.0,
                  velocity_.component[e].data() + o};
  };
  float* acceleration = acceleration_[d].data() + o;
  const int n = faces(grid_, d)[0];
  const PastRow past{rate, past_.component[d].data() + o, has_past_.component[d].data() + o};
  acceleration_row(
      n,
      {across(d), across((d + 1) % 3), across((d + 2) % 3), past, clear_.component[d].data() + o},
      acceleration, turn_[d].data() + o);
  if (grid_.is_periodic[d]) return;
  const int place[3] = {0, j, k};
  if (d == 0) {
    acceleration[0] = acceleration[n - 1] = 0.0F;
  } else if (place[d] == 0 || place[d] == grid_.count[d]) {
    std::fill_n(acceleration, n, 0.0F);
  }
}

/// Takes the mean over the past a share of its way to the velocity of now.
void GasAcceleration::go_towards_velocity(double share) {
  for (std::size_t d = 0; d < 3; ++d) {
    const auto n = faces(grid_, d);
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::size_t o = at(grid_.index(0, j, k));
      mean_row(n[0], share, &velocity_.component[d][o], &clear_.component[d][o],
               &has_past_.component[d][o], &past_.component[d][o]);
    });
  }
}

void GasAcceleration::find(const Flow& flow, double step) {
  find_velocity(flow);
  find_clear(flow);
  if (is_first_) go_towards_velocity(1.0);
  is_first_ = false;
  const double share = -std::expm1(-step / memory_);
  for (int d = 0; d < 3; ++d) {
    if (grid_.count[static_cast<std::size_t>(d)] == 1) continue;  // nothing moves there
    const auto n = faces(grid_, static_cast<std::size_t>(d));
    for_rows(n[0], n[1], n[2], [&](int j, int k) { find_row(d, j, k, share / step); });
  }
  go_towards_velocity(share);
}

void GasAcceleration::save(sdk::ArchiveWriter& archive) const {
  archive.integer("gas_is_first", is_first_ ? 1 : 0);
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    archive.numbers("gas_velocity_" + axis, past_.component[d]);
    archive.numbers("gas_has_past_" + axis, has_past_.component[d]);
  }
}

void GasAcceleration::load(sdk::ArchiveReader& archive) {
  is_first_ = archive.integer("gas_is_first") != 0;
  const auto take = [&](const std::string& name, std::vector<double>& field) {
    auto values = archive.numbers(name);
    if (values.size() != grid_.size) {
      throw sdk::ModelError("the checkpoint's dust belongs to another grid");
    }
    field = std::move(values);
  };
  for (std::size_t d = 0; d < 3; ++d) {
    const std::string axis(1, "xyz"[d]);
    take("gas_velocity_" + axis, past_.component[d]);
    take("gas_has_past_" + axis, has_past_.component[d]);
  }
}

}  // namespace dust::airborne
