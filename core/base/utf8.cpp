// SPDX-License-Identifier: Apache-2.0
#include "base/utf8.hpp"

#include <array>

namespace dust::base {
namespace {

/// Bytes that begin a character, how many follow, and what the first of these may be.
struct Form {
  unsigned first, last;
  std::size_t followers;
  unsigned low, high;
};
constexpr std::array k_forms = {Form{0x00, 0x7F, 0, 0x80, 0xBF}, Form{0xC2, 0xDF, 1, 0x80, 0xBF},
                                Form{0xE0, 0xE0, 2, 0xA0, 0xBF}, Form{0xE1, 0xEC, 2, 0x80, 0xBF},
                                Form{0xED, 0xED, 2, 0x80, 0x9F}, Form{0xEE, 0xEF, 2, 0x80, 0xBF},
                                Form{0xF0, 0xF0, 3, 0x90, 0xBF}, Form{0xF1, 0xF3, 3, 0x80, 0xBF},
                                Form{0xF4, 0xF4, 3, 0x80, 0x8F}};

const Form* form_of(unsigned byte) {
  for (const Form& form : k_forms) {
    if (byte >= form.first && byte <= form.last) return &form;
  }
  return nullptr;
}

}  // namespace

std::size_t utf8_length(std::string_view text, std::size_t at) {
  if (at >= text.size()) return 0;
  const auto byte = [&](std::size_t n) { return static_cast<unsigned char>(text[n]); };
  const Form* form = form_of(byte(at));
  if (form == nullptr || at + form->followers >= text.size()) return 0;
  for (std::size_t n = 1; n <= form->followers; ++n) {
    const unsigned low = n == 1 ? form->low : 0x80;
    const unsigned high = n == 1 ? form->high : 0xBF;
    if (byte(at + n) < low || byte(at + n) > high) return 0;
  }
  return 1 + form->followers;
}

bool is_utf8(std::string_view text) {
  for (std::size_t at = 0; at < text.size();) {
    const std::size_t length = utf8_length(text, at);
    if (length == 0) return false;
    at += length;
  }
  return true;
}

}  // namespace dust::base
