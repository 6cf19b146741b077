// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/parameter_schema.hpp>

#include <cmath>
#include <string>

namespace dust::model {

/// Declares the two parameters of binding_by_moisture(); `bound` is what is given at the reference
/// moisture.
template <class Parameters>
void add_moisture(sdk::SchemaOf<Parameters>& schema, const std::string& bound) {
  schema
      .number(&Parameters::reference_moisture, "reference_moisture", sdk::dimension::none,
              "Moisture of the material that the " + bound +
                  " is given for. By the power 1.4 a material without `moisture` counts as 0.25 %: "
                  "bound 7 times more weakly than at 1 %.")
      .symbol("M_0")
      .at_least(0)
      .at_most(1)
      .optional();
  schema
      .number(&Parameters::moisture_scale, "moisture_scale", sdk::dimension::none,
              "Moisture that binds ten times as strongly; 0: by the power 1.4 of the moisture as "
              "AP-42 has it, where less than 0.25 % counts as that.")
      .symbol("M_1")
      .at_least(0)
      .at_most(1)
      .optional();
}

/// How much stronger moisture binds dust than at the reference moisture, in [0, inf);
/// docs/theory/dust.md, eq. (10):
///   10^((M - M0) / M1)  for M1 > 0: a dust number that falls exponentially with moisture, as drum
///                       tests find (AS 4156.6, ISO 20905);
///   (max(M, Md) / max(M0, Md))^1.4  else, AP-42, 13.2.4 (2006), there for Md = 0.25 to 4.8 %.
/// M, M0, M1 [-] water over dry solids; in the second form M below `k_driest` counts as that, where
/// the fit ends.
inline double binding_by_moisture(double moisture, double reference, double scale) {
  constexpr double k_driest = 0.0025;
  if (scale > 0.0) return std::pow(10.0, (moisture - reference) / scale);
  return std::pow(std::fmax(moisture, k_driest) / std::fmax(reference, k_driest), 1.4);
}

}  // namespace dust::model
