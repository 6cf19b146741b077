// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/aligned.hpp"
#include "particles/grain_rows.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <vector>

namespace dust::resolved {

/// The rows of the grains that are not resolved, in copies that stand one after another: what drag
/// laws and the void fraction may see. Of use where both kinds are in one run.
class UnresolvedRows {
 public:
  /// Reads the rows; valid until they change.
  const particles::GrainRows& take(const particles::GrainRows& all,
                                   const std::function<bool(std::int32_t)>& is_resolved);
  /// Writes back what the fluid does to the grains.
  void give_back_drag(const particles::GrainRows& all) const;
  /// Writes back the impulses, which who reads them sets to zero.
  void give_back_impulses(const particles::GrainRows& all) const;

 private:
  std::vector<std::size_t> row_;  ///< in all rows
  contact::AlignedVector<double> position_, velocity_, rotation_, action_, impulse_, wind_;
  std::vector<double> weight_;
  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  particles::GrainRows rows_;
};

}  // namespace dust::resolved
