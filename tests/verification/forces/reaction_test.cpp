// SPDX-License-Identifier: Apache-2.0
// What grains receive by forces besides drag, the air loses.
#include "still.hpp"

#include "fluid/fluid_solver.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <string>
#include <vector>

namespace {

using namespace dust;
using test::Still;
using test::World;

constexpr double k_side = 4e-3;
constexpr double k_step = 5e-4;

/// Grains on a regular lattice.
struct Lattice {
  int along;
  double diameter;
  std::string voidage;
};
/// 8 per cell, regularly: liquid and grains stay uniform but for the shear.
const Lattice k_small_grains{8, 2e-4, "divided"};
/// Of two cells each, coupled over all the cells they cover.
const Lattice k_large_grains{2, 2e-3, "big_particle"};

/// A liquid in a periodic box and heavy grains, coupled as a run couples them.
struct Cloud {
  explicit Cloud(const std::vector<Still::Force>& names, const Lattice& lattice = k_small_grains)
      : world(box(lattice.voidage)) {
    world.setup.fluid->pressure_tolerance = 1e-10;
    world.restart();
    for (const Still::Force& f : names) {
      forces.push_back(test::ModelLoader::make<sdk::FluidForce>("fluid_force", f.name, f.values));
    }
    world.coupling->use(forces, {});
    liquid = std::make_unique<fluid::FluidSolver>(world.grid, *world.setup.fluid, bodies,
                                                  fluid::Boundaries{});
    // A shear with a jump of direction, so that there is something to lift grains.
    liquid->set_velocity([](sdk::Vec3 x) {
      return sdk::Vec3{0.05 + 0.02 * std::sin(2.0 * 3.14159265 * x.z / k_side), 0, 0.01};
    });
    const int along = lattice.along;
    const double pitch = k_side / along;
    for (int n = 0; n < along * along * along; ++n) {
      world.grains.add({(n % along + 0.5) * pitch, (n / along % along + 0.5) * pitch,
                        (n / along / along + 0.5) * pitch},
                       {}, lattice.diameter, test::k_sand);
      world.grains.rotation[4 * static_cast<std::size_t>(n) + 1] = 30.0;
    }
  }
  static World::Choice box(const std::string& voidage) {
    World::Choice choice;
    choice.voidage = voidage;
    choice.max = {k_side, k_side, k_side};
    choice.cells = {4, 4, 4};
    choice.periodic = {true, true, true};
    choice.fluid_step = k_step;
    choice.density = 998.2;
    choice.viscosity = 1e-3;
    choice.drag = "wen_yu";
    return choice;
  }
  void step() {
    coupling::Coupling& coupling = *world.coupling;
    world.begin_step(k_step);
    liquid->advance(time, k_step, coupling.void_fraction_before(), coupling.void_fraction(),
                    coupling.exchange());
    time += k_step;
    world.evaluate(liquid->drag_velocity());
    const int refreshes = static_cast<int>(std::lround(k_step / coupling.refresh_interval()));
    for (int n = 0; n < refreshes; ++n) {
      world.refresh({liquid->velocity(), liquid->stress_divergence(), &liquid->mean_pressure()});
      world.grains.move(k_step / refreshes, {});
    }
    world.end_step();
  }
  [[nodiscard]] sdk::Vec3 momentum() {
    sdk::Vec3 sum;
    for (int d = 0; d < 3; ++d) {
      world.for_cells([&](int i, int j, int k) {
        sum[d] += 998.2 * world.face_void_fraction(d, i, j, k) * world.grid.cell_volume() *
                  liquid->velocity().component[d][world.grid.index(i, j, k)];
      });
    }
    for (std::size_t g = 0; g < world.grains.count(); ++g) {
      for (int d = 0; d < 3; ++d) {
        sum[d] += world.grains.velocity[4 * g + d] / world.grains.velocity[4 * g + 3];
      }
    }
    // What collect() found and the next map() hands to the liquid, the debt at 6 of 13 numbers; of
    // cells where no other force acts; and less what the liquid has received too much.
    test::MemoryArchive archive;
    world.coupling->save(archive);
    liquid->save(archive);
    const std::vector<double> numbers = archive.numbers("grains");
    for (std::size_t n = 0; n < numbers.size(); n += 13) {
      for (std::size_t d = 0; d < 3; ++d) sum[static_cast<int>(d)] += numbers[n + 6 + d];
    }
    for (int d = 0; d < 3; ++d) {
      const std::string axis(1, "xyz"[d]);
      const std::vector<double> excess = archive.numbers("excess_" + axis);
      std::vector<double> deferred(excess.size());
      if (forces.empty()) deferred = archive.numbers("stress_owed_" + axis);
      world.for_cells([&](int i, int j, int k) {
        const auto c = static_cast<std::size_t>(world.grid.index(i, j, k));
        sum[d] += deferred[c] - excess[c] * world.grid.cell_volume();
      });
    }
    return sum;
  }

