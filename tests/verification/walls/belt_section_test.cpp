// SPDX-License-Identifier: Apache-2.0
// The load of a troughed belt against the section that belts are designed by.
#include "support/approx.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <random>
#include <vector>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_pi = std::numbers::pi;
constexpr double k_inch = 0.0254;
constexpr double k_square_foot = 144 * k_inch * k_inch;

/// [m2] CEMA's section of a load on three rolls. Below the line between the load's edges the
/// trapezoid over the centre roll and both wings, as far as the load reaches up them; above it the
/// segment of a circle that meets that line at the surcharge angle.
/// @param centre  [m] of the belt on the centre roll
/// @param wing    [m] of the load along each wing
double cema_section(double centre, double wing, double trough, double surcharge) {
  const double width = centre + 2 * wing * std::cos(trough);
  const double lower = 0.5 * (centre + width) * wing * std::sin(trough);
  if (surcharge == 0.0) return lower;
  const double radius = 0.5 * width / std::sin(surcharge);
  return lower + 0.5 * radius * radius * (2 * surcharge - std::sin(2 * surcharge));
}

/// The same for a belt loaded to CEMA's edge distance 0.055 B + 0.9 in, its centre roll 0.371 B +
/// 0.25 in wide.
double cema_full_section(double belt, double trough, double surcharge) {
  const double centre = 0.371 * belt + 0.25 * k_inch;
  const double edge = 0.055 * belt + 0.9 * k_inch;
  return cema_section(centre, 0.5 * (belt - centre) - edge, trough, surcharge);
}

constexpr double k_belt = 0.5;
constexpr double k_centre = 0.19;
constexpr double k_trough = 35.0 * k_pi / 180.0;
constexpr double k_thickness = 0.01;
constexpr double k_speed = 1.5;
constexpr double k_grain = 0.014;  // diameter
constexpr double k_stretch = 0.1;  // of the belt, endless
constexpr double k_density = 2650;

/// Grains that fall on to a stretch of a belt at its middle and ride with it.
struct Load {
  DemRig rig;
  std::vector<GrainState> grains;
  double mass = 0.0;
  double flow = 0.0;  ///< [kg/s] through a plane that stands still

  explicit Load(int count) {
    const int stone = rig.material(k_density, 2e6, 0.3);
    rig.law(stone, stone, 0.3, 0.4, 0.05);
    rig.diameters = {k_grain};
    rig.setup.gravity = {0, 0, -k_g};
    rig.setup.domain.min = {0, -0.5, -0.5};
    rig.setup.domain.max = {k_stretch, 0.5, 1.5};
    rig.periodic(0);
    rig.setup.time.expected_speed = 3.0;
    dust::scenario::BodySpec spec;
    spec.name = "belt";
    spec.material = stone;
    spec.shape.kind = "shape";
    spec.shape.name = "belt_conveyor";
    const std::map<std::string, dust::sdk::Value> values{
        {"head", Vec3{6, 0, -0.3}}, {"tail", Vec3{-6, 0, -0.3}}, {"radius", 0.3 - k_thickness},
        {"thickness", k_thickness}, {"width", k_belt},           {"trough_angle", k_trough},
        {"centre_roll", k_centre},  {"bend_radius", 0.05}};
    for (const auto& kind : dust::bodies::shape_catalogue()) {
      if (kind.name != spec.shape.name) continue;
      for (const dust::sdk::Parameter& p : kind.parameters) {
        const auto given = values.find(p.name);
        spec.shape.values.push_back(given == values.end() ? dust::sdk::Value{} : given->second);
      }
    }
    rig.bodies.push_back(
        dust::bodies::make_body(rig.setup, spec, WallRig::motion("belt", {{"speed", k_speed}})));
    const auto dem = rig.make();
    std::vector<NewGrain> feed;
    std::mt19937 random(3);
    std::uniform_real_distribution<double> shift(-0.02 * k_grain, 0.02 * k_grain);
    constexpr int k_along = 6;
    constexpr int k_across = 14;
    for (int n = 0; n < count; ++n) {
      const double i = n % k_along;
      const double j = n / k_along % k_across;
      const double k = n / (k_along * k_across);
      feed.push_back({.position = {(i + 0.5) * k_stretch / k_along + shift(random),
                                   (j - 0.5 * (k_across - 1)) * 1.1 * k_grain + shift(random),
                                   0.05 + (k + 0.5) * 1.1 * k_grain + shift(random)},
                      .velocity = {0.8 * k_speed, 0, -0.5},
                      .diameter = k_grain});
    }
    dem->insert(feed);
    Stepper stepper(*dem);
    while (stepper.time() < 2.0) stepper.step(20);
    for (int n = 0; n < count; ++n) {
      grains.push_back(grain(*dem, n));
      mass += grains.back().mass;
      flow += grains.back().mass * grains.back().velocity.x / k_stretch;
    }
  }
  [[nodiscard]] double belt_at(double y) const {
    double z = 0.4;
    for (int n = 0; n < 80; ++n) z -= rig.bodies[0].shape->nearest({0.05, y, z}).distance;
    return z;
  }
  /// [m] Along x to a grain, the short way round.
  [[nodiscard]] static double apart(double x, double grain_x) {
    const double d = x - grain_x;
    return d - k_stretch * std::round(d / k_stretch);
  }
  /// Highest stone under a point, the belt where there is none: what a laser scan sees.
  [[nodiscard]] double scan(double x, double y, double belt) const {
    double top = belt;
    for (const GrainState& g : grains) {
      const double off = std::hypot(apart(x, g.position.x), y - g.position.y);
      if (off >= g.radius) continue;
      top = std::max(top, g.position.z + std::sqrt(g.radius * g.radius - off * off));
    }
    return top;
  }
  [[nodiscard]] bool is_stone(Vec3 p) const {
    return std::any_of(grains.begin(), grains.end(), [&](const GrainState& g) {
      return norm(Vec3{apart(p.x, g.position.x), p.y - g.position.y, p.z - g.position.z}) <
             g.radius;
    });
  }
};

