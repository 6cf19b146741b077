// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/emitter.hpp"
#include "setup/setup.hpp"

#include <limits>
#include <vector>

namespace dust::preflight {

/// What becomes of a lone grain.
struct Journey {
  double duration = 0.0;  ///< [s] until it is out of the domain; infinite where it stays
  /// [s] after which it first meets something; infinite where it does not.
  double first_touch = std::numeric_limits<double>::infinity();
  double carried = 0.0;         ///< [s] of that on bodies and walls, until it rests
  double carried_way = 0.0;     ///< [m] it goes in that time
  std::vector<double> on_body;  ///< [s] of `carried` on each body
};

/// Follows a grain that an emitter proposes, for `longest` [s] at most: it falls freely, loses the
/// velocity into whatever it meets, and is dragged along or braked there by Coulomb friction. Other
/// grains and the fluid are left out. Bounded work: a few thousand steps. Meant to count how many
/// grains are there at a time, not where they go.
Journey follow_grain(const scenario::Setup& setup, const bodies::BodySet& bodies,
                     const sdk::InsertionRequest& grain, double longest);

/// \f$ \int_0^T N dt \f$ [s], the grain-seconds of a stream of one grain per second from `begin` to
/// `end` [s] within a run of `run_end` = T [s], where each grain stays for `duration` [s]:
/// \f$ \int_{begin}^{\min(end,T)} \min(duration, T - s) ds \f$.
double grain_seconds(double begin, double end, double duration, double run_end);

/// Most grains at a time of the same stream: one per second of the longest interval in which
/// grains come and none has left.
double most_grains(double begin, double end, double duration, double run_end);

}  // namespace dust::preflight
