// SPDX-License-Identifier: Apache-2.0
#include "coupling/face_exchange.hpp"

#include <tbb/parallel_for.h>

#include <cmath>

namespace dust::coupling {
namespace {

constexpr std::size_t k_chunk = 512;  ///< grains per task; never a function of the threads
/// Weight of open faces below which a force component finds no fluid to act on.
constexpr double k_least_weight = 1e-6;

/// Sums over the eight faces of a grain.
struct FaceSums {
  double open = 0.0;   ///< a = sum(w open)
  double fluid = 0.0;  ///< e = sum(w open eps)
};

template <class Faces>
FaceSums sums_of(const Faces& s) {
  FaceSums sums;
  for (std::size_t n = 0; n < s.size(); ++n) {
    const double part = s.weight[n] * s.open[n];
    sums.open += part;
    sums.fluid += part * s.void_fraction[n];
  }
  return sums;
}

}  // namespace

FaceExchange::FaceExchange(const Lattice& lattice, const sdk::VoidageRule& rule, bool is_set_three)
    : lattice_(lattice),
      rule_(rule),
      is_set_three_(is_set_three),
      exchange_{fluid::FaceField(lattice.grid()), fluid::FaceField(lattice.grid())} {}

void FaceExchange::clear(int d) {
  for (const Touched& t : touched_[d]) {
    exchange_.coefficient.component[d][t.face] = 0.0;
    exchange_.source.component[d][t.face] = 0.0;
  }
  touched_[d].clear();
}

// One component is one task and sums in row order: the same bits on any number of threads.
std::int64_t FaceExchange::spread_component(int d, const particles::GrainRows& grains,
                                            GrainMemory& memory, const fluid::CellField& eps,
                                            double step) {
  clear(d);
  paid_[d] = 0.0;
  std::vector<double>& coefficient = exchange_.coefficient.component[d];
  std::vector<double>& source = exchange_.source.component[d];
  const double volume = lattice_.cell_volume();
  std::int64_t unpaired = 0;
  Stencil s;
  WideKernel wide(lattice_, rule_);
  WideStencil many;

  const auto add = [&](const auto& faces, double drag, double grain_velocity, double disturbance,
                       double owed) {
    for (std::size_t n = 0; n < faces.size(); ++n) {
      if (faces.open[n] == 0.0 || faces.weight[n] == 0.0) continue;
      const std::ptrdiff_t face = faces.home[n];
      if (coefficient[face] == 0.0 && source[face] == 0.0) {
        const double fluid = is_set_three_ ? 1.0 : faces.void_fraction[n];
        touched_[d].push_back({face, fluid * faces.open[n] * volume, 0.0});
      }
      const double part = faces.weight[n] * drag * faces.void_fraction[n];
      coefficient[face] += part;
      source[face] += part * grain_velocity + faces.weight[n] * (owed - drag * disturbance);
    }
  };
  const auto spread_one = [&](std::size_t row, const auto& faces, double own) {
    Remembered& r = memory[row];
    const FaceSums sums = sums_of(faces);
    r.is_paired[d] = sums.open > k_least_weight;
    r.taken[d] = 0.0;
    if (!r.is_paired[d]) {
      ++unpaired;
      return;
    }
    // What the grain's own solids add to the void fractions has no part in its drag.
    const double lone = own + r.own_solids;
    const double excess = is_set_three_ ? 1.0 : 1.0 + r.own_face_solids[d] * sums.open / sums.fluid;
    r.taken[d] = r.coefficient * excess / (sums.open * lone * lone);
    const double received = is_set_three_ ? sums.open : sums.fluid;
    r.lone_eps = lone;
    add(faces, grains.weight[row] * r.taken[d] / volume, r.velocity[d], lone * r.disturbance[d],
        r.owed[d] / (received * volume * step));
    paid_[d] += r.owed[d];
    r.owed[d] = 0.0;
  };

  for (std::size_t row = 0; row < grains.count; ++row) {
    const double* place = memory[row].place.data();
    const double radius = grains.position[4 * row + 3];
    if (wide.takes(radius)) {
      wide.set(place, radius);
      wide.stencil(d, eps, many);
      spread_one(row, many, wide.mean(eps));
      continue;
    }
    const Place p = lattice_.place(place);
    lattice_.stencil(d, p, eps, s);
    spread_one(row, s, eps[lattice_.host_cell(p, place)]);
  }
  for (Leaver& l : memory.leavers()) {
    if (l.owed[d] == 0.0) continue;
    lattice_.stencil(d, lattice_.place(l.place.data()), eps, s);
    const FaceSums sums = sums_of(s);
    if (sums.open <= k_least_weight) {
      ++unpaired;
      continue;
    }
    const double taken = is_set_three_ ? sums.open : sums.fluid;
    add(s, 0.0, 0.0, 0.0, l.owed[d] / (taken * volume * step));
    paid_[d] += l.owed[d];
  }
  lattice_.close_periodic(d, coefficient);
  lattice_.close_periodic(d, source);
  return unpaired;
}

std::int64_t FaceExchange::spread(const particles::GrainRows& grains, GrainMemory& memory,
                                  const fluid::CellField& eps, double step) {
  std::array<std::int64_t, 3> unpaired{};
  tbb::parallel_for(0, 3,
                    [&](int d) { unpaired[d] = spread_component(d, grains, memory, eps, step); });
  memory.leavers().clear();
  return unpaired[0] + unpaired[1] + unpaired[2];
}

double FaceExchange::settle(const particles::GrainRows& grains, GrainMemory& memory,
                            const fluid::CellField& eps, const fluid::FaceField& velocity,
                            double step) {
  const std::size_t chunks = (grains.count + k_chunk - 1) / k_chunk;
  tbb::parallel_for(std::size_t{0}, chunks, [&](std::size_t c) {
    Stencil s;
    WideKernel wide(lattice_, rule_);
    WideStencil many;
    for (std::size_t row = c * k_chunk; row < std::min(grains.count, (c + 1) * k_chunk); ++row) {
      Remembered& r = memory[row];
      const double radius = grains.position[4 * row + 3];
      const bool is_wide = wide.takes(radius);
      if (is_wide) wide.set(r.place.data(), radius);
      const Place p = lattice_.place(r.place.data());
      for (int d = 0; d < 3; ++d) {
        const double* u = velocity.component[d].data();
        const double v = r.velocity[d];
        const double disturbance = r.lone_eps * r.disturbance[d];
        const auto slip = [&](const auto& faces) {
          double sum = 0.0;  // eps (u - v) does not jump with eps in plug flow
          for (std::size_t n = 0; n < faces.size(); ++n) {
            const double fluid = is_set_three_ ? 1.0 : faces.void_fraction[n];
            sum += faces.weight[n] * faces.open[n] * fluid *
                   (faces.void_fraction[n] * (u[faces.home[n]] - v) + disturbance);
          }
          return sum;
        };
        r.given[d] = 0.0;
        if (!r.is_paired[d]) continue;
        if (is_wide) {
          wide.stencil(d, eps, many);
          r.given[d] = step * r.taken[d] * slip(many);
        } else {
          lattice_.stencil(d, p, eps, s);
          r.given[d] = step * r.taken[d] * slip(s);
        }
      }
    }
  });

  std::array<double, 3> difference{};
  std::array<double, 3> scale{};
  tbb::parallel_for(0, 3, [&](int d) {
    double on_grains = -paid_[d];
    double size = std::abs(paid_[d]);
    for (std::size_t row = 0; row < grains.count; ++row) {
      const double given = grains.weight[row] * memory[row].given[d];
      on_grains += given;
      size += std::abs(given);
    }
    double on_fluid = 0.0;
    for (Touched& t : touched_[d]) {
      t.force =
          t.volume * (exchange_.source.component[d][t.face] -
                      exchange_.coefficient.component[d][t.face] * velocity.component[d][t.face]);
      on_fluid += step * t.force;
      size += step * std::abs(t.force);
    }
    difference[d] = std::abs(on_fluid + on_grains);
    scale[d] = size;
  });
  const double size = std::max({scale[0], scale[1], scale[2]});
  return size > 0.0 ? std::max({difference[0], difference[1], difference[2]}) / size : 0.0;
}

void FaceExchange::per_cell(std::vector<float>& values) const {
  const fluid::Grid& grid = lattice_.grid();
  const auto number = [&](std::array<int, 3> c) {
    return c[0] + static_cast<std::size_t>(grid.count[0]) *
                      (c[1] + static_cast<std::size_t>(grid.count[1]) * c[2]);
  };
  values.assign(3 * static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2], 0.0F);
  for (int d = 0; d < 3; ++d) {
    for (const Touched& t : touched_[d]) {
      const float half = static_cast<float>(0.5 * t.force / lattice_.cell_volume());
      const std::array<int, 3> upper = lattice_.indices(t.face);
      const std::ptrdiff_t lower =
          lattice_.cell(upper[0] - (d == 0), upper[1] - (d == 1), upper[2] - (d == 2));
      values[3 * number(upper) + d] += half;
      values[3 * number(lattice_.indices(lower)) + d] += half;
    }
  }
}

}  // namespace dust::coupling
