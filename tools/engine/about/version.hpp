// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dust::engine {

/// The commit the engine was built from: "02785cb", "02785cb, changed" where files differed from
/// it, "unknown" without git.
std::string commit();

/// What `engine --version` prints: version, commit, compiler with processor, plugin interface.
std::string version_text();

}  // namespace dust::engine
