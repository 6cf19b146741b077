// SPDX-License-Identifier: Apache-2.0
#include "hertz_mindlin.hpp"

#include "liggghts.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/square_roots.hpp>

#include <algorithm>
#include <string>

namespace {

namespace formula = dust::model::hertz_mindlin;
namespace sdk = dust::sdk;

/// Contacts from one root to the next: what the stages hand on stays in the first-level cache.
constexpr std::size_t k_block = 64;

DUST_KERNEL void evaluate_block(const formula::Constants& constants, const sdk::ContactBatch& b,
                                std::size_t first, std::size_t end) {
  const formula::Constants k = constants;
  const double time_step = b.time_step;
  const double *overlap = b.overlap, *nx = b.normal.x, *ny = b.normal.y, *nz = b.normal.z;
  const double *vx = b.velocity.x, *vy = b.velocity.y, *vz = b.velocity.z;
  const double *ux = b.displacement.x, *uy = b.displacement.y, *uz = b.displacement.z;
  const double *radius = b.effective_radius, *mass = b.effective_mass;
  const double *ri = b.radius_i, *rj = b.radius_j;
  const double *inverse_i = b.inverse_mass_i, *inverse_j = b.inverse_mass_j;
  // Any column will do where no rolling spring has a couple: its part is multiplied by zero.
  const bool has_couple = b.couple.x != nullptr;
  const double *mx = has_couple ? b.couple.x : nx, *my = has_couple ? b.couple.y : ny,
               *mz = has_couple ? b.couple.z : nz;
  const double turning = has_couple ? 2.5 : 0.0;
  double *sx = b.history[0], *sy = b.history[1], *sz = b.history[2], *stiffness = b.history[3];
  double *fn = b.normal_force, *kn = b.normal_stiffness, *kt = b.tangential_stiffness;
  double *fx = b.force.x, *fy = b.force.y, *fz = b.force.z;
  alignas(64) double contact_radius[k_block], keep[k_block], compliance[k_block], total[k_block];
  alignas(64) double dx[k_block], dy[k_block], dz[k_block], vn[k_block];
  alignas(64) double edge[k_block];
  std::size_t in_last_step[k_block];
  double change[k_block];
  std::size_t last_steps = 0;
  const std::size_t count = end - first;
#pragma omp simd
  for (std::size_t q = first; q < end; ++q) {
    contact_radius[q - first] = formula::squared_contact_radius(overlap[q], radius[q]);
    vn[q - first] = vx[q] * nx[q] + vy[q] * ny[q] + vz[q] * nz[q];
  }
  sdk::take_square_roots(contact_radius, count);
#pragma omp simd
  for (std::size_t q = first; q < end; ++q) {
    formula::Contact c{};
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.sx = sx[q], c.sy = sy[q], c.sz = sz[q];
    c.stiffness = stiffness[q];
    c.contact_radius = contact_radius[q - first];
    formula::turn(k, c);
    sx[q] = c.sx, sy[q] = c.sy, sz[q] = c.sz;
    keep[q - first] = c.keep;
    compliance[q - first] = c.compliance;
  }
  sdk::take_square_roots(keep, count);
  double least = 0.0;
#pragma omp simd reduction(min : least)
  for (std::size_t q = first; q < end; ++q) {
    formula::Contact c{};
    c.overlap = overlap[q];
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.vx = vx[q], c.vy = vy[q], c.vz = vz[q];
    c.ux = ux[q], c.uy = uy[q], c.uz = uz[q];
    c.mx = mx[q], c.my = my[q], c.mz = mz[q];
    c.mass = mass[q];
    c.inverse_mass = inverse_i[q] + inverse_j[q];
    c.turning = turning * (inverse_i[q] * rj[q] - inverse_j[q] * ri[q]) / (ri[q] * rj[q]);
    c.sx = sx[q], c.sy = sy[q], c.sz = sz[q];
    c.contact_radius = contact_radius[q - first];
    c.keep = keep[q - first];
    c.vn = vn[q - first];
    formula::load(k, time_step, c);
    formula::add_rolling(time_step, c);
    sx[q] = c.sx, sy[q] = c.sy, sz[q] = c.sz;
    fx[q] = c.fx, fy[q] = c.fy, fz[q] = c.fz;
    dx[q - first] = c.dx, dy[q - first] = c.dy, dz[q - first] = c.dz;
    total[q - first] = c.total;
    stiffness[q] = c.stiffness;
    kt[q] = c.stiffness;
    fn[q] = c.normal_force;
    kn[q] = c.normal_stiffness;
    edge[q - first] = formula::distance_from_edge(time_step, c);
    least = std::min(least, edge[q - first]);
  }
  // Few contacts begin or end, and only those are looked at.
  for (std::size_t q = first; least < 0.0 && q < end; ++q) {
    if (!(edge[q - first] < 0.0)) continue;
    formula::Contact c{};
    c.overlap = overlap[q];
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.vx = vx[q], c.vy = vy[q], c.vz = vz[q];
    c.dx = dx[q - first], c.dy = dy[q - first], c.dz = dz[q - first];
    c.vn = vn[q - first];
    c.stiffness = stiffness[q];
    c.normal_force = fn[q];
    c.normal_stiffness = kn[q];
    c.fx = fx[q], c.fy = fy[q], c.fz = fz[q];
    c.mass = mass[q];
    c.total = total[q - first];
    const double by = formula::weigh_edge(k.friction, time_step, c);
    fn[q] = c.normal_force;
    fx[q] = c.fx, fy[q] = c.fy, fz[q] = c.fz;
    total[q - first] = c.total;
    if (by == 1.0) continue;
    in_last_step[last_steps] = q;
    change[last_steps++] = by;
  }
  sdk::take_square_roots(total, count);
#pragma omp simd
  for (std::size_t q = first; q < end; ++q) {
    formula::Contact c{};
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.sx = sx[q], c.sy = sy[q], c.sz = sz[q];
    c.normal_force = fn[q];
    c.fx = fx[q], c.fy = fy[q], c.fz = fz[q];
    c.compliance = compliance[q - first];
    c.dx = dx[q - first], c.dy = dy[q - first], c.dz = dz[q - first];
    c.total = total[q - first];
    formula::slide(k, c);
    sx[q] = c.sx, sy[q] = c.sy, sz[q] = c.sz;
    fx[q] = c.fx, fy[q] = c.fy, fz[q] = c.fz;
  }
  for (std::size_t n = 0; n < last_steps; ++n) {
    const std::size_t q = in_last_step[n];
    const double less = 1.0 - change[n];
    fx[q] -= less * (fx[q] - fn[q] * nx[q]);
    fy[q] -= less * (fy[q] - fn[q] * ny[q]);
    fz[q] -= less * (fz[q] - fn[q] * nz[q]);
  }
}

void evaluate_batch(const formula::Constants& constants, const sdk::ContactBatch& b) {
  for (std::size_t first = 0; first < b.count; first += k_block) {
    evaluate_block(constants, b, first, std::min(first + k_block, b.count));
  }
}

DUST_KERNEL void evaluate_liggghts(const formula::Constants& constants,
                                   const sdk::ContactBatch& b) {
  const formula::Constants k = constants;
  const double *overlap = b.overlap, *nx = b.normal.x, *ny = b.normal.y, *nz = b.normal.z;
  const double *vx = b.velocity.x, *vy = b.velocity.y, *vz = b.velocity.z;
  const double *ux = b.displacement.x, *uy = b.displacement.y, *uz = b.displacement.z;
  const double *radius = b.effective_radius, *mass = b.effective_mass;
  // The stiffness is for a run that goes on with this engine's own conventions.
  double *sx = b.history[0], *sy = b.history[1], *sz = b.history[2], *stiffness = b.history[3];
  double *fn = b.normal_force, *kn = b.normal_stiffness, *kt = b.tangential_stiffness;
  double *fx = b.force.x, *fy = b.force.y, *fz = b.force.z;
#pragma omp simd
  for (std::size_t q = 0; q < b.count; ++q) {
    formula::Contact c{};
    c.overlap = overlap[q], c.radius = radius[q], c.mass = mass[q];
    c.nx = nx[q], c.ny = ny[q], c.nz = nz[q];
    c.vx = vx[q], c.vy = vy[q], c.vz = vz[q];
    c.ux = ux[q], c.uy = uy[q], c.uz = uz[q];
    c.sx = sx[q], c.sy = sy[q], c.sz = sz[q];
    formula::evaluate_liggghts(k, c);
    sx[q] = c.sx, sy[q] = c.sy, sz[q] = c.sz, stiffness[q] = c.stiffness;
    fn[q] = c.normal_force, kn[q] = c.normal_stiffness, kt[q] = c.stiffness;
    fx[q] = c.fx, fy[q] = c.fy, fz[q] = c.fz;
  }
}

class HertzMindlin final : public sdk::ContactLaw {
 public:
  struct Parameters {
    double restitution = 0.0;
    double friction = 0.0;
    std::string tangential = "rescaled";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(
         &Parameters::restitution, "restitution", sdk::dimension::none,
         "Ratio of the speeds after and before a head-on collision; realised by the law, because "
         "the normal force may attract while the contact opens, and within 0.02 by the default "
         "step at time.expected_speed.")
        .symbol("e")
        .above(0)
        .at_most(1);
    s.number(&Parameters::friction, "friction", sdk::dimension::none,
             "Coefficient of sliding friction; limits spring and damper together.")
        .symbol("\\mu_s")
        .at_least(0)
        .usual(0, 2);
    s.text(&Parameters::tangential, "tangential",
           "Conventions of spring, damper and slip limit: those of this law, or those of LIGGGHTS "
           "for parameters that were calibrated there.")
        .one_of({"rescaled", "liggghts"})
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "hertz_mindlin",
            .version = "2.1",
            .summary =
                "Hertz normal and energy-conserving Mindlin tangential contact with viscous "
                "damping and strict Coulomb friction.",
            .equation =
                "F_n = \\tfrac43 E^* \\sqrt{R^*} d^{3/2} - \\gamma_n v_n,\\quad "
                "F_t = -k_t \\xi_t - \\gamma_t v_t,\\quad |F_t| \\le \\mu_s \\max(F_n, 0)",
            .source =
                "Tsuji, Tanaka, Ishida, Powder Technol. 71 (1992) 239, "
                "doi:10.1016/0032-5910(92)88030-L; rescaled tangential spring: own derivation"};
  }

