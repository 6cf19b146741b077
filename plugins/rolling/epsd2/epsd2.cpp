// SPDX-License-Identifier: Apache-2.0
#include "epsd2.hpp"

#include "../friction.hpp"
#include "../last_steps.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/square_roots.hpp>

#include <algorithm>
#include <cmath>

namespace {

namespace formula = dust::model::epsd2;
namespace sdk = dust::sdk;

/// Contacts from one root to the next: what the stages hand on stays in the first-level cache.
constexpr std::size_t k_block = 64;

DUST_KERNEL void evaluate_block(double friction, const sdk::ContactBatch& b, std::size_t first,
                                std::size_t end) {
  const double *nx = b.normal.x, *ny = b.normal.y, *nz = b.normal.z;
  const double *ax = b.angle.x, *ay = b.angle.y, *az = b.angle.z;
  const double *vx = b.velocity.x, *vy = b.velocity.y, *vz = b.velocity.z, *overlap = b.overlap;
  const double *mass = b.effective_mass, *radius = b.effective_radius, *fn = b.normal_force,
               *kn = b.normal_stiffness, *kt = b.tangential_stiffness;
  const double *ri = b.radius_i, *rj = b.radius_j;
  const double *inverse_i = b.inverse_mass_i, *inverse_j = b.inverse_mass_j;
  const double *fx = b.force.x, *fy = b.force.y, *fz = b.force.z;
  double *mx = b.history[0], *my = b.history[1], *mz = b.history[2], *last = b.history[3];
  double *tx = b.torque.x, *ty = b.torque.y, *tz = b.torque.z;
  alignas(64) double keep[k_block], size[k_block], edge[k_block], lever[k_block];
  std::size_t in_last_step[k_block];
  double change[k_block];
  std::size_t last_steps = 0;
#pragma omp simd
  for (std::size_t q = first; q < end; ++q) {
    formula::Rolling c{};
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.mx = mx[q], c.my = my[q], c.mz = mz[q];
    formula::turn(c);
    tx[q] = c.mx, ty[q] = c.my, tz[q] = c.mz;
    keep[q - first] = c.keep;
  }
  sdk::take_square_roots(keep, end - first);
  double least = 0.0;
#pragma omp simd reduction(min : least)
  for (std::size_t q = first; q < end; ++q) {
    formula::Rolling c{};
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.ax = ax[q], c.ay = ay[q], c.az = az[q];
    c.radius = radius[q];
    c.stiffness = kt[q];
    c.last_stiffness = last[q];
    c.mx = tx[q], c.my = ty[q], c.mz = tz[q];
    c.keep = keep[q - first];
    const double way = (vx[q] * nx[q] + vy[q] * ny[q] + vz[q] * nz[q]) * b.time_step;
    c.normal_force = fn[q];
    c.normal_stiffness = kn[q];
    c.way = way;
    formula::roll(b.time_step, {ri[q], rj[q], inverse_i[q], inverse_j[q]}, c);
    tx[q] = c.mx, ty[q] = c.my, tz[q] = c.mz;
    last[q] = kt[q];
    size[q - first] = c.size;
    lever[q - first] = c.lever;
    edge[q - first] = dust::model::distance_from_end(c.size, overlap[q], way);
    least = std::min(least, edge[q - first]);
  }
  sdk::take_square_roots(size, end - first);
  // Few contacts end, and only those are looked at.
  for (std::size_t q = first; least < 0.0 && q < end; ++q) {
    if (!(edge[q - first] < 0.0)) continue;
    const double speed = vx[q] * nx[q] + vy[q] * ny[q] + vz[q] * nz[q];
    const double before = std::sqrt(mx[q] * mx[q] + my[q] * my[q] + mz[q] * mz[q]);
    const double limit = friction * radius[q] * std::abs(fn[q]);
    const double by = dust::model::change_at_the_end(
        {size[q - first], before, limit, overlap[q], speed, fn[q], mass[q]}, b.time_step);
    if (by == 1.0) continue;
    in_last_step[last_steps] = q;
    change[last_steps++] = by;
  }
#pragma omp simd
  for (std::size_t q = first; q < end; ++q) {
    formula::Rolling c{};
    c.radius = radius[q];
    c.normal_force = fn[q];
    c.mx = tx[q], c.my = ty[q], c.mz = tz[q];
    c.size = size[q - first];
    formula::limit(friction, c);
    mx[q] = c.mx, my[q] = c.my, mz[q] = c.mz;
    const dust::model::Couple by_force =
        dust::model::couple_of_force(lever[q - first], {nx[q], ny[q], nz[q]}, {fx[q], fy[q], fz[q]},
                                     c.size, friction * radius[q] * std::abs(fn[q]));
    tx[q] = c.mx + by_force.x, ty[q] = c.my + by_force.y, tz[q] = c.mz + by_force.z;
  }
  for (std::size_t n = 0; n < last_steps; ++n) {
    const std::size_t q = in_last_step[n];
    tx[q] *= change[n], ty[q] *= change[n], tz[q] *= change[n];
  }
}

class Epsd2 final : public dust::model::RollingFriction {
 public:
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    dust::model::declare_rolling_friction(s, dust::model::k_couple_is_bounded);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "epsd2",
            .version = "2.1",
            .summary = "Elastic-plastic rolling spring without dashpot.",
            .equation =
                "\\Delta M = -k_t R^{*2} \\Delta\\theta_r,\\quad "
                "|M| \\le \\mu_r R^* |F_n|",
            .source =
                "Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269 (model C), "
                "doi:10.1016/j.powtec.2010.09.030; Wensrich and Katterfeld, Powder Technol. "
                "217 (2012) 409, doi:10.1016/j.powtec.2011.10.057"};
  }

  explicit Epsd2(const Parameters& p) : RollingFriction(p) {}
  [[nodiscard]] int history_size() const override { return 4; }
  [[nodiscard]] int couple_column() const override { return 0; }
  void evaluate(const sdk::ContactBatch& batch) const override {
    for (std::size_t first = 0; first < batch.count; first += k_block) {
      evaluate_block(friction(), batch, first, std::min(first + k_block, batch.count));
    }
  }
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Epsd2>(); }
