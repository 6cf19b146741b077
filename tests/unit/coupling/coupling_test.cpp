// SPDX-License-Identifier: Apache-2.0
#include "coupling/stencils/lattice.hpp"
#include "dust/sdk/error.hpp"
#include "fluid/fluid_solver.hpp"
#include "particles/surfaces.hpp"
#include "support/approx.hpp"
#include "unit/coupling/world.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>
#include <tbb/global_control.h>

#include <numbers>
#include <numeric>
#include <type_traits>
#include <utility>

namespace {

using namespace dust;
using test::MemoryArchive;
using test::Numbers;
using test::World;

// Rounding of sums over a thousand grains and their faces.
constexpr double k_sum = 1e-12;
constexpr double k_step = 1e-3;

/// A smooth velocity in a box of 20 mm, with dust and sand scattered over part of it.
World::Choice box(bool with_body) {
  World::Choice choice;
  choice.max = {0.02, 0.02, 0.02};
  choice.cells = {14, 12, 13};
  if (with_body) {
    choice.open = [](int i, int, int k) {
      return k < 4 && i > 6 ? 0.0 : k == 4 && i > 6 ? 0.6 : 1.0;
    };
  }
  return choice;
}
sdk::Vec3 swirl(sdk::Vec3 p) {
  return {0.8 + std::sin(300 * p.z), 0.3 * std::cos(200 * p.x), -0.5 + std::sin(150 * p.y)};
}
/// High enough over the body not to fall into it in a few steps.
void scatter(World& world, int count) {
  Numbers random;
  for (int g = 0; g < count; ++g) {
    const bool is_dust = g % 3 == 0;
    world.grains.add({random.between(0.002, 0.018), random.between(0.002, 0.018),
                      random.between(0.0135, 0.0195)},
                     {random.between(-1, 1), random.between(-1, 1), random.between(-1, 1)},
                     is_dust ? 1e-5 : random.between(3e-4, 6e-4), test::k_sand,
                     is_dust ? 0.05 : 1.0);
  }
}

/// The ways of coupling that must all keep what is conserved.
struct Way {
  bool with_body = false;
  bool corrects = false;    ///< the grains' own disturbance
  bool with_large = false;  ///< grains larger than a cell among them
};
constexpr Way k_ways[] = {{false, false, false},
                          {true, false, false},
                          {true, true, false},
                          {false, false, true},
                          {true, true, true}};
World::Choice box(const Way& way) {
  World::Choice choice = box(way.with_body);
  if (way.corrects) choice.disturbance_correction = scenario::DisturbanceCorrection::taken_off;
  if (way.with_large) choice.voidage = "big_particle";
  return choice;
}
void scatter(World& world, const Way& way) {
  scatter(world, 900);
  if (!way.with_large) return;
  for (int g = 0; g < 4; ++g) {
    world.grains.add({0.0045 + 0.0035 * g, 0.01, 0.016}, {0.1 * g, 0, -0.2}, 3e-3, test::k_sand);
  }
}

/// One fluid step with the grains in free flight, refreshed as often as asked for.
void advance(World& world, sdk::Vec3 gravity = {0, 0, -9.81}) {
  const int refreshes = static_cast<int>(std::lround(k_step / world.coupling->refresh_interval()));
  for (int n = 0; n < refreshes; ++n) {
    world.refresh();
    world.grains.move(k_step / refreshes, gravity);
  }
}

TEST_CASE("the force on the fluid shall be opposite to that on the grains in each exchange") {
  for (const Way& way : k_ways) {
    World world(box(way));
    world.set(world.velocity, swirl);
    scatter(world, way);
    world.begin_step(k_step);
    world.refresh();
    CHECK(world.coupling->report().largest_imbalance > 0.0);
    CHECK(world.coupling->report().largest_imbalance < k_sum);
    CHECK(world.coupling->report().unpaired_forces == 0);
  }
}

TEST_CASE("the sums over time of what grains received and the fluid got shall be opposite") {
  for (const Way& way : k_ways) {
    World world(box(way));
    world.set(world.velocity, swirl);
    // A pressure gradient acts on the grains too; its part is not drag and must not be exchanged.
    const sdk::Vec3 gradient{300, 0, 900};
    world.set(world.stress, [&](sdk::Vec3) { return gradient; });
    scatter(world, way);
    sdk::Vec3 on_grains;
    sdk::Vec3 on_fluid;
    double scale = 0.0;
    // Of the pressure gradient the fluid leaves to the grains what they take up in the cells;
    // grains that cross cells take up another part, and the difference is exchanged, too.
    const auto deferred_in_cells = [&] {
      MemoryArchive archive;
      world.coupling->save(archive);
      sdk::Vec3 sum;
      for (int d = 0; d < 3; ++d) {
        for (const double deferred : archive.numbers(std::string("stress_owed_") + "xyz"[d])) {
          sum[d] += deferred;
        }
      }
      return sum;
    };
    const auto left_to_grains = [&] {
      sdk::Vec3 sum;
      for (int d = 0; d < 3; ++d) {
        world.for_cells([&](int i, int j, int k) {
          const std::ptrdiff_t c = world.grid.index(i, j, k);
          const int at = std::array{i, j, k}[static_cast<std::size_t>(d)];
          const double part = at == 0 || at == world.grid.count[d] - 1 ? 0.5 : 1.0;
          sum[d] += k_step * part * gradient[d] * world.open[c] * world.grid.cell_volume() *
                    (1.0 - world.coupling->void_fraction()[c]);
        });
      }
      return sum;
    };
    const auto give = [&] {
      const sdk::Vec3 force = world.force_on_fluid();
      on_fluid += k_step * force;
      scale += k_step * norm(force);
    };
    for (int step = 0; step < 4; ++step) {
      world.begin_step(k_step);
      give();
      on_grains -= left_to_grains();
      advance(world, {0, 0, -9.81});
      for (std::size_t g = 0; g < world.grains.count(); ++g) {
        for (int d = 0; d < 3; ++d) {
          on_grains[d] += world.grains.weight[g] * world.grains.impulse[4 * g + d];
        }
      }
      world.end_step();
      // Rows may be in any order, and grains leave.
      world.grains.swap(3, 500);
      world.grains.swap(20, 21);
      world.grains.remove_last();
    }
    // What the exchange of a step leaves over is paid in the next: with the last grain gone, all.
    static_cast<void>(world.coupling->begin_step({}, k_step));
    give();
    REQUIRE(scale > 0.0);
    CHECK(norm(on_grains + on_fluid + deferred_in_cells()) < k_sum * scale);
    CHECK(norm(on_grains) > 1e-3 * scale);
    CHECK(world.coupling->report().unpaired_forces == 0);
  }
}

TEST_CASE("rows reordered between map and refresh shall change nothing for any grain") {
  std::array<World, 2> worlds{World(box(true)), World(box(true))};
  for (World& w : worlds) {
    w.set(w.velocity, swirl);
    scatter(w, 600);
    for (int step = 0; step < 2; ++step) {
      w.begin_step(k_step);
      if (step == 1 && &w == &worlds[1]) {
        w.grains.swap(3, 500);
        w.grains.swap(20, 21);
      }
      advance(w);
      w.end_step();
    }
  }
  worlds[1].grains.swap(20, 21);
  worlds[1].grains.swap(3, 500);
  CHECK(worlds[0].grains.velocity == worlds[1].grains.velocity);
  for (World& w : worlds) w.begin_step(k_step);
  // Debts are carried by the grains that have them: the sums differ by their order alone.
  for (int d = 0; d < 3; ++d) {
    CHECK(worlds[0].force_on_fluid()[d] ==
          test::approx(worlds[1].force_on_fluid()[d]).epsilon(1e-12));
  }
}

/// What is owed to the fluid for the stress, per component and cell.
std::array<std::vector<double>, 3> stress_residuals(const World& world) {
  MemoryArchive archive;
  world.coupling->save(archive);
  std::array<std::vector<double>, 3> deferred;
  for (std::size_t d = 0; d < 3; ++d) {
    deferred[d] = archive.numbers(std::string("stress_owed_") + "xyz"[d]);
  }
  return deferred;
}

TEST_CASE(
    "stress shall be booked in the cells that grains were in, whatever became of their rows") {
  // As they were; reordered after the last refresh; reordered before it, and after it once more;
  // one of them gone.
  enum class Fate { none, after, twice, gone };
  const auto residuals_after = [](Fate fate) {
    World world(box(false));
    world.set(world.velocity, swirl);
    world.set(world.stress, [](sdk::Vec3 p) { return 1e5 * sdk::Vec3{p.x, p.y * p.z, p.z}; });
    scatter(world, 600);
    world.begin_step(k_step);
    if (fate == Fate::twice) world.grains.swap(7, 431);
    advance(world);
    if (fate == Fate::after || fate == Fate::twice) {
      world.grains.swap(3, 500);
      world.grains.swap(20, 21);
    }
    if (fate == Fate::gone) world.grains.remove_last();
    world.end_step();
    return stress_residuals(world);
  };
  const auto plain = residuals_after(Fate::none);
  double scale = 0.0;
  for (const auto& component : plain) {
    for (const double deferred : component) scale = std::max(scale, std::abs(deferred));
  }
  REQUIRE(scale > 0.0);
  for (const Fate fate : {Fate::after, Fate::twice, Fate::gone}) {
    const auto deferred = residuals_after(fate);
    for (std::size_t d = 0; d < 3; ++d) {
      int others = 0;
      for (std::size_t cell = 0; cell < deferred[d].size(); ++cell) {
        others += std::abs(deferred[d][cell] - plain[d][cell]) > k_sum * scale ? 1 : 0;
      }
      // What the one that is gone took along is missing in the cell that it was in.
      CHECK(others == (fate == Fate::gone ? 1 : 0));
    }
  }
}

TEST_CASE("a stream that moves with the grains shall neither drag them nor feel them") {
  World world(box(false));
  const sdk::Vec3 speed{0.8, -0.1, 0.4};
  world.set(world.velocity, [&](sdk::Vec3) { return speed; });
  scatter(world, 600);
  for (std::size_t g = 0; g < world.grains.count(); ++g) {
    for (int d = 0; d < 3; ++d) world.grains.velocity[4 * g + d] = speed[d];
  }
  world.begin_step(k_step);
  CHECK(world.coupling->report().smallest_void_fraction < 0.95);
  world.refresh();
  for (std::size_t g = 0; g < world.grains.count(); ++g) {
    for (int d = 0; d < 3; ++d) {
      REQUIRE(world.grains.action[4 * g + d] == test::approx(speed[d]).epsilon(1e-14));
    }
  }
  for (int d = 0; d < 3; ++d) {
    double largest = 0.0;
    double scale = 0.0;
    for (std::size_t f = 0; f < world.grid.size; ++f) {
      const double source = world.coupling->exchange().source.component[d][f];
      largest = std::max(
          largest,
          std::abs(source - world.coupling->exchange().coefficient.component[d][f] * speed[d]));
      scale = std::max(scale, std::abs(source));
    }
    CHECK(scale > 0.0);
    CHECK(largest < 1e-13 * scale);
  }
}

TEST_CASE("k grains of weight 1/k at one place shall act as one grain") {
  constexpr int k_copies = 20;
  World one(box(true));
  World many(box(true));
  for (World* world : {&one, &many}) {
    world->set(world->velocity, swirl);
    const int copies = world == &one ? 1 : k_copies;
    Numbers random;
    for (int g = 0; g < 50; ++g) {
      const sdk::Vec3 place{random.between(0, 0.02), random.between(0, 0.02),
                            random.between(0.008, 0.02)};
      for (int n = 0; n < copies; ++n) {
        world->grains.add(place, {0.1, 0.2, -0.5}, 2e-4, test::k_sand, 1.0 / copies);
      }
    }
    for (int step = 0; step < 2; ++step) {
      world->begin_step(k_step);
      advance(*world);
      world->end_step();
    }
    world->begin_step(k_step);
  }
  for (int d = 0; d < 3; ++d) {
    double scale = 0.0;
    double largest = 0.0;
    for (std::size_t f = 0; f < one.grid.size; ++f) {
      const double a = one.coupling->exchange().source.component[d][f];
      const double b = many.coupling->exchange().source.component[d][f];
      scale = std::max(scale, std::abs(a));
      largest = std::max(largest, std::abs(a - b));
    }
    CHECK(scale > 0.0);
    CHECK(largest < 1e-11 * scale);  // sums of 20 terms in another order, twice fed back
  }
  for (int d = 0; d < 3; ++d) {
    CHECK(one.grains.velocity[d] == test::approx(many.grains.velocity[d]).epsilon(k_sum));
  }
}

struct Bits {
  fluid::CellField eps;
  std::array<std::vector<double>, 6> fields;
  std::vector<double> position, velocity;
  bool operator==(const Bits&) const = default;
};
Bits bits_of(const World& world) {
  Bits b;
  b.eps = world.coupling->void_fraction();
  for (std::size_t d = 0; d < 3; ++d) {
    b.fields[d] = world.coupling->exchange().coefficient.component[d];
    b.fields[d + 3] = world.coupling->exchange().source.component[d];
  }
  b.position = world.grains.position;
  b.velocity = world.grains.velocity;
  return b;
}

TEST_CASE("one and two threads shall give the same bits") {
  std::array<Bits, 2> results;
  for (const std::size_t threads : {1, 2}) {
    const tbb::global_control limit(tbb::global_control::max_allowed_parallelism, threads);
    World::Choice choice = box(true);
    choice.disturbance_correction = scenario::DisturbanceCorrection::taken_off;
    World world(choice);
    world.set(world.velocity, swirl);
    scatter(world, 5000);
    for (int step = 0; step < 2; ++step) {
      world.begin_step(k_step);
      advance(world);
      world.end_step();
    }
    world.begin_step(k_step);
    results[threads - 1] = bits_of(world);
  }
  CHECK(results[0] == results[1]);
}

TEST_CASE("a coupling resumed from an archive shall give the same bits") {
  World::Choice choice = box(true);
  choice.disturbance_correction = scenario::DisturbanceCorrection::taken_off;
  World world(choice);
  world.set(world.velocity, swirl);
  scatter(world, 600);
  for (int step = 0; step < 2; ++step) {
    world.begin_step(k_step);
    advance(world);
    world.end_step();
  }
  world.grains.remove_last();
  MemoryArchive archive;
  world.coupling->save(archive);
  World resumed(choice);
  resumed.velocity = world.velocity;
  resumed.grains = world.grains;
  resumed.coupling->load(archive);
  CHECK(resumed.coupling->void_fraction() == world.coupling->void_fraction());
  CHECK(resumed.coupling->report().moved_shares == world.coupling->report().moved_shares);
  for (World* w : {&world, &resumed}) {
    w->begin_step(k_step);
    advance(*w);
    w->end_step();
    w->begin_step(k_step);
  }
  CHECK(bits_of(world) == bits_of(resumed));
}

TEST_CASE("grains shall feel the pressure gradient on their volume") {
  for (const char* set : {"I", "II"}) {
    World::Choice choice = box(false);
    choice.momentum_set = set;
    World world(choice);
    // Fluid at rest with the full hydrostatic pressure: grad p = rho g, force = buoyancy.
    const double gradient = test::k_air * 9.81;
    world.set(world.stress, [&](sdk::Vec3) { return sdk::Vec3{0, 0, gradient}; });
    world.grains.add({0.011, 0.0093, 0.0081}, {}, 5e-4);
    world.begin_step(k_step);
    world.refresh();
    const double* action = world.grains.action.data();
    const double force = action[3] * action[2] / world.grains.velocity[3];
    CHECK(force == test::approx(gradient * sdk::sphere_volume(5e-4)).epsilon(1e-10));
    CHECK(action[0] == 0.0);
  }
}

TEST_CASE("what grains took up of the stress shall count for as long as it was held") {
  World world(box(false));
  world.grains.add({0.011, 0.0093, 0.0081}, {}, 5e-4);
  world.begin_step(k_step);
  const double volume = sdk::sphere_volume(5e-4);
  for (const auto& [share, gradient] : {std::pair(0.8, 300.0), std::pair(0.2, 800.0)}) {
    world.set(world.stress, [&](sdk::Vec3) { return sdk::Vec3{0, gradient, 0}; });
    world.refresh({world.velocity, world.stress, nullptr, 0.0, share * k_step});
    world.grains.move(share * k_step, {});
  }
  world.end_step();
  const auto residuals = stress_residuals(world);
  const double sum = std::accumulate(residuals[1].begin(), residuals[1].end(), 0.0);
  // Left to it by the fluid: the first for the whole step.
  CHECK(sum == test::approx(0.2 * (300.0 - 800.0) * volume * k_step).epsilon(1e-9));
}

TEST_CASE("a grain larger than a cell that has just left shall feel the fluid of the last one") {
  for (const std::string rule : {"centre", "divided", "big_particle"}) {
    CAPTURE(rule);
    World::Choice choice = box(false);
    choice.voidage = rule;
    choice.is_one_way = true;
    World world(choice);
    const sdk::Vec3 stream{0, 0, -1};
    world.set(world.velocity, [&](sdk::Vec3) { return stream; });
    world.grains.add({0.01, 0.01, 2e-3}, {}, 2.5e-3);
    world.begin_step(k_step);
    world.refresh();
    for (const double below : {1e-4, 2e-3, 0.1}) {
      world.grains.position[2] = -below;
      world.refresh();
      for (int d = 0; d < 3; ++d) CHECK(world.grains.action[d] == test::approx(stream[d]));
      CHECK(world.grains.action[3] > 0.0);
    }
  }
}

TEST_CASE("no face that lies in a body shall take a force") {
  // The corner of a box reaches over the middle of faces that are open for the greater part.
  World::Choice choice = box(false);
  const fluid::Grid grid = fluid::Grid::make(choice.min, choice.max, choice.cells, choice.periodic);
  const sdk::Vec3 h = grid.spacing;
  test::WallRig rig(0.5, 0.5, 1e-3);
  rig.body("box", {{"min", sdk::Vec3{-1, -1, -1}}, {"max", sdk::Vec3{6.5 * h.x, 1, 5.6 * h.z}}});
  std::array<std::unique_ptr<sdk::BoundaryCondition>, 6> sides;
  fluid::Boundaries boundaries{};
  for (std::size_t s = 0; s < 6; ++s) {
    sides[s] = test::make_model<sdk::BoundaryCondition>("boundary", "slip");
    boundaries[s] = sides[s].get();
  }
  scenario::FluidSpec fluid;
  fluid.cells = choice.cells;
  fluid.density = test::k_air;
  fluid.viscosity = test::k_air_viscosity;
  const fluid::FluidSolver solver(grid, fluid, rig.bodies, boundaries);
  coupling::Lattice lattice(grid, solver.open_fraction());
  const std::ptrdiff_t corner = grid.index(6, 4, 5);
  CHECK(lattice.open_share(0, corner) > 0.5);
  lattice.use_walls(particles::surfaces_of(rig.setup, rig.bodies));
  CHECK(lattice.open_share(0, corner) == 0.0);
  // The one above it is clear of the box.
  CHECK(lattice.open_share(0, grid.index(6, 4, 6)) == 1.0);
}

TEST_CASE("without feedback the fluid shall feel nothing and see no grains") {
  World::Choice choice = box(false);
  choice.is_one_way = true;
  World world(choice);
  world.set(world.velocity, swirl);
  scatter(world, 100);
  world.begin_step(k_step);
  advance(world);
  world.end_step();
  world.begin_step(k_step);
  const Bits bits = bits_of(world);
  CHECK(*std::min_element(bits.eps.begin(), bits.eps.end()) == 1.0);
  for (const auto& field : bits.fields) {
    CHECK(std::all_of(field.begin(), field.end(), [](double v) { return v == 0.0; }));
  }
  CHECK(world.grains.action[3] > 0.0);
  CHECK(world.grains.impulse[0] == 0.0);
}

TEST_CASE("refreshes shall follow the shortest relaxation time, at most 64 per fluid step") {
  World::Choice choice;
  choice.max = {0.1, 0.1, 0.1};  // cells of 25 mm: crossing asks for one refresh
  World world(choice);
  world.grains.add({0.05, 0.05, 0.05}, {}, 6e-4);
  world.begin_step(k_step);
  CHECK(world.coupling->refresh_interval() == k_step);
  world.grains.add({0.05, 0.05, 0.05}, {}, 1e-5);  // 0.818 ms: 4 x 1 / 0.818 = 4.9
  world.begin_step(k_step);
  CHECK(world.coupling->refresh_interval() == k_step / 5);
  world.grains.add({0.05, 0.05, 0.05}, {}, 1e-6);
  world.begin_step(k_step);
  CHECK(world.coupling->refresh_interval() == k_step / 64);
  choice.max = {5e-3, 5e-3, 5e-3};  // cells of 1.25 mm: 8 x 2 m/s x 1 ms / 1.25 mm = 12.8
  World fine(choice);
  fine.grains.add({2e-3, 2e-3, 2e-3}, {}, 6e-4);
  fine.begin_step(k_step);
  CHECK(fine.coupling->refresh_interval() == k_step / 13);
}

TEST_CASE("the momentum exchange of the cells shall be the force on the fluid") {
  World world(box(true));
  world.set(world.velocity, swirl);
  scatter(world, 900);
  world.begin_step(k_step);
  world.refresh();
  std::vector<float> cells;
  world.coupling->momentum_exchange(cells);
  REQUIRE(cells.size() == 3 * 14 * 12 * 13);
  sdk::Vec3 sum;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    sum[static_cast<int>(n % 3)] += cells[n] * world.grid.cell_volume();
  }
  const sdk::Vec3 force = world.force_on_fluid();
  CHECK(norm(sum - force) < 1e-5 * norm(force));  // single precision
  CHECK(norm(force) > 0.0);
}

