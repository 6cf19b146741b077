// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "contract/memory_archive.hpp"
#include "dust/sdk/plugin.hpp"
#include "particles/dem.hpp"
#include "setup/setup.hpp"

#include <dlfcn.h>

#include <algorithm>
#include <cstring>
#include <map>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace dust::test {

/// Models straight from the plugin libraries, without the registry.
class ModelLoader : public sdk::Registrar {
 public:
  void add(sdk::ModelInfo info, sdk::ModelFactory factory) override {
    const std::string key = info.kind + "/" + info.name;
    models_[key] = {std::move(info), std::move(factory)};
  }
  /// `kind/name` with parameters by name; the others keep their defaults.
  template <class Kind>
  static std::unique_ptr<Kind> make(const std::string& kind, const std::string& name,
                                    const std::map<std::string, sdk::Value>& values) {
    const auto& [info, factory] = loaded(kind, name);
    std::vector<sdk::Value> row;
    for (const sdk::Parameter& p : info.parameters) {
      const auto given = values.find(p.name);
      row.push_back(given == values.end() ? sdk::Value{} : given->second);
    }
    return std::unique_ptr<Kind>(static_cast<Kind*>(factory(row).release()));
  }

 private:
  using Made = std::pair<sdk::ModelInfo, sdk::ModelFactory>;
  static const Made& loaded(const std::string& kind, const std::string& name) {
    static ModelLoader loader;
    const auto known = loader.models_.find(kind + "/" + name);
    if (known != loader.models_.end()) return known->second;
    const std::string file = std::string(DUST_TEST_PLUGINS) + "/" + kind + "_" + name + ".so";
    void* library = dlopen(file.c_str(), RTLD_NOW);
    if (library == nullptr) throw std::runtime_error(dlerror());
    void (*entry)(sdk::Registrar&) = nullptr;
    void* symbol = dlsym(library, "dust_register");
    std::memcpy(&entry, &symbol, sizeof entry);
    entry(loader);
    return loader.models_.at(kind + "/" + name);
  }
  std::map<std::string, Made> models_;
};

/// What a DEM test needs: one or more materials, walls, bodies and laws.
struct DemRig {
  scenario::Setup setup;
  bodies::BodySet bodies;
  std::vector<particles::PairLaws> laws;
  std::vector<double> diameters;
  bool has_fluid = false;  ///< room for what a fluid does to the grains
  particles::DemOptions options;

  DemRig() {
    setup.domain.min = {-1, -1, -1};
    setup.domain.max = {1, 1, 1};
    setup.time.fluid_step = 0.0;
  }
  int material(double density, double young, double poisson) {
    setup.materials.push_back(
        {"m" + std::to_string(setup.materials.size()), {density, young, poisson}});
    return static_cast<int>(setup.materials.size()) - 1;
  }
  /// A model by name with its parameters; without a name: none.
  struct Choice {
    std::string name;
    std::map<std::string, sdk::Value> values;
  };
  void law(int i, int j, double restitution, double friction, double rolling = -1.0) {
    laws_of(i, j, {"hertz_mindlin", {{"restitution", restitution}, {"friction", friction}}},
            rolling >= 0.0 ? Choice{"epsd2", {{"friction", rolling}}} : Choice{});
  }
  /// Any laws for the pair of materials i, j.
  void laws_of(int i, int j, const Choice& contact, const Choice& rolling = {},
               const Choice& cohesion = {}) {
    particles::PairLaws p;
    p.material_i = i;
    p.material_j = j;
    const auto& mi = setup.materials[static_cast<std::size_t>(i)].properties;
    const auto& mj = setup.materials[static_cast<std::size_t>(j)].properties;
    p.contact = ModelLoader::make<sdk::ContactLaw>("contact", contact.name, contact.values);
    p.contact->prepare(mi, mj);
    if (!rolling.name.empty()) {
      p.rolling = ModelLoader::make<sdk::RollingLaw>("rolling", rolling.name, rolling.values);
      p.rolling->prepare(mi, mj);
    }
    if (!cohesion.name.empty()) {
      p.cohesion = ModelLoader::make<sdk::CohesionLaw>("cohesion", cohesion.name, cohesion.values);
      p.cohesion->prepare(mi, mj);
    }
    laws.push_back(std::move(p));
  }
  void wall(int side, int material) {
    setup.domain.sides[static_cast<std::size_t>(side)] = {
        .grains = scenario::GrainSide::wall, .material = material, .air = {}, .where = {}};
  }
  void periodic(int axis) {
    for (int side : {2 * axis, 2 * axis + 1}) {
      setup.domain.sides[static_cast<std::size_t>(side)].grains = scenario::GrainSide::periodic;
    }
  }
  /// Takes the laws.
  std::unique_ptr<particles::Dem> make() {
    if (has_fluid) setup.fluid.emplace();
    const auto largest = std::max_element(diameters.begin(), diameters.end());
    for (bodies::Body& body : bodies) {
      if (largest != diameters.end()) body.shape->expect_spheres(0.5 * *largest);
    }
    return std::make_unique<particles::Dem>(setup, bodies, std::move(laws), diameters, options);
  }
};

/// One coarse step at a time.
class Stepper {
 public:
  explicit Stepper(particles::Dem& dem) : dem_(dem) {}
  void step(std::int64_t count = 1) {
    for (std::int64_t n = 0; n < count; ++n) {
      dem_.neighbours();
      dem_.step_tiles(time());
      dem_.advance_fine();
      ++steps_;
    }
  }
  [[nodiscard]] double time() const { return static_cast<double>(steps_) * dem_.coarse_step(); }

 private:
  particles::Dem& dem_;
  std::int64_t steps_ = 0;
};

/// Row of a grain, by id.
struct GrainState {
  sdk::Vec3 position, velocity, rotation;
  double radius = 0.0, mass = 0.0, weight = 1.0;
};
inline GrainState grain(particles::Dem& dem, std::int64_t id) {
  const auto rows = dem.rows();
  for (std::size_t n = 0; n < rows.count; ++n) {
    if (rows.id[n] != id) continue;
    const double* p = rows.position_of(n);
    const double* v = rows.velocity_of(n);
    const double* w = rows.rotation_of(n);
    return {{p[0], p[1], p[2]}, {v[0], v[1], v[2]}, {w[0], w[1], w[2]}, p[3],
            1.0 / v[3],         rows.weight[n]};
  }
  throw std::runtime_error("no such grain");
}

using contract::MemoryArchive;

}  // namespace dust::test
