// SPDX-License-Identifier: Apache-2.0
#include "particles/store/balance_ledger.hpp"

#include "contract/memory_archive.hpp"

#include <doctest/doctest.h>

#include <cstdint>
#include <vector>

using dust::contract::MemoryArchive;
using dust::particles::BalanceLedger;

TEST_CASE("the most grains at a time shall be counted with and without their weights") {
  BalanceLedger ledger;
  const auto whole = ledger.population(1e-3, 1.0, 0, 1e-6);
  const auto copies = ledger.population(1e-5, 0.25, 0, 1e-12);
  for (int n = 0; n < 4; ++n) ledger.enter(copies);
  ledger.enter(whole);
  ledger.close();
  CHECK(ledger.balance().max == 5);
  CHECK(ledger.balance().real_max == 2.0);
  // More of those that count little: the one rises, the other does not.
  ledger.leave(whole);
  ledger.enter(copies);
  ledger.enter(copies);
  ledger.close();
  CHECK(ledger.balance().max == 6);
  CHECK(ledger.balance().real_in_domain == 1.5);
  CHECK(ledger.balance().real_max == 2.0);

  MemoryArchive archive;
  ledger.save(archive);
  BalanceLedger resumed;
  resumed.load(archive);
  CHECK(resumed.balance().max == 6);
  CHECK(resumed.balance().real_max == 2.0);
  CHECK(resumed.balance().real_in_domain == 1.5);

  BalanceLedger branch;
  const std::int32_t materials[] = {0};
  const double density[] = {2650.0};
  branch.transfer_from(resumed, materials, {}, density);
  CHECK(branch.balance().real_max == 2.0);
}

TEST_CASE("a ledger from before the largest real count was kept shall go on from what is there") {
  MemoryArchive before;
  before.numbers("population_numbers", std::vector<double>{1e-3, 0.5, 1e-6});
  before.integers("population_counts", std::vector<std::int64_t>{9, 0, 8, 6, 2, 0});
  BalanceLedger ledger;
  ledger.load(before);
  CHECK(ledger.balance().max == 9);
  CHECK(ledger.balance().real_max == 3.0);
}
