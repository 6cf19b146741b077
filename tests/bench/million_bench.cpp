// SPDX-License-Identifier: Apache-2.0
// A million grains in settled beds: memory per grain and rate. million_bench THREADS BED.csv
#include "bench/read_bed.hpp"
#include "support/dem_rig.hpp"

#include <malloc.h>
#include <oneapi/tbb/global_control.h>

#include <chrono>
#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <string>

using dust::particles::NewGrain;
using dust::sdk::Vec3;
using namespace dust::test;

namespace {

/// A line of /proc/self/status, e.g. VmRSS, in bytes.
double memory(const std::string& name) {
  std::ifstream in("/proc/self/status");
  std::string word;
  while (in >> word) {
    if (word != name + ":") continue;
    double kilobytes = 0.0;
    in >> kilobytes;
    return 1024.0 * kilobytes;
  }
  return 0.0;
}

/// Bytes in use on the heap.
double allocated() {
  const struct mallinfo2 info = mallinfo2();
  return static_cast<double>(info.uordblks + info.hblkhd);
}

}  // namespace

int main(int argc, char** argv) {
  if (argc != 3) {
    std::fprintf(stderr, "usage: million_bench THREADS BED.csv\n");
    return 2;
  }
  const auto threads = static_cast<std::size_t>(std::atoi(argv[1]));
  oneapi::tbb::global_control control(oneapi::tbb::global_control::max_allowed_parallelism,
                                      threads);
  DemRig rig;
  const int sand = rig.material(2650, 50e6, 0.3);
  rig.law(sand, sand, 0.9, 0.52, 0.3);
  const Bed bed = read_bed(argv[2]);
  rig.diameters = bed.diameters;
  rig.setup.gravity = {0, 0, -9.81};
  // Beds side by side, as many as it takes.
  const auto copies = static_cast<int>(std::ceil(1e6 / static_cast<double>(bed.grains.size())));
  const auto edge = static_cast<int>(std::ceil(std::sqrt(copies)));
  const Vec3 size = bed.high - bed.low;
  rig.setup.domain.min = bed.low;
  rig.setup.domain.max = bed.low + Vec3{edge * size.x, edge * size.y, size.z + 0.01};
  for (int side = 0; side < 5; ++side) rig.wall(side, sand);
  auto dem = rig.make();
  const double before = memory("VmRSS");
  const double allocated_before = allocated();
  {
    std::vector<NewGrain> grains;
    for (int n = 0; n < copies; ++n) {
      for (NewGrain g : bed.grains) {
        g.position += Vec3{n % edge * size.x, n / edge * size.y, 0};
        grains.push_back(g);
      }
    }
    dem->insert(grains);
  }
  Stepper stepper(*dem);
  stepper.step(40);
  malloc_trim(0);
  const double resident = memory("VmRSS") - before;
  const double live = allocated() - allocated_before;
  const auto start = std::chrono::steady_clock::now();
  stepper.step(100);
  const std::chrono::duration<double> spent = std::chrono::steady_clock::now() - start;
  const auto count = static_cast<double>(dem->rows().count);
  const auto report = dem->report();
  std::printf(
      "%.0f grains, %.2f contacts each: %.2f kB per grain live, %.2f resident, %.2f at "
      "most; "
      "%.1f M grain-steps/s on %zu thread(s), %lld rebuilds\n",
      count, static_cast<double>(report.contacts) / count, 1e-3 * live / count,
      1e-3 * resident / count, 1e-3 * (memory("VmHWM") - before) / count,
      1e-6 * count * 100 / spent.count(), threads, static_cast<long long>(report.rebuilds));
  return 0;
}
