// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/contract.hpp"
#include "dust/sdk/model.hpp"
#include "engine/memory/counting_new.hpp"

#include <doctest/doctest.h>

#include <map>
#include <set>
#include <string>
#include <utility>
#include <vector>

/// Models made to break a rule, and what is said of them.
namespace wrong {

using dust::contract::RuleResult;
using dust::contract::Verdict;
namespace sdk = dust::sdk;

inline sdk::ModelInfo described(const char* kind, sdk::ParameterSchema schema = {}) {
  return {.kind = kind,
          .name = "wrong",
          .version = "1.0",
          .summary = "Wrong.",
          .equation = "0",
          .source = "nobody",
          .parameters = std::move(schema)};
}

/// The findings on a model made by `make` from its values.
inline std::vector<RuleResult> rule_results_of(sdk::ModelInfo info, sdk::ModelFactory make,
                                               std::map<std::string, sdk::Value> given = {}) {
  dust::contract::Options options;
  options.given = std::move(given);
  options.allocations = dust::engine::allocations_so_far;
  return dust::contract::check_model({std::move(info), std::move(make), {}}, options);
}

/// The findings on a model without parameters.
template <class Model, class... Arguments>
std::vector<RuleResult> rule_results_on(Arguments... arguments) {
  return rule_results_of(described(Model::k_kind), [=](std::span<const sdk::Value>) {
    return std::make_unique<Model>(arguments...);
  });
}

/// Keeps count of the rules of one kind that were seen to be broken.
class Seen {
 public:
  /// What the rule whose sentence holds `rule` says; "" if it is kept.
  std::string broken(const std::vector<RuleResult>& results, const std::string& rule) {
    return reported(results, rule, Verdict::fail);
  }
  /// The same of a rule that remarks and does not fail.
  std::string remarked(const std::vector<RuleResult>& results, const std::string& rule) {
    return reported(results, rule, Verdict::remark);
  }
  /// No rule is left that no model has broken. Rules that are one and the same for all kinds are
  /// broken by drag laws (`also_common`).
  void check_complete(bool also_common = false) const {
    static const std::set<std::string> common = {"says what it is: equation, source, parameters",
                                                 "gives finite numbers, all of them",
                                                 "gives the same bits when asked again",
                                                 "gives the same bits however its batch is split",
                                                 "every parameter matters",
                                                 "is homogeneous in its dimensions",
                                                 "does not allocate in the hot call"};
    CHECK(!all_.empty());
    for (const std::string& rule : all_) {
      if (!also_common && common.contains(rule)) continue;
      CAPTURE(rule);
      CHECK_MESSAGE(broken_.contains(rule), "no model of these breaks it");
    }
  }

 private:
  std::string reported(const std::vector<RuleResult>& results, const std::string& rule,
                       Verdict verdict) {
    std::string why;
    bool is_there = false;
    for (const RuleResult& result : results) {
      all_.insert(result.rule);
      if (is_there || result.rule.find(rule) == std::string::npos) continue;
      is_there = true;
      if (result.verdict != verdict) continue;
      broken_.insert(result.rule);
      why = result.why;
    }
    if (!is_there) FAIL("no such rule: " << rule);
    return why;
  }

  std::set<std::string> all_, broken_;
};

}  // namespace wrong
