// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.hpp"
#include "registry/registry.hpp"

#include <cstdint>
#include <map>
#include <string>
#include <vector>

/// What every model owes the engine and its users, checked from outside: the tests run it on the
/// shipped models, `engine test-plugin` on any.
namespace dust::contract {

enum class Verdict {
  pass,
  remark,  ///< kept as far as it can be judged, or no fault but worth knowing
  fail
};

/// One rule applied to one model.
struct RuleResult {
  std::string rule;
  Verdict verdict = Verdict::pass;
  std::string why;  ///< empty for a plain pass
};

/// Values for the parameters of a model; those not given are guessed from the schema.
struct Options {
  std::map<std::string, sdk::Value> given;
  /// More sets of values, each as complete as `given`, for parameters that matter only beside
  /// others (the median of a distribution, where another takes a table).
  std::vector<std::map<std::string, sdk::Value>> also_given;
  /// Another value per parameter that must change what the model gives.
  std::map<std::string, sdk::Value> others;
  /// Number of allocations of this thread so far; null = allocation is not watched.
  std::uint64_t (*allocations)() = nullptr;
};

/// A model that could not be made, for want of values of its parameters.
class NotTested : public base::UserError {
 public:
  NotTested(const sdk::ModelInfo& info, const std::string& why)
      : base::UserError("error: " + info.kind + "/" + info.name + ": " + why), why_(why) {}
  /// What is wanting, and what to write.
  [[nodiscard]] const std::string& why() const { return why_; }

 private:
  std::string why_;
};

/// Every rule of the model's kind, in a fixed order. Never throws for what the model does wrong.
/// Throws NotTested when required parameters can be neither guessed nor were given.
std::vector<RuleResult> check_model(const registry::Entry& entry, const Options& options = {});

}  // namespace dust::contract
