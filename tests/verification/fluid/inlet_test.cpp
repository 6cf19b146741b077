// SPDX-License-Identifier: Apache-2.0
#include "contract/plugin_library.hpp"
#include "fluid_case.hpp"

#include "dust/sdk/error.hpp"
#include "support/approx.hpp"
#include "test_bodies.hpp"

#include <doctest/doctest.h>

#include <numeric>

using namespace dust;
using namespace dust::test;

namespace {

using Settings = std::map<std::string, sdk::Value>;

/// A boundary model of the plugins with these parameters, the rest at their defaults.
std::unique_ptr<sdk::BoundaryCondition> side_model(const std::string& name,
                                                   const Settings& settings) {
  const PluginLibrary library("boundary_" + name);
  const auto& offer = library.offers.at(0);
  std::vector<sdk::Value> values;
  for (const sdk::Parameter& p : offer.info.parameters) {
    const auto given = settings.find(p.name);
    values.push_back(given == settings.end() ? p.default_value : given->second);
  }
  return std::unique_ptr<sdk::BoundaryCondition>(
      static_cast<sdk::BoundaryCondition*>(offer.factory(values).release()));
}

/// A duct along z, slip at its four walls, with models of the plugins at its ends.
struct Duct {
  Vec3 max{0.02, 0.01, 0.04};
  std::array<int, 3> cells{4, 2, 8};
  scenario::FluidSpec fluid;
  std::unique_ptr<sdk::BoundaryCondition> bottom, top;
  std::array<std::unique_ptr<TestSide>, 4> walls{slip(), slip(), slip(), slip()};
  bodies::BodySet bodies;
  fluid::Grid grid;
  fluid::CellField eps;
  fluid::Exchange exchange;
  std::unique_ptr<fluid::FluidSolver> solver;
  double time = 0.0;

  Duct() {
    fluid.density = 1.2;
    fluid.viscosity = 1.8e-5;
    fluid.pressure_tolerance = 1e-11;
  }
  void start() {
    fluid.cells = cells;
    grid = fluid::Grid::make({}, max, cells, {false, false, false});
    eps.assign(grid.size, 1.0);
    exchange = {fluid::FaceField(grid), fluid::FaceField(grid)};
    fluid::Boundaries b{walls[0].get(), walls[1].get(), walls[2].get(),
                        walls[3].get(), bottom.get(),   top.get()};
    solver = std::make_unique<fluid::FluidSolver>(grid, fluid, bodies, b);
  }
  void advance(double step, int count = 1) {
    for (int n = 0; n < count; ++n) {
      solver->advance(time, step, eps, eps, exchange);
      time += step;
    }
  }
  [[nodiscard]] double u(int i, int j, int k) const {
    return solver->velocity().component[2][grid.index(i, j, k)];
  }
  [[nodiscard]] double face_eps(int i, int j, int k) const {
    const int low = std::max(k - 1, 0);
    const int high = std::min(k, cells[2] - 1);
    return 0.5 * (eps[grid.index(i, j, low)] + eps[grid.index(i, j, high)]);
  }
  /// [m3/s] through the faces of layer k.
  [[nodiscard]] double flow(int k) const {
    double sum = 0.0;
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) sum += u(i, j, k) * face_eps(i, j, k);
    }
    return sum * grid.spacing.x * grid.spacing.y;
  }
  void fill_lowest(double value) {
    for (int j = 0; j < cells[1]; ++j) {
      for (int i = 0; i < cells[0]; ++i) eps[grid.index(i, j, 0)] = value;
    }
  }
};

constexpr double k_exact = 1e-9;  // the pressure is solved to 1e-11
const Settings k_open{{"pressure", 0.0}};

}  // namespace

TEST_CASE("a given volume or mass flow shall pass, whatever grains lie on the side") {
  const double flow = 1e-4;
  for (const bool is_mass : {false, true}) {
    for (const double solids : {0.0, 0.55}) {
      Duct d;
      d.bottom = is_mass ? side_model("mass_flow", {{"flow", flow * d.fluid.density}})
                         : side_model("volume_flow", {{"flow", flow}});
      d.top = side_model("static_pressure", k_open);
      d.start();
      d.fill_lowest(1.0 - solids);
      d.advance(1e-3, 3);
      CHECK(d.flow(0) == test::approx(flow).epsilon(k_exact));
      CHECK(d.flow(d.cells[2]) == test::approx(flow).epsilon(k_exact));
    }
  }
}

