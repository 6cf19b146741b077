// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"

namespace dust::contact {

/// A block of `count` histories of `stride` numbers, row by row, becomes `stride` columns of
/// `count`, in the same memory. `count` is a multiple of 8 up to k_batch, `stride` of 4.
void rows_to_columns(double* block, std::size_t count, std::size_t stride);
void columns_to_rows(double* block, std::size_t count, std::size_t stride);

/// Loads pairs [first, first + count) into the first columns and marks in `is_touching` which are
/// near enough. Returns how many are. `count` as above. Brings near what the pairs further on want.
std::size_t gather_persistent(const GatherInput& in, std::size_t first, std::size_t count,
                              BatchColumns& columns);

/// Pairs that have parted are shown to the laws without overlap or motion: none has to expect what
/// lies beyond its range.
void mask_separated(const std::uint8_t* is_touching, std::size_t count, BatchColumns& columns);
/// And whatever a law said of them is taken back, the history with it.
void clear_separated(const std::uint8_t* is_touching, std::size_t count, std::size_t stride,
                     BatchColumns& columns);

}  // namespace dust::contact
