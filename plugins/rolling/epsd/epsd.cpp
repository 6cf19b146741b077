// SPDX-License-Identifier: Apache-2.0
#include "epsd.hpp"

#include "../friction.hpp"
#include "../last_steps.hpp"

#include <dust/sdk/plugin.hpp>

#include <algorithm>

namespace {

namespace formula = dust::model::epsd;
namespace sdk = dust::sdk;

/// Contacts at a time: what is kept of them stays in the first-level cache.
constexpr std::size_t k_block = 64;

DUST_KERNEL void evaluate_block(const formula::Constants& constants, const sdk::ContactBatch& b,
                                std::size_t first, std::size_t end) {
  const formula::Constants k = constants;
  const double *nx = b.normal.x, *ny = b.normal.y, *nz = b.normal.z;
  const double *wx = b.angular_velocity.x, *wy = b.angular_velocity.y, *wz = b.angular_velocity.z;
  const double *ax = b.angle.x, *ay = b.angle.y, *az = b.angle.z;
  const double *radius = b.effective_radius, *mass = b.effective_mass;
  const double *fn = b.normal_force, *kn = b.normal_stiffness, *kt = b.tangential_stiffness;
  const double *fx = b.force.x, *fy = b.force.y, *fz = b.force.z;
  const double *ri = b.radius_i, *rj = b.radius_j;
  const double *inverse_i = b.inverse_mass_i, *inverse_j = b.inverse_mass_j;
  double *sx = b.history[0], *sy = b.history[1], *sz = b.history[2], *last = b.history[3];
  const double *vx = b.velocity.x, *vy = b.velocity.y, *vz = b.velocity.z, *overlap = b.overlap;
  double *tx = b.torque.x, *ty = b.torque.y, *tz = b.torque.z;
  alignas(64) double before[k_block], total[k_block], limit[k_block];
  // Overlaps less the way of two steps: below zero where a contact ends.
  double least = 0.0;
#pragma omp simd reduction(min : least)
  for (std::size_t q = first; q < end; ++q) {
    const double way = (vx[q] * nx[q] + vy[q] * ny[q] + vz[q] * nz[q]) * b.time_step;
    formula::Rolling c{};
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.wx = wx[q], c.wy = wy[q], c.wz = wz[q];
    c.ax = ax[q], c.ay = ay[q], c.az = az[q];
    c.vx = vx[q], c.vy = vy[q], c.vz = vz[q];
    c.fx = fx[q], c.fy = fy[q], c.fz = fz[q];
    c.radius = radius[q], c.mass = mass[q];
    c.normal_force = fn[q], c.stiffness = kn[q], c.tangential_stiffness = kt[q];
    c.last_stiffness = last[q];
    c.way = way;
    c.sx = sx[q], c.sy = sy[q], c.sz = sz[q];
    formula::evaluate(k, b.time_step, {ri[q], rj[q], inverse_i[q], inverse_j[q]}, c);
    last[q] = c.last_stiffness;
    sx[q] = c.sx;
    sy[q] = c.sy;
    sz[q] = c.sz;
    tx[q] = c.mx;
    ty[q] = c.my;
    tz[q] = c.mz;
    before[q - first] = c.before;
    total[q - first] = c.total;
    limit[q - first] = c.limit;
    least = std::min(least, dust::model::distance_from_end(c.total, overlap[q], way));
  }
  for (std::size_t q = first; least < 0.0 && q < end; ++q) {
    const double speed = vx[q] * nx[q] + vy[q] * ny[q] + vz[q] * nz[q];
    const double way = speed * b.time_step;
    if (!(dust::model::distance_from_end(total[q - first], overlap[q], way) < 0.0)) continue;
    const double change = dust::model::change_at_the_end(
        {total[q - first], before[q - first], limit[q - first], overlap[q], speed, fn[q], mass[q]},
        b.time_step);
    tx[q] *= change;
    ty[q] *= change;
    tz[q] *= change;
  }
}

void evaluate_batch(const formula::Constants& constants, const sdk::ContactBatch& b) {
  for (std::size_t first = 0; first < b.count; first += k_block) {
    evaluate_block(constants, b, first, std::min(first + k_block, b.count));
  }
}

class Epsd final : public sdk::RollingLaw {
 public:
  struct Parameters {
    double friction = 0.0;
    double damping_ratio = 0.3;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    dust::model::declare_rolling_friction(s, dust::model::k_couple_is_bounded);
    s.number(&Parameters::damping_ratio, "damping_ratio", sdk::dimension::none,
             "Damping of the rocking about a resting place, as a share of the critical one.")
        .symbol("\\eta_r")
        .at_least(0)
        .at_most(1)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "epsd",
            .version = "2.1",
            .summary = "Elastic-plastic rolling spring with a dashpot below full mobilisation.",
            .equation =
                "\\Delta M_s = -2.25 k_n \\mu_r^2 R^{*2} \\Delta\\theta_r,\\quad "
                "M = M_s - 2 \\eta_r \\sqrt{I_r k_r}\\,\\omega_r,\\quad "
                "|M| \\le \\mu_r R^* |F_n|",
            .source =
                "Ai, Chen, Rotter, Ooi, Powder Technol. 206 (2011) 269 (model C), "
                "doi:10.1016/j.powtec.2010.09.030"};
  }

  explicit Epsd(const Parameters& p) : constants_{p.friction, p.damping_ratio} {}
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return 4; }
  [[nodiscard]] int couple_column() const override { return 0; }
  void evaluate(const sdk::ContactBatch& batch) const override {
    evaluate_batch(constants_, batch);
  }

 private:
  formula::Constants constants_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Epsd>(); }
