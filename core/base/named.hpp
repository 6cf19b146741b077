// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <string_view>

/// Things that have a `name`, in a list.
namespace dust::base {

/// Where in the list the thing of a name stands, or -1.
[[nodiscard]] std::int32_t number_of(const auto& things, std::string_view name) {
  std::int32_t number = 0;
  for (const auto& thing : things) {
    if (thing.name == name) return number;
    ++number;
  }
  return -1;
}

/// That thing, or null.
[[nodiscard]] const auto* find_named(const auto& things, std::string_view name) {
  const std::int32_t number = number_of(things, name);
  return number < 0 ? nullptr : &things[static_cast<std::size_t>(number)];
}

}  // namespace dust::base
