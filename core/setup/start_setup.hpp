// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "setup/mark.hpp"

#include <filesystem>
#include <optional>
#include <string>

namespace dust::scenario {

/// The state of another run that a run starts from.
struct StartSpec {
  std::filesystem::path folder;  ///< of that run's results, absolute
  std::optional<double> time;    ///< [s] of the state; nothing: the newest
  std::string written;           ///< both, as the resolved scenario has them
  Mark where;
};

/// Where a run starts, and which of its states others can start from. No model asks for it.
struct StartSetup {
  std::optional<StartSpec> from;  ///< nothing: at time 0
  double keep_every = 0.0;        ///< [s] between states that are kept; 0: the newest alone
  Mark end_where;                 ///< of time.end
};

}  // namespace dust::scenario
