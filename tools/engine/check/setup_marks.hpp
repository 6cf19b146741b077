// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/derived.hpp"
#include "registry/registry.hpp"
#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"

#include <string>
#include <vector>

namespace dust::engine {

/// What a picture of a set-up shows beside the bodies' outlines.
struct SetupMark {
  enum class Kind { belt, feed, opening, body };
  Kind kind = Kind::body;
  std::string text;  ///< empty: of one that has its name elsewhere
  sdk::Vec3 low;     ///< [m] box; of a belt and a body: a point
  sdk::Vec3 high;
  sdk::Vec3 way;        ///< of length 1 or 0: that the belt runs, the feed or the air goes
  bool is_end = false;  ///< the way leads to it, not from it
};

/// Belts with their ways, feeds, openings for the air (hoods, nozzles, inlets), and the names of
/// other bodies, in the domain's frame as the run begins.
std::vector<SetupMark> setup_marks(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                   const registry::Registry& registry,
                                   const preflight::Derived& derived);

}  // namespace dust::engine
