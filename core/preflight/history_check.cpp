// SPDX-License-Identifier: Apache-2.0
#include "preflight/history_check.hpp"

#include "particles/energy/working_contact.hpp"
#include "particles/pair_law_table.hpp"

#include <algorithm>
#include <string>

namespace dust::preflight {

void check_histories(const scenario::Setup& setup, const scenario::DustSetup& dust,
                     const ParticleModels& models, scenario::Diagnostics& diagnostics) {
  const bool keeps_work = !dust.shares_on_grains().empty();
  const int beside = (keeps_work ? particles::PairLawTable::k_work_columns : 0) +
                     (setup.audit.energy ? particles::k_energy_columns : 0);
  for (std::size_t n = 0; n < setup.interactions.size() && n < models.laws.size(); ++n) {
    const scenario::InteractionSpec& pair = setup.interactions[n];
    const int columns = models.laws[n].history_size() + beside;
    if (columns <= particles::PairLawTable::room()) continue;
    std::string laws = "contact " + pair.contact.name;
    if (pair.rolling) laws += ", rolling " + pair.rolling->name;
    if (pair.cohesion) laws += ", cohesion " + pair.cohesion->name;
    diagnostics.error(
        pair.where, "interactions: " + laws + (keeps_work ? ", with what sets dust free" : "") +
                        (setup.audit.energy ? ", with audit.energy" : "") + ", keep " +
                        std::to_string(columns) + " numbers per contact between " +
                        setup.materials[static_cast<std::size_t>(pair.material_i)].name + " and " +
                        setup.materials[static_cast<std::size_t>(pair.material_j)].name +
                        "; at most " + std::to_string(particles::PairLawTable::room()) +
                        " are possible: take one of the laws out");
  }
}

}  // namespace dust::preflight
