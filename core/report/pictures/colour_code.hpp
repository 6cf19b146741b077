// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>

namespace dust::report {

/// Colours of the pages' pictures in a byte: 0 is nothing at all, 1 to 254 span the scale.
constexpr std::uint8_t k_masked = 255;  ///< of what lies inside a body
constexpr double k_decades = 4.0;       ///< of a logarithmic scale
constexpr double k_square_centimetre = 1e-4;

/// On a logarithmic scale that ends at `most`: 1 there, 0 where it begins, negative below that and
/// for nothing at all.
[[nodiscard]] double place_on_scale(double value, double most);

/// The byte of a place on a scale, of what lies beyond an end that of the end.
[[nodiscard]] std::uint8_t colour_code(double place);

}  // namespace dust::report
