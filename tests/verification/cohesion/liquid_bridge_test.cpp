// SPDX-License-Identifier: Apache-2.0
// A liquid bridge over its life: formed at touch, stretched, broken; through rebuilds and restarts.
#include "dust/sdk/random.hpp"
#include "support/approx.hpp"
#include "verification/cohesion/sticky.hpp"

#include <doctest/doctest.h>

#include <set>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using dust::test::approx;
using namespace dust::test;

namespace {

constexpr double k_tension = 0.072;
constexpr double k_angle = 0.35;
constexpr double k_volume = 5e-14;
const double k_r = Sticky::radius;
const double k_break = (1.0 + 0.5 * k_angle) * std::cbrt(k_volume);

DemRig::Choice wet() {
  return {"liquid_bridge",
          {{"surface_tension", k_tension}, {"contact_angle", k_angle}, {"volume", k_volume}}};
}
/// Two spheres of radius R: 2 pi R gamma cos(theta) / (1 + 1.05 s + 2.5 s^2), s = S sqrt(R / V).
double willett(double gap) {
  const double s = gap * std::sqrt(k_r / k_volume);
  return 2.0 * k_pi * k_r * k_tension * std::cos(k_angle) / (1.0 + 1.05 * s + 2.5 * s * s);
}

/// Two grains that part from touch, or from a gap they never closed.
struct Pair {
  std::unique_ptr<dust::particles::Dem> dem;
  std::unique_ptr<Stepper> stepper;
  explicit Pair(double first_gap, double speed = 0.5) {
    dem = make();
    const double x = k_r + 0.5 * first_gap;
    dem->insert(std::vector<NewGrain>{
        {.position = {x, 0, 0}, .velocity = {speed, 0, 0}, .diameter = 2 * k_r},
        {.position = {-x, 0, 0}, .velocity = {-speed, 0, 0}, .diameter = 2 * k_r}});
    stepper = std::make_unique<Stepper>(*dem);
  }
  static std::unique_ptr<dust::particles::Dem> make() {
    Sticky s(wet(), 0.9, 0.5);
    s.rig.setup.time.dem_step = 1e-7;
    return s.rig.make();
  }
  [[nodiscard]] double gap() const {
    return grain(*dem, 0).position.x - grain(*dem, 1).position.x - 2.0 * k_r;
  }
  /// Force on grain 0 in the coming step.
  double pull() {
    dem->neighbours();
    dem->contact(stepper->time());
    return force_on(0);
  }
  [[nodiscard]] double force_on(std::int64_t id) const {
    const auto rows = dem->rows();
    for (std::size_t n = 0; n < rows.count; ++n) {
      if (rows.id[n] == id) return dem->last_force()[4 * n];
    }
    return 0.0;
  }
};

}  // namespace

TEST_CASE("a bridge shall pull with the closed form of its gap and break at its distance") {
  Pair p(-1e-9);
  double broken_at = -1.0;
  int compared = 0;
  while (p.gap() < 1.5 * k_break) {
    const double gap = p.gap();
    const double pull = p.pull();
    if (gap > 0.0 && gap < k_break) {
      CHECK(-pull == approx(willett(gap)).epsilon(1e-9));
      ++compared;
    }
    if (gap > 0.0 && pull == 0.0 && broken_at < 0.0) broken_at = gap;
    p.stepper->step();
  }
  CHECK(compared > 100);
  // Within what one step opens.
  CHECK(broken_at >= k_break);
  CHECK(broken_at < k_break + 2.0 * 0.5 * 1e-7);
  // Broken for good, until they touch again.
  CHECK(p.pull() == 0.0);
}

TEST_CASE("moisture shall put the liquid of two grains into their bridges") {
  const auto wet_by = [](std::vector<double> moisture) {
    return std::move(
        Sticky({"liquid_bridge", {{"surface_tension", k_tension}, {"moisture", moisture}}}, 0.9,
               0.5)
            .rig.laws[0]
            .cohesion);
  };
  // By hand: 1 % of 2650 kg/m3 in six bridges is V = 2 (4 pi / 3) 0.0265 / 6 R^3 = 0.0370010 R^3
  // for two grains of radius R; they part at the cube root of it, 0.333225 R.
  CHECK(wet_by({0.01, 0.01})->range(0.5 * k_r) == approx(0.333225 * k_r).epsilon(1e-5));
  // At a wall a sixth of one grain's liquid: 0.0185005 R^3.
  CHECK(wet_by({0.01, 0.0})->range(k_r) == approx(0.264481 * k_r).epsilon(1e-5));
  CHECK(wet_by({0.0, 0.01})->range(k_r) == approx(0.264481 * k_r).epsilon(1e-5));
  // The force of that volume in a gap of R / 10: s = 0.1 / sqrt(0.0370010), 1.05 s + 2.5 s^2.
  const double s = 0.1 / std::sqrt(0.0370010);
  const double force = 2.0 * k_pi * k_r * k_tension / (1.0 + 1.05 * s + 2.5 * s * s);
  const double young = Sticky::young;
  CHECK(-force_at(*wet_by({0.01, 0.01}), 0.5 * k_r, young, -0.1 * k_r) ==
        approx(force).epsilon(1e-5));
  // Dry: the contact alone.
  const auto dry = wet_by({0.0, 0.0});
  CHECK(dry->range(k_r) == 0.0);
  CHECK(dry->resting_overlap(k_r) == 0.0);
  CHECK(force_at(*dry, k_r, young, 1e-7) == hertz(1e-7, k_r, young));
  CHECK(force_at(*dry, k_r, young, -1e-7) == 0.0);
}

