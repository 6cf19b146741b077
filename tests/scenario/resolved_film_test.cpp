// SPDX-License-Identifier: Apache-2.0
// A resolved sphere comes near a floor: what the grid sees of the film and the film law add up.
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <nlohmann/json.hpp>

#include <cmath>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::engine;
using dust::test::read_file;
using dust::test::TemporaryFolder;

namespace {

constexpr double k_radius = 4e-3;
constexpr double k_stokes_speed = 120 * 9.81 * 2 * k_radius * k_radius / (9 * 0.2);

/// Time [s] from one gap [m] to a smaller one at the drag near a plane, lambda of the Stokes drag:
/// R / u_s times the integral of lambda over delta = gap / R, with
/// lambda = 1 + (7 delta + 2) / (6 delta^2 + 2 delta) (Bevan and Prieve 2000, within 1 % of Brenner
/// 1961): delta + ln delta + ln(3 delta + 1) / 6.
double closed_form(double from, double to) {
  const auto integral = [](double gap) {
    const double delta = gap / k_radius;
    return delta + std::log(delta) + std::log(3.0 * delta + 1.0) / 6.0;
  };
  return k_radius / k_stokes_speed * (integral(from) - integral(to));
}

/// Times [s] at which the gaps 0.6, 0.4, 0.2, 0.1 and 0.05 mm are passed; 0 where one is not.
std::vector<double> passages(const std::vector<std::string>& settings) {
  const TemporaryFolder folder;
  std::vector<std::string> arguments{"run", DUST_SOURCE "/tests/scenario/resolved_film.yaml", "-o",
                                     folder / "run", "--quiet"};
  arguments.insert(arguments.end(), settings.begin(), settings.end());
  const auto done = engine(arguments);
  INFO(done.err);
  REQUIRE(done.status == 0);
  const auto summary = nlohmann::json::parse(read_file(folder / "run/summary.json"));
  std::vector<double> times;
  for (const char* level : {"0_6", "0_4", "0_2", "0_1", "0_05"}) {
    times.push_back(
        summary["sensors"]["fall"][std::string("level_") + level + "_mm/time"]["value"]);
  }
  return times;
}

}  // namespace

TEST_CASE("V-FILM: a resolved sphere shall come near a floor in the time of Brenner's drag") {
  const auto with = passages({});
  MESSAGE("0.6 to 0.1 mm: " << (with[3] - with[0]) / closed_form(6e-4, 1e-4) << ", 0.4 to 0.05 mm: "
                            << (with[4] - with[1]) / closed_form(4e-4, 5e-5));
  CHECK(with[3] - with[0] == approx(closed_form(6e-4, 1e-4)).epsilon(0.12));
  CHECK(with[4] - with[1] == approx(closed_form(4e-4, 5e-5)).epsilon(0.12));
  // The grid alone lets it through the last film too fast.
  const auto without = passages({"--set", "interactions[1].cohesion.viscosity=1e-9 Pa s"});
  MESSAGE("without the film law, 0.1 to 0.05 mm: " << (without[4] - without[3]) /
                                                          closed_form(1e-4, 5e-5));
  CHECK(without[4] - without[3] < 0.5 * closed_form(1e-4, 5e-5));
  CHECK(with[4] - with[3] == approx(closed_form(1e-4, 5e-5)).epsilon(0.12));
}
