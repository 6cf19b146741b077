// SPDX-License-Identifier: Apache-2.0
#include "fluid/fluid_solver.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"
#include "verification/fluid/fluid_case.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace dust;
using test::World;

constexpr double k_side = 4e-3;      // of the periodic box [m]
constexpr double k_air_speed = 0.5;  // at the start [m/s]
constexpr double k_fluid_step = 1e-3;
constexpr int k_steps = 20;
constexpr int k_overlapped_steps = 150;
constexpr double k_pressure_tolerance = 1e-10;
constexpr double k_smallest_cfl = 0.1;  // a Courant number of 0.5 makes 5 sub-steps

/// Air and grains in a periodic box, coupled as a run couples them.
struct Cloud {
  explicit Cloud(bool overlaps = false) : Cloud(periodic_box(overlaps)) {}
  explicit Cloud(const World::Choice& choice, double largest_cfl = k_smallest_cfl,
                 const fluid::Boundaries& sides = {})
      : world(choice) {
    world.setup.fluid->largest_cfl = largest_cfl;
    world.setup.fluid->pressure_tolerance = k_pressure_tolerance;
    air = std::make_unique<fluid::FluidSolver>(world.grid, *world.setup.fluid, bodies, sides);
    air->set_velocity([](sdk::Vec3) { return sdk::Vec3{k_air_speed, 0, 0}; });
  }
  static World::Choice periodic_box(bool overlaps) {
    World::Choice choice;
    choice.overlaps = overlaps;
    choice.max = {k_side, k_side, k_side};
    choice.cells = {4, 4, 4};
    choice.periodic = {true, true, true};
    choice.fluid_step = k_fluid_step;
    return choice;
  }

  /// One fluid step in the order of a run; without `is_settled` the coupling takes the velocity at
  /// the end of the fluid step for what drag acted on.
  void step(bool is_settled) {
    coupling::Coupling& coupling = *world.coupling;
    const bool overlaps = world.choice.overlaps;
    if (overlaps && time == 0.0) hold_air();
    world.begin_step(k_fluid_step);
    air->advance(time, k_fluid_step, coupling.void_fraction_before(), coupling.void_fraction(),
                 coupling.exchange());
    time += k_fluid_step;
    if (!overlaps) {
      if (is_settled) world.evaluate(air->drag_velocity());
      hold_air();
    }
    const int refreshes = static_cast<int>(std::lround(k_fluid_step / coupling.refresh_interval()));
    for (int n = 0; n < refreshes; ++n) {
      world.refresh();
      world.grains.move(k_fluid_step / refreshes, {});
      if (collides) collide();
    }
    if (overlaps) {
      world.evaluate(air->drag_velocity());
      hold_air();
    }
    world.end_step();
  }
  void hold_air() {
    world.velocity = world.choice.overlaps ? air->mean_velocity() : air->velocity();
    world.stress = air->stress_divergence();
  }

  /// [N s] of the air: interstitial velocity times the mass of air in each face's volume.
  [[nodiscard]] sdk::Vec3 air_momentum() const {
    sdk::Vec3 sum;
    for (int d = 0; d < 3; ++d) {
      world.for_cells([&](int i, int j, int k) {
        sum[d] += test::k_air * world.face_void_fraction(d, i, j, k) * world.grid.cell_volume() *
                  air->velocity().component[d][world.grid.index(i, j, k)];
      });
    }
    return sum;
  }
  [[nodiscard]] sdk::Vec3 grain_momentum() const {
    sdk::Vec3 sum;
    for (std::size_t g = 0; g < world.grains.count(); ++g) {
      const double mass = world.grains.weight[g] / world.grains.velocity[4 * g + 3];
      for (int d = 0; d < 3; ++d) sum[d] += mass * world.grains.velocity[4 * g + d];
    }
    return sum;
  }
  /// Every grain hits another head on: what walls of none of them can give, momentum of the pair.
  void collide() {
    const std::size_t count = world.grains.count();
    const std::size_t shift = 1 + static_cast<std::size_t>(random.next() * (count - 1));
    for (std::size_t g = 0; g < count / 2; ++g) {
      const std::size_t other = (g + shift) % count;
      for (std::size_t d = 0; d < 3; ++d) {
        std::swap(world.grains.velocity[4 * g + d], world.grains.velocity[4 * other + d]);
      }
    }
  }
  /// [N s] that the next fluid step hands to the air: debts of grains and of cells, less what the
  /// air has received too much.
  [[nodiscard]] sdk::Vec3 on_the_way() {
    constexpr std::size_t k_saved = 13;  // numbers per grain in a checkpoint, the debt at 6
    test::MemoryArchive archive;
    world.coupling->save(archive);
    air->save(archive);
    const std::vector<double> numbers = archive.numbers("grains");
    sdk::Vec3 sum;
    for (std::size_t n = 0; n < numbers.size(); n += k_saved) {
      for (std::size_t d = 0; d < 3; ++d) sum[static_cast<int>(d)] += numbers[n + 6 + d];
    }
    const bool has_cells = world.choice.momentum_set != "III" && !world.choice.overlaps;
    for (int d = 0; d < 3; ++d) {
      const std::string axis(1, "xyz"[d]);
      const std::vector<double> excess = archive.numbers("excess_" + axis);
      const std::vector<double> deferred =
          has_cells ? archive.numbers("stress_owed_" + axis) : std::vector<double>(excess.size());
      world.for_cells([&](int i, int j, int k) {
        const auto c = static_cast<std::size_t>(world.grid.index(i, j, k));
        sum[d] += deferred[c] - excess[c] * world.grid.cell_volume();
      });
    }
    return sum;
  }