TEST_CASE("a superficial speed shall be that over the void fraction, an interstitial one itself") {
  const double eps = 0.45;
  for (const bool is_superficial : {true, false}) {
    Duct d;
    d.bottom =
        side_model("velocity_inlet",
                   {{"speed", 0.2},
                    {"measure", std::string(is_superficial ? "superficial" : "interstitial")}});
    d.top = side_model("static_pressure", k_open);
    d.start();
    d.fill_lowest(eps);
    d.advance(1e-3, 3);
    CHECK(d.u(1, 1, 0) == test::approx(is_superficial ? 0.2 / eps : 0.2).epsilon(k_exact));
    CHECK(d.u(1, 1, d.cells[2]) == test::approx(is_superficial ? 0.2 : 0.2 * eps).epsilon(k_exact));
  }
}

TEST_CASE("a parabolic inlet shall have its mean speed at any number of cells") {
  for (const int n : {2, 5, 16}) {
    for (const bool is_both : {false, true}) {
      Duct d;
      d.cells = {n, 3, 4};
      d.bottom =
          side_model("velocity_inlet", {{"speed", 0.3},
                                        {"measure", std::string("interstitial")},
                                        {"profile", std::string("parabolic")},
                                        {"across", is_both ? std::vector<std::string>{"x", "y"}
                                                           : std::vector<std::string>{"x"}}});
      d.top = side_model("static_pressure", k_open);
      d.start();
      d.advance(1e-3);
      CHECK(d.flow(0) == test::approx(0.3 * d.max.x * d.max.y).epsilon(1e-12));
      if (is_both) continue;
      // Mean of 6 s (1 - s) over the first cell: (3 s^2 - 2 s^3) / s at s = 1 / n.
      const double s = 1.0 / n;
      CHECK(d.u(0, 1, 0) == test::approx(0.3 * (3 * s - 2 * s * s)).epsilon(1e-12));
    }
  }
}

TEST_CASE("a table over the side and factors over time shall be followed in straight lines") {
  Duct d;
  d.bottom = side_model("velocity_inlet", {{"speed", 0.5},
                                           {"measure", std::string("superficial")},
                                           {"profile", std::string("table")},
                                           {"across", std::vector<std::string>{"x"}},
                                           {"positions", std::vector<double>{0.0, 0.02}},
                                           {"shares", std::vector<double>{0.0, 2.0}},
                                           {"times", std::vector<double>{0.0, 0.01}},
                                           {"factors", std::vector<double>{1.0, 0.0}}});
  d.top = side_model("static_pressure", k_open);
  d.start();
  d.advance(1e-3, 4);  // 4 ms: factor 0.6
  for (int i = 0; i < 4; ++i) {
    const double x = (i + 0.5) * 0.005;
    CHECK(d.u(i, 0, 0) == test::approx(0.5 * 0.6 * 100 * x).epsilon(1e-12));
  }
  d.advance(1e-3, 8);
  CHECK(std::abs(d.flow(0)) < 1e-15);
}

TEST_CASE("a hood shall suck its flow through an opening that ends within cells") {
  const double flow = 5e-5;
  for (const int n : {4, 7}) {
    Duct d;
    d.cells = {n, 2, n};
    d.bottom = side_model("total_pressure", k_open);
    d.top = side_model(
        "hood",
        {{"flow", flow}, {"min", Vec3{0.006, 0.001, 0.04}}, {"max", Vec3{0.013, 0.01, 0.04}}});
    d.start();
    d.advance(1e-3, 3);
    CHECK(d.flow(n) == test::approx(flow).epsilon(k_exact));
    CHECK(d.flow(0) == test::approx(flow).epsilon(k_exact));
    CHECK(d.u(0, 0, n) == 0.0);  // ends before 6 mm
    // 6 to 10 mm is 0.8 of the second of 4 cells; the fourth of 7 lies wholly in the opening.
    const double covered = n == 4 ? 0.8 : 1.0;
    CHECK(d.u(n == 4 ? 1 : 3, 1, n) ==
          test::approx(covered * flow / (0.007 * 0.009)).epsilon(1e-9));
  }
}

