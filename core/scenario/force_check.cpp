// SPDX-License-Identifier: Apache-2.0
#include "scenario/force_check.hpp"

#include <string>

namespace dust::scenario {
namespace {

struct Part {
  bool sdk::FluidForceParts::*flag;
  const char* name;
  bool is_in_set_three;  ///< as part of the drag
};
constexpr Part k_parts[] = {
    {&sdk::FluidForceParts::pressure_gradient, "the force of the pressure gradient", true},
    {&sdk::FluidForceParts::viscous_stress, "the force of the viscous stress", true},
    {&sdk::FluidForceParts::buoyancy, "the hydrostatic buoyancy", false}};

}  // namespace

void check_forces(const Setup& setup, std::span<const sdk::FluidForce* const> models,
                  Diagnostics& diagnostics) {
  const auto& choices = setup.fluid_forces;
  for (std::size_t n = 0; n < choices.size(); ++n) {
    const auto line = [&](std::size_t m) {
      const int number = choices[m].where.line;
      return choices[m].path + (number > 0 ? " in line " + std::to_string(number) : "");
    };
    bool is_reported = false;
    for (std::size_t m = 0; m < n && !is_reported; ++m) {
      if (choices[m].name != choices[n].name) continue;
      diagnostics.error(choices[n].where, choices[n].path + ": '" + choices[n].name +
                                              "' is given already by " + line(m) +
                                              ": remove one of the two");
      is_reported = true;
    }
    if (models[n] == nullptr || is_reported) continue;
    for (const MaterialSpec& material : setup.materials) {
      if (material.coarse_graining == 1.0 || !(models[n]->needs().wall_reach > 0.0)) continue;
      diagnostics.error(choices[n].where,
                        choices[n].path + ": '" + choices[n].name +
                            "' acts between a wall and the grain itself, but a grain of '" +
                            material.name + "' stands for smaller ones: remove it, or materials." +
                            material.name + ".coarse_graining");
    }
    const sdk::FluidForceParts parts = models[n]->takes_over();
    for (const Part& part : k_parts) {
      if (!(parts.*part.flag)) continue;
      if (part.is_in_set_three && setup.fluid && setup.fluid->momentum_set == "III") {
        diagnostics.error(choices[n].where,
                          choices[n].path + ": '" + choices[n].name + "' gives " + part.name +
                              ", which momentum set III has in the drag already: remove it, or " +
                              "take momentum_set I or II");
        continue;
      }
      for (std::size_t m = 0; m < n; ++m) {
        if (models[m] == nullptr || !(models[m]->takes_over().*part.flag)) continue;
        diagnostics.error(choices[n].where, choices[n].path + ": '" + choices[n].name + "' gives " +
                                                part.name + ", as '" + choices[m].name + "' (" +
                                                line(m) +
                                                ") does: it would count twice; remove one of them");
      }
    }
  }
}

}  // namespace dust::scenario
