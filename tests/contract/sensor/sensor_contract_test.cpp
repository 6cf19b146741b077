// SPDX-License-Identifier: Apache-2.0
// The shipped sensors, placed where the standard stream meets them, against the rules of their
// kind. A new sensor is added to `subjects` with one set of parameters and one other value for
// each.
#include "contract/contract.hpp"
#include "support/sensor_bench.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <iterator>

using namespace dust;
using namespace dust::test;
using sdk::Value;
using sdk::Vec3;

namespace {

struct Subject {
  std::string name;
  std::map<std::string, Value> parameters;
  std::map<std::string, Value> others;  ///< a value per parameter that must change some figure
};

const std::vector<Subject>& subjects() {
  static const std::vector<Subject> list = {
      {"box_concentration",
       {{"min", Vec3{0.1, 0, 0.02}}, {"max", Vec3{0.2, 0.011, 0.2}}},
       {{"min", Vec3{0.12, 0, 0.02}},
        {"max", Vec3{0.17, 0.011, 0.2}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"carry_back",
       {{"min", Vec3{0, 0, 0.1}}, {"max", Vec3{0.08, 0.011, 0.12}}},
       {{"min", Vec3{0.02, 0, 0.1}},
        {"max", Vec3{0.06, 0.011, 0.12}},
        {"direction", Vec3{1, 0, 0}},
        {"faster_than", 0.5},
        {"steady_after", 0.03}}},
      {"low_pressure",
       {},
       {{"count", std::int64_t{1}},
        {"averaging_after", 0.04},
        {"average_along", Vec3{0, 1, 0}},
        {"separation", 0.05},
        {"block", 0.01}}},
      {"plane_flux",
       {{"point", Vec3{0.15, 0, 0.1}},
        {"normal", Vec3{1, 0, 0}},
        {"min", Vec3{0.15, 0, 0}},
        {"max", Vec3{0.15, 0.011, 0.35}}},
       {{"point", Vec3{0.16, 0, 0.1}},
        {"normal", Vec3{-1, 0, 0}},
        {"min", Vec3{0.15, 0.005, 0}},
        {"max", Vec3{0.15, 0.005, 0.35}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"trajectory",
       {{"from", Vec3{0.08, 0, 0.2}}, {"drops", std::vector<double>{0.02, 0.1}}},
       {{"from", Vec3{0.09, 0, 0.2}},
        {"drops", std::vector<double>{0.03, 0.1}},
        {"along", Vec3{-1, 0, 0}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}}};
  return list;
}

}  // namespace

TEST_CASE("every sensor shall keep the rules of its kind where it sees something") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const SensorKind kind = load_sensor(subject.name);
    contract::Options options;
    options.given = subject.parameters;
    options.others = subject.others;
    for (const sdk::Parameter& p : kind.info.parameters) CHECK(subject.others.contains(p.name));
    for (const auto& finding : contract::check_model({kind.info, kind.factory, {}}, options)) {
      CAPTURE(finding.rule);
      CHECK_MESSAGE(finding.verdict == contract::Verdict::pass, finding.why);
    }
  }
}

TEST_CASE("every shipped sensor shall be placed here and have an example") {
  std::size_t shipped = 0;
  for (const auto& entry : std::filesystem::directory_iterator(DUST_TEST_PLUGINS)) {
    shipped += entry.path().filename().string().starts_with("sensor_");
  }
  CHECK(subjects().size() == shipped);
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    std::ifstream readme(std::string(DUST_SOURCE) + "/plugins/sensor/" + subject.name +
                         "/README.md");
    const std::string text{std::istreambuf_iterator<char>(readme), {}};
    CHECK(text.find("model: " + subject.name) != std::string::npos);
  }
}
