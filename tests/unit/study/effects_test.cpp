// SPDX-License-Identifier: Apache-2.0
#include "study/effects.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>

using dust::test::approx;
using namespace dust::study;

namespace {

/// A study of two axes made by hand: speeds 1, 2, 4 and cases a, b, with replicates.
struct Made {
  Spec spec;
  Plan plan;
  std::vector<Outcome> outcomes;

  explicit Made(int replicates) {
    Axis speed{AxisKind::values, {"belt.speed"}, std::vector<Level>(3), {}};
    Axis cases{AxisKind::cases, {}, std::vector<Level>(2), {}};
    cases.levels[0].label = "a";
    cases.levels[1].label = "b";
    spec.axes = {speed, cases};
    plan.inputs = {{"belt.speed", "m/s", false, 0}, {"case", "", true, 1}};
    plan.outputs = {{"x", "sensors.s.x", "", "mm", 1.0, true}};
    const double speeds[] = {1.0, 2.0, 4.0};
    for (std::size_t s = 0; s < 3; ++s) {
      for (std::size_t c = 0; c < 2; ++c) {
        for (int r = 1; r <= replicates; ++r) {
          Point point;
          point.levels = {s, c};
          point.replicate = r;
          point.seed = static_cast<std::uint64_t>(r);
          point.inputs = {{speeds[s], std::to_string(speeds[s])}, {0.0, c == 0 ? "a" : "b"}};
          plan.points.push_back(point);
          // x = 10 speed + 3 in case b; replicates lie 0.2 apart.
          Outcome outcome;
          outcome.status = Status::finished;
          const double scatter = replicates > 1 ? (r == 1 ? -0.1 : 0.1) : 0.0;
          outcome.outputs = {{10.0 * speeds[s] + (c == 0 ? 0.0 : 3.0) + scatter, 0.5}};
          outcomes.push_back(outcome);
        }
      }
    }
  }
  [[nodiscard]] Results results() const { return {plan, outcomes}; }
};

}  // namespace

TEST_CASE("main effects shall be means over the other inputs") {
  const Made made(1);
  const auto effects = main_effects(made.spec, made.results());
  REQUIRE(effects.size() == 2);
  CHECK(effects[0].levels[0].mean == approx(11.5));
  CHECK(effects[0].levels[2].mean == approx(41.5));
  CHECK(effects[0].change == approx(30.0));
  CHECK(effects[1].change == approx(3.0));
  // Without replicates the noise is what the sensor tells, 0.5; a level has two or three runs.
  CHECK(effects[0].levels[0].error == approx(0.5 / std::sqrt(2.0)));
  CHECK(effects[1].error == approx(0.5 * std::sqrt(2.0 / 3.0)));
}

TEST_CASE("noise shall not be known by the errors of some points where others tell none") {
  Made made(1);
  made.outcomes[0].outputs[0].error = -1.0;  // not steady, say
  CHECK_FALSE(noise_of(made.results(), 0).has_value());
}

TEST_CASE("noise shall be the scatter of replicates where there are any") {
  const Made made(2);
  // Two values 0.2 apart have a standard deviation of 0.2 / sqrt 2.
  const auto noise = noise_of(made.results(), 0).value();
  CHECK(noise.deviation == approx(0.2 / std::sqrt(2.0)));
  CHECK(noise.freedom == 6.0);
}

TEST_CASE("points that failed shall be left out of the means") {
  Made made(1);
  made.outcomes[0] = {.status = Status::failed, .reason = "broken", .wall_s = 0.0, .outputs = {}};
  const auto effects = main_effects(made.spec, made.results());
  CHECK(effects[0].levels[0].mean == approx(13.0));
  CHECK(effects[0].levels[0].points == 1);
}

