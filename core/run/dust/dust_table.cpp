// SPDX-License-Identifier: Apache-2.0
#include "run/dust/dust_table.hpp"

#include <utility>

namespace dust::run {

DustTable::DustTable(const fluid::Grid& grid, std::vector<double> diameters, double density)
    : grid_(grid),
      diameters_(std::move(diameters)),
      density_(density),
      concentration_(grid.size, 0.0),
      columns_(diameters_.size()) {
  const auto& n = grid.count;
  for (std::vector<float>& column : columns_) {
    column.assign(static_cast<std::size_t>(n[0]) * n[1] * n[2], 0.0f);
    spans_.emplace_back(column);
  }
}

void DustTable::take(const airborne::DustField& field, const fluid::CellField& volume) {
  const auto& n = grid_.count;
  for (std::size_t c = 0; c < columns_.size(); ++c) {
    field.concentration(c, volume, concentration_);
    auto to = columns_[c].begin();
    for (int k = 0; k < n[2]; ++k) {
      for (int j = 0; j < n[1]; ++j) {
        const std::ptrdiff_t row = grid_.index(0, j, k);
        for (int i = 0; i < n[0]; ++i) {
          *to++ = static_cast<float>(concentration_[static_cast<std::size_t>(row + i)]);
        }
      }
    }
  }
}

}  // namespace dust::run
