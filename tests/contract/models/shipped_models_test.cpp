// SPDX-License-Identifier: Apache-2.0
// Every shipped model against the rules of its kind, the same as `engine test-plugin` applies.
#include "contract/contract.hpp"
#include "engine/counting_new.hpp"

#include <doctest/doctest.h>

#include <fstream>
#include <iterator>

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

std::vector<contract::Finding> findings_of(const registry::Entry& entry) {
  contract::Options options;
  options.allocations = engine::allocations_so_far;
  return contract::check_model(entry, options);
}

Verdict verdict(const std::string& kind, const std::string& name, const std::string& rule) {
  for (const auto& finding : findings_of(*shipped().find(kind, name))) {
    if (finding.rule.find(rule) != std::string::npos) return finding.verdict;
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
  CHECK(shipped().entries().size() >= 20);
  for (const registry::Entry& entry : shipped().entries()) {
    CAPTURE(entry.info.kind);
    CAPTURE(entry.info.name);
    const auto findings = findings_of(entry);
    CHECK(findings.size() >= 5);
    for (const auto& finding : findings) {
      CAPTURE(finding.rule);
      CHECK_MESSAGE(finding.verdict != Verdict::fail, finding.why);
    }
  }
}

TEST_CASE("rules that can be judged shall be judged, not passed over") {
  CHECK(verdict("drag", "wen_yu", "Stokes") == Verdict::pass);
  CHECK(verdict("drag", "ergun", "Stokes") == Verdict::remark);  // for packed beds
  CHECK(verdict("contact", "hertz_mindlin", "restitution") == Verdict::pass);
  CHECK(verdict("contact", "hertz_mindlin", "allocate") == Verdict::pass);
  CHECK(verdict("contact", "hertz_mindlin", "times") == Verdict::pass);
  CHECK(verdict("emitter", "feed", "mass") == Verdict::pass);
  CHECK(verdict("emitter", "feed", "parameter matters") == Verdict::pass);
}

TEST_CASE("every shipped model shall have a page with its limits and an example that names it") {
  for (const registry::Entry& entry : shipped().entries()) {
    const std::string& kind = entry.info.kind;
    if (kind != "drag" && kind != "voidage") continue;
    CAPTURE(entry.info.name);
    const std::string readme = readme_of(entry.info);
    CHECK(readme.find(kind + ": {model: " + entry.info.name) != std::string::npos);
    if (kind == "drag") CHECK(readme.find("Source:") != std::string::npos);
    CHECK(readme.find("Limits:") != std::string::npos);
  }
}
