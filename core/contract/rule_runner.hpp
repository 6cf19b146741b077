// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contract/contract.hpp"
#include "contract/input/units.hpp"
#include "dust/sdk/model.hpp"

#include <functional>
#include <memory>
#include <stdexcept>
#include <string>
#include <utility>
#include <vector>

namespace dust::contract {

/// A rule that is broken, with the reason; caught by the rule runner.
class Violation : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// A rule that could not be judged, or no fault but worth knowing.
class Remark : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

/// Applies rules and keeps the results.
class RuleRunner {
 public:
  /// `who` is the model, for the notice of a crash.
  explicit RuleRunner(std::uint64_t (*counter)(), std::string who = "a model")
      : allocations_(counter), who_(std::move(who)) {}

  /// `rule` is a sentence "it shall ..."; `check` throws Violation or Remark, or returns.
  void rule(const std::string& rule, const std::function<void()>& check);
  /// Number of allocations while `call` runs; 0 where they are not watched.
  [[nodiscard]] std::uint64_t allocations(const std::function<void()>& call) const;
  [[nodiscard]] bool watches_allocations() const { return allocations_ != nullptr; }

  [[nodiscard]] const std::vector<RuleResult>& results() const { return results_; }

 private:
  std::vector<RuleResult> results_;
  std::uint64_t (*allocations_)();
  std::string who_;
};

/// A number a model gave, with its name for messages.
struct Observation {
  std::string name;
  double value = 0.0;
  sdk::Dimension dimension;
  bool has_dimension = true;  ///< false: the model's own, for example history columns
};
using Observations = std::vector<Observation>;

/// How a standard scene is shown to a model.
struct TestVariant {
  Units units;                         ///< the scene and all parameters are given in these units
  std::size_t batch = 0;               ///< rows per call, 0 = all at once
  const RuleRunner* runner = nullptr;  ///< watches allocations in the hot call, if set
};

/// Makes the model with its parameters in the given units.
using Maker = std::function<std::unique_ptr<sdk::Model>(const Units&)>;

/// What the rules need to know of a kind.
struct Kind {
  /// Everything the model gives in a standard scene. Throws Violation for a fault in how it writes.
  std::function<Observations(const Maker&, const TestVariant&)> observe;
  std::vector<std::size_t> batches;  ///< ways to split; empty = the kind has no batches
  Units other_units;                 ///< in which the model must give the same quantities
  bool is_hot = false;               ///< the call must not allocate
  /// Whether the standard scene comes to where the model looks; empty = every scene does.
  std::function<bool(const Maker&)> is_met;
  /// Rules of this kind alone.
  std::function<void(const Maker&, const ModelUnderTest&, RuleRunner&)> rules;
};

/// The kind's rules, or null for a kind that has none yet.
const Kind* find_kind(const std::string& name);

Kind contact_kind();
Kind rolling_kind();
Kind cohesion_kind();
Kind drag_kind();
Kind fluid_force_kind();
Kind voidage_kind();
Kind boundary_kind();
Kind emitter_kind();
Kind motion_kind();
Kind sensor_kind();
Kind turbulence_kind();
Kind liberation_kind();

}  // namespace dust::contract