/// Surface of a load, a mean along the belt, from edge to edge.
struct Profile {
  std::vector<double> y, top, belt;
  double left = 0.0, right = 0.0;  ///< where it meets the belt
};
Profile profile_of(const Load& load) {
  Profile p;
  constexpr double k_bin = 0.25 * k_grain;
  constexpr int k_lines = 20;
  for (double y = -0.24; y < 0.24; y += k_bin) {
    const double belt = load.belt_at(y);
    double top = 0.0;
    for (int n = 0; n < k_lines; ++n) {
      top += load.scan((n + 0.5) * k_stretch / k_lines, y, belt) / k_lines;
    }
    if (top - belt < 0.3 * k_grain) continue;  // beyond the edge but for single grains
    p.y.push_back(y);
    p.top.push_back(top);
    p.belt.push_back(belt);
  }
  p.left = p.y.front() - 0.5 * k_bin;
  p.right = p.y.back() + 0.5 * k_bin;
  return p;
}

/// [1/m] k of the parabola a - k y^2 nearest to a surface.
double curvature(const Profile& p) {
  const double middle = 0.5 * (p.left + p.right);
  double n = 0, s = 0, ss = 0, t = 0, st = 0;
  for (std::size_t i = 0; i < p.y.size(); ++i) {
    const double q = (p.y[i] - middle) * (p.y[i] - middle);
    n += 1;
    s += q;
    ss += q * q;
    t += p.top[i];
    st += q * p.top[i];
  }
  return -(n * st - s * t) / (n * ss - s * s);
}

/// Share of solids inside a load, a grain and a half from belt and surface.
double inner_solids(const Load& load, const Profile& p) {
  std::mt19937 random(7);
  std::uniform_real_distribution<double> unit(0.0, 1.0);
  int inside = 0;
  int stone = 0;
  while (inside < 20000) {
    const auto i = static_cast<std::size_t>(unit(random) * static_cast<double>(p.y.size()));
    const double z = p.belt[i] + unit(random) * 0.3;
    if (z < p.belt[i] + 1.5 * k_grain || z > p.top[i] - 1.5 * k_grain) continue;
    ++inside;
    stone += load.is_stone({unit(random) * k_stretch, p.y[i], z}) ? 1 : 0;
  }
  return static_cast<double>(stone) / inside;
}

}  // namespace

TEST_CASE("CEMA's section shall be that of its construction by hand") {
  // 36 in, 35 degrees: centre roll 13.606 in, load 8.317 in up each wing, so 27.232 in wide and
  // 4.770 in high: 97.4 in2. The circle of 20 degrees over it has 39.81 in radius: 43.9 in2.
  const double belt = 36 * k_inch;
  CHECK(cema_full_section(belt, k_trough, 0.0) / k_square_foot == approx(97.4 / 144).epsilon(1e-3));
  CHECK(cema_full_section(belt, k_trough, 20 * k_pi / 180) / k_square_foot ==
        approx((97.4 + 43.9) / 144).epsilon(1e-3));
}

TEST_CASE("a load on a moving troughed belt shall have CEMA's section at its width and surcharge") {
  for (const int count : {1000, 1400}) {
    CAPTURE(count);
    const Load load(count);
    const double expected_flow = load.mass / k_stretch * k_speed;
    CHECK(load.flow == approx(expected_flow).epsilon(0.01));  // it rides with the belt
    const Profile p = profile_of(load);
    const double width = p.right - p.left;
    CHECK(std::abs(p.left + p.right) < 2 * k_grain);
    // Nothing has gone over the edge.
    CHECK(0.5 * width < 0.5 * k_belt);
    REQUIRE(width > k_centre);
    const double surcharge = std::atan(curvature(p) * width);
    // As CEMA has it of its materials.
    CHECK(surcharge > 5 * k_pi / 180);
    CHECK(surcharge < 30 * k_pi / 180);
    const double wing = 0.5 * (width - k_centre) / std::cos(k_trough);
    const double section = cema_section(k_centre, wing, k_trough, surcharge);
    // What the conveyor's designer takes: flow over bulk density and speed.
    const double bulk_density = k_density * inner_solids(load, p);
    const double by_flow = load.flow / (bulk_density * k_speed);
    CHECK(bulk_density > 0.5 * k_density);
    CAPTURE(width);
    CAPTURE(surcharge * 180 / k_pi);
    CAPTURE(bulk_density);
    CHECK(by_flow == approx(section).epsilon(0.10));
    // And what a scan of the load measures.
    double scanned = 0.0;
    for (std::size_t i = 0; i < p.y.size(); ++i) {
      scanned += (p.top[i] - p.belt[i]) * width / static_cast<double>(p.y.size());
    }
    CHECK(scanned == approx(section).epsilon(0.10));
  }
}