/// Keeps the size ratios it was last asked with.
class SizeLaw final : public sdk::DragLaw {
 public:
  [[nodiscard]] bool needs_size_ratio() const override { return true; }
  void evaluate(const sdk::DragBatch& batch) const override {
    seen.assign(batch.size_ratio, batch.size_ratio + batch.count);
    for (std::size_t g = 0; g < batch.count; ++g) batch.factor[g] = 1.0;
  }
  mutable std::vector<double> seen;
};

TEST_CASE("a law shall get each grain's size over the Sauter mean of its cell") {
  World world({});
  // Cells of 0.25 m. One cell with 3 small grains and one large of half weight, one cell alone.
  for (int n = 0; n < 3; ++n) world.grains.add({0.1 + 0.02 * n, 0.1, 0.1}, {}, 1e-3);
  world.grains.add({0.1, 0.15, 0.1}, {}, 2e-3, test::k_sand, 0.5);
  world.grains.add({0.6, 0.6, 0.6}, {}, 5e-3);
  const SizeLaw law;
  for (const bool is_one_way : {false, true}) {
    world.setup.fluid->is_one_way = is_one_way;
    coupling::Coupling coupling(world.setup, world.grid, world.open, *world.voidage, law);
    const auto rows = world.grains.rows();
    auto drag = coupling.evaluate(coupling.begin_step(rows, 1e-3), rows, world.velocity);
    coupling.refresh(drag, rows, {world.velocity, world.stress});
    const double mean = 1e-3 * (3 * 1 + 0.5 * 8) / (3 * 1 + 0.5 * 4);
    const double expected[] = {1e-3 / mean, 1e-3 / mean, 1e-3 / mean, 2e-3 / mean, 1.0};
    REQUIRE(law.seen.size() == 5);
    for (std::size_t g = 0; g < 5; ++g) {
      CHECK(law.seen[g] == test::approx(expected[g]).epsilon(1e-14));
    }
  }
}

