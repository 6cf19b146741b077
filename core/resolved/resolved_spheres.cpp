// SPDX-License-Identifier: Apache-2.0
#include "resolved/resolved_spheres.hpp"

#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "resolved/inner_fluid.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>
#include <utility>

namespace dust::resolved {
namespace {

using particles::GrainRows;
using sdk::Vec3;

/// The grains' motion knows forces of the fluid as a relaxation towards a velocity. This one is so
/// far off, and so slow, that the force changes by this share over a fluid step.
constexpr double k_relaxed = 1e-4;

/// The fluid meets a change of the spin a step late. This inertia, of the displaced fluid's own,
/// resists the change from step to step, so that light spheres do not spin up by themselves.
constexpr double k_virtual_inertia = 3.0;

Vec3 vector_of(const double* p) { return {p[0], p[1], p[2]}; }

}  // namespace

ResolvedSpheres::ResolvedSpheres(const fluid::Grid& grid, std::vector<std::int32_t> materials,
                                 const FluidAround& around)
    : grid_(grid),
      materials_(std::move(materials)),
      around_(around),
      forcing_(grid, around.density) {}

bool ResolvedSpheres::is_resolved(std::int32_t material) const {
  return std::find(materials_.begin(), materials_.end(), material) != materials_.end();
}

/// Id and row of the spheres, by id.
std::vector<std::pair<std::int64_t, std::size_t>> ResolvedSpheres::rows_of(
    const GrainRows& grains) const {
  std::vector<std::pair<std::int64_t, std::size_t>> rows;
  for (std::size_t row = 0; row < grains.count; ++row) {
    if (is_resolved(grains.material[row])) rows.emplace_back(grains.id[row], row);
  }
  std::sort(rows.begin(), rows.end());
  return rows;
}

/// Calls visit(row, state, number) for the spheres that are there, in the order of their ids.
template <class Visit>
void ResolvedSpheres::each_row(const GrainRows& grains, const Visit& visit) {
  std::size_t n = 0;
  for (const auto& [id, row] : rows_of(grains)) {
    while (n < states_.size() && states_[n].id < id) ++n;
    if (n < states_.size() && states_[n].id == id) visit(row, states_[n], n);
  }
}

/// Of a sphere that goes on, or of one that has just come: the fluid inside it is what was there.
ResolvedSpheres::State ResolvedSpheres::state_of(const Sphere& sphere,
                                                 const fluid::FaceField& velocity) {
  const auto known = std::lower_bound(states_.begin(), states_.end(), sphere.id,
                                      [](const State& s, std::int64_t id) { return s.id < id; });
  if (known != states_.end() && known->id == sphere.id) return std::move(*known);
  State fresh;
  fresh.id = sphere.id;
  fresh.inner = resolved::inner_momentum(grid_, velocity, around_.density, sphere, sphere.position);
  return fresh;
}

void ResolvedSpheres::begin_step(const GrainRows& grains, const fluid::FaceField& velocity) {
  std::vector<Sphere> spheres;
  std::vector<State> states;
  std::vector<MarkerForcing::Forces> forces;
  for (const auto& [id, row] : rows_of(grains)) {
    if (grains.weight[row] != 1.0) {
      throw sdk::ModelError("grain " + std::to_string(id) +
                            " stands for several and cannot be resolved: take its material out of "
                            "coupling.resolved, or emit it with the weight 1");
    }
    spheres.push_back({id, grains.centre(row), vector_of(grains.velocity_of(row)),
                       vector_of(grains.rotation_of(row)), grains.radius(row)});
    states.push_back(state_of(spheres.back(), velocity));
    forces.push_back(std::move(states.back().forces));
    const double cells =
        2.0 * spheres.back().radius / std::max({grid_.spacing.x, grid_.spacing.y, grid_.spacing.z});
    double& least = report_.least_cells_per_diameter;
    least = least == 0.0 ? cells : std::min(least, cells);
  }
  states_ = std::move(states);
  forcing_.begin_step(std::move(spheres), std::move(forces), velocity);
  report_.spheres = static_cast<std::int64_t>(states_.size());
  report_.markers = static_cast<std::int64_t>(forcing_.markers());
}

/// docs/theory/resolved.md, eq. (9).
void ResolvedSpheres::evaluate(const fluid::FaceField& velocity) {
  for (std::size_t n = 0; n < states_.size(); ++n) {
    State& state = states_[n];
    const Sphere& sphere = forcing_.spheres()[n];
    Impulse inner = resolved::inner_momentum(grid_, velocity, around_.density, sphere,
                                             sphere.position_after(around_.step));
    // As if it turned with the sphere, not with the markers.
    inner.angular -= 0.4 * around_.density * sdk::sphere_volume(2.0 * sphere.radius) *
                     sphere.radius * sphere.radius * forcing_.turning_ahead(n);
    state.due = inner;
    state.due -= state.inner;
    state.due -= forcing_.given(n);
    state.due.linear += around_.step * sdk::sphere_volume(2.0 * sphere.radius) * around_.buoyancy;
    state.due.linear += state.deferred;
    state.inner = inner;
    state.forces = forcing_.forces(n);
  }
  report_.largest_slip = forcing_.largest_slip(velocity);
}

/// docs/theory/resolved.md, eq. (11), (12).
void ResolvedSpheres::act(const GrainRows& grains, const Turn& turn) {
  const double rate = k_relaxed / around_.step;
  const double relaxed = -std::expm1(-k_relaxed);
  each_row(grains, [&](std::size_t row, State& state, std::size_t) {
    const double* velocity = grains.velocity_of(row);
    const double inverse_mass = grains.inverse_mass(row);
    double* action = grains.drag_relaxation + 4 * row;
    for (int d = 0; d < 3; ++d) {
      action[d] = velocity[d] + state.due.linear[d] * inverse_mass / relaxed;
    }
    action[3] = rate;
    const double radius = grains.radius(row);
    const Vec3 alone = (2.5 * inverse_mass / (radius * radius)) * state.due.angular;
    const double held =
        k_virtual_inertia * around_.density * sdk::sphere_volume(2.0 * radius) * inverse_mass;
    state.turned = (alone + held * state.turned) / (1.0 + held);
    turn(row, state.turned);
  });
}

void ResolvedSpheres::end_step(const GrainRows& grains) {
  each_row(grains, [&](std::size_t row, State& state, std::size_t) {
    double* received = grains.fluid_impulse + 4 * row;
    for (int d = 0; d < 3; ++d) {
      state.deferred[d] = state.due.linear[d] - received[d];
      received[d] = 0.0;
    }
  });
}

Vec3 ResolvedSpheres::inner_momentum() const {
  Vec3 sum;
  for (const State& s : states_) sum += s.inner.linear;
  return sum;
}

Vec3 ResolvedSpheres::deferred() const {
  Vec3 sum;
  for (const State& s : states_) sum += s.deferred;
  return sum;
}

void ResolvedSpheres::save(sdk::ArchiveWriter& archive) const {
  std::vector<std::int64_t> ids;
  std::vector<std::int64_t> counts;
  std::vector<double> numbers;
  std::vector<double> forces;
  const auto put = [](std::vector<double>& to, Vec3 v) { to.insert(to.end(), {v.x, v.y, v.z}); };
  for (const State& s : states_) {
    ids.push_back(s.id);
    counts.push_back(static_cast<std::int64_t>(s.forces.size()));
    for (const Vec3& v : {s.inner.linear, s.inner.angular, s.deferred, s.turned}) put(numbers, v);
    for (const Vec3& v : s.forces) put(forces, v);
  }
  archive.integers("ids", ids);
  archive.integers("markers", counts);
  archive.numbers("inner_deferred_turned", numbers);
  archive.numbers("forces", forces);
  archive.number("least_cells_per_diameter", report_.least_cells_per_diameter);
  archive.number("largest_slip", report_.largest_slip);
}

void ResolvedSpheres::load(sdk::ArchiveReader& archive) {
  const auto ids = archive.integers("ids");
  const auto counts = archive.integers("markers");
  const auto numbers = archive.numbers("inner_deferred_turned");
  const auto forces = archive.numbers("forces");
  if (counts.size() != ids.size() || numbers.size() != 12 * ids.size()) {
    throw sdk::ModelError("the checkpoint's resolved spheres are not whole");
  }
  states_.clear();
  report_ = {};
  std::size_t at = 0;
  for (std::size_t n = 0; n < ids.size(); ++n) {
    State state;
    state.id = ids[n];
    const double* of_sphere = &numbers[12 * n];
    state.inner = {vector_of(of_sphere), vector_of(of_sphere + 3)};
    state.deferred = vector_of(of_sphere + 6);
    state.turned = vector_of(of_sphere + 9);
    for (std::int64_t l = 0; l < counts[n]; ++l, at += 3) {
      state.forces.push_back(vector_of(&forces.at(at)));
    }
    report_.markers += counts[n];
    states_.push_back(std::move(state));
  }
  report_.spheres = static_cast<std::int64_t>(ids.size());
  report_.least_cells_per_diameter = archive.number("least_cells_per_diameter");
  report_.largest_slip = archive.number("largest_slip");
}

}  // namespace dust::resolved
