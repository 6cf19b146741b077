// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dust::base {

/// `word` as a shell takes it for one word that means itself: as it is, or in single quotes. For
/// commands that messages name, which somebody will copy.
std::string shell_word(const std::string& word);

}  // namespace dust::base
