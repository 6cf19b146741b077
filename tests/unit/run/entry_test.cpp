// SPDX-License-Identifier: Apache-2.0
#include "run/insertion/entry.hpp"

#include "dust/sdk/error.hpp"
#include "support/dem_rig.hpp"
#include "unit/bodies/meshes.hpp"
#include "verification/walls/wall_rig.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <string>
#include <vector>

namespace {

using namespace dust;
using run::InsertionCandidate;

constexpr double k_diameter = 4e-4;  // [m]

InsertionCandidate grain(double x, double diameter = k_diameter) {
  InsertionCandidate e;
  e.grain.position = {x, 0.0, 0.0};
  e.grain.velocity = {0.0, 0.0, -0.15};
  e.grain.diameter = diameter;
  return e;
}

/// A cube from -1 to 1 m with one emitter whose grains wait.
run::EntryScene scene() {
  run::EntryScene s;
  s.min = {-1, -1, -1};
  s.max = {1, 1, 1};
  s.rules = {{}};
  s.names = {"a.yaml:1:1: error: emitters.bed"};
  return s;
}

/// The same among the bodies of a rig.
run::EntryScene scene_among(const test::DemRig& rig) {
  run::EntryScene s = scene();
  s.surfaces = particles::surfaces_of(rig.setup, rig.bodies);
  return s;
}

std::string refusal(const run::EntryScene& s, std::vector<InsertionCandidate> waiting,
                    const particles::GrainRows& rows = {}) {
  try {
    run::take_without_overlap(waiting, rows, s);
  } catch (const sdk::ModelError& e) {
    return e.what();
  }
  return "not refused";
}

/// Grains in the domain, as the rows of the DEM.
struct Present {
  std::vector<double> position;
  void add(double x, double diameter = k_diameter) {
    position.insert(position.end(), {x, 0.0, 0.0, 0.5 * diameter});
  }
  [[nodiscard]] particles::GrainRows rows() const {
    particles::GrainRows rows;
    rows.count = position.size() / 4;
    rows.position = position.data();
    return rows;
  }
};

}  // namespace

TEST_CASE("grains shall enter in their order where nothing is in the way") {
  std::vector<InsertionCandidate> waiting{grain(2e-3), grain(0.0), grain(1e-3)};
  const auto entering = run::take_without_overlap(waiting, {}, scene());
  REQUIRE(entering.size() == 3);
  CHECK(entering[0].grain.position.x == 2e-3);
  CHECK(entering[1].grain.position.x == 0.0);
  CHECK(waiting.empty());
}

TEST_CASE("a grain shall wait for as long as one in the domain touches its place") {
  std::vector<InsertionCandidate> waiting{grain(0.0), grain(1e-3)};
  Present present;
  present.add(0.99 * k_diameter);
  auto entering = run::take_without_overlap(waiting, present.rows(), scene());
  REQUIRE(entering.size() == 1);
  CHECK(entering[0].grain.position.x == 1e-3);
  REQUIRE(waiting.size() == 1);
  present.position[0] = 1.01 * k_diameter;
  entering = run::take_without_overlap(waiting, present.rows(), scene());
  REQUIRE(entering.size() == 1);
  CHECK(entering[0].grain.position.x == 0.0);
  CHECK(waiting.empty());
}

TEST_CASE("of two entering grains that touch the first shall enter and the second wait") {
  std::vector<InsertionCandidate> waiting{grain(0.0), grain(0.9 * k_diameter)};
  const auto entering = run::take_without_overlap(waiting, {}, scene());
  REQUIRE(entering.size() == 1);
  CHECK(entering[0].grain.position.x == 0.0);
  REQUIRE(waiting.size() == 1);
  CHECK(waiting[0].grain.position.x == 0.9 * k_diameter);
}

TEST_CASE("a large grain beyond the box of the waiting centres shall be seen") {
  std::vector<InsertionCandidate> waiting{grain(0.0, 1e-5)};
  Present present;
  present.add(9e-4, 2e-3);
  CHECK(run::take_without_overlap(waiting, present.rows(), scene()).empty());
  CHECK(waiting.size() == 1);
}

TEST_CASE("a grain shall wait while a body that moves stands in its place") {
  // A plate at 1 m/s from x = -2 mm on, 1 mm thick: over the place from 0.8 to 2.2 ms.
  test::WallRig rig(0.5, 0.5, k_diameter);
  rig.body("box", {{"min", sdk::Vec3{-2e-3, -1e-2, -1e-2}}, {"max", sdk::Vec3{-1e-3, 1e-2, 1e-2}}},
           test::WallRig::motion("translate", {{"velocity", sdk::Vec3{1, 0, 0}}}));
  auto s = scene_among(rig);
  std::vector<InsertionCandidate> waiting{grain(0.0)};
  s.time = 1e-3;
  CHECK(run::take_without_overlap(waiting, {}, s).empty());
  s.time = 2.1e-3;
  CHECK(run::take_without_overlap(waiting, {}, s).empty());
  s.time = 2.3e-3;
  CHECK(run::take_without_overlap(waiting, {}, s).size() == 1);
}

