// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <type_traits>

namespace dust::base {

/// A number that tells whether arrays are as they were: FNV-1a over eight bytes at a time. Against
/// accidents, not against intent.
class Digest {
 public:
  template <class T>
  Digest& add(const T* data, std::size_t count) {
    static_assert(std::is_arithmetic_v<T>);
    const auto* bytes = reinterpret_cast<const unsigned char*>(data);
    const std::size_t size = count * sizeof(T);
    add_word(size);
    for (std::size_t n = 0; n < size; n += 8) {
      std::uint64_t word = 0;
      std::memcpy(&word, bytes + n, std::min<std::size_t>(8, size - n));
      add_word(word);
    }
    return *this;
  }
  template <class Vector>
  Digest& add(const Vector& v) {
    return add(v.data(), v.size());
  }
  [[nodiscard]] std::uint64_t value() const { return value_; }

 private:
  void add_word(std::uint64_t word) { value_ = (value_ ^ word) * 0x100000001B3ull; }
  std::uint64_t value_ = 0xCBF29CE484222325ull;
};

}  // namespace dust::base