TEST_CASE("grains that pass without touching shall not form a bridge") {
  Pair p(0.1 * k_break, -0.0);
  p.stepper->step(2000);
  CHECK(p.pull() == 0.0);
  CHECK(p.gap() == approx(0.1 * k_break).epsilon(1e-9));
}

TEST_CASE("a bridge shall outlive rebuilt lists and sorted rows") {
  Pair p(-1e-9);
  while (p.gap() < 0.3 * k_break) p.stepper->step();
  const auto rebuilds = p.dem->report().rebuilds;
  for (int n = 0; n < 6; ++n) {
    // Every insertion makes the lists new and sorts the rows.
    p.dem->insert(
        std::vector<NewGrain>{{.position = {0.1 * n - 0.3, 0.5, 0}, .diameter = 2 * k_r}});
    p.stepper->step(20);
  }
  CHECK(p.dem->report().rebuilds >= rebuilds + 6);
  REQUIRE(p.gap() < k_break);
  CHECK(-p.pull() == approx(willett(p.gap())).epsilon(1e-9));
}

TEST_CASE("a run resumed while a bridge is stretched shall go on with the same bits") {
  Pair p(-1e-9);
  while (p.gap() < 0.5 * k_break) p.stepper->step();
  MemoryArchive archive;
  p.dem->synchronise();
  p.dem->save(archive);
  auto resumed = Pair::make();
  resumed->load(archive);
  Stepper other(*resumed);
  p.stepper->step(100);
  other.step(100);
  REQUIRE(p.gap() < k_break);
  for (std::int64_t id : {0, 1}) {
    CHECK(norm(grain(*p.dem, id).position - grain(*resumed, id).position) == 0.0);
    CHECK(norm(grain(*p.dem, id).velocity - grain(*resumed, id).velocity) == 0.0);
  }
  CHECK(-p.pull() == approx(willett(p.gap())).epsilon(1e-9));
}

TEST_CASE("all pairs within the range of cohesion shall be in the neighbour lists") {
  Sticky s({"liquid_bridge", {{"surface_tension", k_tension}, {"volume", 1e-10}}}, 0.9, 0.5);
  const double range = s.rig.laws[0].cohesion->range(k_r);
  CHECK(range > 0.4 * 2.0 * k_r);  // beyond what the skin would list anyhow
  s.rig.diameters = {10e-6, 300e-6, 600e-6};
  s.rig.setup.domain.min = {0, 0, 0};
  s.rig.setup.domain.max = {6e-3, 6e-3, 6e-3};
  for (int d = 0; d < 3; ++d) s.rig.periodic(d);
  const dust::sdk::Random random(4, 4);
  std::vector<NewGrain> grains;
  for (std::uint64_t n = 0; n < 343; ++n) {
    const auto at = [&](std::uint64_t k, std::uint32_t d) {
      return 8.5e-4 * (static_cast<double>(k % 7) + 0.5 + 0.2 * (random.uniform(n, 0, d) - 0.5));
    };
    grains.push_back({.position = {at(n, 0), at(n / 7, 1), at(n / 49, 2)},
                      .diameter = n % 3 == 0   ? 10e-6
                                  : n % 3 == 1 ? 300e-6
                                               : 600e-6});
  }
  auto dem = s.rig.make();
  dem->insert(grains);
  dem->neighbours();
  const auto listed = dem->listed_pairs();
  const std::set<std::pair<std::int64_t, std::int64_t>> known(listed.begin(), listed.end());
  int near = 0;
  for (std::size_t i = 0; i < grains.size(); ++i) {
    for (std::size_t j = i + 1; j < grains.size(); ++j) {
      Vec3 d = grains[i].position - grains[j].position;
      for (int k = 0; k < 3; ++k) d[k] -= 6e-3 * std::round(d[k] / 6e-3);
      const double touch = 0.5 * (grains[i].diameter + grains[j].diameter);
      if (norm(d) >= touch + range) continue;
      ++near;
      CHECK(known.count({static_cast<std::int64_t>(i), static_cast<std::int64_t>(j)}) == 1);
    }
  }
  CHECK(near > 300);
}

TEST_CASE("wet dust shall leave wet sand alike with several rates and with one") {
  // The bridge of a 10 um grain on one of 600 um holds it, breaks, and costs the same work.
  std::vector<Vec3> out;
  for (const bool single : {true, false}) {
    DemRig rig;
    const int sand = rig.material(2650, 50e6, 0.3);
    rig.laws_of(sand, sand, {"hertz_mindlin", {{"restitution", 0.9}, {"friction", 0.4}}}, {},
                {"liquid_bridge", {{"surface_tension", 0.02}, {"relative_volume", 0.001}}});
    rig.diameters = {10e-6, 600e-6};
    rig.setup.time.rates_single = single;
    rig.setup.time.expected_speed = 3.0;
    auto dem = rig.make();
    dem->insert(std::vector<NewGrain>{
        {.position = {0, 0, 0}, .diameter = 600e-6},
        {.position = {3.1e-4, 0, 0}, .velocity = {-3.0, 0, 0}, .diameter = 10e-6}});
    Stepper stepper(*dem);
    while (stepper.time() < 2e-5) stepper.step();
    REQUIRE(dem->report().largest_overlap > 1e-3);
    out.push_back(grain(*dem, 1).velocity);
  }
  const double work_speed = 2.9 * 0.9;
  CHECK(out[0].x > 0.1);
  CHECK(out[0].x < work_speed);
  // Some 15 steps per contact in both.
  CHECK(std::abs(out[1].x - out[0].x) < 0.05 * 3.0);
}
