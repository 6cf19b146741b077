// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <string_view>

namespace dust::base {

/// Bytes of the UTF-8 character (RFC 3629) at `text[at]`; 0 where there is none: a byte that stands
/// alone, an overlong form, a surrogate, the end.
std::size_t utf8_length(std::string_view text, std::size_t at);

/// Whether `text` is UTF-8 throughout.
bool is_utf8(std::string_view text);

}  // namespace dust::base
