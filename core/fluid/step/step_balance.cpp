// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/step_balance.hpp"

#include "fluid/parallel.hpp"

namespace dust::fluid {

void StepBalance::make() {
  balance_ = std::make_unique<MomentumBalance>(grid_, geometry_, properties_);
  mean_pressure_.assign(grid_.size, 0.0);
}

void StepBalance::begin(const FaceField& u, StepVoidFraction& void_fraction,
                        const FaceField& source, double step) {
  if (!balance_) make();
  balance_->begin(u, void_fraction, source, step);
}

void StepBalance::add_pressure(const CellField& pressure, double share, bool is_first) {
  for_rows(grid_.count[0], grid_.count[1], grid_.count[2], [&](int j, int k) {
    const std::ptrdiff_t o = grid_.index(0, j, k);
    for (int i = 0; i < grid_.count[0]; ++i) {
      const double before = is_first ? 0.0 : mean_pressure_[o + i];
      mean_pressure_[o + i] = before + share * pressure[o + i];
    }
  });
}

void StepBalance::save(sdk::ArchiveWriter& archive) const {
  archive.integer("has_book", balance_ ? 1 : 0);
  if (balance_) balance_->save(archive);
}

void StepBalance::load(sdk::ArchiveReader& archive) {
  if (archive.integer("has_book") == 0) return;
  make();
  balance_->load(archive);
}

}  // namespace dust::fluid