  World world;
  bodies::BodySet bodies;
  std::unique_ptr<fluid::FluidSolver> air;
  double time = 0.0;
  bool collides = false;
  test::Numbers random;
};

/// Largest drift of the momentum of air and grains over the run, relative to that at the start.
struct Drift {
  double largest = 0.0;
  double given_to_grains = 0.0;  ///< share of the momentum, to see that something was exchanged
  double most_given = 0.0;       ///< the largest share during the run
};
Drift drift_of(Cloud& cloud, bool is_settled, int steps = k_steps) {
  // The grains are there from the first step on: the air fills what they leave of the box.
  const double air = k_side * k_side * k_side - cloud.world.grains.solid_volume();
  const sdk::Vec3 start{test::k_air * air * k_air_speed, 0, 0};
  // As a run begins: their volume is not pushed out of the box in the first step.
  cloud.world.begin_step(k_fluid_step);
  Drift drift;
  for (int step = 0; step < steps; ++step) {
    cloud.step(is_settled);
    // Heavily loaded air comes to rest, which takes fewer.
    if (step == 0) REQUIRE(cloud.air->report().sub_steps > 1);
    const sdk::Vec3 now = cloud.air_momentum() + cloud.grain_momentum() + cloud.on_the_way();
    drift.largest = std::max(drift.largest, norm(now - start) / norm(start));
    drift.most_given = std::max(drift.most_given, norm(cloud.grain_momentum()) / norm(start));
  }
  drift.given_to_grains = cloud.grain_momentum().x / start.x;
  return drift;
}

/// Grains at rest on a regular lattice of 8 per cell: air and grains stay uniform.
void fill_regularly(World& world, double diameter, double solids) {
  constexpr int k_along = 8;
  constexpr double k_pitch = k_side / k_along;
  const double weight = solids * k_pitch * k_pitch * k_pitch / sdk::sphere_volume(diameter);
  for (int n = 0; n < k_along * k_along * k_along; ++n) {
    world.grains.add({(n % k_along + 0.5) * k_pitch, (n / k_along % k_along + 0.5) * k_pitch,
                      (n / k_along / k_along + 0.5) * k_pitch},
                     {}, diameter, test::k_sand, weight);
  }
}
void fill_at_random(World& world, double diameter, double solids) {
  constexpr int k_count = 600;
  const double weight =
      solids * k_side * k_side * k_side / (k_count * sdk::sphere_volume(diameter));
  test::Numbers random;
  for (int n = 0; n < k_count; ++n) {
    world.grains.add({k_side * random.next(), k_side * random.next(), k_side * random.next()}, {},
                     diameter, test::k_sand, weight);
  }
}

struct Load {
  double diameter;  // [m]
  double solids;    // share of the volume
};
// 0.2 and 22 kg of dust per kg of air, relaxation times of 0.2 and 7.4 fluid steps.
constexpr Load k_loads[] = {{5e-6, 1e-4}, {5e-6, 1e-2}, {3e-5, 1e-4}, {3e-5, 1e-2}};

