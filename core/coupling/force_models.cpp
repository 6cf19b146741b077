// SPDX-License-Identifier: Apache-2.0
#include "coupling/force_models.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "particles/surface_search.hpp"

#include <algorithm>
#include <limits>
#include <stdexcept>
#include <string>

namespace dust::coupling {
namespace {

/// Numbers kept per grain before the models' own.
enum Kept : std::size_t {
  k_velocity = 0,       ///< [m/s] at the last refresh
  k_impulse = 3,        ///< [N s] of the fluid, then
  k_change = 6,         ///< [m/s2] du_f/dt at the grain's place over the fluid step
  k_held = 9,           ///< [s] from the last refresh to this one, 0 = no refresh yet
  k_contact = 10,       ///< [m/s2] by contacts over the last interval
  k_first_history = 13  ///< of the models
};

using Column = std::array<double, ForceModels::k_batch>;

/// A vector column with its storage.
struct Vectors {
  Column x, y, z;
};
void set(Vectors& c, std::size_t n, sdk::Vec3 v) {
  c.x[n] = v.x;
  c.y[n] = v.y;
  c.z[n] = v.z;
}
void set(Vectors& c, std::size_t n, const Triple& v) { set(c, n, sdk::Vec3{v[0], v[1], v[2]}); }
sdk::VectorColumns columns_of(const Vectors& c) { return {c.x.data(), c.y.data(), c.z.data()}; }

}  // namespace

struct ForceModels::Columns {
  Column diameter, mass, density, viscosity, gap, added_mass, resistance;
  Vectors rotation, slip, vorticity, acceleration, pressure_gradient, viscous_stress, wall_normal,
      wall_velocity, force;
};

ForceModels::ForceModels(std::span<const std::unique_ptr<sdk::FluidForce>> models,
                         std::vector<particles::Surface> surfaces, const Lattice& lattice,
                         const DragModel& drag, sdk::Vec3 gravity)
    : surfaces_(std::move(surfaces)),
      lattice_(lattice),
      properties_(drag.properties()),
      gravity_(gravity),
      set_(drag.momentum_set()),
      graining_(drag.graining()),
      width_(k_first_history) {
  for (const auto& model : models) {
    const sdk::FluidForceNeeds needs = model->needs();
    const sdk::FluidForceParts parts = model->takes_over();
    needs_.vorticity |= needs.vorticity;
    needs_.acceleration |= needs.acceleration;
    needs_.stresses |= needs.stresses;
    needs_.wall_reach = std::max(needs_.wall_reach, needs.wall_reach);
    taken_.pressure_gradient |= parts.pressure_gradient;
    taken_.viscous_stress |= parts.viscous_stress;
    taken_.buoyancy |= parts.buoyancy;
    width_ += static_cast<std::size_t>(model->history_size());
    models_.push_back(model.get());
  }
  // What is not taken over has to be told apart from what is.
  needs_.stresses |= taken_.pressure_gradient != taken_.viscous_stress;
}

void ForceModels::begin(const FluidState& fluid, double step, bool is_first) {
  if (needs_.stresses && fluid.pressure == nullptr) {
    throw std::logic_error("forces of the pressure gradient need the pressure at a refresh");
  }
  step_ = step;
  is_first_ = is_first;
  if (needs_.wall_reach > 0.0) {
    particles::move_to(fluid.time, surfaces_);
  }
}

void ForceModels::end(const FluidState& fluid) {
  if (needs_.acceleration && is_first_) last_velocity_ = fluid.velocity;
}

sdk::Vec3 ForceModels::velocity_at(sdk::Vec3 place, const fluid::FaceField& u) const {
  const double at[3] = {place.x, place.y, place.z};
  const Place p = lattice_.place(at);
  sdk::Vec3 velocity;
  Stencil s;
  for (int d = 0; d < 3; ++d) {
    lattice_.faces(d, p, s);
    for (std::size_t n = 0; n < 8; ++n) velocity[d] += s.weight[n] * u.component[d][s.storage[n]];
  }
  return velocity;
}

std::array<sdk::Vec3, 3> ForceModels::gradient_at(sdk::Vec3 place,
                                                  const fluid::FaceField& u) const {
  const fluid::Grid& grid = lattice_.grid();
  std::array<sdk::Vec3, 3> gradient;
  for (int e = 0; e < 3; ++e) {
    if (grid.count[e] == 1 && grid.is_periodic[e]) continue;  // nothing varies
    sdk::Vec3 low = place;
    sdk::Vec3 high = place;
    low[e] -= 0.5 * grid.spacing[e];
    high[e] += 0.5 * grid.spacing[e];
    if (!grid.is_periodic[e]) {
      // Beyond a side there is no fluid: one-sided.
      low[e] = std::max(low[e], grid.origin[e]);
      high[e] = std::min(high[e], grid.origin[e] + grid.count[e] * grid.spacing[e]);
    }
    gradient[static_cast<std::size_t>(e)] =
        (velocity_at(high, u) - velocity_at(low, u)) / (high[e] - low[e]);
  }
  return gradient;
}

void ForceModels::find_wall(sdk::Vec3 centre, double radius, double time, std::size_t n,
                            Columns& c) const {
  const double reach = radius + 2.0 * radius * needs_.wall_reach;
  c.gap[n] = std::numeric_limits<double>::infinity();
  set(c.wall_normal, n, sdk::Vec3{});
  set(c.wall_velocity, n, sdk::Vec3{});
  const auto [nearest, point] = particles::nearest_surface(surfaces_, centre, reach);
  // In touch, the contact law carries the force.
  if (nearest == nullptr || point.distance <= radius) return;
  c.gap[n] = point.distance - radius;
  set(c.wall_normal, n, point.normal);
  if (nearest->body != nullptr) {
    set(c.wall_velocity, n,
        nearest->body->surface_velocity(centre - point.distance * point.normal, point.normal,
                                        time));
  }
}

void ForceModels::gather(const particles::GrainRows& grains, const Batch& batch,
                         const FluidState& fluid, ParticleStates& memory, Columns& c) const {
  for (std::size_t n = 0; n < batch.rows.size(); ++n) {
    const auto row = static_cast<std::size_t>(batch.rows[n]);
    const double* v = grains.velocity_of(row);
    const double* w = grains.rotation_of(row);
    const sdk::Vec3 centre = grains.centre(row);
    const fluid::Properties::Values own =
        properties_.is_uniform() ? properties_.own() : properties_.at(centre);
    const double l = graining_.of(grains, row);
    c.diameter[n] = grains.diameter(row) / l;
    c.mass[n] = 1.0 / (grains.inverse_mass(row) * (l * l * l));
    c.density[n] = own.density;
    c.viscosity[n] = own.viscosity;
    set(c.rotation, n, sdk::Vec3{w[0], w[1], w[2]});
    set(c.slip, n, batch.slip[n]);
    if (needs_.vorticity || needs_.acceleration) {
      const auto gradient = gradient_at(centre, fluid.velocity);
      set(c.vorticity, n,
          sdk::Vec3{gradient[1].z - gradient[2].y, gradient[2].x - gradient[0].z,
                    gradient[0].y - gradient[1].x});
      if (needs_.acceleration) {
        double* change = memory.columns(row) + k_change;
        if (is_first_) {
          // The field changes once per fluid step; its change is felt over the whole of it.
          sdk::Vec3 rate;
          if (!last_velocity_.component[0].empty()) {
            rate =
                (velocity_at(centre, fluid.velocity) - velocity_at(centre, last_velocity_)) / step_;
          }
          for (int d = 0; d < 3; ++d) change[d] = rate[d];
        }
        set(c.acceleration, n,
            sdk::Vec3{change[0], change[1], change[2]} + v[0] * gradient[0] + v[1] * gradient[1] +
                v[2] * gradient[2]);
      }
    }
    if (needs_.stresses) {
      const Place p = lattice_.place(grains.position_of(row));
      Triple gradient{};
      Triple viscous{};
      for (int d = 0; d < 3; ++d) {
        gradient[static_cast<std::size_t>(d)] = lattice_.cell_slope(d, p, *fluid.pressure);
        viscous[static_cast<std::size_t>(d)] =
            batch.stress[n][d] + gradient[static_cast<std::size_t>(d)];
      }
      set(c.pressure_gradient, n, gradient);
      set(c.viscous_stress, n, viscous);
    }
    if (needs_.wall_reach > 0.0) find_wall(centre, grains.radius(row), fluid.time, n, c);
  }
}

/// What contacts gave to the grain since the last refresh: the change of its velocity less the
/// fluid's and gravity's part.
void ForceModels::note_contact(const particles::GrainRows& grains, std::size_t row, double held,
                               double* numbers, Triple& acceleration) const {
  const double* v = grains.velocity_of(row);
  const double* impulse = grains.fluid_impulse + 4 * row;
  const double last = numbers[k_held];
  const double mass = grains.mass(row);
  const double share = weight_share(mass, sdk::sphere_volume(grains.diameter(row)));
  for (std::size_t d = 0; d < 3; ++d) {
    acceleration[d] = 0.0;
    if (last > 0.0) {
      const double fluid = (impulse[d] - numbers[k_impulse + d]) / mass;
      acceleration[d] =
          (v[d] - numbers[k_velocity + d] - fluid) / last - share * gravity_[static_cast<int>(d)];
    }
    numbers[k_velocity + d] = v[d];
    numbers[k_impulse + d] = impulse[d];
  }
  numbers[k_held] = held;
}

double ForceModels::weight_share(double mass, double volume) const {
  return taken_.buoyancy ? 1.0 : 1.0 - properties_.own().density * volume / mass;
}

void ForceModels::impulse_was_read(ParticleStates& memory, std::size_t row,
                                   const double* received) const {
  double* numbers = memory.columns(row);
  for (std::size_t d = 0; d < 3; ++d) numbers[k_impulse + d] -= received[d];
}

/// What a batch's particles have besides the models' forces: contacts, the wall, the stress that no
/// model takes over.
void ForceModels::begin_sums(const particles::GrainRows& grains, const Batch& batch, double held,
                             const Columns& c, ParticleStates& states, Sums& sums) const {
  for (std::size_t n = 0; n < batch.rows.size(); ++n) {
    sums.contained[n] = {};
    sums.returned[n] = {};
    sums.added_mass[n] = 0.0;
    sums.resistance[n] = 0.0;
    const auto row = static_cast<std::size_t>(batch.rows[n]);
    note_contact(grains, row, held, states.columns(row), sums.contact[n]);
    if (needs_.wall_reach > 0.0) {
      const sdk::Vec3 normal{c.wall_normal.x[n], c.wall_normal.y[n], c.wall_normal.z[n]};
      const sdk::Vec3 speed{c.wall_velocity.x[n], c.wall_velocity.y[n], c.wall_velocity.z[n]};
      sums.normal[n] = {normal.x, normal.y, normal.z};
      sums.wall_speed[n] = dot(normal, speed);
    }
    const bool is_set_three = set_ == fluid::MomentumSet::three;
    const Triple stress{batch.stress.x[n], batch.stress.y[n], batch.stress.z[n]};
    sums.kept[n] = is_set_three ? Triple{} : stress;  // set III has it in the drag
    if (is_set_three || !(taken_.pressure_gradient || taken_.viscous_stress)) continue;
    if (taken_.pressure_gradient && taken_.viscous_stress) {
      sums.kept[n] = {};
      continue;
    }
    const Triple gradient{c.pressure_gradient.x[n], c.pressure_gradient.y[n],
                          c.pressure_gradient.z[n]};
    const Triple viscous{c.viscous_stress.x[n], c.viscous_stress.y[n], c.viscous_stress.z[n]};
    for (std::size_t d = 0; d < 3; ++d) {
      if (taken_.pressure_gradient) sums.kept[n][d] += gradient[d];
      if (taken_.viscous_stress) sums.kept[n][d] -= viscous[d];
    }
  }
}

/// The columns that a model asks for.
sdk::FluidForceBatch ForceModels::batch_for(const sdk::FluidForce& model, const Batch& batch,
                                            double held, Columns& c) const {
  const sdk::FluidForceNeeds needs = model.needs();
  sdk::FluidForceBatch b;
  b.count = batch.rows.size();
  b.interval = held;
  b.gravity = gravity_;
  b.diameter = c.diameter.data();
  b.mass = c.mass.data();
  b.angular_velocity = columns_of(c.rotation);
  b.density = c.density.data();
  b.viscosity = c.viscosity.data();
  b.void_fraction = batch.void_fraction;
  b.slip = columns_of(c.slip);
  if (needs.vorticity) b.vorticity = columns_of(c.vorticity);
  if (needs.acceleration) b.acceleration = columns_of(c.acceleration);
  if (needs.stresses) {
    b.pressure_gradient = columns_of(c.pressure_gradient);
    b.viscous_stress = columns_of(c.viscous_stress);
  }
  if (needs.wall_reach > 0.0) {
    b.gap = c.gap.data();
    b.wall_normal = columns_of(c.wall_normal);
    b.wall_velocity = columns_of(c.wall_velocity);
  }
  for (Column* column : {&c.force.x, &c.force.y, &c.force.z, &c.added_mass, &c.resistance}) {
    std::fill_n(column->data(), batch.rows.size(), 0.0);
  }
  b.force = {c.force.x.data(), c.force.y.data(), c.force.z.data()};
  b.added_mass = c.added_mass.data();
  b.resistance = c.resistance.data();
  return b;
}

/// What a model has found, for the particles that the computed ones stand for.
void ForceModels::add_to_sums(const sdk::FluidForce& model, const particles::GrainRows& grains,
                              const Batch& batch, const Columns& c, Sums& sums) const {
  const bool is_returned = model.reaction() == sdk::FluidForceReaction::fluid;
  const bool is_divided = is_returned && set_ == fluid::MomentumSet::three;
  for (std::size_t n = 0; n < batch.rows.size(); ++n) {
    // Set III divides by the void fraction what grains and fluid give each other.
    const double l = graining_.of(grains, static_cast<std::size_t>(batch.rows[n]));
    const double share = l * l * l * (is_divided ? 1.0 / batch.void_fraction[n] : 1.0);
    Triple& sum = is_returned ? sums.returned[n] : sums.contained[n];
    sum[0] += share * c.force.x[n];
    sum[1] += share * c.force.y[n];
    sum[2] += share * c.force.z[n];
    sums.added_mass[n] += share * c.added_mass[n];
    sums.resistance[n] += c.resistance[n];  // of a wall: none with coarse grains
  }
}

void ForceModels::evaluate(const particles::GrainRows& grains, const Batch& batch,
                           const FluidState& fluid, double held, ParticleStates& states,
                           Sums& sums) const {
  Columns c;
  gather(grains, batch, fluid, states, c);
  begin_sums(grains, batch, held, c, states, sums);
  // Histories of one model of all grains lie side by side.
  thread_local std::vector<double> history;
  std::size_t offset = k_first_history;
  for (const sdk::FluidForce* model : models_) {
    const auto size = static_cast<std::size_t>(model->history_size());
    sdk::FluidForceBatch columns = batch_for(*model, batch, held, c);
    if (size > 0) {
      history.resize(size * batch.rows.size());
      columns.history = history.data();
    }
    for (std::size_t n = 0; size > 0 && n < batch.rows.size(); ++n) {
      const double* own = states.columns(static_cast<std::size_t>(batch.rows[n]));
      std::copy_n(own + offset, size, history.data() + size * n);
    }
    model->evaluate(columns);
    add_to_sums(*model, grains, batch, c, sums);
    for (std::size_t n = 0; size > 0 && n < batch.rows.size(); ++n) {
      double* own = states.columns(static_cast<std::size_t>(batch.rows[n]));
      std::copy_n(history.data() + size * n, size, own + offset);
    }
    offset += size;
  }
}

void ForceModels::save(sdk::ArchiveWriter& archive) const {
  if (!needs_.acceleration) return;
  for (int d = 0; d < 3; ++d) {
    archive.numbers(std::string("last_velocity_") + "xyz"[d], last_velocity_.component[d]);
  }
}

void ForceModels::load(sdk::ArchiveReader& archive) {
  if (!needs_.acceleration) return;
  for (int d = 0; d < 3; ++d) {
    last_velocity_.component[d] = archive.numbers(std::string("last_velocity_") + "xyz"[d]);
  }
}

}  // namespace dust::coupling