TEST_CASE("an effect shall be the change of the combinations that finished at both of its levels") {
  Made made(2);
  // x rises by 30 from speed 1 to 4, and is 300 higher in case b: of 4 m/s there b has failed.
  for (std::size_t n = 0; n < made.plan.points.size(); ++n) {
    if (made.plan.points[n].levels[1] == 1) *made.outcomes[n].outputs[0].value += 300.0;
  }
  made.outcomes[10] = {};
  made.outcomes[11] = {};
  const auto effects = main_effects(made.spec, made.results());
  REQUIRE(effects.size() == 2);
  CHECK(effects[0].change == approx(30.0));
  // Each change of the one case left is of two replicates against two.
  CHECK(effects[0].error == approx(0.2 / std::sqrt(2.0)));
  CHECK(effects[0].coverage.planned == 8);
  CHECK(effects[0].coverage.used == 4);
  CHECK(effects[0].coverage.left_out == 2);
  // The marks of a plot compare the same: all levels over case a.
  CHECK(effects[0].levels[0].mean == approx(10.0));
  CHECK(effects[0].levels[1].mean == approx(20.0));
  CHECK(effects[0].levels[2].mean == approx(40.0));
  // Between the cases the two other speeds tell the change.
  CHECK(effects[1].change == approx(303.0));
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  const Verdict verdict = assess(e, made.spec, made.results());
  CHECK(verdict.kind == Verdict::Kind::as_expected);
  CHECK(verdict.text ==
        "as expected: 30.00 +- 0.14 mm (2 of 8 points are missing, 2 left out: nothing finished to "
        "compare them with)");
}

TEST_CASE("replicates that begin with the same seeds shall tell the error by their changes") {
  Made made(3);
  // What a seed adds is the same at both speeds but for 0.3, 0 and -0.3.
  for (std::size_t n = 0; n < made.plan.points.size(); ++n) {
    const Point& point = made.plan.points[n];
    const double own = 5.0 * static_cast<double>(point.seed);
    const double rest = point.levels[0] == 2 ? 0.3 * (2.0 - static_cast<double>(point.seed)) : 0.0;
    made.outcomes[n].outputs[0].value = 10.0 * point.inputs[0].number + own + rest;
  }
  const auto effects = main_effects(made.spec, made.results());
  CHECK(effects.at(0).change == approx(30.0));
  CHECK(effects[0].error == approx(0.3 / std::sqrt(3.0)));
  // The cases share what a seed adds: three seeds, however many cases.
  CHECK(effects[0].freedom == 2.0);
  // One seed is missing at an end: what is left is as if independent.
  made.outcomes[0] = {};
  CHECK(main_effects(made.spec, made.results()).at(0).error > 2.0);
}

TEST_CASE("changes that are equal to the last digit shall not tell an error of 0") {
  const Made made(2);
  // Both seeds change by 30 exactly, as counts do by chance; their values scatter.
  CHECK(main_effects(made.spec, made.results()).at(0).error > 0.05);
}

TEST_CASE("few values shall tell an effect by Student's t") {
  // Tables: 12.706, 4.303, 3.182, 2.776, 2.228.
  CHECK(clear_limit(1.0) == approx(12.706).epsilon(1e-4));
  CHECK(clear_limit(2.0) == approx(4.303).epsilon(1e-4));
  CHECK(clear_limit(3.0) == approx(3.182).epsilon(2e-3));
  CHECK(clear_limit(4.0) == approx(2.776).epsilon(1e-3));
  CHECK(clear_limit(10.0) == approx(2.228).epsilon(1e-3));
  CHECK(clear_limit(1000.0) == 2.0);
  CHECK(clear_limit(k_free) == 2.0);
  Made made(2);
  // The two seeds rise by 30 -+ 4: 7.5 times their error, of two values.
  for (std::size_t n = 0; n < made.plan.points.size(); ++n) {
    const Point& point = made.plan.points[n];
    const double more = point.levels[0] == 2 ? (point.seed == 1 ? -4.0 : 4.0) : 0.0;
    *made.outcomes[n].outputs[0].value += more;
  }
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  const Verdict verdict = assess(e, made.spec, made.results());
  CHECK(verdict.kind == Verdict::Kind::unresolved);
  CHECK(verdict.text ==
        "not told from noise: 30.0 +- 4.0 mm, of so few values 12.71 times the error tells");
}