TEST_CASE("a law shall get the sizes that coarse grains stand for") {
  // A grain of 4 mm for 64 of 1 mm, among three of 2 mm that are themselves.
  World::Choice choice;
  choice.coarse_graining = {4.0, 1.0};
  World world(choice);
  world.grains.add({0.1, 0.1, 0.1}, {}, 4e-3);
  for (int n = 0; n < 3; ++n) world.grains.add({0.1 + 0.02 * n, 0.15, 0.1}, {}, 2e-3);
  for (std::size_t g = 1; g < 4; ++g) world.grains.material[g] = 1;
  const SizeLaw law;
  coupling::Coupling coupling(world.setup, world.grid, world.open, *world.voidage, law);
  const auto rows = world.grains.rows();
  auto drag = coupling.evaluate(coupling.begin_step(rows, 1e-3), rows, world.velocity);
  coupling.refresh(drag, rows, {world.velocity, world.stress});
  const double mean = 1e-3 * (64 * 1 + 3 * 8) / (64 * 1 + 3 * 4);
  REQUIRE(law.seen.size() == 4);
  CHECK(law.seen[0] == test::approx(1e-3 / mean).epsilon(1e-14));
  CHECK(law.seen[1] == test::approx(2e-3 / mean).epsilon(1e-14));
}

}  // namespace

