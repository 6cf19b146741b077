// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/reference_trajectories.hpp"

#include "particles/store/reorder_rows.hpp"

#include <vector>

namespace dust::particles {

void ReferenceTrajectories::reorder(std::span<const std::int32_t> order) {
  reorder_rows(rows_, order, 4);
  reorder_rows(velocity_, order, 4);
}

void ReferenceTrajectories::save(sdk::ArchiveWriter& archive) const {
  archive.numbers("start", {rows_.data(), rows_.size()});
  const std::vector<double> velocity(velocity_.begin(), velocity_.end());
  archive.numbers("start_velocity", velocity);
}

void ReferenceTrajectories::load(sdk::ArchiveReader& archive) {
  const auto rows = archive.numbers("start");
  rows_.assign(rows.begin(), rows.end());
  const auto velocity = archive.numbers("start_velocity");
  velocity_.assign(velocity.begin(), velocity.end());
}

}  // namespace dust::particles
