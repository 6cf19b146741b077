// SPDX-License-Identifier: Apache-2.0
#include "preflight/body_work.hpp"
#include "preflight/derived.hpp"
#include "preflight/particle_models.hpp"
#include "preflight/reader.hpp"
#include "support/approx.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <numbers>
#include <string>

using namespace dust;
using preflight::CostTerm;

namespace {

struct Scenario {
  registry::Registry shipped;
  scenario::ReadResult read;
  preflight::ParticleModels models;

  explicit Scenario(const std::string& file, const std::vector<scenario::Override>& set = {}) {
    shipped.load({DUST_TEST_PLUGINS});
    read = preflight::read_scenario(std::string(DUST_SOURCE) + "/scenarios/" + file, set, shipped);
    models = preflight::make_particle_models(read.setup, shipped);
  }
  [[nodiscard]] preflight::BodyWork work() const {
    return preflight::body_work(read.setup, models.bodies);
  }
  [[nodiscard]] preflight::Derived derived() const {
    return preflight::derive(read.setup, shipped, read.dust);
  }
};

}  // namespace

TEST_CASE(
    "cells shall be cut anew for bodies that go to other places, not for what turns in place") {
  const auto drum = Scenario("dust/drum.yaml").work();
  CHECK(drum.cut > 0.0);
  CHECK(drum.predict > 0.0);
  CHECK(drum.predict < drum.cut);
  // Of cells half as large there are eight times as many, four times as many at a surface.
  const auto finer = Scenario("dust/drum.yaml", {{"fluid.cells", "[20, 16, 20]"}}).work();
  CHECK(finer.cut > 2.0 * drum.cut);
  CHECK(finer.cut < 8.0 * drum.cut);
  // At ten times the step the lifters go half a cell and more: several cuts in each.
  const auto longer = Scenario("dust/drum.yaml", {{"time.fluid_step", "1 s"}}).work();
  CHECK(longer.cut > 3.0 * drum.cut);
  std::vector<scenario::Override> without;
  for (int n = 1; n <= 8; ++n) {
    without.push_back({"bodies.lifter_" + std::to_string(n) + ".enabled", "false"});
  }
  const auto smooth = Scenario("dust/drum.yaml", without).work();
  CHECK(smooth.cut == 0.0);
  CHECK(smooth.predict == 0.0);
  CHECK(smooth.touch.size() == 3);
}

TEST_CASE("cells near a body thinner than a cell shall be counted by their place, not its area") {
  // A paddle of 16 by 1.2 mm through the whole depth, cells of 2 mm: those within 3 mm of it.
  const auto work = Scenario("../tests/scenario/paddle.yaml").work();
  const double near = 16.0 * 1.2 + 2.0 * 3.0 * (16.0 + 1.2) + std::numbers::pi * 3.0 * 3.0;  // mm2
  // Four layers of whole cells of 4 mm2.
  CHECK(work.near_cells == test::approx(near / 4.0 * 4.0).epsilon(0.08));
}

TEST_CASE(
    "a mesh and a trough shall cost more to touch than plates, in proportion to the time on them") {
  const Scenario chute("plant/transfer_chute.yaml");
  const auto work = chute.work();
  const auto derived = chute.derived();
  double least = 1.0;
  double trough = 0.0;
  for (std::size_t b = 0; b < work.touch.size(); ++b) {
    least = std::min(least, work.touch[b]);
    if (chute.read.setup.bodies[b].name == "belt_1") trough = work.touch[b];
  }
  CHECK(trough > 5.0 * least);
  for (const auto& e : derived.emissions) {
    double sum = 0.0;
    for (const double share : e.on_body) sum += share;
    // On two bodies at once counts for both.
    CHECK(sum >= e.carried_share * (1.0 - 1e-9));
    CHECK(e.on_body.size() == work.touch.size());
  }
}

TEST_CASE("dust in the air shall cost each of its classes, from when there is some, in its steps") {
  const Scenario silt("dust/silt_to_plate.yaml");
  const auto derived = silt.derived();
  REQUIRE(silt.read.dust.field);
  const auto classes = static_cast<double>(silt.read.dust.field->diameters.size());
  // Grains carry it to the plate: nothing is in the air before the first one is there.
  CHECK(derived.dust_begin > 0.05);
  CHECK(derived.dust_begin < 0.5);
  const double dusty = 1.0 - derived.dust_begin / silt.read.setup.time.end;
  CHECK(derived.cost.terms[CostTerm::dust].amount ==
        test::approx(dusty * classes * derived.cost.terms[CostTerm::fluid].amount));
  // Its sub-steps keep to 0.65 of a cell where the fluid's keep to one.
  const Scenario hood("dust/hood_over_drop.yaml");
  const auto fast = hood.derived();
  CHECK(fast.dust_begin == 0.0);
  CHECK(fast.cost.terms[CostTerm::dust].amount ==
        test::approx(3.0 / 0.65 * fast.cost.terms[CostTerm::fluid].amount));
  const auto none = preflight::derive(silt.read.setup, silt.shipped);
  CHECK(none.cost.terms[CostTerm::dust].seconds == 0.0);
  CHECK(none.cost.memory_bytes < derived.cost.memory_bytes);
}

TEST_CASE("beside a resolved sphere the fluid shall be no faster than the sphere settles") {
  // ten Cate et al. 2002, case B1: 15 mm of nylon in oil, 38 mm/s. In one step of 2.5 ms that is
  // 0.08 of a cell of 1.25 mm: one sub-step.
  const Scenario b1("thesis/settling_b1_resolved.yaml", {{"time.end", "0.2 s"}});
  const auto derived = b1.derived();
  CHECK(derived.air_speed == test::approx(0.038).epsilon(0.1));
  CHECK(derived.cost.terms[CostTerm::fluid].amount == test::approx(80.0 * 80 * 80 * 128));
  // Seconds of one processor, as taken.
  CHECK(derived.cost.terms.seconds() == test::approx(28.4).epsilon(0.5));
}

TEST_CASE("a run that starts from the state of another shall be told what is left of it") {
  const Scenario silt("dust/silt_to_plate.yaml");
  const auto whole = silt.derived();
  const auto rest = preflight::derive(silt.read.setup, silt.shipped, silt.read.dust, 0.75);
  const auto& fluid = rest.cost.terms[CostTerm::fluid];
  CHECK(fluid.amount == test::approx(0.25 * whole.cost.terms[CostTerm::fluid].amount));
  CHECK(fluid.seconds == test::approx(0.25 * whole.cost.terms[CostTerm::fluid].seconds));
  // Grains that come all the time are most at the end: N grows as t, their steps as t^2.
  CHECK(rest.cost.terms[CostTerm::grains].amount >
        0.25 * whole.cost.terms[CostTerm::grains].amount);
  CHECK(rest.cost.terms[CostTerm::grains].amount < whole.cost.terms[CostTerm::grains].amount);
  CHECK(rest.cost.memory_bytes == whole.cost.memory_bytes);
  CHECK(rest.cost.disk_bytes < whole.cost.disk_bytes);
  CHECK(rest.grains_in_domain == whole.grains_in_domain);
}
