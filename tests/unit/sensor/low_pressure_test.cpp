// SPDX-License-Identifier: Apache-2.0
#include "support/approx.hpp"
#include "unit/sensor/coverage.hpp"

#include <doctest/doctest.h>

using namespace dust;
using namespace dust::test;
using sdk::Vec3;

namespace {

const SensorKind& kind() {
  static const SensorKind loaded = load_sensor("low_pressure");
  return loaded;
}

struct Well {
  int i, j, k;
  double depth;
};

/// A sum of Gaussian wells 4 cells wide.
void dig(SyntheticScene& world, const std::vector<Well>& wells) {
  for (int k = 0; k < world.count[2]; ++k) {
    for (int j = 0; j < world.count[1]; ++j) {
      for (int i = 0; i < world.count[0]; ++i) {
        double p = 0.0;
        for (const Well& w : wells) {
          const double r2 = std::pow(i - w.i, 2) + std::pow(j - w.j, 2) + std::pow(k - w.k, 2);
          p -= w.depth * std::exp(-r2 / 32.0);
        }
        pressure_at(world, i, j, k) = static_cast<float>(p);
      }
    }
  }
}

/// The mean of 27 cells over a well of this shape: exp(-r2/32) averaged over -1, 0, 1 per
/// direction.
double smoothed_share() {
  const double per_direction = (1.0 + 2.0 * std::exp(-1.0 / 32.0)) / 3.0;
  return std::pow(per_direction, 3);
}

}  // namespace

TEST_CASE("wells of pressure shall be found in place, depth and order") {
  const auto sensor = kind().make({{"count", std::int64_t{3}}});
  SyntheticScene world;
  set_cells(world, 60, 20, 40);
  dig(world, {{12, 10, 20, 0.3}, {45, 10, 10, 0.5}});
  for (int s = 0; s < 100; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["found"] == 2.0);
  CHECK(figures["place_1/x"] == test::approx(0.0455).epsilon(1e-12));
  CHECK(figures["place_1/y"] == test::approx(0.0105).epsilon(1e-12));
  CHECK(figures["place_1/z"] == test::approx(0.0105).epsilon(1e-12));
  // Floats carry 7 digits.
  CHECK(figures["place_1/depth"] == test::approx(0.5 * smoothed_share()).epsilon(1e-6));
  CHECK(figures["place_1/pressure_over_density"] ==
        test::approx(-0.5 * smoothed_share() / 1.2).epsilon(1e-6));
  CHECK(figures["place_2/x"] == test::approx(0.0125).epsilon(1e-12));
  CHECK(figures["place_2/depth"] == test::approx(0.3 * smoothed_share()).epsilon(1e-6));
  CHECK(figures["place_3/depth"] == 0.0);
  CHECK(is_of_nothing(figures.at("place_3/x")));
  CHECK(figures.at("place_1/depth").uncertainty < 1e-9);
  CHECK(series_of(*sensor)["lowest_pressure"] == test::approx(-0.5).epsilon(1e-6));
}

TEST_CASE("solid cells and neighbours of deeper wells shall not be reported") {
  const auto sensor = kind().make({{"count", std::int64_t{5}}, {"separation", 0.015}});
  SyntheticScene world;
  set_cells(world, 60, 3, 40);
  // Fourteen cells of 1 mm from the deepest one, and a well inside a body.
  dig(world, {{20, 1, 20, 0.5}, {34, 1, 20, 0.4}});
  pressure_at(world, 50, 1, 30) = -9.0f;
  world.open_fraction[50 + 60 * (1 + 3 * 30)] = 0.0f;
  step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["found"] == 1.0);
  CHECK(figures["place_1/x"] == test::approx(0.0205).epsilon(1e-9));
  CHECK(series_of(*sensor)["lowest_pressure"] > -1.0);
  const auto nearer = kind().make({{"count", std::int64_t{5}}, {"separation", 0.005}});
  world.time = 0.0;
  step(*nearer, world);
  CHECK(summary_of(*nearer)["found"] == 2.0);
}

TEST_CASE("pressure before the averaging shall not count") {
  const auto sensor = kind().make({{"averaging_after", 0.05}});
  SyntheticScene world;
  set_cells(world, 20, 3, 20);
  dig(world, {{5, 1, 5, 9.0}});
  for (int s = 0; s < 50; ++s) step(*sensor, world);
  dig(world, {{14, 1, 14, 0.25}});
  for (int s = 0; s < 50; ++s) step(*sensor, world);
  const Figures figures = summary_of(*sensor);
  CHECK(figures["found"] == 1.0);
  CHECK(figures["place_1/x"] == test::approx(0.0145).epsilon(1e-9));
}

