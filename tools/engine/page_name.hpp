// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dust::engine {

/// What is wrong with a name that a page is to be written to; empty where nothing is. A page under
/// the name of a picture would open in nothing, and files that are no page of this engine's, or the
/// report of a run or study, are not overwritten.
std::string page_name_problem(const std::string& name);

}  // namespace dust::engine
