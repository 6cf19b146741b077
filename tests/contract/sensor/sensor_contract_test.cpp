// SPDX-License-Identifier: Apache-2.0
// What every sensor owes its users. A new sensor is added to `subjects` with one set of parameters
// and one other value for each of them.
#include "contract/contract.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

using namespace dust;
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
       {{"min", Vec3{0.1, 0, 0.15}}, {"max", Vec3{0.2, 0.011, 0.17}}},
       {{"min", Vec3{0.145, 0, 0.15}},
        {"max", Vec3{0.145, 0.011, 0.17}},
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
      {"belt_load",
       {{"point", Vec3{0.05, 0.005, 0.02}},
        {"direction", Vec3{1, 0, 0}},
        {"length", 0.2},
        {"width", 0.02},
        {"height", 0.2}},
       {{"point", Vec3{0.08, 0.004, 0.03}},
        {"direction", Vec3{1, 0.02, 0}},
        {"length", 0.1},
        {"width", 0.005},
        {"height", 0.1},
        {"belt_speed", 2.0},
        {"up", Vec3{0.1, 0, 1}},
        {"steady_after", 0.03}}},
      {"spillage",
       {{"min", Vec3{0.05, 0, 0.1}}, {"max", Vec3{0.25, 0.011, 0.1}}},
       {{"min", Vec3{0.19, 0, 0.1}},
        {"max", Vec3{0.15, 0.011, 0.1}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"residence_time",
       {{"min", Vec3{0.1, 0, 0.05}}, {"max", Vec3{0.2, 0.011, 0.2}}},
       {{"min", Vec3{0.12, 0, 0.06}},
        {"max", Vec3{0.17, 0.011, 0.18}},
        {"from", std::string("birth")},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"blockage",
       {{"min", Vec3{0.1, 0, 0.05}},
        {"max", Vec3{0.2, 0.011, 0.2}},
        {"largest_mass", 1e-6},
        {"largest_growth", 1e-9}},
       {{"min", Vec3{0.12, 0, 0.06}},
        {"max", Vec3{0.17, 0.011, 0.18}},
        {"largest_mass", 2e-5},
        {"largest_growth", 1e9},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"stream_section",
       {{"point", Vec3{0.15, 0, 0.1}},
        {"normal", Vec3{0, 0, -1}},
        {"min", Vec3{0.05, 0, 0.1}},
        {"max", Vec3{0.25, 0.011, 0.1}},
        {"bulk_density", 1600.0}},
       {{"point", Vec3{0.15, 0, 0.11}},
        {"normal", Vec3{0, 0, 1}},
        {"min", Vec3{0.13, 0, 0.1}},
        {"max", Vec3{0.14, 0.011, 0.1}},
        {"bulk_density", 1000.0},
        {"belt_velocity", Vec3{1, 0, 0}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"wear",
       {{"min", Vec3{0, 0, 0}},
        {"max", Vec3{0.33, 0.011, 0.35}},
        {"cell", 0.01},
        {"coefficient", 1e-3},
        {"hardness", 4e9}},
       {{"walls", std::vector<std::string>{"chute"}},
        {"min", Vec3{0.02, 0, 0.1}},
        {"max", Vec3{0.03, 0.011, 0.35}},
        {"cell", 0.02},
        {"coefficient", 2e-3},
        {"hardness", 2e9},
        {"steady_after", 0.03}}},
      {"angle_of_repose",
       {{"form", std::string("planar")}, {"coarser_than", 250e-6}},
       {{"form", std::string("crater")},
        {"centre", Vec3{0.2, 0, 0.1}},
        {"direction", Vec3{0, 1, 0}},
        {"min", Vec3{0.12, 0, 0}},
        {"max", Vec3{0.17, 0.011, 0.35}},
        {"from_share", 0.5},
        {"to_share", 0.5},
        {"cell", 0.01},
        {"steady_after", 0.03},
        {"coarser_than", 400e-6},
        {"finer_than", 500e-6}}},
      {"coordination",
       {},
       {{"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6},
        {"with_walls", false}}},
      {"discharge",
       {{"centre", Vec3{0.14, 0.005, 0.16}}, {"hole", 0.04}},
       {{"centre", Vec3{0.14, 0.005, 0.14}},
        {"hole", 0.05},
        {"direction", Vec3{1, 0, 0}},
        {"reach", 0.004},
        {"opened_at", 0.01},
        {"from_share", 0.5},
        {"to_share", 0.6},
        {"bulk_density", 1500.0},
        {"grain_diameter", 1e-3},
        {"beverloo_c", 0.7},
        {"beverloo_k", 2.0}}},
      {"kinetic_energy",
       {},
       {{"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6},
        {"settled_below", 1.0}}},
      {"segregation",
       {{"split", 100e-6}, {"min", Vec3{0, 0, 0}}, {"max", Vec3{0.33, 0.011, 0.35}}},
       {{"split", 400e-6},
        {"min", Vec3{0.1, 0, 0}},
        {"max", Vec3{0.2, 0.011, 0.35}},
        {"cells", Vec3{8, 1, 2}},
        {"direction", Vec3{1, 0, 0}},
        {"steady_after", 0.03},
        {"coarser_than", 20e-6},
        {"finer_than", 500e-6}}},
      {"size_distribution",
       {},
       {{"min", Vec3{0.12, 0, 0}},
        {"max", Vec3{0.17, 0.011, 0.35}},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"stress",
       {{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.33, 0.011, 0.35}}},
       {{"min", Vec3{0.05, 0, 0}},
        {"max", Vec3{0.2, 0.011, 0.35}},
        {"cells", Vec3{3, 1, 2}},
        {"steady_after", 0.03}}},
      {"low_pressure",
       {{"largest_solids_fraction", 0.2}},
       {{"count", std::int64_t{1}},
        {"averaging_after", 0.04},
        {"average_along", Vec3{0, 1, 0}},
        {"separation", 0.05},
        {"block", 0.01},
        {"clearance", 0.12},
        {"largest_solids_fraction", 0.5},
        {"min", Vec3{0.1, 0, 0}},
        {"max", Vec3{0.1, 0.011, 0.35}}}},
      {"bed_height",
       {{"base", Vec3{0, 0, 0}}},
       {{"base", Vec3{0, 0, 0.01}},
        {"direction", Vec3{1, 0, 0}},
        {"share", 0.5},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"bubbles",
       {{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.33, 0.011, 0.35}}, {"threshold", 0.9}},
       {{"min", Vec3{0.05, 0, 0}},
        {"max", Vec3{0.2, 0.011, 0.09}},
        {"threshold", 0.8},
        {"direction", Vec3{1, 0, 0}},
        {"smallest", 0.1},
        {"steady_after", 0.03}}},
      {"settling_velocity",
       {{"base", Vec3{0, 0, 0}}, {"levels", std::vector<double>{0.1, 0.15}}},
       {{"base", Vec3{0, 0, 0.01}},
        {"direction", Vec3{1, 0, 0}},
        {"levels", std::vector<double>{0.12}},
        {"until", 0.2},
        {"steady_after", 0.03},
        {"coarser_than", 100e-6},
        {"finer_than", 500e-6}}},
      {"minimum_fluidisation",
       {{"from", Vec3{0, 0, 0.01}}, {"to", Vec3{0, 0, 0.3}}},
       {{"from", Vec3{0, 0, 0.1}},
        {"to", Vec3{0, 0, 0.2}},
        {"after", 0.06},
        {"fixed_share", 0.3},
        {"fluid_factor", 2.0}}},
      {"air_flow",
       {{"min", Vec3{0, 0, 0.1}}, {"max", Vec3{0.3, 0.011, 0.1}}},
       {{"min", Vec3{0.1, 0, 0.12}}, {"max", Vec3{0.2, 0.011, 0.12}}, {"steady_after", 0.03}}},
      {"pressure_drop",
       {{"from", Vec3{0, 0, 0.01}}, {"to", Vec3{0, 0, 0.3}}},
       {{"from", Vec3{0, 0, 0.1}},
        {"to", Vec3{0, 0, 0.2}},
        {"between", std::string("points")},
        {"steady_after", 0.03}}},
      {"exposure",
       {{"points", std::vector<Vec3>{{0.1, 0.005, 0.1}, {0.2, 0.005, 0.2}}}},
       {{"points", std::vector<Vec3>{{0.3, 0.005, 0.1}, {0.2, 0.005, 0.3}}},
        {"steady_after", 0.03}}},
      {"probe",
       {{"from", Vec3{0, 0.005, 0.1}},
        {"to", Vec3{0.3, 0.005, 0.1}},
        {"count", std::int64_t{3}},
        {"across", Vec3{0, 0, 0.1}},
        {"count_across", std::int64_t{2}}},
       {{"from", Vec3{0.1, 0.005, 0.1}},
        {"to", Vec3{0.3, 0.005, 0.3}},
        {"count", std::int64_t{4}},
        {"across", Vec3{0, 0, 0.2}},
        {"count_across", std::int64_t{3}},
        {"steady_after", 0.03}}},
      {"vorticity",
       {},
       {{"min", Vec3{0.1, 0, 0.1}}, {"max", Vec3{0.2, 0.011, 0.2}}, {"steady_after", 0.03}}},
      {"wall_shear",
       {{"side", std::string("bottom")}},
       {{"side", std::string("left")}, {"wall_velocity", Vec3{0.1, 0, 0}}, {"steady_after", 0.03}}},
      {"plane_flux",
       {{"point", Vec3{0.15, 0, 0.1}},
        {"normal", Vec3{1, 0, 0}},
        {"min", Vec3{0.15, 0, 0}},
        {"max", Vec3{0.15, 0.011, 0.35}}},
       {{"point", Vec3{0.16, 0, 0.1}},
        {"normal", Vec3{-1, 0, 0}},
        {"min", Vec3{0.15, 0.005, 0}},
        {"max", Vec3{0.15, 0.005, 0.35}},
        {"role", std::string("opening")},
        {"towards", std::string("product")},
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
        {"finer_than", 500e-6}}},
      {"wall_load",
       {{"walls", std::vector<std::string>{"belt"}}},
       {{"walls", std::vector<std::string>{"chute"}},
        {"about", Vec3{0.1, 0, 0.2}},
        {"averaging_after", 0.03},
        {"least_energy", 1e-9},
        {"largest_energy", 1e-8},
        {"bins", std::int64_t{3}}}}};
  return list;
}

const registry::Registry& shipped() {
  static const registry::Registry* registry = [] {
    auto* all = new registry::Registry;
    all->load({DUST_TEST_PLUGINS});
    return all;
  }();
  return *registry;
}

}  // namespace

TEST_CASE("every shipped sensor shall be placed here where it sees the standard scene") {
  for (const registry::Entry& entry : shipped().entries()) {
    if (entry.info.kind != "sensor") continue;
    CAPTURE(entry.info.name);
    CHECK(std::any_of(subjects().begin(), subjects().end(),
                      [&](const Subject& s) { return s.name == entry.info.name; }));
  }
}

TEST_CASE("every sensor shall keep the rules of sensors") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    const registry::Entry* entry = shipped().find("sensor", subject.name);
    REQUIRE(entry != nullptr);
    // A model that nobody varies is not known to heed its parameters.
    for (const sdk::Parameter& p : entry->info.parameters) {
      CAPTURE(p.name);
      REQUIRE(subject.others.contains(p.name));
    }
    const auto rule_results = contract::check_model(
        *entry, {.given = subject.parameters, .also_given = {}, .others = subject.others});
    CHECK(rule_results.size() >= 9);
    for (const contract::RuleResult& rule_result : rule_results) {
      CAPTURE(rule_result.rule);
      CHECK_MESSAGE(rule_result.verdict == contract::Verdict::pass, rule_result.why);
    }
  }
}

TEST_CASE("the page of every sensor shall hold an example that names it") {
  for (const Subject& subject : subjects()) {
    CAPTURE(subject.name);
    std::ifstream readme(std::string(DUST_SOURCE) + "/plugins/sensor/" + subject.name +
                         "/README.md");
    const std::string text{std::istreambuf_iterator<char>(readme), {}};
    CHECK(text.find("model: " + subject.name) != std::string::npos);
  }
}