TEST_CASE("a grain shall wait while a mesh that moves holds its place deep inside") {
  // As thick as ten grains: no face is within a radius of the centre.
  const test::TemporaryFolder folder;
  test::WallRig rig(0.5, 0.5, k_diameter);
  rig.body("mesh",
           {{"file", test::write_text_stl(folder / "gate.stl",
                                          test::box_mesh({-6, -10, -10}, {-2, 10, 10}))},
            {"unit", 1e-3}},
           test::WallRig::motion("translate", {{"velocity", sdk::Vec3{1, 0, 0}}}));
  auto s = scene_among(rig);
  std::vector<InsertionCandidate> waiting{grain(0.0)};
  s.time = 4e-3;
  CHECK(run::take_without_overlap(waiting, {}, s).empty());
  s.time = 6.3e-3;
  CHECK(run::take_without_overlap(waiting, {}, s).size() == 1);
}

TEST_CASE("waiting grains shall come back from a checkpoint as they were") {
  std::vector<InsertionCandidate> waiting{grain(0.0), grain(1e-3, 1e-5)};
  waiting[1].grain.weight = 0.05;
  waiting[1].grain.material = 2;
  waiting[1].grain.rotation = {1, 2, 3};
  waiting[1].emitter = 3;
  waiting[1].line = 17;
  test::MemoryArchive archive;
  run::save_waiting(waiting, archive);
  std::vector<InsertionCandidate> loaded{grain(7.0)};
  run::load_waiting(loaded, archive);
  REQUIRE(loaded.size() == 2);
  for (std::size_t n = 0; n < 2; ++n) {
    CHECK(loaded[n].grain.position == waiting[n].grain.position);
    CHECK(loaded[n].grain.velocity == waiting[n].grain.velocity);
    CHECK(loaded[n].grain.diameter == waiting[n].grain.diameter);
    CHECK(loaded[n].grain.weight == waiting[n].grain.weight);
    CHECK(loaded[n].grain.material == waiting[n].grain.material);
    CHECK(loaded[n].grain.rotation == waiting[n].grain.rotation);
    CHECK(loaded[n].emitter == waiting[n].emitter);
    CHECK(loaded[n].line == waiting[n].line);
  }
}

TEST_CASE("a grain shall wait for one that touches its place through a periodic side") {
  auto s = scene();
  s.is_periodic = {true, true, false};
  InsertionCandidate e = grain(0.9999);
  e.grain.position.y = -0.9999;
  std::vector<InsertionCandidate> waiting{e};
  Present present;
  present.position = {-0.9999, 0.9999, 0.0, 0.5 * k_diameter};  // 0.2 mm off in x and in y
  CHECK(run::take_without_overlap(waiting, present.rows(), s).empty());
  s.is_periodic = {true, false, false};
  CHECK(run::take_without_overlap(waiting, present.rows(), s).size() == 1);
}

TEST_CASE("grains that may not wait shall be refused with both sides named") {
  auto s = scene();
  s.rules[0].waits = false;
  auto pair = std::vector{grain(0.0), grain(0.5 * k_diameter)};
  pair[0].line = 2;
  pair[1].line = 7;
  CHECK(refusal(s, pair) ==
        "a.yaml:1:1: error: emitters.bed: a grain of 0.0004 m at (0.0002, 0, 0) m (line 7) and a "
        "grain of 0.0004 m at (0, 0, 0) m (line 2) overlap by 0.0002 m, 1 of the smaller radius; 0 "
        "is allowed: move one of them; grains that touch at the start, as in a settled bed, come "
        "from a file (model: file, whose allowed_overlap takes them)");
  Present present;
  present.add(0.0);
  std::vector<std::int64_t> id{41};
  auto rows = present.rows();
  rows.id = id.data();
  CHECK(
      refusal(s, {grain(1e-5)}, rows).find("and grain 41 in the domain, at (0, 0, 0) m overlap") !=
      std::string::npos);
  CHECK(refusal(s, {grain(1.5)}) ==
        "a.yaml:1:1: error: emitters.bed: a grain of 0.0004 m at (1.5, 0, 0) m lies outside the "
        "domain");
  particles::Surface floor;
  floor.name = "left";
  floor.normal = {1, 0, 0};
  floor.offset = -1.0;
  s.surfaces = {floor};
  CHECK(refusal(s, {grain(-1.0 + 1e-4)}).find("overlaps 'left' by 0.0001 m; move it clear") !=
        std::string::npos);
}