TEST_CASE("momentum of air in sub-steps and uniform dust shall be conserved") {
  // The volumes of the divided grains add up to a uniform void fraction to 1e-9 only.
  constexpr double k_conserved = 1e-9;
  for (const Load& load : k_loads) {
    CAPTURE(load.diameter);
    CAPTURE(load.solids);
    Cloud settled;
    fill_regularly(settled.world, load.diameter, load.solids);
    const Drift drift = drift_of(settled, true);
    CHECK(drift.largest < k_conserved);
    const double grains = test::k_sand * load.solids;
    const double air = test::k_air * (1.0 - load.solids);
    CHECK(drift.given_to_grains == test::approx(grains / (grains + air)).epsilon(0.05));
    // The same where the grains move in the air of the step before while it is solved.
    Cloud overlapped(true);
    fill_regularly(overlapped.world, load.diameter, load.solids);
    // In the first step they are given what the air of the start would give, up to 22 times the
    // momentum there is; heavy dust of 5 um settles slowly after that.
    const Drift of_overlap = drift_of(overlapped, true, k_overlapped_steps);
    CHECK(of_overlap.largest < k_conserved * std::max(1.0, of_overlap.most_given));
    CHECK(of_overlap.given_to_grains == test::approx(grains / (grains + air)).epsilon(0.05));
    // With the velocity at the end of the fluid step for what drag acted on, momentum is made or
    // lost: 0.14, 0.15, 0.0027 and 0.88 of all there is.
    Cloud unsettled;
    fill_regularly(unsettled.world, load.diameter, load.solids);
    CHECK(drift_of(unsettled, false).largest > 1e-3);
  }
}

/// Sum of the magnitudes of what there is: the scale of what is exchanged.
double size_of(Cloud& cloud) {
  double size = norm(cloud.air_momentum());
  for (std::size_t g = 0; g < cloud.world.grains.count(); ++g) {
    const double* v = &cloud.world.grains.velocity[4 * g];
    size +=
        cloud.world.grains.weight[g] / v[3] * std::sqrt(v[0] * v[0] + v[1] * v[1] + v[2] * v[2]);
  }
  return size;
}

/// Over the momentum that air and grains have, each by its size: the largest drift per step of what
/// there is and what is on its way, and what is on its way at the end.
struct Kept {
  double drift = 0.0;
  double on_the_way = 0.0;
};
Kept kept_over(Cloud& cloud, int steps) {
  // They are there before; then a step that makes a flow of the initial velocity, which is none.
  cloud.world.begin_step(k_fluid_step);
  cloud.step(true);
  const sdk::Vec3 start = cloud.air_momentum() + cloud.grain_momentum() + cloud.on_the_way();
  double size = size_of(cloud);
  Kept kept;
  for (int step = 1; step <= steps; ++step) {
    cloud.step(true);
    size = std::max(size, size_of(cloud));
    const sdk::Vec3 late = cloud.on_the_way();
    const sdk::Vec3 now = cloud.air_momentum() + cloud.grain_momentum() + late;
    kept.drift = std::max(kept.drift, norm(now - start) / (size * step));
    kept.on_the_way = norm(late) / size;
  }
  return kept;
}

World::Choice scattered_box(const std::string& law, const std::string& rule,
                            const std::string& set) {
  World::Choice choice = Cloud::periodic_box(false);
  choice.max = {2 * k_side, 2 * k_side, 2 * k_side};  // cells of 2 mm
  choice.drag = law;
  choice.voidage = rule;
  choice.momentum_set = set;
  return choice;
}

/// A share of the volume in grains of weight 1, or in 300 of larger weight.
void scatter(World& world, double diameter, double solids) {
  constexpr int k_max = 300;
  const double side = world.choice.max.x;
  const double all = solids * side * side * side / sdk::sphere_volume(diameter);
  const int count = std::min(k_max, static_cast<int>(all));
  test::Numbers random;
  for (int n = 0; n < count; ++n) {
    world.grains.add({side * random.next(), side * random.next(), side * random.next()}, {},
                     diameter, test::k_sand, all / count);
  }
}

// What is on its way must not pile up there. Most of it is drag's difference of the last step.
constexpr double k_late = 2e-3;

TEST_CASE("momentum of air and scattered grains shall be conserved to rounding") {
  constexpr double k_rounding = 1e-10;
  constexpr int k_long = 100;  // [fluid steps]
  struct Grain {
    double diameter;
    std::vector<std::string> rules;
  };
  const Grain grains[] = {{2e-5, {"centre", "divided", "gaussian", "big_particle"}},
                          {3e-4, {"centre", "divided", "gaussian", "big_particle"}},
                          {1e-3, {"centre", "divided", "gaussian", "big_particle"}},
                          {3e-3, {"gaussian", "big_particle"}}};
  for (const Grain& grain : grains) {
    for (const std::string& rule : grain.rules) {
      for (const std::string set : {"I", "II", "III"}) {
        for (const bool collides : {false, true}) {
          CAPTURE(grain.diameter);
          CAPTURE(rule);
          CAPTURE(set);
          CAPTURE(collides);
          Cloud cloud(scattered_box("di_felice", rule, set), collides ? 1.0 : k_smallest_cfl);
          cloud.collides = collides;
          scatter(cloud.world, grain.diameter, 0.03);
          const Kept kept = kept_over(cloud, k_long);
          CHECK(kept.drift < k_rounding);
          CHECK(kept.on_the_way < k_late);
          CHECK(norm(cloud.grain_momentum()) > 0.01 * norm(cloud.air_momentum()));
        }
      }
    }
  }
}

