// SPDX-License-Identifier: Apache-2.0
// What `engine check` says of dust.
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <string>
#include <vector>

using dust::test::engine;
using Json = nlohmann::json;

namespace {

const std::string k_plant = DUST_SOURCE "/scenarios/plant/transfer_chute.yaml";

}  // namespace

TEST_CASE("a check shall say what dust the load carries, what sets it free and who catches it") {
  const auto outcome = engine({"check", k_plant});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  CHECK(outcome.out.find("  dust       a field of 2.5 um, 10 um, 30 um, 2650 kg/m3\n") !=
        std::string::npos);
  // 0.9 % of 500 t/h.
  CHECK(outcome.out.find("limestone carries 0.9 % of it (0.1, 0.3, 0.5 %) at 1 % of moisture: "
                         "4.5 t/h") != std::string::npos);
  CHECK(outcome.out.find("set free by energy\n") != std::string::npos);
  CHECK(outcome.out.find("caught by top\n") != std::string::npos);
}

TEST_CASE("the numbers of a check shall hold the flow of dust by class") {
  const auto outcome = engine(
      {"check", k_plant, "--json", "--set", "materials.limestone.dust_load=[0.2 %, 0.3 %, 0.6 %]"});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  const Json dust = Json::parse(outcome.out)["dust"];
  CHECK(dust["classes_m"] == Json({2.5e-6, 10e-6, 30e-6}));
  const std::vector<double> share{0.002, 0.003, 0.006};
  for (std::size_t n = 0; n < share.size(); ++n) {
    CHECK(dust["brought_kg_per_s"]["limestone"][n].get<double>() ==
          doctest::Approx(share[n] * 500e3 / 3600.0).epsilon(1e-9));
  }
}

TEST_CASE("a scenario without a dust field shall not be told of one") {
  const auto outcome = engine({"check", DUST_SOURCE "/scenarios/transfer_point.yaml"});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  CHECK(outcome.out.find("\n  dust ") == std::string::npos);
}
