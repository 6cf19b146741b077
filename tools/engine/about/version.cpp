// SPDX-License-Identifier: Apache-2.0
#include "about/version.hpp"

#include "base/built_by.hpp"
#include "dust/sdk/plugin.hpp"

#include <dust_commit.hpp>

namespace dust::engine {
std::string commit() { return DUST_COMMIT; }

std::string version_text() {
  return "engine " DUST_VERSION "\ncommit: " + commit() + "\ncompiler: " + base::k_compiler + ", " +
         base::k_processor + ", " DUST_BUILD_TYPE +
         "\nplugin interface: " + std::to_string(sdk::k_interface_version);
}

}  // namespace dust::engine
