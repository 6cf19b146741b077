// SPDX-License-Identifier: Apache-2.0
#include "about/version.hpp"

#include "dust/sdk/plugin.hpp"

#include <dust_commit.hpp>

namespace dust::engine {
namespace {

constexpr const char* k_compiler =
#if defined(__clang__)
    "clang " __clang_version__;
#elif defined(__GNUC__)
    "g++ " __VERSION__;
#else
    "unknown";
#endif
constexpr const char* k_processor =
#if defined(__x86_64__)
    "x86-64";
#elif defined(__aarch64__)
    "aarch64";
#else
    "unknown processor";
#endif

}  // namespace

std::string commit() { return DUST_COMMIT; }

std::string version_text() {
  return "engine " DUST_VERSION "\ncommit: " + commit() + "\ncompiler: " + k_compiler + ", " +
         k_processor + ", " DUST_BUILD_TYPE +
         "\nplugin interface: " + std::to_string(sdk::k_interface_version);
}

}  // namespace dust::engine
