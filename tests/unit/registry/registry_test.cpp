// SPDX-License-Identifier: Apache-2.0
#include "registry/registry.hpp"
#include "base/error.hpp"
#include "unit/scenario/fake_models.hpp"

#include <doctest/doctest.h>

#include <cstdlib>

using namespace dust;

TEST_CASE("entries shall be sorted by kind and name") {
  const auto registry = fake::registry();
  const auto& entries = registry->entries();
  REQUIRE(entries.size() > 2);
  for (std::size_t n = 1; n < entries.size(); ++n) {
    const auto& a = entries[n - 1].info;
    const auto& b = entries[n].info;
    CHECK((a.kind < b.kind || (a.kind == b.kind && a.name < b.name)));
  }
}

TEST_CASE("a model's refusal of its parameters shall name the place in the scenario") {
  const auto registry = fake::registry();
  const auto* entry = registry->find("emitter", "feed");
  REQUIRE(entry != nullptr);
  scenario::ModelChoice choice;
  choice.kind = "emitter";
  choice.name = "feed";
  choice.path = "emitters.feed";
  choice.where = {"s.yaml", 7, 12};
  for (const auto& p : entry->info.parameters) choice.values.push_back(p.default_value);
  choice.values[4] = std::vector<double>{1e-3};  // diameters, but no fractions
  try {
    static_cast<void>(registry->create(choice));
    FAIL("accepted");
  } catch (const base::UserError& problem) {
    CHECK(problem.lines() ==
          std::vector<std::string>{"s.yaml:7:12: error: emitters.feed: diameters and "
                                   "number_fractions differ in length"});
  }
}

TEST_CASE("the search path shall hold the command line's folders, then those of the environment") {
  ::setenv("DUST_PLUGIN_PATH", "/b::/c", 1);
  const auto folders = registry::Registry::search_path({"/a"});
  ::unsetenv("DUST_PLUGIN_PATH");
  REQUIRE(folders.size() >= 3);
  CHECK(folders[0] == "/a");
  CHECK(folders[1] == "/b");
  CHECK(folders[2] == "/c");
}
