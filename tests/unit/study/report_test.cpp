// SPDX-License-Identifier: Apache-2.0
#include "study/study_report.hpp"

#include <doctest/doctest.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <iterator>

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
      all.push_back({20.0 + 30.0 * p[0] + 20.0 * p[1], 5.0 + 2.0 * p[0] - 3.0 * p[1]});
    }
    return all;
  }
};

std::string text_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(stream), std::istreambuf_iterator<char>()};
}

std::size_t count_of(const std::string& text, const std::string& part) {
  std::size_t count = 0;
  for (auto at = text.find(part); at != std::string::npos; at = text.find(part, at + 1)) ++count;
  return count;
}

}  // namespace

TEST_CASE("the report of a calibration shall draw the crossing and ask no other machine") {
  CalibrationAnswer answer;
  answer.settings.goals = {{"angle", "deg", 36.0, 1.0}, {"time", "s", 5.2, 0.1}};
  answer.settings.parameters = {{"mu_s", "", 0.2, 0.7}, {"mu_r", "", 0.0, 0.5}};
  Lines lines;
  answer.calibration = calibrate(answer.settings, lines);
  CHECK(answer.calibration.estimates[0].best == doctest::Approx(0.4).epsilon(0.05));
  CHECK(answer.calibration.is_pinned);

  Spec spec;
  spec.name = "crossing";
  spec.title = "<script>alert(1)</script>";
  Plan plan;
  const fs::path file =
      fs::temp_directory_path() / ("dust_study_report_" + std::to_string(::getpid()) + ".html");
  write_study_report(file, spec, {plan, {}}, &answer);
  const std::string text = text_of(file);
  fs::remove(file);
  CHECK(text.find("Where the contours cross") != std::string::npos);
  // Three lines per target (met, and one error to either side), each of many pieces.
  CHECK(count_of(text, "<path d=\"M") == 6);
  CHECK(count_of(text, "<svg ") == 1);
  // What the user wrote is text, not markup; nothing is fetched.
  CHECK(text.find("<script>alert") == std::string::npos);
  CHECK(text.find("default-src 'none'") != std::string::npos);
  CHECK(count_of(text, "src=\"") == 0);
  CHECK(text.find("nan ") == std::string::npos);
  CHECK(text.find("Mnan") == std::string::npos);
}

TEST_CASE("the report of a study shall draw every effect with the lines it is made of") {
  Spec spec;
  spec.name = "made";
  spec.axes = {{AxisKind::values, {"belt.speed"}, std::vector<Level>(2), {}},
               {AxisKind::values, {"belt.angle"}, std::vector<Level>(2), {}}};
  Plan plan;
  plan.inputs = {{"belt.speed", "m/s", false, 0}, {"belt.angle", "deg", false, 1}};
  plan.outputs = {{"x", "sensors.s.x", "", "mm", 1.0, true}};
  std::vector<Outcome> outcomes;
  for (std::size_t s = 0; s < 2; ++s) {
    for (std::size_t a = 0; a < 2; ++a) {
      Point point;
      point.levels = {s, a};
      point.inputs = {{1.0 + static_cast<double>(s), std::to_string(s + 1)},
                      {static_cast<double>(a), std::to_string(a)}};
      plan.points.push_back(point);
      Outcome outcome;
      outcome.status = Status::finished;
      outcome.outputs = {{10.0 * static_cast<double>(s) + static_cast<double>(a), 0.6}};
      outcomes.push_back(outcome);
    }
  }
  const fs::path file =
      fs::temp_directory_path() / ("dust_study_effects_" + std::to_string(::getpid()) + ".html");
  write_study_report(file, spec, {plan, outcomes}, nullptr);
  const std::string text = text_of(file);
  fs::remove(file);
  CHECK(text.find("<h1>Made</h1>") != std::string::npos);
  CHECK(text.find("data-plots=\"output-0\"") != std::string::npos);
  // The mean over the angles, and a line per angle.
  CHECK(text.find("\"angle 0 deg\"") != std::string::npos);
  CHECK(text.find("\"angle 1 deg\"") != std::string::npos);
  CHECK(text.find("\"y\":[0.5,10.5]") != std::string::npos);
  CHECK(text.find("Change over the levels: 10.00 \\u00b1 0.60 mm.") != std::string::npos);
  // At a glance: the speed's effect stands out of its error, the angle's (1.00 of 0.60) does not.
  CHECK(text.find("over speed 1 to 2 m/s") != std::string::npos);
  CHECK(text.find("<strong>10.00 \u00b1 0.60 mm</strong>") != std::string::npos);
  CHECK(text.find(">1.00 \u00b1 0.60 mm</td>") != std::string::npos);
}
