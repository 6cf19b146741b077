// SPDX-License-Identifier: Apache-2.0
#include "particles/conditions.hpp"

#include "particles/energy/working_contact.hpp"

#include <algorithm>
#include <string>
#include <utility>

namespace dust::particles {
namespace {

std::vector<std::string> names_of(const auto& materials) {
  std::vector<std::string> names;
  names.reserve(materials.size());
  for (const auto& m : materials) names.push_back(m.name);
  return names;
}

double largest_of(const std::vector<double>& diameters) {
  return diameters.empty() ? 0.0 : *std::max_element(diameters.begin(), diameters.end());
}

}  // namespace

Conditions::Conditions(const scenario::Setup& setup, const bodies::BodySet& bodies,
                       std::vector<PairLaws> pair_laws, const std::vector<double>& diameters,
                       const DemOptions& options, bool keeps_work)
    : laws(std::move(pair_laws), names_of(setup.materials), largest_of(diameters), keeps_work,
           setup.audit.energy ? k_energy_columns : 0),
      surfaces(surfaces_of(setup, bodies)),
      domain(setup),
      steps(time_steps(setup, bodies, laws.all(), diameters, options.release_speed)) {
  find_abutting(bodies, setup.domain.min, setup.domain.max, surfaces);
  for (const auto& m : setup.materials) {
    materials.push_back(m.properties);
    // Buoyancy of the hydrostatic pressure: the fluid's own pressure does not hold it.
    const double share = 1.0 - options.fluid_density / m.properties.density;
    gravity.insert(gravity.end(), {share * setup.gravity.x, share * setup.gravity.y,
                                   share * setup.gravity.z, 0.0});
  }
}

}  // namespace dust::particles
