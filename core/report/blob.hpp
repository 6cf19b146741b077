// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>

namespace dust::report {

/// Bytes as base64.
[[nodiscard]] std::string base64(std::span<const std::uint8_t> bytes);

/// Bytes as a zlib stream in base64: what the page's scripts unpack.
[[nodiscard]] std::string packed(std::span<const std::uint8_t> bytes);

}  // namespace dust::report
