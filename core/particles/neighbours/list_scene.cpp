// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/list_scene.hpp"

#include <oneapi/tbb/blocked_range.h>
#include <oneapi/tbb/parallel_reduce.h>

#include <algorithm>
#include <functional>

namespace dust::particles {

RowPair ListScene::in_order(std::int32_t i, std::int32_t j) const {
  const bool is_lower =
      particles.id(static_cast<std::size_t>(i)) < particles.id(static_cast<std::size_t>(j));
  const std::int32_t a = is_lower ? i : j;
  const std::int32_t b = is_lower ? j : i;
  return tiling.is_coarse(a) && !tiling.is_coarse(b) ? RowPair{b, a} : RowPair{a, b};
}

double ListScene::fastest_speed() const {
  double walls = 0.0;
  for (const Surface& s : surfaces) {
    if (!s.is_removed()) walls = std::max(walls, s.displacing_speed);
  }
  const double square = oneapi::tbb::parallel_reduce(
      oneapi::tbb::blocked_range<std::size_t>(0, blocks()), walls * walls,
      [&](const oneapi::tbb::blocked_range<std::size_t>& range, double most) {
        const std::size_t end = std::min(particles.size(), range.end() * k_block);
        for (std::size_t n = range.begin() * k_block; n < end; ++n)
          most = std::max(most, speed2(n));
        return most;
      },
      [](double a, double b) { return std::max(a, b); });
  return std::sqrt(square);
}

double ListScene::typical_speed() const {
  const double squares = oneapi::tbb::parallel_deterministic_reduce(
      oneapi::tbb::blocked_range<std::size_t>(0, blocks()), 0.0,
      [&](const oneapi::tbb::blocked_range<std::size_t>& range, double sum) {
        const std::size_t end = std::min(particles.size(), range.end() * k_block);
        for (std::size_t n = range.begin() * k_block; n < end; ++n) sum += speed2(n);
        return sum;
      },
      std::plus<>());
  return std::sqrt(squares / static_cast<double>(std::max<std::size_t>(particles.size(), 1)));
}

}  // namespace dust::particles
