// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/scene_columns.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace dust::contract {

SceneColumns::SceneColumns(const SyntheticScene& scene, const sdk::Sensor& sensor) {
  show_domain(scene);
  show_particles(scene);
  if (sensor.wants_contacts()) show_contacts(scene);
  if (sensor.wants_walls() || sensor.wants_sliding()) show_walls(scene);
  if (sensor.wants_sliding()) show_slidings(scene);
  show_fluid(scene);
  if (sensor.wants_face_fluxes() && !scene.pressure.empty()) show_faces(scene);
}

void SceneColumns::show_domain(const SyntheticScene& scene) {
  const double l = scene.units.length;
  class_diameters_ = scene.class_diameters;
  for (double& d : class_diameters_) d *= l;
  view_.time = scene.units.time * scene.time;
  view_.interval = scene.units.time * scene.interval;
  view_.domain_min = l * scene.domain_min;
  view_.domain_max = l * scene.domain_max;
  view_.gravity = scene.units.of(sdk::dimension::acceleration) * scene.gravity;
  view_.class_diameters = class_diameters_;
  view_.emitted_mass = scene.units.mass * scene.emitted_mass;
}

void SceneColumns::show_particles(const SyntheticScene& scene) {
  const double l = scene.units.length;
  const double v = scene.units.of(sdk::dimension::velocity);
  const double w = scene.units.of(sdk::dimension::angular_velocity);
  const double f = scene.units.of(sdk::dimension::force);
  id_.clear();
  for (auto& column : columns_) column.clear();
  for (std::size_t i = 0; i < scene.grains.size(); ++i) {
    const Grain& g = scene.grains[i];
    id_.push_back(static_cast<std::int64_t>(i));
    const double values[18] = {l * g.now.x,
                               l * g.now.y,
                               l * g.now.z,
                               l * g.before.x,
                               l * g.before.y,
                               l * g.before.z,
                               v * g.velocity.x,
                               v * g.velocity.y,
                               v * g.velocity.z,
                               w * g.angular_velocity.x,
                               w * g.angular_velocity.y,
                               w * g.angular_velocity.z,
                               f * g.force.x,
                               f * g.force.y,
                               f * g.force.z,
                               l * g.diameter,
                               scene.units.mass * g.mass,
                               g.weight};
    for (int c = 0; c < 18; ++c) columns_[c].push_back(values[c]);
  }
  material_.assign(scene.grains.size(), 0);
  sdk::GrainColumns& g = view_.grains;
  g.id = id_;
  g.material = material_;
  std::span<const double>* targets[18] = {&g.x,
                                          &g.y,
                                          &g.z,
                                          &g.x_before,
                                          &g.y_before,
                                          &g.z_before,
                                          &g.velocity_x,
                                          &g.velocity_y,
                                          &g.velocity_z,
                                          &g.angular_velocity_x,
                                          &g.angular_velocity_y,
                                          &g.angular_velocity_z,
                                          &g.force_x,
                                          &g.force_y,
                                          &g.force_z,
                                          &g.diameter,
                                          &g.mass,
                                          &g.weight};
  for (int c = 0; c < 18; ++c) *targets[c] = columns_[c];
}

void SceneColumns::show_contacts(const SyntheticScene& scene) {
  const double l = scene.units.length;
  const double f = scene.units.of(sdk::dimension::force);
  for (auto& column : partners_) column.clear();
  for (auto& column : contact_columns_) column.clear();
  for (const Contact& c : scene.contacts) {
    partners_[0].push_back(c.i);
    partners_[1].push_back(c.j);
    const sdk::Vec3 wall = l / scene.units.time * c.wall_velocity;
    const double values[10] = {f * c.force.x,  f * c.force.y,  f * c.force.z, l * c.branch.x,
                               l * c.branch.y, l * c.branch.z, l * c.overlap, wall.x,
                               wall.y,         wall.z};
    for (int n = 0; n < 10; ++n) contact_columns_[n].push_back(values[n]);
  }
  sdk::ContactColumns& c = view_.contacts;
  c.grain_i = partners_[0];
  c.grain_j = partners_[1];
  std::span<const double>* targets[10] = {
      &c.force_x,  &c.force_y, &c.force_z,         &c.branch_x,        &c.branch_y,
      &c.branch_z, &c.overlap, &c.wall_velocity_x, &c.wall_velocity_y, &c.wall_velocity_z};
  for (int n = 0; n < 10; ++n) *targets[n] = contact_columns_[n];
}

