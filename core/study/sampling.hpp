// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <vector>

namespace dust::study {

/// Points in the unit cube, one vector of `dimensions` numbers in [0, 1) each.
using Sample = std::vector<std::vector<double>>;

/// Latin hypercube: every one of `count` equal intervals of every direction holds one point, at
/// random inside it (McKay, Beckman and Conover 1979, doi:10.1080/00401706.1979.10489755).
Sample latin_hypercube(std::size_t count, std::size_t dimensions, std::uint64_t seed);

/// Most directions of sobol().
inline constexpr std::size_t k_max_sobol_dimensions = 10;

/// First `count` points of the Sobol sequence with a random digital shift (direction numbers of Joe
/// and Kuo 2008, doi:10.1137/070709359). A longer sample begins with the shorter one, so that a
/// widened study keeps its runs. Balanced best where `count` is a power of two.
Sample sobol(std::size_t count, std::size_t dimensions, std::uint64_t seed);

}  // namespace dust::study
