// SPDX-License-Identifier: Apache-2.0
#include "lone_grain.hpp"

#include <doctest/doctest.h>

// A lone grain in an open fluid must feel the law's drag at the undisturbed slip, whatever the size
// of the cells and wherever in one it stands (docs/theory/own_disturbance.md). The boxes are
// periodic: what a grain's own images do to it is taken off in closed form.
namespace {

using namespace dust;
using test::IsolatedGrain;
using test::k_test_air;
using test::k_test_water;

/// What is asked for, and what one sees: 2 % at most, -1.9 with 100 um in water at D/dx 2.
constexpr double k_law = 0.03;

constexpr sdk::Vec3 k_middle{0.5, 0.5, 0.5};
constexpr sdk::Vec3 k_on_face{0.5, 0.5, 0.0};
constexpr sdk::Vec3 k_some{0.21, 0.37, 0.68};

TEST_CASE("a lone grain shall feel the law's drag in cells of any size, anywhere in one") {
  struct Size {
    test::TestFluid fluid;
    double diameter;
  };
  // Reynolds numbers of 0.007, 0.04, 3.9, 47, 476 and 1150.
  const Size sizes[] = {{k_test_water, 20e-6}, {k_test_air, 20e-6}, {k_test_air, 100e-6},
                        {k_test_air, 300e-6},  {k_test_air, 1e-3},  {k_test_water, 3e-3}};
  for (const Size& size : sizes) {
    for (const double ratio : {0.05, 0.25, 0.5, 1.0, 2.0}) {
      double least = 1e9;
      double largest = -1e9;
      for (const sdk::Vec3& place : {k_middle, k_on_face, k_some}) {
        const IsolatedGrain::Error error =
            IsolatedGrain{size.diameter, ratio, size.fluid, place}.error();
        least = std::min(least, error.least);
        largest = std::max(largest, error.largest);
      }
      MESSAGE(std::string(size.fluid.name)
              << ", " << 1e6 * size.diameter << " um, D/dx " << ratio << ": " << 100.0 * least
              << " to " << 100.0 * largest << " % of the drag");
      CHECK(least > -k_law);
      CHECK(largest < k_law);
      // The place in the cell is not seen where the kernel is used.
      if (ratio >= 0.25) CHECK(largest - least < 0.005);
    }
  }
}

TEST_CASE("without the correction a lone grain shall feel what it does by itself") {
  for (const double ratio : {0.25, 1.0}) {
    IsolatedGrain grain{20e-6, ratio, k_test_air, k_on_face};
    grain.disturbance_correction = scenario::DisturbanceCorrection::felt;
    CHECK(grain.error().largest < -0.2);
  }
}

TEST_CASE("a lone grain shall feel the law's drag while it goes through the cells") {
  struct Way {
    double diameter, ratio, gate;
  };
  // What it displaces in a fluid step shows at the end of it (0.3 cells per step here): up to 1.8
  // %.
  for (const Way& way : {Way{20e-6, 0.25, 0.01}, Way{20e-6, 1.0, 0.02}, Way{100e-6, 0.5, 0.01},
                         Way{300e-6, 1.0, 0.02}, Way{1e-3, 0.5, 0.02}, Way{1e-3, 2.0, k_law}}) {
    IsolatedGrain grain{way.diameter, way.ratio, k_test_air};
    grain.motion = IsolatedGrain::Motion::towed;
    const IsolatedGrain::Error error = grain.error();
    MESSAGE("" << 1e6 * way.diameter << " um, D/dx " << way.ratio << ": " << 100.0 * error.least
               << " to " << 100.0 * error.largest << " % of the drag");
    CHECK(error.least > -way.gate);
    CHECK(error.largest < way.gate);
  }
}

TEST_CASE("a lone grain of half a cell that a stream carries shall feel the drag of its slip") {
  // Larger ones do not: docs/theory/own_disturbance.md has their figures.
  for (const test::TestFluid& fluid : {k_test_air, k_test_water}) {
    for (const double diameter : {20e-6, 100e-6, 1e-3}) {
      for (const double ratio : {0.25, 0.5}) {
        IsolatedGrain grain{diameter, ratio, fluid};
        grain.carried = 3.0 * grain.terminal();
        const IsolatedGrain::Error error = grain.error();
        MESSAGE(std::string(fluid.name) << ", " << 1e6 * diameter << " um, D/dx " << ratio << ": "
                                        << 100.0 * error.least << " to " << 100.0 * error.largest
                                        << ", mean " << 100.0 * error.mean << " % of the drag");
        CHECK(std::abs(error.mean) < 0.01);
      }
    }
  }
}

TEST_CASE(
    "a lone grain shall fall at the law's speed, whatever the set and the order of the nodes") {
  for (const double ratio : {0.25, 0.5, 1.0}) {
    for (const std::string set : {"I", "III"}) {
      for (const bool overlaps : {false, true}) {
        IsolatedGrain grain{20e-6, ratio, k_test_air};
        grain.motion = IsolatedGrain::Motion::free;
        grain.set = set;
        grain.overlaps = overlaps;
        const IsolatedGrain::Error error = grain.error();
        MESSAGE("D/dx " << ratio << ", set " << set
                        << std::string(overlaps ? ", overlapped: " : ": ") << 100.0 * error.least
                        << " to " << 100.0 * error.largest << " % of the speed");
        // A grain as large as a cell falls through the whole box, in a flow that its images made
        // while it was slower: known to a fifth of their 7 %.
        const double gate = ratio < 1.0 ? k_law : k_law + 0.2 * 0.07;
        CHECK(error.least > -gate);
        CHECK(error.largest < gate);
      }
    }
  }
}

// Images of the box are left in the figures: less than 1 %.
void check_beside_a_wall(double ratio, bool is_across) {
  for (const double beside : {0.5, 1.0, 2.0, 3.0}) {
    if (beside < 0.5 * ratio) continue;  // in the wall
    IsolatedGrain grain{20e-6, ratio, k_test_water};
    grain.beside = beside;
    grain.is_across = is_across;
    if (ratio == 2.0) grain.box = 40;
    const IsolatedGrain::Error error = grain.error();
    MESSAGE("D/dx " << ratio << ", " << beside << " cells from the wall, "
                    << std::string(is_across ? "across: " : "along: ") << 100.0 * error.largest
                    << " %");
    // In touch with the wall a grain of two cells also feels its own solids, squeezed by the wall.
    const double gate = ratio == 2.0 && beside == 1.0 ? 0.05 : k_law;
    CHECK(error.least > -gate);
    CHECK(error.largest < gate);
  }
}

TEST_CASE("a lone grain shall feel the law's drag along a wall") {
  for (const double ratio : {0.1, 0.5, 1.0}) check_beside_a_wall(ratio, false);
}

TEST_CASE("a lone grain shall feel the law's drag on its way to a wall") {
  for (const double ratio : {0.1, 0.5, 1.0}) check_beside_a_wall(ratio, true);
}

TEST_CASE("a lone grain of two cells shall feel the law's drag along a wall") {
  check_beside_a_wall(2.0, false);
}

TEST_CASE("a lone grain of two cells shall feel the law's drag on its way to a wall") {
  check_beside_a_wall(2.0, true);
}

TEST_CASE("a lone grain shall feel the law's drag beside a body, wherever it cuts the cells") {
  // Slivers of cells between a grain as large as a cell and the surface that it touches; the images
  // of the box are left in, up to 2 % for such a grain.
  const auto gate_of = [](double ratio) { return ratio <= 0.5 ? 0.025 : 0.05; };
  for (const bool is_across : {false, true}) {
    for (const double tilt : {0.0, 0.35}) {
      for (const double ratio : {0.25, 0.5, 1.0}) {
        for (const double floor : {3.05, 3.37, 3.8}) {
          for (const double beside : {0.5, 1.5, 3.0, 6.0}) {
            IsolatedGrain grain{20e-6, ratio, k_test_water};
            grain.beside = beside;
            grain.is_across = is_across;
            grain.floor = floor;
            grain.tilt = tilt;
            const IsolatedGrain::Error error = grain.error();
            MESSAGE("D/dx " << ratio << ", tilted by " << tilt << ", " << beside
                            << " cells from a body's surface at " << floor << ", "
                            << std::string(is_across ? "across: " : "along: ")
                            << 100.0 * error.largest << " %");
            const double gate = gate_of(ratio);
            CHECK(error.least > -gate);
            CHECK(error.largest < gate);
          }
        }
      }
    }
  }
}

}  // namespace
