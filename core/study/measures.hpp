// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/plan.hpp"
#include "study/quantities.hpp"

#include <set>
#include <string>
#include <vector>

namespace dust::study {

/// Checks that what a study measures is told by every run, and in a unit that fits.
class MeasureCheck {
 public:
  MeasureCheck(const Spec& spec, scenario::Diagnostics& diagnostics)
      : spec_(spec), diagnostics_(diagnostics) {}

  /// Looks at the quantities of one point; each measure is told of once.
  void see(const std::vector<Quantity>& known);
  /// The columns, once a point has been seen; units that do not fit are told.
  std::vector<OutputColumn> columns();

 private:
  void check(const Measure& measure, const std::string& quantity,
             const std::vector<Quantity>& known);

  const Spec& spec_;
  scenario::Diagnostics& diagnostics_;
  std::vector<Quantity> first_;  ///< of the first point
  std::set<std::string> reported_;
};

}  // namespace dust::study
