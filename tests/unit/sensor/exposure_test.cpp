// SPDX-License-Identifier: Apache-2.0
#include "contract/scenes/scene_columns.hpp"
#include "dust/sdk/airborne_dust.hpp"
#include "support/approx.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <functional>
#include <span>
#include <vector>

using namespace dust;
using namespace dust::test;
using sdk::Value;
using sdk::Vec3;

namespace {

/// Floats carry 7 digits.
constexpr double k_float = 1e-5;

/// 20 x 10 x 40 cells of 1 mm with dust of 1 and 20 um of the density at which diameters are
/// aerodynamic.
class DustyAir {
 public:
  DustyAir() {
    world_.domain_max = {0.02, 0.01, 0.04};
    set_cells(world_, 20, 10, 40);
    dust_.fill(world_.pressure);
  }
  void set(std::size_t n, const std::function<double(Vec3)>& c) {
    for_cells(world_, [&](std::size_t cell, Vec3 x) { dust_[n][cell] = static_cast<float>(c(x)); });
  }
  void show(sdk::Sensor& sensor) {
    world_.time += world_.interval;
    const contract::SceneColumns columns(world_, sensor);
    sensor.observe(columns.view());
    const std::array<double, 2> diameters = {1e-6, 20e-6};
    const std::array<std::span<const float>, 2> spans = {dust_[0], dust_[1]};
    dynamic_cast<sdk::DustObserver&>(sensor).observe_dust(columns.view(),
                                                          {diameters, 1000.0, spans});
  }

 private:
  SyntheticScene world_;
  std::array<std::vector<float>, 2> dust_;
};

}  // namespace

TEST_CASE("exposure shall be the dust at the point, by the shares of EN 481") {
  DustyAir air;
  air.set(0, [](Vec3 x) { return 1e-6 * (1.0 + 100.0 * x.x - 20.0 * x.z); });
  air.set(1, [](Vec3 x) { return 1e-6 * (2.0 + 50.0 * x.y); });
  const Vec3 point{0.0093, 0.0052, 0.0217};
  const auto sensor = load_sensor("exposure").make({{"points", std::vector<Vec3>{point}}});
  for (int s = 0; s < 20; ++s) air.show(*sensor);
  const double fine = 1.0 + 100.0 * point.x - 20.0 * point.z;  // mg/m3
  const double coarse = 2.0 + 50.0 * point.y;
  // By hand: E_I = (1 + exp(-0.06 D)) / 2; 20 um pass the thoracic cut at 11.64 um as a normal
  // variable exceeds ln(20 / 11.64) / ln 1.5 = 1.3351: 9.094 %; the respirable one at 3.8198:
  // 67e-6.
  const double inhalable_fine = 0.5 * (1.0 + std::exp(-0.06));
  const double inhalable_coarse = 0.5 * (1.0 + std::exp(-1.2));
  const Figures found = summary_of(*sensor);
  CHECK(found["point_1/dust"] == test::approx(fine + coarse).epsilon(k_float));
  CHECK(found["point_1/inhalable"] ==
        test::approx(inhalable_fine * fine + inhalable_coarse * coarse).epsilon(k_float));
  // 1 um: ln(11.64) / ln 1.5 = 6.05 and ln(4.25) / ln 1.5 = 3.57 deviations below the cuts.
  CHECK(found["point_1/thoracic"] ==
        test::approx(inhalable_fine * fine + 0.09094 * inhalable_coarse * coarse).epsilon(1e-4));
  CHECK(found["point_1/respirable"] ==
        test::approx((1.0 - 180e-6) * inhalable_fine * fine + 67e-6 * inhalable_coarse * coarse)
            .epsilon(1e-4));
}

TEST_CASE("exposure shall be a mean from steady_after on, and keep the highest of all") {
  DustyAir air;
  const auto sensor = load_sensor("exposure")
                          .make({{"points", std::vector<Vec3>{{0.01, 0.005, 0.02}}},
                                 {"steady_after", Value(0.0105)}});
  for (int s = 1; s <= 30; ++s) {
    // 5 mg/m3 at first, then 1 and 3 in turn.
    const double c = s <= 10 ? 5e-6 : s % 2 == 1 ? 1e-6 : 3e-6;
    air.set(0, [&](Vec3) { return c; });
    air.show(*sensor);
  }
  const Figures found = summary_of(*sensor);
  CHECK(found["point_1/dust"] == test::approx(2.0).epsilon(k_float));
  CHECK(found["point_1/highest_inhalable"] ==
        test::approx(5.0 * 0.5 * (1.0 + std::exp(-0.06))).epsilon(k_float));
}

TEST_CASE("exposure without a dust field shall be none") {
  SyntheticScene world;
  set_cells(world, 20, 10, 40);
  const auto sensor =
      load_sensor("exposure").make({{"points", std::vector<Vec3>{{0.01, 0.005, 0.02}}}});
  for (int s = 0; s < 5; ++s) {
    world.time += world.interval;
    sensor->observe(contract::SceneColumns(world, *sensor).view());
  }
  CHECK(summary_of(*sensor)["point_1/dust"] == 0.0);
  CHECK_THROWS(load_sensor("exposure").make({{"points", std::vector<Vec3>{}}}));
}
