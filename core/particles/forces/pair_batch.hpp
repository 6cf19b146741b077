// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "contact/batch_kernels.hpp"
#include "particles/pair_law_table.hpp"

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// A batch of contacts of one law between particles: the columns that the laws are evaluated on,
/// and which pairs of a list stand in them.
struct PairBatch {
  const PairLaws& law;
  const contact::PairView& pairs;
  contact::BatchColumns& columns;
  std::size_t count = 0;
  std::size_t first = 0;  ///< entry of the first contact, where they stand in order
  const std::int32_t* contacts = nullptr;  ///< entry of each; null: they stand in order

  /// Of contact q in the list.
  [[nodiscard]] std::size_t entry(std::size_t q) const {
    return contacts == nullptr ? first + q : static_cast<std::size_t>(contacts[q]);
  }
};

}  // namespace dust::particles
