// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"
#include "setup/setup.hpp"

#include <string_view>
#include <variant>

namespace dust::preflight {

/// A parameter of a body's shape by its name; null where the shape has none of this type.
template <class T>
const T* shape_parameter(const scenario::ModelChoice& shape, std::string_view name) {
  for (const bodies::ShapeKind& kind : bodies::shape_catalogue()) {
    if (kind.name != shape.name) continue;
    for (std::size_t n = 0; n < kind.parameters.size() && n < shape.values.size(); ++n) {
      if (kind.parameters[n].name == name) return std::get_if<T>(&shape.values[n]);
    }
  }
  return nullptr;
}

}  // namespace dust::preflight
