// SPDX-License-Identifier: Apache-2.0
#include "support/sensor_bench.hpp"

#include <dlfcn.h>

#include <stdexcept>

namespace dust::test {
namespace {

class OneModel final : public sdk::Registrar {
 public:
  void add(sdk::ModelInfo info, sdk::ModelFactory factory) override {
    kind = {std::move(info), std::move(factory)};
  }
  SensorKind kind;
};

}  // namespace

SensorKind load_sensor(const std::string& name) {
  const std::string file = std::string(DUST_TEST_PLUGINS) + "/sensor_" + name + ".so";
  void* library = ::dlopen(file.c_str(), RTLD_NOW | RTLD_LOCAL);
  if (library == nullptr) throw std::runtime_error(::dlerror());
  using Register = void (*)(sdk::Registrar&);
  const auto enter = reinterpret_cast<Register>(::dlsym(library, "dust_register"));
  if (enter == nullptr) throw std::runtime_error(file + " has no entry point");
  OneModel registrar;
  enter(registrar);
  return registrar.kind;
}

std::unique_ptr<sdk::Sensor> SensorKind::make(
    const std::map<std::string, sdk::Value>& parameters) const {
  std::vector<sdk::Value> values;
  std::size_t used = 0;
  for (const sdk::Parameter& p : info.parameters) {
    const auto given = parameters.find(p.name);
    used += given != parameters.end();
    values.push_back(given != parameters.end() ? given->second : p.default_value);
  }
  if (used != parameters.size()) throw std::runtime_error("a parameter is not in the schema");
  return std::unique_ptr<sdk::Sensor>(static_cast<sdk::Sensor*>(factory(values).release()));
}

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

void MemoryArchive::numbers(std::string_view name, std::span<const double> values) {
  if (!numbers_.emplace(name, std::vector<double>(values.begin(), values.end())).second) {
    throw std::runtime_error("saved twice: " + std::string(name));
  }
}
void MemoryArchive::integers(std::string_view name, std::span<const std::int64_t> values) {
  if (!integers_.emplace(name, std::vector<std::int64_t>(values.begin(), values.end())).second) {
    throw std::runtime_error("saved twice: " + std::string(name));
  }
}
std::vector<double> MemoryArchive::numbers(std::string_view name) {
  return numbers_.at(std::string(name));
}
std::vector<std::int64_t> MemoryArchive::integers(std::string_view name) {
  return integers_.at(std::string(name));
}

void World::set_cells(int nx, int ny, int nz) {
  count[0] = nx;
  count[1] = ny;
  count[2] = nz;
  const auto cells = static_cast<std::size_t>(nx) * ny * nz;
  pressure.assign(cells, 0.0f);
  open_fraction.assign(cells, 1.0f);
  still_air_.assign(cells, 0.0f);
  no_solids_.assign(cells, 1.0f);
}

const sdk::WorldView& World::view() {
  id_.clear();
  for (auto& column : columns_) column.clear();
  for (std::size_t i = 0; i < grains.size(); ++i) {
    const Grain& g = grains[i];
    id_.push_back(static_cast<std::int64_t>(i));
    const double values[18] = {g.now.x,      g.now.y,      g.now.z,      g.before.x,   g.before.y,
                               g.before.z,   g.velocity.x, g.velocity.y, g.velocity.z, g.rotation.x,
                               g.rotation.y, g.rotation.z, g.force.x,    g.force.y,    g.force.z,
                               g.diameter,   g.mass,       g.weight};
    for (int c = 0; c < 18; ++c) columns_[c].push_back(values[c]);
  }
  material_.assign(grains.size(), 0);
  view_ = {};
  view_.time = time;
  view_.interval = interval;
  view_.domain_min = domain_min;
  view_.domain_max = domain_max;
  view_.gravity = gravity;
  view_.class_diameters = class_diameters;
  view_.emitted_mass = emitted_mass;
  sdk::GrainColumns& g = view_.grains;
  g.id = id_;
  g.material = material_;
  std::span<const double>* targets[18] = {
      &g.x,          &g.y,          &g.z,          &g.x_before,   &g.y_before,   &g.z_before,
      &g.velocity_x, &g.velocity_y, &g.velocity_z, &g.rotation_x, &g.rotation_y, &g.rotation_z,
      &g.force_x,    &g.force_y,    &g.force_z,    &g.diameter,   &g.mass,       &g.weight};
  for (int c = 0; c < 18; ++c) *targets[c] = columns_[c];
  for (auto& column : partners_) column.clear();
  for (auto& column : contact_columns_) column.clear();
  for (const Contact& c : contacts) {
    partners_[0].push_back(c.i);
    partners_[1].push_back(c.j);
    const double values[7] = {c.force.x,  c.force.y,  c.force.z, c.branch.x,
                              c.branch.y, c.branch.z, c.overlap};
    for (int n = 0; n < 7; ++n) contact_columns_[n].push_back(values[n]);
  }
  sdk::ContactColumns& c = view_.contacts;
  c.grain_i = partners_[0];
  c.grain_j = partners_[1];
  std::span<const double>* contact_targets[7] = {&c.force_x,  &c.force_y,  &c.force_z, &c.branch_x,
                                                 &c.branch_y, &c.branch_z, &c.overlap};
  for (int n = 0; n < 7; ++n) *contact_targets[n] = contact_columns_[n];
  wall_name_.clear(), wall_group_.clear(), wall_force_.clear(), wall_torque_.clear();
  wall_power_.clear(), wall_mass_.clear(), wall_contacts_.clear();
  for (const Wall& w : walls) {
    wall_name_.push_back(w.name);
    wall_group_.push_back(w.group);
    wall_force_.push_back(w.force);
    wall_torque_.push_back(w.torque);
    wall_power_.push_back(w.power);
    wall_mass_.push_back(w.mass);
    wall_contacts_.push_back(w.contacts);
  }
  view_.walls = {wall_name_,  wall_group_, wall_force_,    wall_torque_,
                 wall_power_, wall_mass_,  wall_contacts_, impacts};
  sdk::FluidColumns& f = view_.fluid;
  f.spacing = spacing;
  for (int d = 0; d < 3; ++d) f.count[d] = count[d];
  f.density = density;
  f.viscosity = 1.8e-5;
  f.pressure = pressure;
  f.open_fraction = open_fraction;
  f.velocity_x = f.velocity_y = f.velocity_z = still_air_;
  f.void_fraction = no_solids_;
  return view_;
}

void step(sdk::Sensor& sensor, World& world) {
  world.time += world.interval;
  sensor.observe(world.view());
}

}  // namespace dust::test
