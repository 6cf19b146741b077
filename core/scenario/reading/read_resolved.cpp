// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/emitter.hpp"
#include "scenario/reading/setup_reader.hpp"
#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::scenario {
namespace {

/// To three decimals, for messages; `length` [m].
double rounded_mm(double length) { return std::round(1e6 * length) / 1e3; }

/// Below this the delta function of the markers, three cells wide, is no longer thin.
constexpr double k_min_cells_per_diameter = 8.0;
/// Fluid over grain density from which on the force of a step, which follows the velocity of the
/// step before, would drive the sphere to and fro: docs/theory/resolved.md, section 4.
constexpr double k_lightest = 0.8;

std::vector<int> materials_of(const EmitterSpec& emitter) {
  std::vector<int> all = emitter.more_materials;
  if (all.empty()) all.push_back(emitter.material);
  return all;
}

}  // namespace

bool SetupReader::is_resolved(const EmitterSpec& emitter) const {
  const std::vector<int> all = materials_of(emitter);
  return setup_.fluid && std::any_of(all.begin(), all.end(), [this](int material) {
           return setup_.fluid->resolves(material);
         });
}

void SetupReader::read_resolved(const CouplingBlock& coupling, const Entry* entry) {
  if (coupling.resolved.empty()) return;
  const Mark where = mark_of(entry->value, "resolved");
  if (!setup_.fluid) {
    if (!has_fluid_) {
      error(where,
            "coupling.resolved: spheres are resolved by the grid of a fluid, and fluid is none: "
            "declare a fluid, or leave resolved out");
    }
    return;
  }
  FluidSpec& fluid = *setup_.fluid;
  fluid.resolved_where = where;
  for (const std::string& name : coupling.resolved) {
    fluid.resolved.push_back(names_.materials.index(name));
  }
  const auto refuse = [&](bool is_there, const char* what) {
    if (!is_there) return;
    error(where,
          std::string("coupling.resolved: does not go with ") + what + ": leave one of both out");
  };
  refuse(coupling.one_way, "coupling.one_way, where the fluid does not feel the grains");
  refuse(coupling.overlap, "coupling.overlap, where grains see the fluid of the step before");
  refuse(!fluid.regions.empty(), "fluid.regions: the markers know one density");
  refuse(fluid.momentum_set == "III", "fluid.momentum_set III");
}

/// Sizes and densities of the grains that are to be resolved.
void SetupReader::check_resolved() {
  if (!setup_.fluid || setup_.fluid->resolved.empty() || diagnostics_.has_errors()) return;
  const FluidSpec& fluid = *setup_.fluid;
  double spacing = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double width = setup_.domain.max[d] - setup_.domain.min[d];
    spacing = std::max(spacing, width / fluid.cells[static_cast<std::size_t>(d)]);
  }
  for (const int material : fluid.resolved) {
    const MaterialSpec& m = setup_.materials[static_cast<std::size_t>(material)];
    if (m.coarse_graining != 1.0) {
      error(fluid.resolved_where, "coupling.resolved: grains of '" + m.name +
                                      "' stand for smaller ones (coarse_graining); a resolved "
                                      "sphere is itself: leave one of both out");
    }
    if (m.properties.density < k_lightest * fluid.density) {
      error(fluid.resolved_where,
            "coupling.resolved: '" + m.name + "' has " +
                number_text(m.properties.density / fluid.density) +
                " of the fluid's density; below " + number_text(k_lightest) +
                " the sphere and the fluid that it shoves would drive each other to and fro: take "
                "the material out of resolved");
    }
  }
  for (std::size_t n = 0; n < emitters_.size(); ++n) {
    const EmitterSpec& emitter = setup_.emitters[n];
    if (!is_resolved(emitter)) continue;
    const std::vector<int> all = materials_of(emitter);
    if (!std::all_of(all.begin(), all.end(), [&](int m) { return fluid.resolves(m); })) {
      error(emitter.model.where, emitter.model.path +
                                     ": gives grains of materials that are resolved and of others: "
                                     "use an emitter for each");
    }
    for (const double d : static_cast<const sdk::Emitter&>(*emitters_[n]).diameters()) {
      if (d >= (k_min_cells_per_diameter - 1e-9) * spacing) continue;
      error(fluid.resolved_where,
            "coupling.resolved: grains of " + number_text(rounded_mm(d)) + " mm from " +
                emitter.name + " are " + number_text(std::round(100 * d / spacing) / 100) +
                " cells across, and " + number_text(k_min_cells_per_diameter) +
                " are the fewest: cells of at most " +
                number_text(rounded_mm(d / k_min_cells_per_diameter)) +
                " mm are needed, or take the material out of resolved");
      break;
    }
  }
}

}  // namespace dust::scenario
