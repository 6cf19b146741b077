// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_field.hpp"
#include "airborne/dust_weight.hpp"
#include "verification/fluid/fluid_case.hpp"

#include <memory>
#include <utility>

namespace dust::test {

/// Gas without bodies and grains, and dust whose weight it feels, as a run couples them.
struct DustyCase {
  Case air;
  scenario::DustFieldSpec spec;
  std::unique_ptr<airborne::Flow> flow;
  std::unique_ptr<airborne::DustField> field;
  std::unique_ptr<airborne::DustWeight> weight;
  static constexpr double k_gravity = 9.81;

  void start() {
    air.start();
    const sdk::Vec3 gravity{0, 0, -k_gravity};
    flow = std::make_unique<airborne::Flow>(air.grid);
    flow->volume_before.assign(air.grid.size, 1.0);
    flow->volume_after.assign(air.grid.size, 1.0);
    for (int d = 0; d < 3; ++d) {
      const auto axis = static_cast<std::size_t>(d);
      auto& passage = flow->passage.component[axis];
      passage.assign(air.grid.size, 1.0);
      if (air.grid.is_periodic[axis]) continue;
      for (const int high : {0, 1}) {
        if (air.sides[static_cast<std::size_t>(2 * d + high)]->side_rules.normal_velocity !=
            sdk::SideRule::fixed) {
          continue;
        }
        std::array<int, 3> n = air.cells;
        n[axis] = 1;
        for (int k = 0; k < n[2]; ++k) {
          for (int j = 0; j < n[1]; ++j) {
            for (int i = 0; i < n[0]; ++i) {
              std::array<int, 3> at{i, j, k};
              at[axis] = high * air.cells[axis];
              passage[static_cast<std::size_t>(air.grid.index(at[0], at[1], at[2]))] = 0.0;
            }
          }
        }
      }
    }
    field = std::make_unique<airborne::DustField>(
        air.grid, spec, airborne::Gas{air.fluid.density, air.fluid.viscosity}, gravity,
        airborne::DustField::Ends{0, 6});
    weight =
        std::make_unique<airborne::DustWeight>(air.grid, gravity, spec.density, air.fluid.density);
    field->start(flow->volume_after);
  }
  void advance(double step) {
    air.exchange.source = weight->find(*field, flow->volume_after);
    air.advance(step);
    air.solver->find_throughflow(flow->throughflow);
    if (const fluid::CellField* eddies = air.solver->eddy_viscosity()) {
      flow->eddy_diffusivity = *eddies;
      for (double& d : flow->eddy_diffusivity) d /= air.fluid.density;
    }
    field->advance(*flow, air.time - step, step);
  }
};

}  // namespace dust::test
