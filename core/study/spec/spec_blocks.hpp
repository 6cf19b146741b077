// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/parameter_schema.hpp"

#include <cstdint>
#include <string>

/// What a study file declares key by key, as written; the reader and the JSON Schema follow it.
namespace dust::study {

struct GeneralBlock {
  std::string name;
  std::string title;
  std::string base;
  std::int64_t replicates = 1;
  std::int64_t seed = -1;
  static const sdk::ParameterSchema& schema();
};

/// A measure that is more than the name of a quantity.
struct MeasureBlock {
  std::string quantity;
  std::string minus;
  std::string unit;
  static const sdk::ParameterSchema& schema();
};

struct ExpectationBlock {
  std::string output;
  std::string input;
  std::string then;
  std::string from;
  std::string to;
  std::string why;
  static const sdk::ParameterSchema& schema();
};

}  // namespace dust::study
