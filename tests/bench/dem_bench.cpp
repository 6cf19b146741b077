// SPDX-License-Identifier: Apache-2.0
// Rates of the DEM in million grain-steps per second, rebuilds included:
//   dem_bench [threads] [settled bed as csv: diameter,x,y,z] [bed: nothing but it]
// A dilute flow (sand falling through air space with dust between); where a bed is given, that bed,
// and the same loosened and thrown down, as where a container is being filled: lists last a few
// steps there.
#include "bench/in_tube.hpp"

#include "dust/sdk/random.hpp"

#include <oneapi/tbb/global_control.h>

#include <algorithm>
#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <ctime>

using dust::particles::Dem;
using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

namespace {

/// Processor time of all threads where DEM_BENCH_CPU is set (a busy machine), else wall time.
double seconds() {
  static const bool is_cpu = std::getenv("DEM_BENCH_CPU") != nullptr;
  if (is_cpu) return static_cast<double>(std::clock()) / CLOCKS_PER_SEC;
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

void measure(const char* name, Dem& dem, int warm_up, int steps, int repeats) {
  double best[5] = {1e30, 1e30, 1e30, 1e30, 1e30};
  double time = 0.0;
  const auto step = [&](double* spent) {
    const double t0 = seconds();
    dem.neighbours();
    const double t1 = seconds();
    dem.step_tiles(time, false);
    const double t2 = seconds();
    dem.advance_fine();
    const double t3 = seconds();
    spent[0] += t1 - t0, spent[1] += t2 - t1, spent[2] += t3 - t2;
    time += dem.coarse_step();
  };
  double waste[3] = {};
  for (int n = 0; n < warm_up; ++n) step(waste);
  const auto before = dem.report();
  for (int r = 0; r < repeats; ++r) {
    double spent[3] = {};
    const double start = seconds();
    for (int n = 0; n < steps; ++n) step(spent);
    const double total = seconds() - start;
    if (total < best[0]) {
      best[0] = total;
      for (int k = 0; k < 3; ++k) best[k + 1] = spent[k];
    }
  }
  const auto after = dem.report();
  const auto count = static_cast<double>(dem.rows().count);
  std::printf(
      "%-12s %8.0f grains  dt %.2e s  %6.1f M grain-steps/s  (neighbours %4.1f %%, tiles %4.1f "
      "%%, "
      "fine level %4.1f %%)  rebuilds %.4f, list repairs %.4f/step  contacts %lld  fine "
      "sub-steps/step "
      "%.0f\n",
      name, count, dem.coarse_step(), 1e-6 * count * steps / best[0], 100 * best[1] / best[0],
      100 * best[2] / best[0], 100 * best[3] / best[0],
      static_cast<double>(after.rebuilds - before.rebuilds) / (steps * repeats),
      static_cast<double>(after.list_repairs - before.list_repairs) / (steps * repeats),
      static_cast<long long>(after.contacts),
      static_cast<double>(after.fine_steps - before.fine_steps) / (steps * repeats));
}

void dilute(bool with_dust) {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.49, 0.3);
  rig.diameters = {10e-6, 300e-6, 420e-6, 500e-6, 600e-6};
  rig.setup.gravity = {0, 0, -9.81};
  rig.setup.domain.min = {0, 0, -1};
  rig.setup.domain.max = {1, 11e-3, 1};
  rig.setup.time.expected_speed = 0.8;
  rig.wall(2, sand);
  rig.wall(3, sand);
  dust::scenario::BodySpec spec;
  spec.material = sand;
  spec.shape = {.kind = "shape",
                .name = "conveyor",
                .values = {Vec3{0.08, 0, -0.042}, Vec3{-0.5, 0, -0.042}, 0.042, 0.0},
                .path = {},
                .where = {}};
  rig.bodies.push_back(dust::bodies::make_body(
      rig.setup, spec, ModelLoader::make<dust::sdk::Motion>("motion", "belt", {{"speed", 0.8}})));
  auto dem = rig.make();
  const dust::sdk::Random random(1, 1);
  std::vector<NewGrain> grains;
  const double sizes[] = {300e-6, 420e-6, 500e-6, 600e-6};
  std::uint64_t n = 0;
  // A third rides on the belt, the rest falls as a stream; solids about one in ten.
  for (int i = 0; i < 900; ++i) {
    for (int j = 0; j < 15; ++j, ++n) {
      const bool on_belt = i % 3 == 0;
      const Vec3 jitter{random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)};
      NewGrain g{.diameter = sizes[n % 4]};
      g.position =
          on_belt ? Vec3{0.01 + 7e-4 * (i / 3 % 100), 7e-4 * (j + 0.6), 3.1e-4 + 7e-4 * (i / 300)}
                  : Vec3{0.13 + 8e-4 * (i % 20), 7e-4 * (j + 0.6), -0.1 + 1e-3 * (i / 20)};
      g.position += 5e-5 * jitter;
      g.velocity = on_belt ? Vec3{0.8, 0, 0} : Vec3{0.8, 0, -1.2} + 0.1 * jitter;
      grains.push_back(g);
    }
  }
  if (with_dust) {
    for (int i = 0; i < 2700; ++i, ++n) {
      NewGrain g{.diameter = 10e-6, .weight = 0.05};
      const Vec3 u{random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)};
      g.position =
          i % 10 == 0
              ? Vec3{0.0035 * (i / 140 + 0.5 * u.x) + 1e-4, 7e-4 * (i / 10 % 14 + 0.6) + 3.75e-4, 0}
              : Vec3{0.13 + 0.016 * u.x, 7e-4 * (i % 14 + 0.6) + 3.75e-4, -0.1 + 0.045 * u.z};
      if (i % 10 == 0) g.position.z = 5.2e-6;
      g.velocity = i % 10 == 0 ? Vec3{0.8, 0, 0} : Vec3{0.8, 0, -1.0};
      grains.push_back(g);
    }
  }
  dem->insert(grains);
  measure(with_dust ? "with dust" : "dilute", *dem, 500, 1000, 3);
}

void bed_of(const char* file, bool is_landing) {
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.52, 0.3);
  rig.setup.gravity = {0, 0, -9.81};
  Bed bed = read_bed(file);
  rig.diameters = bed.diameters;
  put_in_tube(rig, bed, sand);
  if (is_landing) {
    rig.setup.time.expected_speed = 1.0;
    const dust::sdk::Random random(1, 1);
    for (std::size_t n = 0; n < bed.grains.size(); ++n) {
      NewGrain& g = bed.grains[n];
      const Vec3 u{random.uniform(n, 0), random.uniform(n, 1), random.uniform(n, 2)};
      g.position.z = bed.low.z + 1.5 * (g.position.z - bed.low.z);
      g.velocity = 0.6 * (u - Vec3{0.5, 0.5, 0.5}) + Vec3{0, 0, -0.5};
    }
  }
  auto dem = rig.make();
  dem->insert(bed.grains);
  if (is_landing) {
    measure("landing", *dem, 4000, 2000, 1);
  } else {
    measure("settled bed", *dem, 200, 100, 12);
  }
}

}  // namespace

int main(int argc, char** argv) {
  const std::size_t threads = argc > 1 ? static_cast<std::size_t>(std::atoi(argv[1])) : 1;
  oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                      threads);
  std::printf("%zu thread(s)\n", threads);
  if (argc <= 3) {
    dilute(false);
    dilute(true);
  }
  if (argc > 2) bed_of(argv[2], false);
  if (argc > 2) bed_of(argv[2], true);
  return 0;
}
