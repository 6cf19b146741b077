// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using dust::test::approx;
using namespace dust::study;
namespace fs = std::filesystem;

namespace {

/// Two lines that cross at (0.4, 0.2).
class Lines final : public Evaluator {
 public:
  std::optional<std::vector<Evaluation>> evaluate(
      const std::vector<std::vector<double>>& places) override {
    std::vector<Evaluation> all;
    for (const auto& p : places) {
      all.push_back(
          {{20.0 + 30.0 * p[0] + 20.0 * p[1], error, no_error}, {5.0 + 2.0 * p[0] - 3.0 * p[1]}});
    }
    return all;
  }
  double error = -1.0;  ///< of the first
  std::string no_error;
};

/// Speeds 1 and 2 m/s by angles 0 and 1 deg: x = 10 (speed - 1) + angle, expected to rise with
/// speed; replicates lie 0.2 apart.
struct TwoAxes {
  Spec spec;
  Plan plan;
  std::vector<Outcome> outcomes;

  explicit TwoAxes(std::uint64_t replicates = 1) {
    spec.name = "made";
    spec.axes = {{AxisKind::values, {"belt.speed"}, std::vector<Level>(2), {}},
                 {AxisKind::values, {"belt.angle"}, std::vector<Level>(2), {}}};
    Expectation expectation;
    expectation.output = "x";
    expectation.input = "belt.speed";
    expectation.then = "rises";
    spec.expectations = {expectation};
    plan.inputs = {{"belt.speed", "m/s", false, 0}, {"belt.angle", "deg", false, 1}};
    plan.outputs = {{"x", "sensors.s.x", "", "mm", 1.0, true}};
    for (std::size_t s = 0; s < 2; ++s) {
      for (std::size_t a = 0; a < 2; ++a) {
        for (std::uint64_t seed = 0; seed < replicates; ++seed) add(s, a, seed);
      }
    }
  }

  void add(std::size_t s, std::size_t a, std::uint64_t seed) {
    const auto speed = static_cast<double>(s);
    const auto angle = static_cast<double>(a);
    Point point;
    point.levels = {s, a};
    point.seed = seed;
    point.inputs = {{1.0 + speed, std::to_string(s + 1)}, {angle, std::to_string(a)}};
    plan.points.push_back(point);
    Outcome outcome;
    outcome.status = Status::finished;
    outcome.outputs = {{10.0 * speed + angle + 0.2 * static_cast<double>(seed), 0.6}};
    outcomes.push_back(outcome);
  }

