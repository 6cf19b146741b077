// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>
#include <string_view>
#include <vector>

namespace dust::scenario {

/// The candidate nearest to `word` by edits (a swap of neighbours counts as one), "" when none is
/// near enough to be meant.
std::string nearest(std::string_view word, const std::vector<std::string>& candidates);

/// "; did you mean 'x'?", or "; <label>: a, b, c" when nothing is near, or "" without candidates.
std::string suggestion(std::string_view word, const std::vector<std::string>& candidates,
                       std::string_view label);

/// "a, b, c"
std::string listed(const std::vector<std::string>& words);

/// `text` on one line, cut to a readable length, with control characters replaced.
std::string printable(std::string_view text);

/// `text` as printable() gives it, between single quotes.
std::string in_quotes(std::string_view text);

}  // namespace dust::scenario
