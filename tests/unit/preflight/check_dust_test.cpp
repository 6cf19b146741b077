// SPDX-License-Identifier: Apache-2.0
// What `engine check` says of dust.
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cmath>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

using dust::test::approx;
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
  CHECK(outcome.out.find("set free by energy, but not in onto_belt_1\n") != std::string::npos);
  CHECK(outcome.out.find("caught by top\n") != std::string::npos);
}

TEST_CASE("a check shall say how much air a side drives, and which way") {
  const auto side = [](const std::string& flow, const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"check", k_plant,
                                       "--set", "dust.hoods=null",
                                       "--set", "domain.boundaries.top.air.flow=" + flow};
    arguments.insert(arguments.end(), more.begin(), more.end());
    const auto outcome = engine(arguments);
    REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
    const auto at = outcome.out.find("top: ");
    return outcome.out.substr(at, outcome.out.find('\n', at) - at);
  };
  CHECK(side("1800 m3/h").ends_with(", air: hood, 1800 m3/h out"));
  CHECK(side("-1800 m3/h").ends_with(", air: hood, 1800 m3/h in"));
  // Where it is largest, be that in between any times that are evenly spread.
  CHECK(side("1800 m3/h", {"--set", "domain.boundaries.top.air.times=[0.11, 0.12, 0.13 s]", "--set",
                           "domain.boundaries.top.air.factors=[0, 1, 0.2]"})
            .ends_with(", air: hood, 1800 m3/h out"));
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
          approx(share[n] * 500e3 / 3600.0).epsilon(1e-9));
  }
}

TEST_CASE("the dust of grains that come at once shall be told by the material of each") {
  const dust::test::TemporaryFolder folder;
  std::ofstream(folder / "grains.csv") << "diameter,x,y,z,material\n"
                                          "0.006,0.008,0.008,0.02,ore\n"
                                          "0.004,0.03,0.03,0.02,shale\n"
                                          "0.006,0.03,0.008,0.02,shale\n";
  std::ofstream(folder / "s.yaml")
      << "include: " DUST_SOURCE
         "/tests/scenario/dusty_bounce.yaml\n"
         "materials:\n"
         "  shale: {density: 2000, young_modulus: 20 MPa, poisson_ratio: 0.3, "
         "dust_load: [0.2 %, 0.3 %], moisture: 1 %}\n"
         "interactions:\n"
         "  - between: [ore, ore]\n"
         "    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.4}\n"
         "  - {between: [ore, steel], like: [ore, ore]}\n"
         "  - {between: [ore, shale], like: [ore, ore]}\n"
         "  - {between: [shale, shale], like: [ore, ore]}\n"
         "  - {between: [shale, steel], like: [ore, ore]}\n"
         "emitters:\n"
         "  bed: {model: file, material: ore, materials: [shale], file: grains.csv}\n";
  const auto outcome = engine({"check", folder / "s.yaml", "--json"});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  const Json dust = Json::parse(outcome.out)["dust"];
  const auto volume = [](double diameter) {
    return std::numbers::pi / 6.0 * std::pow(diameter, 3);
  };
  // With the grain of 6 mm that dusty_bounce drops.
  const double ore = 3000.0 * 2.0 * volume(6e-3);
  const double shale = 2000.0 * (volume(4e-3) + volume(6e-3));
  const Json& at_once = dust["brought_at_once_kg"];
  CHECK(at_once["ore"][0].get<double>() == approx(0.004 * ore).epsilon(1e-9));
  CHECK(at_once["ore"][1].get<double>() == approx(0.006 * ore).epsilon(1e-9));
  CHECK(at_once["shale"][0].get<double>() == approx(0.002 * shale).epsilon(1e-9));
  CHECK(at_once["shale"][1].get<double>() == approx(0.003 * shale).epsilon(1e-9));
  CHECK(dust["brought_kg_per_s"]["ore"] == Json({0.0, 0.0}));
  const auto text = engine({"check", folder / "s.yaml"});
  CHECK(text.out.find("ore carries 1 % of it (0.4, 0.6 %) at 1 % of moisture: 6.79 mg at once\n") !=
        std::string::npos);
}

TEST_CASE("a scenario without a dust field shall not be told of one") {
  const auto outcome = engine({"check", DUST_SOURCE "/scenarios/transfer_point.yaml"});
  REQUIRE_MESSAGE(outcome.status == 0, outcome.err);
  CHECK(outcome.out.find("\n  dust ") == std::string::npos);
}
