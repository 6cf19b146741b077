// SPDX-License-Identifier: Apache-2.0
#include "report/blob.hpp"

#include <zlib.h>

#include <stdexcept>
#include <vector>

namespace dust::report {

std::string base64(std::span<const std::uint8_t> bytes) {
  static constexpr char k_digits[] =
      "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
  const std::size_t size = bytes.size();
  std::string text;
  text.reserve((size + 2) / 3 * 4);
  for (std::size_t k = 0; k < size; k += 3) {
    const unsigned a = bytes[k];
    const unsigned b = k + 1 < size ? bytes[k + 1] : 0;
    const unsigned c = k + 2 < size ? bytes[k + 2] : 0;
    text += k_digits[a >> 2];
    text += k_digits[(a & 3) << 4 | b >> 4];
    text += k + 1 < size ? k_digits[(b & 15) << 2 | c >> 6] : '=';
    text += k + 2 < size ? k_digits[c & 63] : '=';
  }
  return text;
}

std::string packed(std::span<const std::uint8_t> bytes) {
  uLongf size = compressBound(static_cast<uLong>(bytes.size()));
  std::vector<std::uint8_t> zipped(size);
  static const std::uint8_t k_none = 0;
  if (compress2(zipped.data(), &size, bytes.empty() ? &k_none : bytes.data(),
                static_cast<uLong>(bytes.size()), 6) != Z_OK) {
    throw std::runtime_error("no memory left to compress the pictures of the report");
  }
  zipped.resize(size);
  return base64(zipped);
}

}  // namespace dust::report
