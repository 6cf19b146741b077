// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"

#include <span>
#include <string>
#include <vector>

namespace dust::contract {

/// A system of units: the number of a length in it is `length` times the number in metres.
struct Units {
  double length = 1.0;
  double mass = 1.0;
  double time = 1.0;

  /// Factor of a quantity of `dimension`.
  [[nodiscard]] double of(sdk::Dimension dimension) const;
};

/// Parameters as they are written in other units.
std::vector<sdk::Value> in_units(const Units& units, const sdk::ParameterSchema& schema,
                                 std::span<const sdk::Value> values);

/// What the rules of a kind may look up: the description and the values chosen.
struct ModelUnderTest {
  sdk::ModelInfo info;
  std::vector<sdk::Value> values;

  /// The number a parameter of that name has; nothing where there is no such parameter.
  [[nodiscard]] const double* number(const std::string& name) const;
};

}  // namespace dust::contract
