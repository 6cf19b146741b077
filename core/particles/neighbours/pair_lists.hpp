// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"
#include "contact/batch_kernels.hpp"

#include <cstddef>
#include <cstdint>
#include <type_traits>
#include <vector>

namespace dust::particles {

/// Contacts of one law, [begin, end) of a list.
struct Segment {
  std::int32_t law = 0;
  std::int32_t surface = -1;
  std::int32_t begin = 0;
  std::int32_t end = 0;
  /// Of a chunk's pairs: [begin, standing) touched when the list was made, a multiple of eight.
  std::int32_t standing = 0;
};

/// Who may meet whom until the list's lifetime ends. For surfaces `b` is the surface's number.
struct OuterList {
  std::vector<std::int32_t> a;
  std::vector<std::int32_t> b;
  std::vector<Segment> segments;

  void clear() { a.clear(), b.clear(), segments.clear(); }
  void push(std::int32_t i, std::int32_t j) { a.push_back(i), b.push_back(j); }
  [[nodiscard]] std::size_t size() const { return a.size(); }
};

/// The entries of an outer list that may touch within the next steps, with the history of contacts:
/// of each segment first those standing, then the others, both in the list's order.
struct ContactList {
  std::vector<std::int32_t> a;
  std::vector<std::int32_t> b;
  std::vector<std::uint8_t> is_touching;  ///< 0: no; of a fine list: 1 + its level
  contact::AlignedVector<double> history;
  std::vector<Segment> segments;
  bool is_standing = false;  ///< histories of standing contacts are in columns

  void clear() { a.clear(), b.clear(), is_touching.clear(), history.clear(), segments.clear(); }
  /// `from`: the history of a pair in touch, or null.
  void push(std::int32_t i, std::int32_t j, const double* from, std::size_t stride) {
    a.push_back(i), b.push_back(j), is_touching.push_back(from == nullptr ? 0 : 1);
    if (from == nullptr) {
      history.insert(history.end(), stride, 0.0);
    } else {
      history.insert(history.end(), from, from + stride);
    }
  }
  /// Room for so many entries, never given back: for lists made again and again.
  void make_room(std::size_t most, std::size_t stride) {
    if (a.size() < most) a.resize(most), b.resize(most), is_touching.resize(most);
    if (history.size() < most * stride) history.resize(most * stride);
  }
  /// The first `count` entries of `other` in blocks of just their size: lists are most of the
  /// memory.
  void take_exactly(const ContactList& other, std::size_t count, std::size_t stride) {
    const auto take = [](auto& to, const auto& from, std::size_t size) {
      const auto end = from.begin() + static_cast<std::ptrdiff_t>(size);
      if (to.capacity() < size || 4 * to.capacity() > 5 * size + 64) {
        std::remove_reference_t<decltype(to)>(from.begin(), end).swap(to);
      } else {
        to.assign(from.begin(), end);
      }
    };
    take(a, other.a, count), take(b, other.b, count), take(is_touching, other.is_touching, count);
    take(history, other.history, count * stride);
    segments = other.segments;
  }
  [[nodiscard]] std::size_t size() const { return a.size(); }
  [[nodiscard]] contact::PairView view(std::size_t stride) {
    return {a.data(), b.data(), is_touching.data(), history.data(), stride, size()};
  }
};

}  // namespace dust::particles
