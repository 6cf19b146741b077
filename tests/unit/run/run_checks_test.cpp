// SPDX-License-Identifier: Apache-2.0
#include "run/run_checks.hpp"

#include "dust/sdk/error.hpp"
#include "run/body_removal.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <limits>
#include <string>

using dust::test::approx;

TEST_CASE("a grain whose position or velocity is not a number shall stop the run by its name") {
  const std::vector<std::int64_t> id{4, 7};
  std::vector<double> good{1.0, 2.0};
  std::vector<double> bad{1.0, std::numeric_limits<double>::quiet_NaN()};
  dust::sdk::GrainColumns columns;
  columns.id = id;
  for (auto* column : {&columns.x, &columns.y, &columns.z, &columns.velocity_x, &columns.velocity_y,
                       &columns.velocity_z, &columns.angular_velocity_x,
                       &columns.angular_velocity_y, &columns.angular_velocity_z}) {
    *column = good;
  }
  CHECK_NOTHROW(dust::run::check_finite(columns));
  for (auto* column : {&columns.x, &columns.velocity_z, &columns.angular_velocity_y}) {
    *column = bad;
    std::string message;
    try {
      dust::run::check_finite(columns);
    } catch (const dust::sdk::ModelError& error) {
      message = error.what();
    }
    CHECK(message.find("grain 7 has a position or velocity that is not a number") == 0);
    *column = good;
  }
}

TEST_CASE("overlaps beyond what contact laws hold for shall be told at the end with their causes") {
  dust::particles::DemReport report;
  const auto text = [&](double coarse, double fine) {
    report.largest_coarse_overlap = coarse;
    report.largest_fine_overlap = fine;
    return dust::run::overlap_warning(report, 0.5);
  };
  CHECK(text(0.29, 0.29) == "");
  CHECK(text(0.31, 2.0).starts_with("the largest overlap of grains is 0.31 of the radius"));
  CHECK(text(0.31, 0.0).find("is an MPa missing?") != std::string::npos);
  const std::string through = text(1.86, 0.0);
  CHECK(through.starts_with("grains went through each other or through walls"));
  CHECK(through.find("1.86 of the radius") != std::string::npos);
  CHECK(through.find("not to be trusted") != std::string::npos);
  CHECK(through.find("faster than time.expected_speed, 0.5 m/s") != std::string::npos);
  CHECK(text(0.1, 0.4).starts_with("fine grains were crushed between coarse ones"));
}

TEST_CASE("the mean kinetic energy shall be that of translation and of rotation") {
  dust::test::Grains grains;
  CHECK(dust::run::kinetic_energy_per_grain(grains.rows()) ==
        std::numeric_limits<double>::infinity());
  grains.add({0, 0, 0}, {3, 0, 4}, 2e-3);
  grains.add({0, 0, 0}, {0, 0, 0}, 2e-3);
  grains.rotation[4 + 1] = 500.0;
  const double mass = dust::test::k_sand * dust::sdk::sphere_volume(2e-3);
  const double inertia = 0.4 * mass * 1e-3 * 1e-3;
  const double moving = 0.5 * mass * 25.0;
  const double turning = 0.5 * inertia * 500.0 * 500.0;
  CHECK(dust::run::kinetic_energy_per_grain(grains.rows()) ==
        approx(0.5 * (moving + turning)).epsilon(1e-12));
  // Of real grains: one that stands for a tenth of one counts as that.
  grains.weight[1] = 0.1;
  CHECK(dust::run::kinetic_energy_per_grain(grains.rows()) ==
        approx((moving + 0.1 * turning) / 1.1).epsilon(1e-12));
}

TEST_CASE("a body shall go when its time has come or its grains have come to rest, not before") {
  dust::scenario::Setup setup;
  setup.time.fluid_step = 1e-3;
  setup.bodies.resize(2);
  setup.bodies[0].removal.emplace().at = 0.5;
  auto& by_energy = setup.bodies[1].removal.emplace();
  by_energy.kinetic_energy_per_grain = 1e-9;
  by_energy.after = 0.1;
  dust::bodies::BodySet bodies(2);
  dust::test::Grains still;
  still.add({0, 0, 0}, {0, 0, 0}, 2e-3);
  dust::test::Grains moving;
  moving.add({0, 0, 0}, {1, 0, 0}, 2e-3);

  CHECK_FALSE(dust::run::remove_bodies(setup, 0.05, still.rows(), bodies));  // before `after`
  CHECK_FALSE(dust::run::remove_bodies(setup, 0.2, moving.rows(), bodies));  // not at rest
  CHECK(dust::run::remove_bodies(setup, 0.2, still.rows(), bodies));
  CHECK(bodies[1].removed_at == 0.2);
  CHECK_FALSE(bodies[0].is_removed());
  CHECK_FALSE(dust::run::remove_bodies(setup, 0.3, still.rows(), bodies));    // gone already
  CHECK(dust::run::remove_bodies(setup, 0.5 - 1e-13, still.rows(), bodies));  // rounding
  CHECK(bodies[0].is_removed());
}

TEST_CASE("an account of energy that does not close shall be warned of with what is missing") {
  dust::particles::EnergyBalance balance;
  balance.gravity = 2.0;
  balance.lost_friction = 1.9;
  CHECK(dust::run::energy_warning(balance).empty());  // 0.1 J of 3.9
  balance.lost_normal = 1.0;
  const std::string more = dust::run::energy_warning(balance);
  CHECK(more.find("0.9 J, 18.4 % of all that was turned over, came out of nothing") !=
        std::string::npos);
  balance.lost_normal = 0.0;
  balance.lost_friction = 1.0;
  CHECK(dust::run::energy_warning(balance).find("went without a trace") != std::string::npos);
  CHECK(dust::run::energy_warning({}).empty());
}
