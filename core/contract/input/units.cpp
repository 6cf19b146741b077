// SPDX-License-Identifier: Apache-2.0
#include "contract/input/units.hpp"

#include <cmath>

namespace dust::contract {

double Units::of(sdk::Dimension d) const {
  return std::pow(length, d.length) * std::pow(mass, d.mass) * std::pow(time, d.time);
}

std::vector<sdk::Value> in_units(const Units& units, const sdk::ParameterSchema& schema,
                                 std::span<const sdk::Value> values) {
  std::vector<sdk::Value> result(values.begin(), values.end());
  for (std::size_t n = 0; n < result.size(); ++n) {
    const double factor = units.of(schema[n].dimension);
    if (auto* number = std::get_if<double>(&result[n])) *number *= factor;
    if (auto* vector = std::get_if<sdk::Vec3>(&result[n])) *vector = factor * *vector;
    if (auto* numbers = std::get_if<std::vector<double>>(&result[n])) {
      for (double& number : *numbers) number *= factor;
    }
    if (auto* vectors = std::get_if<std::vector<sdk::Vec3>>(&result[n])) {
      for (sdk::Vec3& vector : *vectors) vector = factor * vector;
    }
  }
  return result;
}

const double* ModelUnderTest::number(const std::string& name) const {
  for (std::size_t n = 0; n < info.parameters.size(); ++n) {
    if (info.parameters[n].name == name) return std::get_if<double>(&values[n]);
  }
  return nullptr;
}

}  // namespace dust::contract
