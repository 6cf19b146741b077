// SPDX-License-Identifier: Apache-2.0
// Every shipped model against the rules of its kind, the same as `engine test-plugin` applies.
#include "contract/contract.hpp"
#include "dust/sdk/vec3.hpp"
#include "engine/memory/counting_new.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>
#include <map>
#include <string>
#include <vector>

using namespace dust;
using contract::Verdict;

namespace {

const registry::Registry& shipped() {
  static const registry::Registry* registry = [] {
    auto* all = new registry::Registry;
    all->load({DUST_TEST_PLUGINS});
    return all;
  }();
  return *registry;
}

std::string full_name(const sdk::ModelInfo& info) { return info.kind + "/" + info.name; }

/// Models that the general rules cannot judge, why, and where they are tested instead.
const std::map<std::string, std::string>& judged_elsewhere() {
  static const std::map<std::string, std::string> list = {
      {"emitter/file", "needs a file: unit/emitter"}};
  return list;
}

using Values = std::map<std::string, sdk::Value>;
using Numbers = std::vector<double>;
using sdk::Vec3;

/// `place` with the sizes of grains told in every way that a scenario may.
std::vector<Values> with_sizes(const Values& place) {
  const Values sizes[] = {
      {{"diameters", Numbers{3e-4, 5e-4}}, {"number_fractions", Numbers{0.7, 0.3}}},
      {{"diameters", Numbers{3e-4, 5e-4}}, {"mass_fractions", Numbers{0.4, 0.6}}},
      {{"distribution", std::string("lognormal")},
       {"median", 4e-4},
       {"spread", 1.3},
       {"smallest", 2e-4},
       {"largest", 8e-4}},
      {{"distribution", std::string("rosin_rammler")},
       {"characteristic_diameter", 4e-4},
       {"exponent", 3.0},
       {"smallest", 2e-4},
       {"largest", 8e-4}}};
  std::vector<Values> sets;
  for (const Values& way : sizes) {
    sets.push_back(place);
    sets.back().insert(way.begin(), way.end());
  }
  return sets;
}

/// The ways of filling a box, then a cylinder.
std::vector<Values> fillings() {
  std::vector<Values> sets =
      with_sizes({{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.01, 0.01, 0.01}}, {"mass", 2e-4}});
  sets.push_back({{"region", std::string("cylinder")},
                  {"from", Vec3{0, 0, 0}},
                  {"to", Vec3{0, 0, 0.02}},
                  {"radius", 0.005},
                  {"end_radius", 0.006},
                  {"count", std::int64_t{200}},
                  {"diameters", Numbers{4e-4}}});
  return sets;
}

/// Values of models whose parameters go together in ways that cannot be guessed: sets that between
/// them use every parameter.
const std::map<std::string, std::vector<Values>>& sets_of_values() {
  static const std::map<std::string, std::vector<Values>> list = {
      {"emitter/feed", with_sizes({})},
      {"emitter/fill", fillings()},
      {"emitter/lattice",
       with_sizes({{"min", Vec3{0, 0, 0}}, {"max", Vec3{0.01, 0.01, 0.01}}, {"spacing", 1e-3}})},
      {"cohesion/liquid_bridge",
       {{{"volume", 1e-13}},
        {{"relative_volume", 0.01}},
        {{"moisture", Numbers{0.01, 0.005}}, {"liquid_density", 990.0}, {"coordination", 7.0}}}},
      {"motion/translate", {{}, {{"ramp", 0.02}}}},
      {"motion/circulate",
       {{{"head", Vec3{0.5, 0, 0}}, {"tail", Vec3{0, 0, 0}}, {"radius", 0.05}, {"speed", 2.0}}}},
      {"motion/oscillate",
       {{{"amplitude", Numbers{1e-3, 2e-3}},
         {"frequency", Numbers{50.0, 31.0}},
         {"phase", Numbers{0.2, 1.0}}}}}};
  return list;
}

