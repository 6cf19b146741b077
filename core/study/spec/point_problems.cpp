// SPDX-License-Identifier: Apache-2.0
#include "study/spec/point_problems.hpp"

#include "setup/mark.hpp"
#include "study/spec/axes.hpp"

#include <algorithm>
#include <iterator>

namespace dust::study {
namespace {

/// Without digits: what is told of another value of the same quantity.
std::string without_numbers(const std::string& text) {
  std::string rest;
  std::copy_if(text.begin(), text.end(), std::back_inserter(rest),
               [](char c) { return c != '.' && (c < '0' || c > '9'); });
  return rest;
}

/// "point 3; " or "points 1, 4 to 8, 10; ": those of ascending combinations, counted from 1.
std::string points_text(const std::vector<std::size_t>& of, std::size_t replicates) {
  if (replicates == 0) return "";
  std::string text;
  for (std::size_t n = 0; n < of.size();) {
    std::size_t last = n;
    while (last + 1 < of.size() && of[last + 1] == of[last] + 1) ++last;
    const std::size_t begin = of[n] * replicates + 1;
    const std::size_t end = (of[last] + 1) * replicates;
    text += (text.empty() ? "" : ", ") + std::to_string(begin);
    if (end > begin) text += (end > begin + 1 ? " to " : ", ") + std::to_string(end);
    n = last + 1;
  }
  return (of.size() * replicates == 1 ? "point " : "points ") + text + "; ";
}

}  // namespace

void PointProblems::add(const std::vector<Problem>& of_one, std::size_t n) {
  std::map<std::string, int> counts;
  for (const Problem& problem : of_one) {
    const std::string text = scenario::place(problem.where) + without_numbers(problem.text);
    const auto [at, is_new] = index_.try_emplace({text, counts[text]++}, groups_.size());
    if (is_new) groups_.push_back({problem, false, {}});
    Group& group = groups_[at->second];
    group.has_other_numbers = group.has_other_numbers || problem.text != group.problem.text;
    if (group.of.empty() || group.of.back() != n) group.of.push_back(n);
  }
}

void PointProblems::report(const Points& points,
                           const std::function<void(const Problem&)>& to) const {
  for (const auto& [problem, has_other_numbers, of] : groups_) {
    const bool is_of_all = of.size() == points.combinations;
    if (is_of_all && !has_other_numbers) {
      to(problem);
      continue;
    }
    std::string which = is_of_all ? "all points; " : points_text(of, points.replicates);
    if (has_other_numbers) {
      which += "numbers of the first, ";
    } else if (of.size() > 1) {
      which += "the first ";
    }
    to({problem.where, problem.text + " (" + which + "with " + points.values_of(of.front()) + ")"});
  }
}

std::string values_text(const Spec& spec, const std::vector<std::size_t>& levels) {
  std::string text;
  for (std::size_t a = 0; a < spec.axes.size(); ++a) {
    const Level& level = spec.axes[a].levels[levels[a]];
    if (!level.label.empty()) {
      text += (text.empty() ? "" : ", ") + std::string("case: ") + level.label;
      continue;
    }
    for (const Setting& s : level.settings) {
      text += (text.empty() ? "" : ", ") + s.path + ": " + value_text(s.value);
    }
  }
  return text;
}

}  // namespace dust::study
