// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/wall_shear_check.hpp"

#include "preflight/air/air_passage.hpp"

#include <algorithm>
#include <string>

namespace dust::preflight {
namespace {

using scenario::Diagnostics;
using scenario::k_side_names;
using scenario::Setup;
using sdk::SideRule;

}  // namespace

void check_wall_shear(const Setup& setup, const SideModels& sides, const scenario::SensorSpec& spec,
                      const sdk::Sensor& sensor, Diagnostics& diagnostics) {
  if (!setup.fluid) return;
  const auto* const found =
      std::find(k_side_names.begin(), k_side_names.end(), sensor.wanted_surfaces().rubbed_side);
  if (found == k_side_names.end()) return;
  const auto side = static_cast<std::size_t>(found - k_side_names.begin());
  const auto refuse = [&](const std::string& why) {
    diagnostics.error(spec.model.where, "sensors." + spec.name + ".side: " + *found + why);
  };
  if (sides[side] == nullptr) {
    refuse(" is periodic, no wall that the air could rub; name a side that is one");
  } else if (passes_air_everywhere(setup, side, sides)) {
    refuse(" lets air pass wherever it is, so that there is no wall; name a side that is one");
  } else if (sides[side]->rules().tangential_velocity != SideRule::fixed) {
    refuse(
        " holds no air that goes along it, so that there is no shear; name a side with no_slip "
        "or moving_wall");
  } else if (!is_too_large(setup, side) && !SideFaces(setup, side).is_of_own_fluid()) {
    refuse(
        " has a region of another viscosity beside it, and the sensor knows that of the fluid "
        "alone; name another side, or take the sensor out");
  }
}

}  // namespace dust::preflight