TEST_CASE("a grain just beyond a periodic side shall come in, as the frame of a run has it") {
  auto s = scene();
  s.rules[0].waits = false;
  CHECK(refusal(s, {grain(1.0 + 0.5 * k_diameter)}) != "not refused");
  s.is_periodic = {true, false, false};
  CHECK(refusal(s, {grain(1.0 + 0.5 * k_diameter)}) == "not refused");
  CHECK(refusal(s, {grain(-1.0 - 0.5 * k_diameter)}) == "not refused");
  // Farther out it is a mistake, and one that lies in its image's place is in its way.
  CHECK(refusal(s, {grain(1.0 + 1.5 * k_diameter)}).find("lies outside the domain") !=
        std::string::npos);
  CHECK(refusal(s, {grain(1.0 + 0.5 * k_diameter), grain(-1.0 + 0.5 * k_diameter)})
            .find("overlap by 0.0004 m") != std::string::npos);
}

TEST_CASE("grains that touch each other or a wall exactly shall come in, an overlap shall not") {
  auto s = scene();
  s.rules[0].waits = false;
  particles::Surface floor;
  floor.name = "left";
  floor.normal = {1, 0, 0};
  floor.offset = -0.3;
  s.surfaces = {floor};
  // Rows of grains side by side, as somebody writes them down: in millimetres, or with a sum.
  constexpr double k_overlap = 1e-12;  // [m] far below what any contact notices, above rounding
  for (int tenths = 3; tenths < 40; ++tenths) {
    CAPTURE(tenths);
    const double diameter = 1e-3 * (0.1 * tenths);
    const double radius = 0.5 * diameter;
    std::vector<InsertionCandidate> row;
    for (int n = 0; n < 40; ++n) {
      row.push_back(grain(1e-3 * (-300.0 + 0.1 * tenths * (n + 0.5)), diameter));
      row.push_back(grain(0.1 + n * diameter, diameter));
    }
    CHECK(refusal(s, row) == "not refused");
    CHECK(refusal(s, {grain(0.1, diameter), grain(0.1 + diameter - k_overlap, diameter)}) !=
          "not refused");
    CHECK(refusal(s, {grain(-0.3 + radius - k_overlap, diameter)}) != "not refused");
    // An emitter that looks for a place finds the one that just fits.
    Present present;
    present.add(-0.3 + radius, diameter);
    present.add(-0.3 + radius + 2.0 * diameter, diameter);
    const std::vector<std::int64_t> ids{1, 2};
    auto rows = present.rows();
    rows.id = ids.data();
    const std::vector<InsertionCandidate> none;
    const run::LazySurroundings around(s, rows, none, diameter, nullptr);
    CHECK(around.is_free({-0.3 + 1.5 * diameter, 0, 0}, radius));
    CHECK_FALSE(around.is_free({-0.3 + 1.5 * diameter, 0, 0}, radius + k_overlap));
  }
}

TEST_CASE("a bed pressed by its weight shall overlap as much as is allowed and no more") {
  auto s = scene();
  s.rules[0] = {.waits = false, .allowed_overlap = 0.01};
  // 0.8 % and 1.2 % of the radius.
  std::vector<InsertionCandidate> fine{grain(0.0), grain(k_diameter * (1 - 0.004))};
  CHECK(run::take_without_overlap(fine, {}, s).size() == 2);
  CHECK(refusal(s, {grain(0.0), grain(k_diameter * (1 - 0.006))}) != "not refused");
}

TEST_CASE("places shall be found as by brute force, with any sizes and periodic sides") {
  sdk::Random random(3, 1);
  auto s = scene();
  s.min = {0, 0, 0};
  s.max = {0.01, 0.006, 0.02};
  s.is_periodic = {true, true, false};
  std::vector<InsertionCandidate> waiting;
  for (std::uint64_t n = 0; n < 1500; ++n) {
    InsertionCandidate e = grain(0.0, n % 4 == 0 ? 1e-3 : 2e-4);
    for (int d = 0; d < 3; ++d) {
      e.grain.position[d] = s.max[d] * random.uniform(n, 0, static_cast<std::uint32_t>(d));
    }
    waiting.push_back(e);
  }
  std::vector<InsertionCandidate> expected;
  for (const InsertionCandidate& e : waiting) {
    bool is_free = true;
    for (const InsertionCandidate& other : expected) {
      sdk::Vec3 apart = e.grain.position - other.grain.position;
      apart.x -= 0.01 * std::round(apart.x / 0.01);
      apart.y -= 0.006 * std::round(apart.y / 0.006);
      is_free &= norm(apart) >= 0.5 * (e.grain.diameter + other.grain.diameter);
    }
    if (is_free) expected.push_back(e);
  }
  const auto entering = run::take_without_overlap(waiting, {}, s);
  REQUIRE(entering.size() == expected.size());
  CHECK(entering.size() < 1400);  // some were in the way of others
  for (std::size_t n = 0; n < entering.size(); ++n) {
    CHECK(entering[n].grain.position == expected[n].grain.position);
  }
}
