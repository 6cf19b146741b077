// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/random.hpp"
#include "particles/neighbours/contact_carrier.hpp"
#include "particles/neighbours/reference_trajectories.hpp"
#include "particles/neighbours/search.hpp"
#include "particles/store/row_order.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <numeric>
#include <random>
#include <vector>

using dust::test::approx;
using namespace dust::particles;

namespace {

constexpr std::size_t k_stride = 4;

PairList list_of(const std::vector<RowPair>& pairs, PartnerKind partners) {
  PairList list(partners);
  for (const RowPair& p : pairs) list.push(p[0], p[1]);
  return list;
}

/// History by which a contact is known again.
void push(ContactList& list, std::int32_t a, std::int32_t b, double mark,
          std::uint8_t touching = 1) {
  const double history[k_stride] = {mark, 2 * mark, 3 * mark, 4 * mark};
  list.push(a, b, history, touching);
}

}  // namespace

TEST_CASE("contacts shall keep their histories through any order of the rows") {
  constexpr std::int32_t k_rows = 40;
  std::mt19937 random(5);
  for (int trial = 0; trial < 20; ++trial) {
    std::vector<std::int32_t> order(k_rows);
    std::iota(order.begin(), order.end(), 0);
    std::shuffle(order.begin(), order.end(), random);
    std::vector<std::int32_t> new_row(k_rows);
    for (std::int32_t n = 0; n < k_rows; ++n)
      new_row[static_cast<std::size_t>(order[static_cast<std::size_t>(n)])] = n;

    // Pairs n, n + 7 touch, every third entry is apart; walls by number.
    ContactList pairs(PartnerKind::particles, k_stride);
    ContactList walls(PartnerKind::surfaces, k_stride);
    std::vector<RowPair> new_pairs;
    std::vector<RowPair> new_walls;
    for (std::int32_t n = 0; n + 7 < k_rows; ++n) {
      push(pairs, n, n + 7, n + 1.0, n % 3 == 0 ? 0 : 1);
      new_pairs.push_back(
          {new_row[static_cast<std::size_t>(n)], new_row[static_cast<std::size_t>(n) + 7]});
      push(walls, n, n % 4, 100.0 + n);
      new_walls.push_back({new_row[static_cast<std::size_t>(n)], n % 4});
    }
    std::shuffle(new_pairs.begin(), new_pairs.end(), random);
    ContactCarrier carrier(k_rows, k_stride);
    carrier.take(std::move(pairs));
    carrier.take(std::move(walls));
    carrier.arrange();
    carrier.renumber(order);

    ContactList found(PartnerKind::particles, k_stride);
    carrier.adopt(list_of(new_pairs, PartnerKind::particles), found);
    CHECK(found.size() == 22);  // of 33, without every third
    for (std::size_t q = 0; q < found.size(); ++q) {
      const std::int32_t n = order[static_cast<std::size_t>(found.a()[q])];
      CHECK(order[static_cast<std::size_t>(found.b()[q])] == n + 7);
      CHECK(n % 3 != 0);
      for (std::size_t h = 0; h < k_stride; ++h) {
        CHECK(found.history(q)[h] == static_cast<double>(h + 1) * (n + 1.0));
      }
    }
    ContactList at_walls(PartnerKind::surfaces, k_stride);
    carrier.adopt(list_of(new_walls, PartnerKind::surfaces), at_walls);
    CHECK(at_walls.size() == new_walls.size());
    for (std::size_t q = 0; q < at_walls.size(); ++q) {
      CHECK(at_walls.history(q)[0] == 100.0 + order[static_cast<std::size_t>(at_walls.a()[q])]);
    }
  }
}

TEST_CASE("particles that have just come shall have no contacts to carry") {
  ContactList pairs(PartnerKind::particles, k_stride);
  push(pairs, 0, 1, 1.0);
  ContactCarrier carrier(2, k_stride);
  carrier.take(std::move(pairs));
  carrier.arrange();
  const std::vector<std::int32_t> order{2, 1, 0};  // row 2 is new
  carrier.renumber(order);
  ContactList found(PartnerKind::particles, k_stride);
  carrier.adopt(list_of({{2, 1}, {0, 1}, {0, 2}}, PartnerKind::particles), found);
  REQUIRE(found.size() == 1);
  CHECK(found.a()[0] == 2);
  CHECK(found.b()[0] == 1);
}

TEST_CASE(
    "a row order shall hold every row once, coarse ones first, and neighbours near each other") {
  const dust::sdk::Random random(9, 1);
  constexpr std::size_t k_count = 4000;
  std::vector<double> position(4 * k_count);
  for (std::size_t n = 0; n < k_count; ++n) {
    for (std::size_t d = 0; d < 3; ++d) position[4 * n + d] = random.uniform(n, d);
    position[4 * n + 3] = n % 5 == 0 ? 0.001 : 0.01;
  }
  const RowOrder sorted = morton_order(position.data(), k_count, {0, 0, 0}, 0.02, 0.01);
  CHECK(sorted.coarse_count == k_count * 4 / 5);
  std::vector<std::int32_t> rows = sorted.order;
  std::sort(rows.begin(), rows.end());
  for (std::size_t n = 0; n < k_count; ++n) REQUIRE(rows[n] == static_cast<std::int32_t>(n));
  double apart = 0.0;
  for (std::size_t n = 0; n < k_count; ++n) {
    const auto row = static_cast<std::size_t>(sorted.order[n]);
    CHECK((position[4 * row + 3] == 0.01) == (n < sorted.coarse_count));
    if (n == 0 || n == sorted.coarse_count) continue;
    const auto last = static_cast<std::size_t>(sorted.order[n - 1]);
    apart += std::hypot(position[4 * row] - position[4 * last],
                        position[4 * row + 1] - position[4 * last + 1],
                        position[4 * row + 2] - position[4 * last + 2]);
  }
  // 0.66 in a random order; the mean distance of neighbours is 0.06.
  CHECK(apart / k_count < 0.15);
}

TEST_CASE("a particle on its reference trajectory shall ask for no new list, one off it shall") {
  ReferenceTrajectories trajectories;
  trajectories.resize(1);
  trajectories.set_skin(0, 1e-4);
  const double start[3] = {0.1, 0.2, 0.3};
  const double velocity[3] = {0.5, -0.25, 1.0};  // exact in single precision
  trajectories.restart(0, start, velocity);
  const double t = 1e-3;
  double p[3];
  for (int d = 0; d < 3; ++d) p[d] = start[d] + t * velocity[d];
  CHECK(trajectories.deviation(0, p, velocity, t, 1e-3).next2 < 1e-30);
  // 60 % of the skin off holds, 80 % does not; nor does 60 % with a speed that makes it 80 %.
  p[2] += 0.6e-4;
  CHECK_FALSE(trajectories.deviation(0, p, velocity, t, 0.0).asks_for_another(1e-4));
  const double faster[3] = {0.5, -0.25, 1.0 + 0.02};
  CHECK(trajectories.deviation(0, p, faster, t, 1e-3).asks_for_another(1e-4));
  p[2] += 0.2e-4;
  CHECK(trajectories.deviation(0, p, velocity, t, 0.0).asks_for_another(1e-4));
  // Set anew in the middle of the list's lifetime, it is on its trajectory again.
  trajectories.restart(0, p, faster, t);
  CHECK(trajectories.deviation(0, p, faster, t, 1e-3).next2 < 1e-20);
  CHECK(trajectories.position(0, t).z == approx(p[2]).epsilon(1e-12));
}
