// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"

#include <map>
#include <memory>
#include <stdexcept>
#include <string>

namespace dust::test {

/// A shape of the catalogue with parameters by name; the others keep their defaults.
inline std::unique_ptr<bodies::Shape> make_shape(const std::string& name,
                                                 const std::map<std::string, sdk::Value>& values) {
  for (const auto& kind : bodies::shape_catalogue()) {
    if (kind.name != name) continue;
    std::vector<sdk::Value> row;
    for (const sdk::Parameter& p : kind.parameters) {
      const auto given = values.find(p.name);
      row.push_back(given == values.end() ? sdk::Value{} : given->second);
    }
    return kind.make(row);
  }
  throw std::runtime_error("no shape " + name);
}

}  // namespace dust::test
