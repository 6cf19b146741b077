// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/stencils/face_kernels.hpp"

#include <array>
#include <cstddef>

namespace dust::coupling {

/// What predicts how a batch of grains will move, as columns.
struct DragLookAhead {
  StencilBatch::Reals rate;                 ///< [1/s] of the last action
  StencilBatch::Reals weight;               ///< part of gravity that the grain falls with; 0 if new
  StencilBatch::Reals is_known;             ///< 1, or 0 for a grain without a refresh before this
  std::array<StencilBatch::Reals, 3> pull;  ///< [m/s] target of the last action less velocity
  std::array<StencilBatch::Reals, 3> change;  ///< [m/s] in: since the last refresh; out: expected
  StencilBatch::Reals speed;                  ///< [m/s] out: slip half way
};

/// `change` of each grain's velocity in the first half of the coming interval, `half` [s], and the
/// magnitude of the `slip` [m/s] then. With the drag coefficient of that slip the whole interval is
/// right to second order, where that of the beginning is right to first.
///
/// The change is what the last action and the weight make of the grain. One that its neighbours
/// hold or hit does not follow them: it changes by no more than it did since the last refresh,
/// taken `before` times (half over the last interval).
void predict(std::size_t count, double half, double before, const std::array<double, 3>& gravity,
             const std::array<StencilBatch::Reals, 3>& slip, DragLookAhead& grains);

}  // namespace dust::coupling