TEST_CASE("an expectation shall stay open where points are not steady, whatever replicates say") {
  Made made(3);
  for (std::size_t n = 0; n < made.plan.points.size(); ++n) {
    made.outcomes[n].outputs[0].error = -1.0;
    // No error for another reason leaves the verdict to the replicates.
    made.outcomes[n].outputs[0].no_error = "few grains";
  }
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::as_expected);
  // The middle speed is not compared.
  made.outcomes[6].outputs[0].no_error = "not steady";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::as_expected);
  made.outcomes[0].outputs[0].no_error = "not steady";
  made.outcomes[1].outputs[0].no_error = "not steady";
  const Verdict verdict = assess(e, made.spec, made.results());
  CHECK(verdict.kind == Verdict::Kind::unresolved);
  CHECK(verdict.error < 0.0);
  CHECK(verdict.text == "open: 2 of 12 points not steady: 30 mm");
  const auto effects = main_effects(made.spec, made.results());
  CHECK_FALSE(is_clear(effects.at(0)));
  CHECK(unsteady_text(effects[0].coverage) == "2 of 12 points not steady");
  CHECK(effects[0].levels[0].error < 0.0);
}

TEST_CASE("an expectation shall stay open where runs say that nothing has passed") {
  Made made(1);
  // The belt has delivered at 4 m/s alone.
  for (std::size_t n = 0; n < 4; ++n) {
    made.outcomes[n].outputs[0] = {.value = {}, .error = -1.0, .no_error = "nothing passed"};
  }
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  const Verdict verdict = assess(e, made.spec, made.results());
  CHECK(verdict.kind == Verdict::Kind::unknown);
  CHECK(verdict.text == "open: 4 of 6 points without a value: nothing passed");
  CHECK(why_no_errors(made.plan, made.outcomes[0]) == "x: nothing passed");
}

TEST_CASE("levels without a combination in common shall give no effect") {
  Made made(1);
  // At 1 m/s case a alone, at 4 m/s case b alone.
  made.outcomes[1] = {};
  made.outcomes[4] = {};
  const auto effects = main_effects(made.spec, made.results());
  CHECK(effects.at(0).coverage.used == 0);
  CHECK(effects[0].levels[1].points == 0);
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::unknown);
  CHECK(assess(e, made.spec, made.results()).text.find("2 of 4 points are missing") !=
        std::string::npos);
}

TEST_CASE("an end at which nothing finished shall be told as missing") {
  Made made(1);
  made.outcomes[4] = {};
  made.outcomes[5] = {};
  const auto effects = main_effects(made.spec, made.results());
  CHECK(effects.at(0).change == approx(10.0));
  CHECK(coverage_text(effects[0].coverage) == "2 of 6 points are missing");
}

TEST_CASE("a scattered input shall be judged by levels that have all combinations of the others") {
  Spec spec;
  spec.axes = {{AxisKind::samples, {"p"}, std::vector<Level>(4), {}},
               {AxisKind::cases, {}, std::vector<Level>(2), {}}};
  Plan plan;
  plan.inputs = {{"p", "", false, 0}, {"case", "", true, 1}};
  plan.outputs = {{"y", "y", "", "1", 1.0, false}};
  std::vector<Outcome> outcomes;
  for (std::size_t n = 0; n < 8; ++n) {
    Point point;
    point.levels = {n / 2, n % 2};
    point.inputs = {{static_cast<double>(n / 2), ""}, {0.0, n % 2 == 0 ? "a" : "b"}};
    plan.points.push_back(point);
    Outcome outcome;
    outcome.status = Status::finished;
    outcome.outputs = {{point.inputs[0].number + 100.0 * static_cast<double>(n % 2), -1.0}};
    outcomes.push_back(outcome);
  }
  outcomes[7] = {};
  const auto effects = main_effects(spec, {plan, outcomes});
  CHECK(effects.at(0).change == approx(2.0));
  CHECK(effects[0].coverage.left_out == 1);
}

TEST_CASE("a change whose levels tell no error shall have that of its scatter over other inputs") {
  Made made(1);
  for (std::size_t n = 0; n < made.plan.points.size(); ++n) {
    // In case b higher by 2, 3 and 4 at the three speeds; no sensor tells an error.
    const auto& levels = made.plan.points[n].levels;
    const double more = levels[1] == 1 ? 2.0 + static_cast<double>(levels[0]) : 0.0;
    made.outcomes[n].outputs[0] = {100.0 * static_cast<double>(levels[0]) + more, -1.0};
  }
  const auto effects = main_effects(made.spec, made.results());
  CHECK(effects.at(1).change == approx(3.0));
  // A standard deviation of 1 over three changes.
  CHECK(effects[1].error == approx(std::sqrt(1.0 / 3.0)));
  // Over two cases a change with speed has no scatter to speak of.
  CHECK(effects[0].error < 0.0);
  Expectation e;
  e.output = "x";
  e.input = "case";
  e.then = "falls";
  e.from = "b";
  e.to = "a";
  CHECK(assess(e, made.spec, made.results()).error == approx(std::sqrt(1.0 / 3.0)));
  // One of the three speeds did not finish in case b: two changes are left.
  made.outcomes[5] = {};
  CHECK(assess(e, made.spec, made.results()).error < 0.0);
}

