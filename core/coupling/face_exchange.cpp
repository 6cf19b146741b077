// SPDX-License-Identifier: Apache-2.0
#include "coupling/face_exchange.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <cmath>

namespace dust::coupling {
namespace {

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

FaceExchange::FaceExchange(const Lattice& lattice, const FaceVoid& face_void,
                           const sdk::VoidageRule& rule, bool is_set_three, bool is_own_taken_off)
    : lattice_(lattice),
      face_void_(face_void),
      rule_(rule),
      is_set_three_(is_set_three),
      is_own_taken_off_(is_own_taken_off),
      exchange_{fluid::FaceField(lattice.grid()), fluid::FaceField(lattice.grid())} {}

void FaceExchange::clear(int d) {
  for (const Touched& t : touched_[d]) {
    exchange_.coefficient.component[d][t.face] = 0.0;
    exchange_.source.component[d][t.face] = 0.0;
  }
  touched_[d].clear();
}

/// What each grain of a batch gives, from the sums over its faces.
void FaceExchange::charge(const particles::GrainRows& grains, const Spots& spots, std::size_t batch,
                          GrainMemory& memory, const fluid::CellField& eps, double step) {
  const std::size_t first = batch * SpotBatch::k_size;
  const std::size_t last = std::min(grains.count, first + SpotBatch::k_size);
  const double volume = lattice_.cell_volume();
  SpotBatch::Reals open;
  SpotBatch::Reals fluid;
  WideKernel wide(lattice_, rule_);
  WideStencil many;
  BatchSums& batch_sums = sums_[batch];
  batch_sums = {};
  for (int d = 0; d < 3; ++d) {
    sum_faces(spots.batches[batch], d, last - first, face_void_.columns(d),
              {open.data(), fluid.data()});
    for (std::size_t row = first; row < last; ++row) {
      Remembered& r = memory[row];
      FaceSums sums{open[row - first], fluid[row - first]};
      if (wide.takes(grains.position[4 * row + 3])) {
        wide.set(r.place.data(), grains.position[4 * row + 3]);
        wide.stencil(d, eps, many);
        sums = sums_of(many);
      }
      Charge& charge = charges_[d][row];
      charge = {};
      r.taken[d] = 0.0;
      r.is_paired[d] = sums.open > k_least_weight;
      if (!r.is_paired[d]) {
        ++batch_sums.unpaired;
        continue;
      }
      // What the grain's own solids add to the void fractions has no part in its drag.
      double lone = spots.eps[row];
      double excess = 1.0;
      double disturbance = 0.0;
      if (is_own_taken_off_) {
        OwnFlow& own = memory.own_flow(row);
        lone += own.solids;
        if (!is_set_three_) excess += own.face_solids[d] * sums.open / sums.fluid;
        own.lone_eps = lone;
        disturbance = lone * own.disturbance[d];
      }
      r.taken[d] = r.coefficient * excess / (sums.open * lone * lone);
      const double received = is_set_three_ ? sums.open : sums.fluid;
      charge.drag = grains.weight[row] * r.taken[d] / volume;
      charge.push = charge.drag * r.velocity[d];
      charge.extra = r.owed[d] / (received * volume * step) - charge.drag * disturbance;
      batch_sums.paid[d] += r.owed[d];
      r.owed[d] = 0.0;
    }
  }
}

inline void FaceExchange::add(int d, std::ptrdiff_t face, double weight, double open, double eps,
                              const Charge& charge) {
  double& coefficient = exchange_.coefficient.component[d][face];
  double& source = exchange_.source.component[d][face];
  if (coefficient == 0.0 && source == 0.0) {
    const double fluid = is_set_three_ ? 1.0 : eps;
    touched_[d].push_back({face, fluid * open * lattice_.cell_volume(), 0.0});
  }
  coefficient += weight * eps * charge.drag;
  source += weight * (eps * charge.push + charge.extra);
}

template <class Faces>
void FaceExchange::give_one(int d, const Faces& faces, const Charge& charge) {
  for (std::size_t n = 0; n < faces.size(); ++n) {
    if (faces.open[n] == 0.0 || faces.weight[n] == 0.0) continue;
    add(d, faces.home[n], faces.weight[n], faces.open[n], faces.void_fraction[n], charge);
  }
}

// One component is one task and sums in row order: the same bits on any number of threads.
void FaceExchange::give(int d, const particles::GrainRows& grains, const Spots& spots,
                        const GrainMemory& memory, const fluid::CellField& eps) {
  const FaceColumns columns = face_void_.columns(d);
  const std::vector<Charge>& charges = charges_[d];
  WideKernel wide(lattice_, rule_);
  WideStencil many;
  for (std::size_t row = 0; row < grains.count; ++row) {
    const Charge& charge = charges[row];
    if (charge.drag == 0.0 && charge.extra == 0.0) continue;
    if (wide.takes(grains.position[4 * row + 3])) {
      wide.set(memory[row].place.data(), grains.position[4 * row + 3]);
      wide.stencil(d, eps, many);
      give_one(d, many, charge);
      continue;
    }
    const SpotBatch& batch = spots.batches[row / SpotBatch::k_size];
    for_corners(corners(batch, d, (d + 1) % 3, (d + 2) % 3, row % SpotBatch::k_size),
                [&](std::int32_t face, double weight) {
                  const double open = columns.open[face];
                  if (open == 0.0 || weight == 0.0) return;
                  add(d, face, weight, open, columns.void_fraction[face], charge);
                });
  }
}

/// The debts of grains that are gone; returns how many find no open face.
std::int64_t FaceExchange::pay_leavers(int d, GrainMemory& memory, double step) {
  const double volume = lattice_.cell_volume();
  std::int64_t unpaired = 0;
  Stencil s;
  for (const Leaver& l : memory.leavers()) {
    if (l.owed[d] == 0.0) continue;
    face_void_.stencil(d, lattice_.place(l.place.data()), s);
    const FaceSums sums = sums_of(s);
    if (sums.open <= k_least_weight) {
      ++unpaired;
      continue;
    }
    const double received = is_set_three_ ? sums.open : sums.fluid;
    give_one(d, s, {0.0, 0.0, l.owed[d] / (received * volume * step)});
    paid_[d] += l.owed[d];
  }
  return unpaired;
}

std::int64_t FaceExchange::spread(const particles::GrainRows& grains, const Spots& spots,
                                  GrainMemory& memory, const fluid::CellField& eps, double step) {
  const std::size_t batches = (grains.count + SpotBatch::k_size - 1) / SpotBatch::k_size;
  sums_.resize(batches);
  for (auto& charges : charges_) charges.resize(grains.count);
  tbb::parallel_for(std::size_t{0}, batches,
                    [&](std::size_t b) { charge(grains, spots, b, memory, eps, step); });
  std::array<std::int64_t, 3> unpaired{};
  tbb::parallel_for(0, 3, [&](int d) {
    clear(d);
    paid_[d] = 0.0;
    for (const BatchSums& sums : sums_) paid_[d] += sums.paid[d];
    give(d, grains, spots, memory, eps);
    unpaired[d] = pay_leavers(d, memory, step);
    lattice_.close_periodic(d, exchange_.coefficient.component[d]);
    lattice_.close_periodic(d, exchange_.source.component[d]);
  });
  memory.leavers().clear();
  std::int64_t all = unpaired[0] + unpaired[1] + unpaired[2];
  for (const BatchSums& sums : sums_) all += sums.unpaired;
  return all;
}

double FaceExchange::settle(const particles::GrainRows& grains, const std::vector<SpotBatch>& spots,
                            GrainMemory& memory, const fluid::CellField& eps,
                            const fluid::FaceField& velocity, double step) {
  const std::size_t batches = (grains.count + SpotBatch::k_size - 1) / SpotBatch::k_size;
  sums_.resize(batches);
  tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t b) {
    const std::size_t first = b * SpotBatch::k_size;
    const std::size_t count = std::min(grains.count - first, SpotBatch::k_size);
    SpotBatch::Reals own;
    SpotBatch::Reals disturbance;
    SpotBatch::Reals factor;
    SpotBatch::Reals given;
    WideKernel wide(lattice_, rule_);
    WideStencil many;
    for (int d = 0; d < 3; ++d) {
      for (std::size_t q = 0; q < count; ++q) {
        const Remembered& r = memory[first + q];
        own[q] = r.velocity[d];
        disturbance[q] = 0.0;
        if (is_own_taken_off_) {
          const OwnFlow& flow = memory.own_flow(first + q);
          disturbance[q] = flow.lone_eps * flow.disturbance[d];
        }
        factor[q] = step * r.taken[d];  // 0 if unpaired
      }
      const double* u = velocity.component[d].data();
      settle_faces(spots[b], d, count, face_void_.columns(d), u, own.data(), disturbance.data(),
                   factor.data(), is_set_three_, given.data());
      const auto wide_slip = [&](std::size_t q) {
        wide.set(memory[first + q].place.data(), grains.position[4 * (first + q) + 3]);
        wide.stencil(d, eps, many);
        double sum = 0.0;
        for (std::size_t n = 0; n < many.size(); ++n) {
          const double fluid = is_set_three_ ? 1.0 : many.void_fraction[n];
          sum += many.weight[n] * many.open[n] * fluid *
                 (many.void_fraction[n] * (u[many.home[n]] - own[q]) + disturbance[q]);
        }
        return sum;
      };
      sums_[b].given[d] = sums_[b].size[d] = 0.0;
      for (std::size_t q = 0; q < count; ++q) {
        Remembered& r = memory[first + q];
        const double radius = grains.position[4 * (first + q) + 3];
        if (wide.takes(radius)) given[q] = factor[q] * wide_slip(q);
        r.given[d] = given[q];
        const double impulse = grains.weight[first + q] * given[q];
        sums_[b].given[d] += impulse;
        sums_[b].size[d] += std::abs(impulse);
      }
    }
  });

  std::array<double, 3> difference{};
  std::array<double, 3> scale{};
  tbb::parallel_for(0, 3, [&](int d) {
    double on_grains = -paid_[d];
    double size = std::abs(paid_[d]);
    for (const BatchSums& sums : sums_) {
      on_grains += sums.given[d];
      size += sums.size[d];
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
