// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/cohesion_law.hpp>
#include <dust/sdk/parameter_schema.hpp>

#include <string>

namespace dust::model {

/// What laws of elastic spheres share that stick by the work of adhesion of their surfaces.
class SurfaceEnergyLaw : public sdk::CohesionLaw {
 public:
  struct Parameters {
    double surface_energy = 0.0;
  };
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    young_ = sdk::effective_young_modulus(i, j);
  }

 protected:
  explicit SurfaceEnergyLaw(const Parameters& p) : surface_energy_(p.surface_energy) {}
  /// [J/m2]
  [[nodiscard]] double surface_energy() const { return surface_energy_; }
  /// [Pa] E*
  [[nodiscard]] double young() const { return young_; }

 private:
  double surface_energy_;
  double young_ = 0.0;
};

/// `pull_off` is the pull-off force over R* times the energy: "2 pi".
template <class P>
void declare_surface_energy(sdk::SchemaOf<P>& s, const std::string& pull_off) {
  s.number(&P::surface_energy, "surface_energy", sdk::dimension::surface_energy,
           "Work to part a unit area of the two surfaces (of two equal solids: twice the "
           "surface energy of one); the pull-off force is " +
               pull_off + " R* times it.")
      .symbol("\\gamma")
      .above(0);
}

}  // namespace dust::model
