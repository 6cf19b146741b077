// SPDX-License-Identifier: Apache-2.0
#include "unit/coupling/world.hpp"

#include <benchmark/benchmark.h>
#include <tbb/global_control.h>

namespace {

using namespace dust;
using test::World;

/// A bed of 20,000 grains in rows, as the DEM sorts them, in cells of 20 mm / `cells`: sand of
/// 0.6 mm has D/dx 0.48 with 16 and 0.12 with 4.
World::Choice bed(int cells) {
  World::Choice choice;
  choice.max = {0.02, 0.02, 0.04};
  choice.cells = {cells, cells, 2 * cells};
  return choice;
}
void fill(World& world, double diameter) {
  test::Numbers random;
  for (int n = 0; n < 20000; ++n) {
    const auto place = [&](int i, double pitch) { return (i + random.between(0.3, 0.7)) * pitch; };
    world.grains.add(
        {place(n % 27, 0.02 / 27), place(n / 27 % 27, 0.02 / 27), place(n / 729, 0.02 / 27)},
        {0.1, 0.2, -0.3}, diameter);
  }
  world.set(world.velocity, [](sdk::Vec3 p) { return sdk::Vec3{0.1, 50 * p.x, 0.5}; });
}

void exchange(benchmark::State& state, double diameter, int cells) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(state.range(0)));
  World world(bed(cells));
  fill(world, diameter);
  for (auto _ : state) {
    world.begin_step(1e-3);
    world.refresh();
    world.end_step();
  }
  state.counters["us_per_grain"] =
      benchmark::Counter(20000e-6 * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void refresh(benchmark::State& state, double diameter, int cells) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(state.range(0)));
  World world(bed(cells));
  fill(world, diameter);
  world.begin_step(1e-3);
  for (auto _ : state) {
    world.refresh();
  }
  state.counters["us_per_grain"] =
      benchmark::Counter(20000e-6 * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

void map(benchmark::State& state, double diameter, int cells) {
  const tbb::global_control limit(tbb::global_control::max_allowed_parallelism,
                                  static_cast<std::size_t>(state.range(0)));
  World world(bed(cells));
  fill(world, diameter);
  for (auto _ : state) world.begin_step(1e-3);
  state.counters["us_per_grain"] =
      benchmark::Counter(20000e-6 * static_cast<double>(state.iterations()),
                         benchmark::Counter::kIsRate | benchmark::Counter::kInvert);
}

BENCHMARK_CAPTURE(exchange, sand_0_12, 6e-4, 4)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(exchange, sand_0_48, 6e-4, 16)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(exchange, dust, 1e-5, 16)->Arg(1)->UseRealTime();
BENCHMARK_CAPTURE(map, sand_0_12, 6e-4, 4)->Arg(1)->UseRealTime();
BENCHMARK_CAPTURE(map, sand_0_48, 6e-4, 16)->Arg(1)->UseRealTime();
BENCHMARK_CAPTURE(map, dust, 1e-5, 16)->Arg(1)->UseRealTime();
BENCHMARK_CAPTURE(refresh, sand_0_12, 6e-4, 4)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(refresh, sand_0_48, 6e-4, 16)->Arg(1)->Arg(2)->UseRealTime();
BENCHMARK_CAPTURE(refresh, dust, 1e-5, 16)->Arg(1)->UseRealTime();

}  // namespace

BENCHMARK_MAIN();