TEST_CASE("momentum shall be conserved to rounding with every drag law, thin and dense") {
  constexpr double k_rounding = 1e-10;
  for (const std::string law : {"abraham", "beetstra", "di_felice", "ergun", "gidaspow",
                                "koch_hill", "schiller_naumann", "stokes", "wen_yu"}) {
    for (const double solids : {1e-3, 0.05, 0.3}) {
      CAPTURE(law);
      CAPTURE(solids);
      Cloud cloud(scattered_box(law, "divided", "I"), 0.5);
      scatter(cloud.world, 8e-4, solids);
      const Kept kept = kept_over(cloud, 50);
      CHECK(kept.drift < k_rounding);
      CHECK(kept.on_the_way < k_late);
    }
  }
}

TEST_CASE("momentum of air with eddies and scattered grains shall be conserved to rounding") {
  constexpr double k_rounding = 1e-10;
  const auto model = test::make_model<sdk::TurbulenceModel>("turbulence", "smagorinsky");
  for (const std::string set : {"I", "II", "III"}) {
    CAPTURE(set);
    Cloud cloud(scattered_box("di_felice", "divided", set));
    cloud.air->use(*model);
    scatter(cloud.world, 8e-4, 0.05);
    const Kept kept = kept_over(cloud, 50);
    const fluid::CellField& viscosity = *cloud.air->eddy_viscosity();
    CHECK(*std::max_element(viscosity.begin(), viscosity.end()) > 0.1 * test::k_air_viscosity);
    CHECK(kept.drift < k_rounding);
    CHECK(kept.on_the_way < k_late);
  }
}

TEST_CASE("momentum along slip sides shall be conserved, whichever axis these stand across") {
  constexpr double k_rounding = 1e-10;
  for (int across = 0; across < 3; ++across) {
    const int along = (across + 1) % 3;
    World::Choice choice = scattered_box("di_felice", "divided", "I");
    choice.periodic[static_cast<std::size_t>(across)] = false;
    const auto low = test::slip();
    const auto high = test::slip();
    fluid::Boundaries sides{};
    sides[static_cast<std::size_t>(2 * across)] = low.get();
    sides[static_cast<std::size_t>(2 * across + 1)] = high.get();
    Cloud cloud(choice, 0.5, sides);
    cloud.air->set_velocity([along](sdk::Vec3) {
      sdk::Vec3 v;
      v[along] = k_air_speed;
      return v;
    });
    scatter(cloud.world, 8e-4, 0.05);
    cloud.world.begin_step(k_fluid_step);
    cloud.step(true);
    const auto there = [&] {
      return (cloud.air_momentum() + cloud.grain_momentum() + cloud.on_the_way())[along];
    };
    const double start = there();
    for (int step = 0; step < 20; ++step) cloud.step(true);
    CAPTURE(across);
    CHECK(std::abs(there() - start) < 20 * k_rounding * size_of(cloud));
    CHECK(cloud.grain_momentum()[along] > 0.01 * start);
  }
}

TEST_CASE("momentum of air in sub-steps and scattered dust shall be conserved") {
  // At the start a uniform flow is none between scattered grains: its momentum is that of the flow
  // that the first step makes of it. Of the order of the square of the solids' share.
  constexpr double k_conserved = 0.01;
  for (const Load& load : k_loads) {
    CAPTURE(load.diameter);
    CAPTURE(load.solids);
    Cloud cloud;
    fill_at_random(cloud.world, load.diameter, load.solids);
    const Drift drift = drift_of(cloud, true);
    CHECK(drift.largest < k_conserved * load.solids * load.solids + 1e-9);
    CHECK(drift.given_to_grains > 0.1);
    Cloud overlapped(true);
    fill_at_random(overlapped.world, load.diameter, load.solids);
    // The pressure that the grains feel is that of the step before; at the start there is none.
    const Drift of_overlap = drift_of(overlapped, true, k_overlapped_steps);
    CHECK(of_overlap.largest < load.solids);
    CHECK(of_overlap.given_to_grains > 0.1);
  }
}

}  // namespace
