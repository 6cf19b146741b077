// SPDX-License-Identifier: Apache-2.0
#include "contract/sensor_world.hpp"

#include <stdexcept>

namespace dust::contract {

void Figures::figure(std::string_view name, double value, std::string_view unit,
                     double uncertainty) {
  figures_.emplace_back(std::string(name), Figure{value, std::string(unit), uncertainty});
}
const Figure& Figures::at(const std::string& name) const {
  for (const auto& [known, figure] : figures_) {
    if (known == name) return figure;
  }
  throw std::runtime_error("no figure " + name);
}
std::vector<std::string> Figures::names() const {
  std::vector<std::string> names;
  for (const auto& [name, figure] : figures_) names.push_back(name + " [" + figure.unit + "]");
  return names;
}
Figures summary_of(const sdk::Sensor& sensor) {
  Figures figures;
  sensor.summary(figures);
  return figures;
}
Figures series_of(const sdk::Sensor& sensor) {
  Figures figures;
  sensor.series(figures);
  return figures;
}

void World::set_cells(int nx, int ny, int nz) {
  count[0] = nx;
  count[1] = ny;
  count[2] = nz;
  const auto cells = static_cast<std::size_t>(nx) * ny * nz;
  pressure.assign(cells, 0.0f);
  open_fraction.assign(cells, 1.0f);
  for (auto& component : velocity) component.assign(cells, 0.0f);
  void_fraction.assign(cells, 1.0f);
}

const sdk::WorldView& World::view() {
  const double l = units.length;
  classes_shown_ = class_diameters;
  for (double& d : classes_shown_) d *= l;
  view_ = {};
  view_.time = units.time * time;
  view_.interval = units.time * interval;
  view_.domain_min = l * domain_min;
  view_.domain_max = l * domain_max;
  view_.gravity = units.of(sdk::dimension::acceleration) * gravity;
  view_.class_diameters = classes_shown_;
  view_.emitted_mass = units.mass * emitted_mass;
  show_grains();
  show_contacts();
  show_walls();
  show_fluid();
  return view_;
}

void World::show_grains() {
  const double l = units.length;
  const double v = units.of(sdk::dimension::velocity);
  const double w = units.of(sdk::dimension::angular_velocity);
  const double f = units.of(sdk::dimension::force);
  id_.clear();
  for (auto& column : columns_) column.clear();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Grain& g = grains[i];
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
                               units.mass * g.mass,
                               g.weight};
    for (int c = 0; c < 18; ++c) columns_[c].push_back(values[c]);
  }
  material_.assign(grains.size(), 0);
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

void World::show_contacts() {
  const double l = units.length;
  const double f = units.of(sdk::dimension::force);
  for (auto& column : partners_) column.clear();
  for (auto& column : contact_columns_) column.clear();
  for (const Contact& c : contacts) {
    partners_[0].push_back(c.i);
    partners_[1].push_back(c.j);
    const double values[7] = {f * c.force.x,  f * c.force.y,  f * c.force.z, l * c.branch.x,
                              l * c.branch.y, l * c.branch.z, l * c.overlap};
    for (int n = 0; n < 7; ++n) contact_columns_[n].push_back(values[n]);
  }
  sdk::ContactColumns& c = view_.contacts;
  c.grain_i = partners_[0];
  c.grain_j = partners_[1];
  std::span<const double>* targets[7] = {&c.force_x,  &c.force_y,  &c.force_z, &c.branch_x,
                                         &c.branch_y, &c.branch_z, &c.overlap};
  for (int n = 0; n < 7; ++n) *targets[n] = contact_columns_[n];
}

void World::show_walls() {
  const double energy = units.of(sdk::dimension::energy);
  wall_name_.clear(), wall_group_.clear(), wall_force_.clear(), wall_torque_.clear();
  wall_power_.clear(), wall_mass_.clear(), wall_contacts_.clear();
  for (const Wall& w : walls) {
    wall_name_.push_back(w.name);
    wall_group_.push_back(w.group);
    wall_force_.push_back(units.of(sdk::dimension::force) * w.force);
    wall_torque_.push_back(energy * w.torque);
    wall_power_.push_back(energy / units.time * w.power);
    wall_mass_.push_back(units.mass * w.mass);
    wall_contacts_.push_back(w.contacts);
  }
  impacts_shown_ = impacts;
  for (sdk::WallImpact& impact : impacts_shown_) {
    impact.normal_energy *= energy;
    impact.tangential_energy *= energy;
  }
  view_.walls = {wall_name_,  wall_group_, wall_force_,    wall_torque_,
                 wall_power_, wall_mass_,  wall_contacts_, impacts_shown_};
}

void World::show_fluid() {
  pressure_shown_ = pressure;
  const auto p = static_cast<float>(units.of(sdk::dimension::pressure));
  for (float& value : pressure_shown_) value *= p;
  const auto v = static_cast<float>(units.length / units.time);
  for (int d = 0; d < 3; ++d) {
    velocity_shown_[d] = velocity[d];
    for (float& value : velocity_shown_[d]) value *= v;
  }
  sdk::FluidColumns& f = view_.fluid;
  f.spacing = units.length * spacing;
  for (int d = 0; d < 3; ++d) f.count[d] = count[d];
  f.density = units.of(sdk::dimension::density) * density;
  f.viscosity = units.of(sdk::dimension::dynamic_viscosity) * viscosity;
  f.origin = units.length * domain_min;
  f.pressure = pressure_shown_;
  f.open_fraction = open_fraction;
  f.velocity_x = velocity_shown_[0];
  f.velocity_y = velocity_shown_[1];
  f.velocity_z = velocity_shown_[2];
  f.void_fraction = void_fraction;
}

void step(sdk::Sensor& sensor, World& world) {
  world.time += world.interval;
  sensor.observe(world.view());
}

}  // namespace dust::contract