TEST_CASE("the drag of a step shall be evaluated once, and before the step ends") {
  // The order of the stages is that of their types: any other does not compile.
  using coupling::AssembledDrag;
  using coupling::Coupling;
  using coupling::EvaluatedDrag;
  using Grains = particles::GrainRows;
  static_assert(!std::is_default_constructible_v<AssembledDrag>);
  static_assert(!std::is_default_constructible_v<EvaluatedDrag>);
  static_assert(!std::is_copy_constructible_v<AssembledDrag>);
  static_assert(!std::is_copy_constructible_v<EvaluatedDrag>);
  using Evaluate = decltype(&Coupling::evaluate);
  static_assert(
      !std::is_invocable_v<Evaluate, Coupling&, AssembledDrag&, Grains, fluid::FaceField>);
  static_assert(!std::is_invocable_v<Evaluate, Coupling&, EvaluatedDrag, Grains, fluid::FaceField>);
  using EndStep = decltype(&Coupling::end_step);
  static_assert(!std::is_invocable_v<EndStep, Coupling&, AssembledDrag, Grains, double>);
  static_assert(!std::is_invocable_v<EndStep, Coupling&, EvaluatedDrag&, Grains, double>);
  // What is moved on is all that a step needs of the one before.
  for (const bool overlaps : {false, true}) {
    CAPTURE(overlaps);
    World::Choice choice = box(false);
    choice.overlaps = overlaps;
    World world(choice);
    world.set(world.velocity, swirl);
    scatter(world, 20);
    for (int step = 0; step < 3; ++step) {
      const auto rows = world.grains.rows();
      AssembledDrag assembled = world.coupling->begin_step(rows, k_step);
      if (overlaps) world.coupling->refresh(assembled, rows, {world.velocity, world.stress});
      EvaluatedDrag evaluated =
          world.coupling->evaluate(std::move(assembled), rows, world.velocity);
      if (!overlaps) world.coupling->refresh(evaluated, rows, {world.velocity, world.stress});
      CHECK(world.grains.action[3] > 0.0);
      world.grains.hold(k_step);
      world.coupling->end_step(std::move(evaluated), rows);
      CHECK(world.grains.impulse[0] == 0.0);
    }
    CHECK(world.coupling->report().largest_imbalance < k_sum);
  }
}