  World world;
  bodies::BodySet bodies;
  std::vector<std::unique_ptr<sdk::FluidForce>> forces;
  std::unique_ptr<fluid::FluidSolver> liquid;
  double time = 0.0;
};

/// Largest change of the whole momentum per step over 15 steps, relative to it, once the first step
/// has made room for the grains.
double drift(const std::vector<Still::Force>& names, const Lattice& lattice = k_small_grains) {
  Cloud cloud(names, lattice);
  cloud.step();
  const sdk::Vec3 start = cloud.momentum();
  double largest = 0.0;
  for (int n = 0; n < 15; ++n) {
    cloud.step();
    largest = std::max(largest, norm(cloud.momentum() - start) / norm(start));
  }
  return largest;
}

TEST_CASE("whatever forces act, the momentum of grains and liquid together shall stay") {
  // With drag alone all of it is booked; with other forces the stress that grains receive beside
  // what the liquid leaves them is not.
  const double plain = drift({});
  MESSAGE("drag alone: " << plain);
  CHECK(plain < 1e-9);
  using Names = std::vector<Still::Force>;
  for (const Names& names : {Names{{"virtual_mass"}}, Names{{"virtual_mass"}, {"basset"}}}) {
    const double with = drift(names);
    MESSAGE(names.front().name << ": " << with);
    CHECK(with < 1.5 * plain + 1e-9);
  }
  // Lift varies with the shear and makes the flow vary along the shear, too: then what grains feel
  // at the end of a step is no longer what the liquid feels within it.
  const double lift = drift({{"saffman"}, {"magnus"}});
  MESSAGE("saffman and magnus: " << lift);
  CHECK(lift < 1e-5);
}

TEST_CASE("the virtual mass of grains larger than a cell shall be stable and keep the momentum") {
  // Solids of half the box: C_A (1 - eps) / eps is 0.5, and the late reaction decays.
  const double plain = drift({}, k_large_grains);
  const double with = drift({{"virtual_mass"}}, k_large_grains);
  MESSAGE("grains of two cells: drag alone " << plain << ", with virtual mass " << with);
  CHECK(plain < 1e-9);
  CHECK(with < 1e-8);
  Cloud cloud({{"virtual_mass"}}, k_large_grains);
  Cloud without({}, k_large_grains);
  for (int n = 0; n < 60; ++n) {
    cloud.step();
    without.step();
  }
  // Long after the start both move with the liquid, at the speed of the momentum they all share.
  for (std::size_t g = 0; g < cloud.world.grains.count(); ++g) {
    CHECK(cloud.world.grains.velocity[4 * g] ==
          test::approx(without.world.grains.velocity[4 * g]).epsilon(0.1));
  }
  CHECK(cloud.liquid->report().largest_speed < 0.1);
}

TEST_CASE("forces shall change the exchange: the comparison can fail") {
  Cloud plain({});
  Cloud lifted({{"magnus"}});
  for (int n = 0; n < 10; ++n) {
    plain.step();
    lifted.step();
  }
  double plain_z = 0.0;
  double lifted_z = 0.0;
  for (std::size_t g = 0; g < plain.world.grains.count(); ++g) {
    plain_z += plain.world.grains.velocity[4 * g + 2];
    lifted_z += lifted.world.grains.velocity[4 * g + 2];
  }
  CHECK(std::abs(lifted_z - plain_z) > 1e-3 * std::abs(plain_z));
}

}  // namespace