  explicit HertzMindlin(const Parameters& p) : is_liggghts_(p.tangential == "liggghts") {
    constants_.damping = formula::damping(p.restitution);
    constants_.friction = p.friction;
  }

  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    const auto shear = [](const sdk::MaterialProperties& m) {
      return 2.0 * (2.0 - m.poisson_ratio) * (1.0 + m.poisson_ratio) / m.young_modulus;
    };
    constants_.young = sdk::effective_young_modulus(i, j);
    constants_.shear = 1.0 / (shear(i) + shear(j));
    constants_.normal_root = std::sqrt(2.0 * constants_.young);
    constants_.tangential_root = std::sqrt(8.0 * constants_.shear);
  }
  [[nodiscard]] int history_size() const override { return 4; }
  [[nodiscard]] bool has_hertz_force() const override { return true; }

  void evaluate(const sdk::ContactBatch& batch) const override {
    is_liggghts_ ? evaluate_liggghts(constants_, batch) : evaluate_batch(constants_, batch);
  }

  [[nodiscard]] double collision_time(double radius, double mass, double speed) const override {
    return damped_share() * formula::collision_time(constants_.young, radius, mass, speed);
  }
  [[nodiscard]] double half_period(double radius, double mass, double overlap) const override {
    return damped_share() * formula::half_period(constants_.young, radius, mass, overlap);
  }

 private:
  [[nodiscard]] double damped_share() const { return formula::damped_share(constants_.damping); }

  formula::Constants constants_;
  bool is_liggghts_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<HertzMindlin>(); }
