// SPDX-License-Identifier: Apache-2.0
#include "particles/energy/energy_account.hpp"

#include "dust/sdk/sphere.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/grain_rows.hpp"

namespace dust::particles {
namespace {

using sdk::Vec3;

Vec3 vector_at(const double* numbers) { return {numbers[0], numbers[1], numbers[2]}; }

struct Kinetic {
  double translation = 0.0, rotation = 0.0;  ///< [J]
};

Kinetic kinetic(const ParticleStore& particles, std::size_t row, Vec3 velocity) {
  const double mass = 1.0 / particles.inverse_mass(row);
  const Vec3 spin = vector_at(particles.rotation(row));
  const double half = 0.5 * particles.weight(row);
  return {half * mass * dot(velocity, velocity),
          half * sdk::sphere_inertia(mass, particles.radius(row)) * dot(spin, spin)};
}

void begin_step(EnergySums& sums) {
  sums.translation = sums.rotation = sums.elastic_normal = sums.elastic_friction = 0.0;
}

void add(EnergySums& to, const EnergySums& more) {
  to.translation += more.translation;
  to.rotation += more.rotation;
  to.elastic_normal += more.elastic_normal;
  to.elastic_friction += more.elastic_friction;
  to.normal += more.normal;
  to.tangential += more.tangential;
  to.rolling += more.rolling;
  to.walls += more.walls;
  to.gravity += more.gravity;
  to.fluid += more.fluid;
}

}  // namespace

EnergySums EnergyAccount::sum() const {
  EnergySums all = before_;
  for (const EnergySums& tile : tiles_) add(all, tile);
  return all;
}

void EnergyAccount::begin_step() {
  particles::begin_step(before_);
  for (EnergySums& tile : tiles_) particles::begin_step(tile);
}

void EnergyAccount::restart(std::size_t tiles) {
  if (!is_on_) return;
  before_ = sum();
  tiles_.assign(tiles, {});
}

void EnergyAccount::enter(const ParticleStore& particles, std::size_t row) {
  if (!is_on_) return;
  const Kinetic energy = kinetic(particles, row, vector_at(particles.velocity(row)));
  entered_ += energy.translation + energy.rotation;
  // It is there already, though the last step has not seen it: the next one forgets this.
  before_.translation += energy.translation;
  before_.rotation += energy.rotation;
}

/// Takes the velocity that it had when the account was last made up: half a step back.
void EnergyAccount::leave(const ParticleStore& particles, std::size_t row, const double* gravity,
                          double step) {
  if (!is_on_) return;
  const double* g = gravity + 4 * static_cast<std::ptrdiff_t>(particles.material(row));
  const Vec3 then = vector_at(particles.half_velocity(row)) - (0.5 * step) * vector_at(g);
  const Kinetic energy = kinetic(particles, row, then);
  left_ += energy.translation + energy.rotation;
  before_.translation -= energy.translation;
  before_.rotation -= energy.rotation;
}

EnergyBalance EnergyAccount::balance() const {
  const EnergySums s = sum();
  EnergyBalance b;
  b.translation = s.translation;
  b.rotation = s.rotation;
  b.elastic_normal = s.elastic_normal;
  b.elastic_friction = s.elastic_friction;
  b.entered = entered_;
  b.left = left_;
  b.gravity = s.gravity;
  b.walls = s.walls;
  b.fluid = s.fluid;
  // What a contact has taken from its sides is stored in it or lost; theory page, eq. (3).
  b.lost_normal = -s.normal - s.elastic_normal;
  b.lost_friction = -s.tangential - s.elastic_friction;
  b.lost_rolling = -s.rolling;
  return b;
}

void EnergyAccount::save(sdk::ArchiveWriter& archive) const {
  if (!is_on_) return;
  const EnergySums s = sum();
  const double numbers[] = {s.translation, s.rotation,   s.elastic_normal, s.elastic_friction,
                            s.normal,      s.tangential, s.rolling,        s.walls,
                            s.gravity,     s.fluid,      entered_,         left_};
  archive.numbers("energy", numbers);
}

void EnergyAccount::load(sdk::ArchiveReader& archive) {
  if (!is_on_) return;
  const auto n = archive.numbers("energy");
  before_ = {n[0], n[1], n[2], n[3], n[4], n[5], n[6], n[7], n[8], n[9]};
  entered_ = n[10];
  left_ = n[11];
}

}  // namespace dust::particles