void SceneColumns::show_walls(const SyntheticScene& scene) {
  const double energy = scene.units.of(sdk::dimension::energy);
  walls_ = {};
  for (const Wall& w : scene.walls) {
    walls_.name.push_back(w.name);
    walls_.group.push_back(w.group);
    walls_.force.push_back(scene.units.of(sdk::dimension::force) * w.force);
    walls_.torque.push_back(energy * w.torque);
    walls_.power.push_back(energy / scene.units.time * w.power);
    walls_.mass.push_back(scene.units.mass * w.mass);
    walls_.contacts.push_back(w.contacts);
  }
  impacts_ = scene.impacts;
  for (sdk::WallImpact& impact : impacts_) {
    impact.normal_energy *= energy;
    impact.tangential_energy *= energy;
  }
  view_.walls = {walls_.name,     walls_.group, walls_.force,
                 walls_.torque,   walls_.power, walls_.mass,
                 walls_.contacts, impacts_,     {}};
}

void SceneColumns::show_slidings(const SyntheticScene& scene) {
  const double energy = scene.units.of(sdk::dimension::energy);
  slidings_ = scene.slidings;
  for (sdk::WallSliding& s : slidings_) {
    s.place = scene.units.length * s.place;
    s.impulse *= scene.units.of(sdk::dimension::force) * scene.units.time;
    s.sliding *= energy;
    s.friction *= energy;
  }
  view_.walls.slidings = slidings_;
}

void SceneColumns::show_fluid(const SyntheticScene& scene) {
  pressure_ = scene.pressure;
  const auto p = static_cast<float>(scene.units.of(sdk::dimension::pressure));
  for (float& value : pressure_) value *= p;
  const auto v = static_cast<float>(scene.units.length / scene.units.time);
  for (int d = 0; d < 3; ++d) {
    velocity_[d] = scene.velocity[d];
    for (float& value : velocity_[d]) value *= v;
  }
  sdk::FluidColumns& f = view_.fluid;
  f.spacing = scene.units.length * scene.spacing;
  for (int d = 0; d < 3; ++d) f.count[d] = scene.count[d];
  f.density = scene.units.of(sdk::dimension::density) * scene.density;
  f.viscosity = scene.units.of(sdk::dimension::dynamic_viscosity) * scene.viscosity;
  f.origin = scene.units.length * scene.domain_min;
  f.pressure = pressure_;
  f.open_fraction = scene.open_fraction;
  f.velocity_x = velocity_[0];
  f.velocity_y = velocity_[1];
  f.velocity_z = velocity_[2];
  f.void_fraction = scene.void_fraction;
}

/// Between the numbers of the two cells, as open as the less open one; at a side those of its cell.
void SceneColumns::show_faces(const SyntheticScene& scene) {
  for (int d = 0; d < 3; ++d) {
    Faces& faces = faces_[d];
    faces = {};
    int n[3] = {scene.count[0], scene.count[1], scene.count[2]};
    n[d] += 1;
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        for (int i = 0; i < n[0]; ++i) {
          int below[3] = {i, j, k};
          int above[3] = {i, j, k};
          below[d] = std::max(0, below[d] - 1);
          above[d] = std::min(scene.count[d] - 1, above[d]);
          const std::size_t a = cell_at(scene, below[0], below[1], below[2]);
          const std::size_t b = cell_at(scene, above[0], above[1], above[2]);
          const float open = std::min(scene.open_fraction[a], scene.open_fraction[b]);
          const float voids = 0.5F * (scene.void_fraction[a] + scene.void_fraction[b]);
          faces.flux.push_back(open * voids * 0.5F * (velocity_[d][a] + velocity_[d][b]));
          faces.open.push_back(open);
          faces.void_fraction.push_back(voids);
        }
      }
    }
  }
  view_.fluid.faces = {faces_[0].flux,          faces_[1].flux,          faces_[2].flux,
                       faces_[0].open,          faces_[1].open,          faces_[2].open,
                       faces_[0].void_fraction, faces_[1].void_fraction, faces_[2].void_fraction};
}

}  // namespace dust::contract
