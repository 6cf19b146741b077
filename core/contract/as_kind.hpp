// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/text.hpp"
#include "contract/rule_runner.hpp"

#include <memory>
#include <string>

namespace dust::contract {

/// The model behind a maker as its kind.
template <class T>
std::unique_ptr<T> make_as(const Maker& make, const Units& units = {}) {
  return std::unique_ptr<T>(static_cast<T*>(make(units).release()));
}

inline void require(bool is_kept, const std::string& why) {
  if (!is_kept) throw Violation(why);
}

/// A number for messages.
inline std::string shown(double value) { return base::digits_text(value, 4); }

/// Runs the hot call of a trial; a Violation when it allocates and the trial watches.
template <class Call>
void call_hot(const TestVariant& variant, const Call& call) {
  if (variant.runner == nullptr) return call();
  const std::uint64_t count = variant.runner->allocations(call);
  require(count == 0, "it allocates " + std::to_string(count) + " times in one call");
}

}  // namespace dust::contract
