// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <utility>

namespace dust::fluid {

/// A value that follows from others, found when it is first asked for after these have changed.
/// Not for several threads at once.
template <class T>
class Cached {
 public:
  /// Not yet found.
  Cached() = default;
  /// Known from the start.
  explicit Cached(T value) : value_(std::move(value)), is_valid_(true) {}

  [[nodiscard]] bool is_valid() const { return is_valid_; }
  /// What it follows from has changed.
  void invalidate() { is_valid_ = false; }
  /// Calls find(value) if it is not valid.
  template <class Find>
  const T& get(const Find& find) {
    if (!is_valid_) {
      find(value_);
      is_valid_ = true;
    }
    return value_;
  }
  /// To be written now: it is valid from here on.
  T& write() {
    is_valid_ = true;
    return value_;
  }

 private:
  T value_{};
  bool is_valid_ = false;
};

}  // namespace dust::fluid
