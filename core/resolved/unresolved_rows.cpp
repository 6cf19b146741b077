// SPDX-License-Identifier: Apache-2.0
#include "resolved/unresolved_rows.hpp"

#include <algorithm>

namespace dust::resolved {
namespace {

using particles::GrainRows;

void append(contact::AlignedVector<double>& to, const double* from) {
  to.insert(to.end(), from, from + 4);
}

}  // namespace

const GrainRows& UnresolvedRows::take(const GrainRows& all,
                                      const std::function<bool(std::int32_t)>& is_resolved) {
  row_.clear();
  id_.clear();
  material_.clear();
  weight_.clear();
  for (auto* column : {&position_, &velocity_, &rotation_, &action_, &impulse_, &wind_}) {
    column->clear();
  }
  for (std::size_t n = 0; n < all.count; ++n) {
    if (is_resolved(all.material[n])) continue;
    row_.push_back(n);
    append(position_, all.position_of(n));
    append(velocity_, all.velocity_of(n));
    append(rotation_, all.rotation_of(n));
    append(action_, all.drag_relaxation + 4 * n);
    append(impulse_, all.fluid_impulse + 4 * n);
    if (all.wind != nullptr) append(wind_, all.wind + 4 * n);
    weight_.push_back(all.weight[n]);
    id_.push_back(all.id[n]);
    material_.push_back(all.material[n]);
  }
  rows_ = {.count = row_.size(),
           .position = position_.data(),
           .velocity = velocity_.data(),
           .rotation = rotation_.data(),
           .id = id_.data(),
           .material = material_.data(),
           .weight = weight_.data(),
           .drag_relaxation = action_.data(),
           .fluid_impulse = impulse_.data(),
           .wind = all.wind != nullptr ? wind_.data() : nullptr};
  return rows_;
}

void UnresolvedRows::give_back_drag(const GrainRows& all) const {
  for (std::size_t n = 0; n < row_.size(); ++n) {
    std::copy_n(&action_[4 * n], 4, all.drag_relaxation + 4 * row_[n]);
    if (all.wind != nullptr) std::copy_n(&wind_[4 * n], 4, all.wind + 4 * row_[n]);
  }
}

void UnresolvedRows::give_back_impulses(const GrainRows& all) const {
  for (std::size_t n = 0; n < row_.size(); ++n) {
    std::copy_n(&impulse_[4 * n], 4, all.fluid_impulse + 4 * row_[n]);
  }
}

}  // namespace dust::resolved
