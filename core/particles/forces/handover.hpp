// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "particles/surfaces.hpp"

#include <cstddef>

/// Contacts that go on when a grain passes from one body to another that is flush with it: the
/// spring of friction and what cohesion remembers pass with it.
namespace dust::particles {

/// Whether a contact that ends at one surface may go on at another: bodies that touch, of one
/// material.
[[nodiscard]] bool may_hand_over(const Surface& from, const Surface& to);

/// Entry `to` of a list goes on with the history of `from`, which ends.
void hand_over(const contact::PairView& list, std::size_t from, std::size_t to);

}  // namespace dust::particles