TEST_CASE("expectations shall be judged by sign and noise") {
  Made made(1);
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::as_expected);
  e.then = "falls";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::against);
  e.input = "case";
  e.from = "b";
  e.to = "a";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::as_expected);
  CHECK(assess(e, made.spec, made.results()).change == approx(-3.0));
  // Errors so large that 3 mm could be chance.
  for (Outcome& o : made.outcomes) o.outputs[0].error = 5.0;
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::unresolved);
  // Sensors that have seen nothing yet say 0: that is no verdict against anything.
  for (Outcome& o : made.outcomes) o.outputs[0] = {0.0, -1.0};
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::unresolved);
  CHECK(assess(e, made.spec, made.results()).text.starts_with("no change"));
  for (Outcome& o : made.outcomes) o = {};
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::unknown);
}

TEST_CASE("an expectation shall go from the smallest number to the largest, however given") {
  Made made(1);
  // The study names 4 m/s first.
  for (Point& point : made.plan.points) point.levels[0] = 2 - point.levels[0];
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::as_expected);
  CHECK(assess(e, made.spec, made.results()).change == approx(30.0));
}

TEST_CASE("an expectation at a level of another input shall be judged by the points there") {
  Made made(1);
  // In case b the faster belt makes x fall, more than it rises in case a.
  for (std::size_t n = 0; n < made.plan.points.size(); ++n) {
    const Point& point = made.plan.points[n];
    if (point.levels[1] == 1) made.outcomes[n].outputs[0].value = -20.0 * point.inputs[0].number;
  }
  Expectation e;
  e.output = "x";
  e.input = "belt.speed";
  e.then = "rises";
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::against);
  e.at = {{"case", "a", 1, 0}};
  CHECK(assess(e, made.spec, made.results()).kind == Verdict::Kind::as_expected);
  CHECK(assess(e, made.spec, made.results()).change == approx(30.0));
  CHECK(assess(e, made.spec, made.results()).error == approx(0.5 * std::sqrt(2.0)));
  CHECK(place_text(e) == "at case a");
  e.at = {{"case", "b", 1, 1}};
  CHECK(assess(e, made.spec, made.results()).change == approx(-60.0));
}

TEST_CASE("amounts shall be cut where their error allows") {
  CHECK(amount_text(60.3345, 0.09865, "mm") == "60.334 +- 0.099 mm");
  CHECK(amount_text(-3.5, 12.4, "1") == "-4 +- 12");
  CHECK(amount_text(628.0, -1.0, "1") == "628");
  CHECK(amount_text(0.123456, 0.0, "m") == "0.1235 m");
}

TEST_CASE("a scattered input shall be judged by a fitted line") {
  Spec spec;
  Axis sample{AxisKind::samples, {"p"}, std::vector<Level>(20), {}};
  spec.axes = {sample};
  Plan plan;
  plan.inputs = {{"p", "", false, 0}};
  plan.outputs = {{"y", "y", "", "1", 1.0, false}};
  std::vector<Outcome> outcomes;
  for (std::size_t n = 0; n < 20; ++n) {
    Point point;
    point.levels = {n};
    point.inputs = {{0.05 * static_cast<double>(n), ""}};
    plan.points.push_back(point);
    Outcome outcome;
    outcome.status = Status::finished;
    outcome.outputs = {{2.0 * point.inputs[0].number + (n % 2 == 0 ? 0.01 : -0.01), -1.0}};
    outcomes.push_back(outcome);
  }
  const auto effects = main_effects(spec, {plan, outcomes});
  CHECK(effects.at(0).is_scattered);
  CHECK(effects[0].change == approx(1.9).epsilon(0.02));
  CHECK(effects[0].error > 0.0);
  CHECK(effects[0].error < 0.05);
}
