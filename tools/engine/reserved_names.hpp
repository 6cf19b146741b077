// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string>

namespace dust::engine {

/// Why a plugin cannot have this name, which is a namespace and a class in its sources and a target
/// in its build: "a keyword of C++", "a target that CMake makes itself"; empty where it can.
std::string why_reserved(const std::string& name);

}  // namespace dust::engine