  [[nodiscard]] nlohmann::json document() const {
    return study_document(spec, {plan, outcomes}, nullptr);
  }
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

}  // namespace

TEST_CASE("the report of a calibration shall draw the crossing and ask no other machine") {
  CalibrationAnswer answer;
  answer.settings.goals = {{"angle", "deg", 36.0, 1.0}, {"time", "s", 5.2, 0.1}};
  answer.settings.parameters = {{"mu_s", "", 0.2, 0.7}, {"mu_r", "", 0.0, 0.5}};
  Lines lines;
  answer.calibration = calibrate(answer.settings, lines);
  CHECK(answer.calibration.estimates[0].best == approx(0.4).epsilon(0.05));
  CHECK(answer.calibration.is_pinned);

  Spec spec;
  spec.name = "crossing";
  spec.title = "<script>alert(1)</script>";
  Plan plan;
  const auto document = study_document(spec, {plan, {}}, &answer);
  const auto& crossing = document["calibration"]["crossing"];
  CHECK(document["calibration"]["is_good"] == true);
  CHECK(crossing["axes"][0]["best"].get<double>() == approx(0.4).epsilon(0.05));
  // A field per target over the whole grid, and the region about the likeliest values.
  const auto n = crossing["per_direction"].get<std::size_t>();
  REQUIRE(crossing["fields"].size() == 2);
  CHECK(crossing["fields"][0]["level"] == 36.0);
  CHECK(crossing["fields"][0]["error"] == 1.0);
  CHECK(crossing["fields"][0]["values"].size() == n * n);
  CHECK(crossing["region"]["values"].size() == n * n);

  const fs::path file =
      fs::temp_directory_path() / ("dust_study_report_" + std::to_string(::getpid()) + ".html");
  write_study_report(file, spec, {plan, {}}, &answer);
  const std::string text = text_of(file);
  fs::remove(file);
  // What the user wrote is text, not markup; nothing is fetched.
  CHECK(text.find("<script>alert") == std::string::npos);
  CHECK(text.find("default-src 'none'") != std::string::npos);
  CHECK(text.find("d3.contours") != std::string::npos);
  CHECK(text.find("{{file:") == std::string::npos);
}

TEST_CASE("a calibration of points that are not steady shall say so, and be no good answer") {
  CalibrationAnswer answer;
  answer.settings.goals = {{"angle", "deg", 36.0, 1.0}, {"time", "s", 5.2, 0.1}};
  answer.settings.parameters = {{"mu_s", "", 0.2, 0.7}, {"mu_r", "", 0.0, 0.5}};
  const auto calibration_of = [&](double error, const std::string& no_error) {
    Lines lines;
    lines.error = error;
    lines.no_error = no_error;
    answer.calibration = calibrate(answer.settings, lines);
    return calibration_json(answer);
  };
  const auto steady = calibration_of(0.2, "");
  CHECK(steady["is_good"] == true);
  CHECK(steady["targets"][0]["run_error"].get<double>() == approx(0.2));
  CHECK(steady["targets"][0]["points_without_error"] == 0);
  CHECK(steady["targets"][1]["run_error"].is_null());
  CHECK(steady["targets"][1]["points_without_error"] == steady["places"]);
  CHECK(std::abs(steady["targets"][0]["chi"].get<double>()) < 0.1);

  const auto unsteady = calibration_of(-1.0, k_not_steady);
  CHECK(unsteady["is_good"] == false);
  CHECK(unsteady["targets"][0]["points_not_steady"] == unsteady["places"]);
  CHECK(unsteady["targets"][0]["points_without_error"] == 0);
  const std::string said = unsteady["statements"].dump();
  const std::string places = unsteady["places"].dump();
  CHECK(said.find("angle is not steady in " + places + " of " + places + " points: it may still") !=
        std::string::npos);
  CHECK(said.find("time has no error in " + places + " of " + places + " points") !=
        std::string::npos);
}

TEST_CASE("the report of a study shall draw every effect with the lines it is made of") {
  TwoAxes made;
  const auto document = made.document();
  CHECK(document["calibration"].is_null());
  CHECK(document["facts"]["finished"] == 4);
  const auto& effects = document["effects"];
  // The mean over the angles, and a line per angle.
  const auto& plot = effects["outputs"][0]["plots"][0];
  REQUIRE(plot["lines"].size() == 3);
  CHECK(plot["lines"][0]["y"] == nlohmann::json({0.5, 10.5}));
  CHECK(plot["lines"][1]["name"] == "angle 0 deg");
  CHECK(plot["lines"][2]["name"] == "angle 1 deg");
  CHECK(plot["change"] == 10.0);
  CHECK(plot["change_error"].get<double>() == approx(0.6));
  // At a glance: the speed's effect stands out of its error, the angle's (1.00 of 0.60) does not.
  const auto& table = effects["table"];
  CHECK(table["columns"][0]["name"] == "speed");
  CHECK(table["columns"][0]["to"] == 2.0);
  CHECK(table["rows"][0]["cells"][0]["is_clear"] == true);
  CHECK(table["rows"][0]["cells"][1]["is_clear"] == false);
  CHECK(document["points"]["rows"].size() == 4);

  // One point is missing: what it would be compared with is left out, and both are told.
  made.outcomes[3] = {.status = Status::failed, .reason = "broken", .wall_s = 0.0, .outputs = {}};
  const auto less = made.document();
  const auto& gap = less["effects"]["outputs"][0]["plots"][0];
  CHECK(gap["lines"][0]["y"] == nlohmann::json({0.0, 10.0}));
  CHECK(gap["coverage"] ==
        "1 of 4 points is missing, 1 left out: nothing finished to compare them with");
  CHECK(less["effects"]["table"]["rows"][0]["cells"][0]["coverage"] == gap["coverage"]);
}

TEST_CASE("the report of a study shall say which marks have no error, and why") {
  TwoAxes made;
  made.outcomes[2].outputs[0] = {10.0, -1.0, "not steady"};
  const auto document = made.document();
  const auto& plot = document["effects"]["outputs"][0]["plots"][0];
  // Where one point tells none, no level's is known; of one it is said that it has not settled.
  CHECK_FALSE(plot["lines"][0].contains("low"));
  CHECK(plot["lines"][0]["no_error"] ==
        nlohmann::json({"no error is known", "1 of 2 points not steady"}));
  CHECK(plot["lines"][1]["no_error"] == nlohmann::json({"", "1 of 1 points not steady"}));
  CHECK(plot["lines"][2]["no_error"] == nlohmann::json({"", ""}));
  CHECK(plot["unsteady"] == "1 of 4 points not steady");
  CHECK(document["effects"]["table"]["rows"][0]["cells"][0]["unsteady"] == plot["unsteady"]);
  CHECK(document["points"]["rows"][2]["outputs"][0]["no_error"] == "not steady");
  CHECK(document["points"]["rows"][1]["outputs"][0]["no_error"] == "");
  REQUIRE(document["expectations"].size() == 1);
  CHECK(document["expectations"][0]["verdict"] == "open");
  CHECK(document["expectations"][0]["text"] == "open: 1 of 4 points not steady: 10 mm");
}

TEST_CASE("marks with errors beside those without shall keep theirs in the report of a study") {
  // Two replicates of each point tell the noise; of one level they have not settled.
  TwoAxes made(2);
  made.outcomes[4].outputs[0].error = -1.0;
  made.outcomes[4].outputs[0].no_error = "not steady";
  const auto document = made.document();
  const auto& mean = document["effects"]["outputs"][0]["plots"][0]["lines"][0];
  CHECK(mean["low"][0].is_number());
  CHECK(mean["low"][1].is_null());
  CHECK(mean["high"][1].is_null());
  CHECK(mean["no_error"] == nlohmann::json({"", "1 of 4 points not steady"}));
}
