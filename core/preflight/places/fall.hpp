// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "registry/registry.hpp"
#include "setup/setup.hpp"

namespace dust::preflight {

/// How far grains may fall, and how fast they are then.
struct Fall {
  double height = 0.0;  ///< [m] along gravity
  double speed = 0.0;   ///< [m/s] \f$ \sqrt{v_0^2 + 2 g h} \f$, with that at which they come in
};

/// [m/s] at which a lone sphere settles in the fluid, with the drag of Schiller and Naumann (1935):
/// \f$ v^2 = 4 d g |\rho_s / \rho_f - 1| / (3 C_D) \f$.
double settling_speed(const scenario::Setup& setup, double diameter, double density);

/// The fastest free fall of an emitter's grains, from the highest place at which a stream brings
/// them in, or the top of the domain for grains that come at once or are too many to look at, to
/// the lowest place that may stop them: what of bodies faces upwards, and sides that do not let
/// them out. At most: whether something stops them before is not asked. In a liquid, or where the
/// grid resolves them, they are no faster than one that settles alone. Zero where nothing is below:
/// grains that fall together do not meet.
Fall largest_fall(const scenario::Setup& setup, const bodies::BodySet& bodies,
                  const registry::Registry& registry);

}  // namespace dust::preflight
