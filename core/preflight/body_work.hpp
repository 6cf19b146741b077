// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "setup/setup.hpp"

#include <vector>

namespace dust::preflight {

/// What the bodies of a scenario add to the work of a run [s], told by their shapes and motions.
struct BodyWork {
  /// To find where a grain touches a body, in each of its steps; by body.
  std::vector<double> touch;
  /// To ask all bodies whether they are near a grain, spread over the steps between two lists.
  double search = 0.0;
  bool is_shaking = false;  ///< one goes to and fro: `oscillate`
  /// Each fluid step: to cut the cells anew by bodies that go to other places, and to predict what
  /// they leave open at its end. Nothing where none does.
  double cut = 0.0;
  double predict = 0.0;
  /// Cells beside the surfaces of those, which take most of it.
  double near_cells = 0.0;
  /// [B] Of the surfaces in each frame, where they are written anew with it: bodies go to other
  /// places or are taken away.
  double frame_bytes = 0.0;
};

/// Looks at shapes, areas and motions. Held against runs in docs/validation/estimates.md.
BodyWork body_work(const scenario::Setup& setup, const bodies::BodySet& bodies);

}  // namespace dust::preflight
