// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/diagnostics.hpp"
#include "study/spec/spec.hpp"

#include <cstddef>
#include <functional>
#include <map>
#include <string>
#include <utility>
#include <vector>

namespace dust::study {

/// Problems of the scenarios of a study's points: the same of many points is reported once, with
/// those that it is of unless it is of all.
class PointProblems {
 public:
  using Problem = scenario::Diagnostics::Problem;
  /// Of combination `n` of levels: those of one scenario. Problems that differ by their numbers
  /// alone, in other scenarios, count as the same one.
  void add(const std::vector<Problem>& of_one, std::size_t n);
  struct Points {
    std::size_t combinations = 0;
    std::size_t replicates = 0;                         ///< points of each; 0: they have no numbers
    std::function<std::string(std::size_t)> values_of;  ///< what makes one
  };
  /// All, the first of the same ones with what makes its point.
  void report(const Points& points, const std::function<void(const Problem&)>& to) const;

 private:
  struct Group {
    Problem problem;              ///< as of the first
    bool has_other_numbers;       ///< in one of the others
    std::vector<std::size_t> of;  ///< combinations, ascending
  };
  std::vector<Group> groups_;
  std::map<std::pair<std::string, int>, std::size_t> index_;  ///< by text and count in a scenario
};

/// Level by level what a combination sets: `a.b: 1 mm, case: wide`.
std::string values_text(const Spec& spec, const std::vector<std::size_t>& levels);

}  // namespace dust::study
