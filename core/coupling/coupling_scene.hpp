// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/drag/drag_model.hpp"
#include "coupling/particle_states.hpp"
#include "coupling/stencils/face_void_fraction.hpp"
#include "coupling/stencils/lattice.hpp"
#include "coupling/void_fraction_field.hpp"
#include "dust/sdk/voidage_rule.hpp"

namespace dust::coupling {

/// What the stages of the coupling work on: views of what others own.
struct CouplingScene {
  const Lattice& lattice;
  const sdk::VoidageRule& voidage;
  const DragModel& drag;
  const FaceVoidFraction& face_void;
  VoidFractionField& void_fraction;
  ParticleStates& states;
};

}  // namespace dust::coupling
