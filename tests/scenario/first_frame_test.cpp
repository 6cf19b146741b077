// SPDX-License-Identifier: Apache-2.0
#include "report/h5_source.hpp"
#include "support/approx.hpp"
#include "support/engine.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <filesystem>
#include <fstream>
#include <string>
#include <vector>

using dust::test::approx;
using dust::test::engine;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

/// A closed box without gravity; what is in it at the start lies still.
std::string scenario(const std::string& emitter, const std::string& voidage) {
  return R"(name: first_frame
time: {end: 3 ms, fluid_step: 1 ms, output_every: 1 ms}
gravity: [0, 0, 0]
domain:
  min: [0, 0, 0 mm]
  max: [20, 20, 20 mm]
  boundaries:
    left: {grains: wall, material: sand, air: {model: no_slip}}
    right: {grains: wall, material: sand, air: {model: no_slip}}
    front: {grains: wall, material: sand, air: {model: no_slip}}
    back: {grains: wall, material: sand, air: {model: no_slip}}
    bottom: {grains: wall, material: sand, air: {model: no_slip}}
    top: {grains: wall, material: sand, air: {model: no_slip}}
materials:
  sand: {density: 2650, young_modulus: 5 MPa, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.5, friction: 0.4}
bodies: {}
fluid: {density: 1.2, viscosity: 1.8e-5 Pa s, cells: [10, 10, 10]}
drag: {model: di_felice}
voidage: {model: )" +
         voidage + R"(}
emitters:
  sand:
)" + emitter;
}

const std::string k_block = R"(    model: lattice
    material: sand
    spacing: 1.1 mm
    min: [4, 4, 4 mm]
    max: [14, 15, 16 mm]
    diameters: [1 mm]
    number_fractions: [1]
)";
const std::string k_feed = R"(    model: feed
    material: sand
    mass_flow: 200 g/s
    min: [2, 2, 18 mm]
    max: [18, 18, 18 mm]
    velocity: [0, 0, -1 m/s]
    diameters: [1 mm]
    number_fractions: [1]
)";

void run(const TemporaryFolder& folder, const std::string& text) {
  std::ofstream(folder / "box.yaml") << text;
  const auto done = engine(
      {"run", folder / "box.yaml", "-o", folder / "out", "--force", "--quiet", "--threads", "1"});
  INFO(done.err);
  REQUIRE(done.status == 0);
}

/// [m3] of the grains of a frame, by their diameters and by the void fraction of the air.
struct Solids {
  double of_grains = 0.0;
  double of_air = 0.0;
};
Solids solids_of(const dust::report::H5Source& source, const std::string& frame) {
  Solids solids;
  for (const double d : source.floats("/particles/" + frame + "/diameter")) {
    solids.of_grains += 0.5235987755982989 * d * d * d;
  }
  for (const double eps : source.floats("/fluid/" + frame + "/void_fraction")) {
    solids.of_air += (1.0 - eps) * 8e-9;
  }
  return solids;
}

// Single precision of the columns.
constexpr double k_single = 1e-5;

}  // namespace

TEST_CASE("the first frame shall show the grains that are there in the void fraction") {
  for (const std::string& emitter : {k_block, k_feed}) {
    for (const std::string voidage : {"centre", "divided"}) {
      CAPTURE(emitter);
      CAPTURE(voidage);
      const TemporaryFolder folder;
      run(folder, scenario(emitter, voidage));
      const dust::report::H5Source source(folder / "out" / "results.h5");
      const std::vector<std::string> frames = source.frames("/fluid");
      REQUIRE(frames.size() == 4);
      const Solids first = solids_of(source, frames[0]);
      CHECK(first.of_grains > 1e-9);
      CHECK(first.of_air == approx(first.of_grains).epsilon(k_single));
    }
  }
}

TEST_CASE("grains that lie there from the start shall push no air aside in the first step") {
  const TemporaryFolder folder;
  run(folder, scenario(k_block, "divided"));
  const dust::report::H5Source source(folder / "out" / "results.h5");
  for (const std::string& frame : source.frames("/fluid")) {
    double fastest = 0.0;
    for (const float u : source.floats("/fluid/" + frame + "/velocity")) {
      fastest = std::max(fastest, std::abs(static_cast<double>(u)));
    }
    // Nothing moves; pushing aside half of a cell in 1 ms makes m/s.
    CHECK(fastest < 1e-12);
  }
}
