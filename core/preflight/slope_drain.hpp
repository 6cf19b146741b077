// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "setup/setup.hpp"

#include <limits>

namespace dust::preflight {

/// A bed behind a wall that is taken away: what lies above the slope leaves, through a side of the
/// domain that lets grains out.
struct SlopeDrain {
  double begin = std::numeric_limits<double>::infinity();  ///< [s] of the run
  double share = 0.0;                                      ///< of the bed's grains that leave
  double time = 0.0;                                       ///< [s] in which all but 1/e of it does

  /// Share of the bed that has left at `end` [s]: \f$ s (1 - e^{-(end - begin) / time}) \f$.
  [[nodiscard]] double left(double end) const;
  /// [s] Time that a grain of the bed, on average, is no longer there before `end`: the integral
  /// of `left`.
  [[nodiscard]] double absent(double end) const;
};

/// How `solids` [m3] that fill the domain from wall to wall run out, where a body that will be
/// removed covers a side that grains may leave by; otherwise nothing leaves. `gap` [m]: no grain
/// passes between body and side. Of a bed of height H and depth L behind the side what lies above
/// a slope of tangent t leaves: \f$ H / (2 t L) \f$ of it, or \f$ 1 - t L / (2 H) \f$ where
/// the slope ends at the far wall. Bodies within the bed are left out, and funnels with an opening
/// below, which empty.
SlopeDrain slope_drain(const scenario::Setup& setup, const bodies::BodySet& bodies, double solids,
                       double gap);

}  // namespace dust::preflight
