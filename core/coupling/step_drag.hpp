// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/face_stencils.hpp"

#include <utility>

namespace dust::coupling {

/// The drag that the fluid is given in a fluid step: begin_step() makes it, evaluate() takes it. Of
/// one step and of one coupling; whoever has none cannot ask for what follows from it.
class AssembledDrag {
 public:
  AssembledDrag(AssembledDrag&&) = default;
  AssembledDrag& operator=(AssembledDrag&&) = default;

 private:
  friend class Coupling;
  AssembledDrag(FaceStencils assembled, FaceStencils sampled)
      : assembled_(std::move(assembled)), sampled_(std::move(sampled)) {}

  FaceStencils assembled_;  ///< of the particles where the drag was assembled
  FaceStencils sampled_;    ///< where the fluid is sampled before the drag is evaluated
};

/// The same after the fluid has taken it: evaluate() makes it, end_step() takes it.
class EvaluatedDrag {
 public:
  EvaluatedDrag(EvaluatedDrag&&) = default;
  EvaluatedDrag& operator=(EvaluatedDrag&&) = default;

 private:
  friend class Coupling;
  explicit EvaluatedDrag(FaceStencils sampled) : sampled_(std::move(sampled)) {}

  FaceStencils sampled_;  ///< of the particles where the fluid was sampled last
};

}  // namespace dust::coupling