namespace {

/// The last cell of each row of tables.
struct LastCells final : sdk::ReportSink {
  std::vector<double> cells;
  void section(std::string_view, std::string_view) override {}
  void curve(std::string_view, std::string_view, std::string_view, std::string_view,
             std::span<const double>, std::span<const double>) override {}
  void row(std::string_view, std::span<const std::string>,
           std::span<const double> values) override {
    cells.push_back(values.back());
  }
};

}  // namespace

TEST_CASE("an error that is not known shall have no number in the report's table") {
  const auto sensor = kind().make({});
  SyntheticScene world;
  set_cells(world, 20, 3, 20);
  dig(world, {{5, 1, 5, 1.0}});
  for (int s = 0; s < 45; ++s) step(*sensor, world);  // two blocks of 20 ms
  LastCells rows;
  sensor->report(rows);
  REQUIRE(rows.cells.size() == 1);
  CHECK(std::isnan(rows.cells[0]));
}

TEST_CASE("the error of a depth shall cover the truth at its rate") {
  Coverage coverage;
  SyntheticScene world;
  set_cells(world, 9, 3, 9);
  for (int run = 0; run < k_runs; ++run) {
    Dice dice(run);
    const auto sensor = kind().make({{"count", std::int64_t{1}}});
    world.time = 0.0;
    for (int s = 0; s < 400; ++s) {
      // The whole well rises and falls: no cell overtakes another, so that the minimum stays put.
      dig(world, {{4, 1, 4, 1.0 + 0.3 * dice.normal()}});
      step(*sensor, world);
    }
    coverage.add(summary_of(*sensor).at("place_1/depth"), smoothed_share());
  }
  CHECK(coverage.without_error == 0);
  CHECK(coverage.one() > k_one_low);
  CHECK(coverage.one() < k_one_high);
  CHECK(coverage.two() > k_two_low);
}

TEST_CASE("a level flow shall have one place per eddy, at half its depth, however noisy the rows") {
  SyntheticScene world;
  set_cells(world, 60, 8, 40);
  // Two wells level along y, each with its own deepest row; noise of a tenth makes more minima.
  const auto dig_rows = [&world] {
    Dice dice(7);
    for (int k = 0; k < 40; ++k) {
      for (int j = 0; j < 8; ++j) {
        for (int i = 0; i < 60; ++i) {
          const double a = std::hypot(i - 12.0, k - 20.0), b = std::hypot(i - 45.0, k - 10.0);
          pressure_at(world, i, j, k) =
              static_cast<float>(-0.3 * std::exp(-a * a / 32.0) - 0.5 * std::exp(-b * b / 32.0) -
                                 0.05 * (j % 2 == 0 ? 1.0 : -1.0) *
                                     (0.5 + std::abs(dice.normal())) * (i % 5 == 0 ? 1.0 : 0.0));
        }
      }
    }
  };
  dig_rows();
  const auto level = kind().make({{"average_along", Vec3{0, 1, 0}}, {"count", std::int64_t{2}}});
  step(*level, world);
  const Figures figures = summary_of(*level);
  CHECK(figures["place_1/y"] == test::approx(0.5 * 8e-3).epsilon(1e-12));
  CHECK(figures["place_2/y"] == test::approx(0.5 * 8e-3).epsilon(1e-12));
  // One cell of 1 mm to either side for what noise is left.
  CHECK(std::abs(figures["place_1/x"] - 45.5e-3) < 1.1e-3);
  CHECK(std::abs(figures["place_2/x"] - 12.5e-3) < 1.1e-3);
  CHECK(figures["place_1/z"] == test::approx(10.5e-3).epsilon(0.11));

  // Without noise the depth is that of the well, smoothed over 3 x 3 rows.
  for (int k = 0; k < 40; ++k) {
    for (int j = 0; j < 8; ++j) {
      for (int i = 0; i < 60; ++i) {
        const double a = std::hypot(i - 12.0, k - 20.0);
        pressure_at(world, i, j, k) = static_cast<float>(-0.3 * std::exp(-a * a / 32.0));
      }
    }
  }
  const auto even = kind().make({{"average_along", Vec3{0, 1, 0}}, {"count", std::int64_t{1}}});
  step(*even, world);
  CHECK(summary_of(*even)["place_1/depth"] ==
        test::approx(0.3 * std::pow(smoothed_share(), 2.0 / 3.0)).epsilon(1e-6));
}

TEST_CASE("averaging along more than one axis shall be refused") {
  CHECK_THROWS(kind().make({{"average_along", Vec3{1, 1, 0}}}));
}

