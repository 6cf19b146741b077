// SPDX-License-Identifier: Apache-2.0
#pragma once

/// By what and for what this program was compiled: summary.json, `engine --version`.
namespace dust::base {

inline constexpr const char* k_compiler =
#if defined(__clang__)
    "clang " __clang_version__;
#elif defined(__GNUC__)
    "g++ " __VERSION__;
#else
    "unknown";
#endif
inline constexpr const char* k_processor =
#if defined(__x86_64__)
    "x86-64";
#elif defined(__aarch64__)
    "aarch64";
#else
    "unknown";
#endif

}  // namespace dust::base