TEST_CASE("a given flow shall pass what is open of its side now, not what was at the start") {
  const double flow = 1e-4;
  for (const std::string model : {"volume_flow", "mass_flow", "hood"}) {
    CAPTURE(model);
    Duct d;
    d.top = side_model("static_pressure", k_open);
    Settings settings{{"flow", flow}};
    if (model == "mass_flow") settings["flow"] = flow * d.fluid.density;
    if (model == "hood") {
      settings = {{"flow", -flow}, {"min", Vec3{0, 0, 0}}, {"max", Vec3{0.02, 0.01, 0}}};
    }
    d.bottom = side_model(model, settings);
    // Covers three of four faces, until it is taken away.
    d.bodies.push_back(body(std::make_unique<HalfSpace>(Vec3{0.015, 0, 0}, Vec3{1, 0, 0}), 0.0));
    d.start();
    d.advance(1e-3, 2);
    CHECK(0.25 * d.u(3, 0, 0) * 0.02 * 0.01 == test::approx(flow).epsilon(k_exact));
    d.bodies[0].removed_at = d.time;
    d.solver->bodies_changed(d.time);
    d.advance(1e-3, 2);
    CHECK(d.flow(0) == test::approx(flow).epsilon(k_exact));
    CHECK(d.flow(d.cells[2]) == test::approx(flow).epsilon(k_exact));
  }
}

TEST_CASE("static pressures shall accelerate a slug of air as Newton has it") {
  Duct d;
  // Slow enough for the convection of the first, impulsive step (u^2) to be nothing.
  d.bottom = side_model("static_pressure", {{"pressure", 3e-3}});
  d.top = side_model("static_pressure", k_open);
  d.start();
  d.advance(1e-3, 20);
  CHECK(d.u(2, 1, 4) == test::approx(3e-3 * 0.02 / (1.2 * 0.04)).epsilon(1e-5));
}

TEST_CASE("sides that contradict themselves shall be refused with the reason") {
  const auto refusal = [](const std::string& model, const Settings& settings) -> std::string {
    try {
      Duct d;
      d.bottom = side_model("total_pressure", k_open);
      d.top = side_model(model, settings);
      d.start();
      return "";
    } catch (const sdk::ParameterError& e) {
      return e.what();
    }
  };
  const std::string superficial = "superficial";
  CHECK(refusal("velocity_inlet",
                {{"speed", 1.0}, {"measure", superficial}, {"profile", std::string("parabolic")}})
            .find("needs across") != std::string::npos);
  CHECK(refusal("velocity_inlet", {{"speed", 1.0},
                                   {"measure", superficial},
                                   {"profile", std::string("parabolic")},
                                   {"across", std::vector<std::string>{"z"}}})
            .find("the normal of the side") != std::string::npos);
  CHECK(
      refusal("velocity_inlet",
              {{"speed", 1.0}, {"measure", superficial}, {"across", std::vector<std::string>{"x"}}})
          .find("varies across nothing") != std::string::npos);
  CHECK(refusal("volume_flow", {{"flow", 1e-4},
                                {"times", std::vector<double>{0.0, 1.0}},
                                {"factors", std::vector<double>{1.0}}})
            .find("differ in length") != std::string::npos);
  CHECK(refusal("volume_flow", {{"flow", 1e-4},
                                {"times", std::vector<double>{1.0, 0.0}},
                                {"factors", std::vector<double>{1.0, 2.0}}})
            .find("must grow") != std::string::npos);
  CHECK(refusal("hood", {{"flow", 1e-4}, {"min", Vec3{0, 0, 0}}, {"max", Vec3{0.03, 0.01, 0}}})
            .find("beyond the side along x") != std::string::npos);
  CHECK(refusal("hood", {{"flow", 1e-4}, {"min", Vec3{0.01, 0, 0}}, {"max", Vec3{0.01, 0.01, 0}}})
            .find("no width along x") != std::string::npos);
  // Along the normal of its side anything.
  CHECK(refusal("hood", {{"flow", 1e-4}, {"min", Vec3{0, 0, 0.35}}, {"max", Vec3{0.01, 0.01, 0}}})
            .empty());
}
