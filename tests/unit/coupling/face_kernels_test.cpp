// SPDX-License-Identifier: Apache-2.0
#include "coupling/face_void.hpp"
#include "unit/coupling/world.hpp"

#include <doctest/doctest.h>

#include <memory>
#include <vector>

namespace {

using namespace dust;
using test::World;

TEST_CASE("batches of grains shall see at their faces what each sees by itself") {
  for (const bool is_periodic : {false, true}) {
    CAPTURE(is_periodic);
    World::Choice choice;
    choice.cells = {5, 1, 4};
    choice.periodic = {is_periodic, is_periodic, false};
    choice.open = [](int i, int, int k) { return i == 3 && k < 2 ? 0.0 : k == 0 ? 0.7 : 1.0; };
    const World world(choice);
    const coupling::Lattice lattice(world.grid, world.open);
    test::Numbers random;
    // Solids in some cells, two of them at sides.
    fluid::CellField eps(world.grid.size, 1.0);
    std::vector<std::ptrdiff_t> touched;
    for (const auto& c :
         std::vector<std::array<int, 3>>{{0, 0, 0}, {1, 0, 0}, {2, 0, 2}, {4, 0, 3}}) {
      touched.push_back(world.grid.index(c[0], c[1], c[2]));
      eps[touched.back()] = random.between(0.4, 0.9);
    }
    coupling::FaceVoid faces(lattice);
    faces.update(fluid::CellField(world.grid.size, 0.5), {world.grid.index(3, 0, 3)});
    faces.update(eps, touched);  // what was set before is 1 again

    constexpr std::size_t k_count = 200;
    std::vector<double> position, u(world.grid.size), v(k_count);
    for (double& number : u) number = random.next();
    for (std::size_t q = 0; q < k_count; ++q) {
      // Some lie beyond the sides.
      for (int d = 0; d < 3; ++d) position.push_back(random.between(-0.1, 1.1));
      position.push_back(1e-3);
      v[q] = random.next();
    }
    const auto spots = std::make_unique<coupling::SpotBatch>();
    lattice.place(position.data(), k_count, *spots);
    std::vector<double> open(k_count), fluid(k_count), flux(k_count), given(k_count);
    const std::vector<double> ones(k_count, 1.0);
    for (int d = 0; d < 3; ++d) {
      CAPTURE(d);
      coupling::look_at_faces(*spots, d, k_count, faces.columns(d), u.data(), v.data(),
                              {open.data(), fluid.data()}, flux.data());
      coupling::settle_faces(*spots, d, k_count, faces.columns(d), u.data(), v.data(), ones.data(),
                             ones.data(), false, given.data());
      for (std::size_t q = 0; q < k_count; ++q) {
        const coupling::Place p = lattice.place(&position[4 * q]);
        CHECK(spots->cell(q) == lattice.cell(p));
        coupling::Stencil s;
        lattice.stencil(d, p, eps, s);
        double sums[4] = {};
        for (std::size_t n = 0; n < coupling::Stencil::size(); ++n) {
          const double part = s.weight[n] * s.open[n];
          const double slip = s.void_fraction[n] * (u[s.home[n]] - v[q]);
          sums[0] += part;
          sums[1] += part * s.void_fraction[n];
          sums[2] += s.weight[n] * slip;
          sums[3] += part * s.void_fraction[n] * (slip + 1.0);
        }
        CHECK(open[q] == doctest::Approx(sums[0]).epsilon(1e-12));
        CHECK(fluid[q] == doctest::Approx(sums[1]).epsilon(1e-12));
        CHECK(flux[q] == doctest::Approx(sums[2]).epsilon(1e-12));
        CHECK(given[q] == doctest::Approx(sums[3]).epsilon(1e-12));
      }
    }
  }
}

}  // namespace