std::vector<contract::RuleResult> rule_results_of(const registry::Entry& entry) {
  contract::Options options;
  const auto sets = sets_of_values().find(full_name(entry.info));
  if (sets != sets_of_values().end()) {
    options.given = sets->second.front();
    options.also_given.assign(sets->second.begin() + 1, sets->second.end());
  }
  options.allocations = engine::allocations_so_far;
  return contract::check_model(entry, options);
}

Verdict verdict(const std::string& kind, const std::string& name, const std::string& rule) {
  for (const auto& result : rule_results_of(*shipped().find(kind, name))) {
    if (result.rule.find(rule) != std::string::npos) return result.verdict;
  }
  FAIL("no such rule: " << rule);
  return Verdict::fail;
}

std::string readme_of(const sdk::ModelInfo& info) {
  std::ifstream file(std::string(DUST_SOURCE) + "/plugins/" + info.kind + "/" + info.name +
                     "/README.md");
  return {std::istreambuf_iterator<char>(file), {}};
}

}  // namespace

TEST_CASE("every shipped model shall keep the rules of its kind") {
  std::size_t judged = 0;
  for (const registry::Entry& entry : shipped().entries()) {
    CAPTURE(entry.info.kind);
    CAPTURE(entry.info.name);
    const bool is_general = entry.info.kind != "sensor";  // placed in contract/sensor
    if (!is_general || judged_elsewhere().contains(full_name(entry.info))) continue;
    ++judged;
    const auto results = rule_results_of(entry);
    CHECK(results.size() >= 5);
    for (const auto& result : results) {
      CAPTURE(result.rule);
      CHECK_MESSAGE(result.verdict != Verdict::fail, result.why);
    }
  }
  CHECK(judged >= 20);
}

TEST_CASE("no shipped model shall break a rule with the values that are guessed") {
  // As `engine test-plugin` shows it to whoever takes a shipped model as an example.
  for (const registry::Entry& entry : shipped().entries()) {
    CAPTURE(entry.info.kind);
    CAPTURE(entry.info.name);
    const std::string name = full_name(entry.info);
    if (entry.info.kind == "sensor" || name == "emitter/lattice") continue;  // takes minutes
    if (name == "emitter/file" || name == "emitter/fill" || name == "motion/circulate") {
      // A file; sizes of grains, and how many of them; two pulleys that are apart: what is wanted
      // is said.
      CHECK_THROWS_WITH(contract::check_model(entry),
                        doctest::Contains("give some: --set PARAMETER=VALUE"));
      continue;
    }
    for (const auto& result : contract::check_model(entry)) {
      CAPTURE(result.rule);
      CHECK_MESSAGE(result.verdict != Verdict::fail, result.why);
    }
  }
}

TEST_CASE("rules that can be judged shall be judged, not passed over") {
  CHECK(verdict("drag", "wen_yu", "Stokes") == Verdict::pass);
  CHECK(verdict("drag", "ergun", "Stokes") == Verdict::remark);  // for packed beds
  CHECK(verdict("contact", "hertz_mindlin", "restitution") == Verdict::pass);
  CHECK(verdict("contact", "hertz_mindlin", "allocate") == Verdict::pass);
  CHECK(verdict("contact", "hertz_mindlin", "times") == Verdict::pass);
}

TEST_CASE("every shipped model shall have a page with its limits and an example that names it") {
  for (const registry::Entry& entry : shipped().entries()) {
    const std::string& kind = entry.info.kind;
    const std::map<std::string, std::string> keys = {{"drag", "drag: {"},
                                                     {"voidage", "voidage: {"},
                                                     {"fluid_force", "fluid_forces: [{"},
                                                     {"turbulence", "turbulence: {"},
                                                     {"liberation", "liberation: {"}};
    if (!keys.contains(kind)) continue;
    CAPTURE(entry.info.name);
    const std::string readme = readme_of(entry.info);
    const std::string example = keys.at(kind) + "model: " + entry.info.name;
    const std::string in_a_list = ", {model: " + entry.info.name;
    CHECK((readme.find(example) != std::string::npos ||
           (kind == "fluid_force" && readme.find(in_a_list) != std::string::npos)));
    if (kind != "voidage") CHECK(readme.find("Source:") != std::string::npos);
    CHECK(readme.find("Limits:") != std::string::npos);
  }
}
