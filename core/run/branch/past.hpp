// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "io/stored_state.hpp"
#include "run/summary/summary.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// What a run knows of its own beginning. Once it is resumed, nothing else tells it any more.
struct Past {
  std::optional<StartFacts> start;    ///< nothing: at 0 s
  std::vector<std::string> warnings;  ///< given when it began, or went on, with something changed
};

/// Notes it in a checkpoint; its part is `k_past_part`.
inline constexpr const char* k_past_part = "past";
void save_past(const Past& past, sdk::ArchiveWriter& archive);

/// Nothing of checkpoints from before it was kept.
Past load_past(const io::StoredState& state);

}  // namespace dust::run
