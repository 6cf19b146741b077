// SPDX-License-Identifier: Apache-2.0
#include "contract/rule_runner.hpp"

#include "registry/crash_notice.hpp"

#include <map>

namespace dust::contract {

void RuleRunner::rule(const std::string& rule, const std::function<void()>& check) {
  RuleResult result{rule, Verdict::pass, {}};
  const registry::Asking asking(who_.c_str(), " was tested by the rule: ", rule.c_str());
  try {
    check();
  } catch (const Remark& remark) {
    result = {rule, Verdict::remark, remark.what()};
  } catch (const Violation& violation) {
    result = {rule, Verdict::fail, violation.what()};
  } catch (const std::exception& problem) {
    result = {rule, Verdict::fail, std::string("it throws: ") + problem.what()};
  } catch (...) {
    result = {rule, Verdict::fail, "it throws something that is no std::exception"};
  }
  results_.push_back(std::move(result));
}

std::uint64_t RuleRunner::allocations(const std::function<void()>& call) const {
  if (allocations_ == nullptr) return call(), 0;
  const std::uint64_t before = allocations_();
  call();
  return allocations_() - before;
}

const Kind* find_kind(const std::string& name) {
  static const std::map<std::string, Kind> kinds = {
      {"contact", contact_kind()},         {"rolling", rolling_kind()},
      {"cohesion", cohesion_kind()},       {"drag", drag_kind()},
      {"fluid_force", fluid_force_kind()}, {"voidage", voidage_kind()},
      {"boundary", boundary_kind()},       {"turbulence", turbulence_kind()},
      {"liberation", liberation_kind()},   {"emitter", emitter_kind()},
      {"motion", motion_kind()},           {"sensor", sensor_kind()}};
  const auto found = kinds.find(name);
  return found == kinds.end() ? nullptr : &found->second;
}

}  // namespace dust::contract
