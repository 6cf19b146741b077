// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace dust::base {

/// Whether `text` is UTF-8 (RFC 3629): no bytes that stand alone, no overlong forms, no surrogates.
bool is_utf8(std::string_view text);

}  // namespace dust::base