TEST_CASE("no place shall lie nearer than its clearance to a body") {
  SyntheticScene world;
  set_cells(world, 60, 3, 40);
  // The deeper well is 8 cells of 1 mm above a body whose uppermost cells are k = 9.
  dig(world, {{15, 1, 18, 0.5}, {45, 1, 30, 0.3}});
  for (int k = 0; k < 10; ++k) {
    for (int j = 0; j < 3; ++j) {
      for (int i = 0; i < 60; ++i) world.open_fraction[cell_at(world, i, j, k)] = 0.0f;
    }
  }
  const auto first_height = [&world](double clearance) {
    const auto sensor = kind().make({{"count", std::int64_t{5}}, {"clearance", clearance}});
    world.time = 0.0;
    step(*sensor, world);
    return summary_of(*sensor)["place_1/z"];
  };
  // Up to 8 mm the well itself; then the pressure still falls towards the body, and the place lies
  // at the edge of what is left.
  CHECK(first_height(0.0) == test::approx(18.5e-3));
  CHECK(first_height(8e-3) == test::approx(18.5e-3));
  CHECK(first_height(9e-3) == test::approx(19.5e-3));
  CHECK(first_height(11e-3) == test::approx(21.5e-3));
  // Far above the deeper well the other one is the deepest that is left.
  CHECK(first_height(18e-3) == test::approx(30.5e-3));
  // Less than a cell is a cell.
  CHECK(first_height(1e-5) == test::approx(18.5e-3));
}

TEST_CASE("a body that is gone before the averaging shall hide no place") {
  const auto sensor = kind().make({{"count", std::int64_t{1}}, {"averaging_after", 0.05}});
  SyntheticScene world;
  set_cells(world, 60, 20, 40);
  dig(world, {{12, 10, 20, 0.3}, {45, 10, 10, 0.5}});
  const auto set_gate = [&](float open) {
    for (int k = 4; k < 16; ++k) {
      for (int j = 0; j < 20; ++j) {
        for (int i = 38; i < 52; ++i) {
          world.open_fraction[static_cast<std::size_t>(i + 60 * (j + 20 * k))] = open;
        }
      }
    }
  };
  set_gate(0.0F);
  while (world.time < 0.02) step(*sensor, world);
  set_gate(1.0F);
  while (world.time < 0.2) step(*sensor, world);
  CHECK(summary_of(*sensor)["place_1/depth"] == test::approx(0.5 * smoothed_share()).epsilon(1e-6));
}

TEST_CASE("no place shall lie in the stream, judged by its mean solids fraction") {
  SyntheticScene world;
  set_cells(world, 60, 3, 40);
  dig(world, {{15, 1, 18, 0.5}, {45, 1, 30, 0.3}});
  const auto fill = [&world](float void_fraction) {
    for (int k = 0; k < 40; ++k) {
      for (int i = 13; i < 18; ++i) world.void_fraction[cell_at(world, i, 1, k)] = void_fraction;
    }
  };
  const auto first_x = [&](double limit) {
    const auto sensor = kind().make(
        {{"count", std::int64_t{1}}, {"clearance", 1e-3}, {"largest_solids_fraction", limit}});
    world.time = 0.0;
    // A tenth of the time 0.2 of solids: 0.02 in the mean.
    for (int s = 0; s < 50; ++s) {
      fill(s % 10 == 0 ? 0.8f : 1.0f);
      step(*sensor, world);
    }
    return summary_of(*sensor)["place_1/x"];
  };
  CHECK(first_x(0.021) == test::approx(15.5e-3));
  // The stream takes cells 13 to 17, its clearance one more on either side.
  const double beside = first_x(0.019);
  CHECK((beside == test::approx(11.5e-3) || beside == test::approx(19.5e-3)));
}

TEST_CASE("places shall lie in the box that was asked for, in rows by their middle") {
  SyntheticScene world;
  set_cells(world, 60, 4, 40);
  dig(world, {{15, 1, 18, 0.5}, {45, 1, 30, 0.3}});
  const Vec3 min{30e-3, 0, 0}, max{50e-3, 4e-3, 40e-3};
  const auto cells = kind().make({{"count", std::int64_t{1}}, {"min", min}, {"max", max}});
  step(*cells, world);
  CHECK(summary_of(*cells)["place_1/x"] == test::approx(45.5e-3));
  const auto rows = kind().make({{"count", std::int64_t{1}},
                                 {"average_along", Vec3{0, 1, 0}},
                                 {"min", Vec3{30e-3, 1e-3, 0}},
                                 {"max", max}});
  step(*rows, world);
  CHECK(summary_of(*rows)["place_1/x"] == test::approx(45.5e-3));
  CHECK_THROWS(kind().make({{"min", max}, {"max", min}}));
}

TEST_CASE("a body in a part of the depth shall take the whole row") {
  SyntheticScene world;
  set_cells(world, 60, 4, 40);
  dig(world, {{15, 1, 18, 0.5}, {45, 1, 30, 0.3}});
  world.open_fraction[cell_at(world, 15, 3, 18)] = 0.0f;
  const auto sensor = kind().make(
      {{"count", std::int64_t{1}}, {"average_along", Vec3{0, 1, 0}}, {"clearance", 20e-3}});
  step(*sensor, world);
  CHECK(summary_of(*sensor)["place_1/x"] == test::approx(45.5e-3));
}
