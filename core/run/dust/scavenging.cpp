// SPDX-License-Identifier: Apache-2.0
#include "run/dust/scavenging.hpp"

#include "airborne/impaction.hpp"
#include "run/dust/dust_stage.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_for.h>

#include <cmath>

namespace dust::run {
namespace {

std::size_t at(std::int32_t cell) { return static_cast<std::size_t>(cell); }

/// Calls visit(row) for all rows, several at once.
template <class Visit>
void for_all(std::size_t rows, const Visit& visit) {
  constexpr std::size_t k_grain = 1024;
  oneapi::tbb::parallel_for(oneapi::tbb::blocked_range<std::size_t>(0, rows, k_grain),
                            [&](const auto& range) {
                              for (std::size_t row = range.begin(); row < range.end(); ++row) {
                                visit(row);
                              }
                            });
}

}  // namespace

Scavenging::Scavenging(const scenario::Setup& setup, std::size_t cells) : in_cell_(cells, 0.0) {
  for (const scenario::MaterialSpec& m : setup.materials) {
    coarse_graining_.push_back(m.coarse_graining);
  }
}

void Scavenging::find_meetings(const DustStage& dust, const particles::GrainRows& grains) {
  cell_.resize(grains.count);
  speed_.resize(grains.count);
  flow_.resize(grains.count);
  for_all(grains.count, [&](std::size_t row) {
    const double* v = grains.velocity_of(row);
    cell_[row] = dust.cell_with_gas(grains.centre(row));
    speed_[row] =
        cell_[row] < 0 ? 0.0 : norm(dust.gas_velocity(cell_[row]) - sdk::Vec3{v[0], v[1], v[2]});
  });
}

/// A coarse grain of diameter D stands for l^3 of D / l, which together have l D^2 in the way.
void Scavenging::find_flows(const airborne::DustClass& dust, const particles::GrainRows& grains) {
  for_all(grains.count, [&](std::size_t row) {
    const double l = coarse_graining_[static_cast<std::size_t>(grains.material[row])];
    const double diameter = grains.diameter(row) / l;
    flow_[row] =
        grains.weight[row] * l * l * l * airborne::cleared_flow(dust, diameter, speed_[row]);
  });
}

void Scavenging::catch_class(std::size_t n, double step, DustStage& dust,
                             particles::Dem& particles) {
  const particles::GrainRows grains = particles.rows();
  find_flows(dust.field().dust_class(n), grains);
  touched_.clear();
  for (std::size_t row = 0; row < grains.count; ++row) {
    if (!(flow_[row] > 0.0)) continue;
    double& sum = in_cell_[at(cell_[row])];
    if (sum == 0.0) touched_.push_back(cell_[row]);
    sum += flow_[row];
  }
  for (const std::int32_t cell : touched_) {
    double& sum = in_cell_[at(cell)];
    const double share = -std::expm1(-step * sum / dust.gas_volume(cell));
    sum = dust.catch_in(n, cell, share) / sum;
  }
  for (std::size_t row = 0; row < grains.count; ++row) {
    if (!(flow_[row] > 0.0)) continue;
    const double caught = flow_[row] * in_cell_[at(cell_[row])];
    if (caught > 0.0) particles.take_up_dust(row, n, caught / grains.weight[row]);
  }
  for (const std::int32_t cell : touched_) in_cell_[at(cell)] = 0.0;
}

void Scavenging::advance(double step, DustStage& dust, particles::Dem& particles) {
  if (dust.field().is_empty() || particles.rows().count == 0) return;
  find_meetings(dust, particles.rows());
  for (std::size_t n = 0; n < dust.field().classes(); ++n) catch_class(n, step, dust, particles);
}

}  // namespace dust::run
