// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch_kernels.hpp"
#include "particles/surfaces.hpp"

#include <cstddef>

/// Contacts that go on when a grain passes from one body to another that is flush with it: the
/// spring of friction and what cohesion remembers pass with it.
namespace dust::particles {

/// A contact of a grain with a surface: its entry in a list.
struct SurfaceContact {
  std::size_t entry = 0;
  const Surface* surface = nullptr;
};

/// Whether a contact that ends at one surface may go on at another: bodies that touch, of one
/// material.
[[nodiscard]] bool may_hand_over(const Surface& from, const Surface& to);

/// Entry `to` of a list goes on with the history of `from`, which ends.
void hand_over(const contact::PairView& list, std::size_t from, std::size_t to);

/// Joins a contact that has begun in this step, or has ended and still stands as touching, with one
/// of `others` of the same grain that has ended or begun instead: one of a pair is looked at after
/// the other, so that either may come first. `reaches(other)`: whether the grain touches there now.
/// Returns whether there was one.
template <class Others, class Reaches>
bool join_handover(const contact::PairView& list, const SurfaceContact& one, Others&& others,
                   const Reaches& reaches) {
  if (one.surface->abutting == nullptr) return false;
  const bool has_ended = list.is_touching[one.entry] != 0;
  for (const SurfaceContact& other : others) {
    if ((list.is_touching[other.entry] != 0) == has_ended) continue;
    const SurfaceContact& from = has_ended ? one : other;
    const SurfaceContact& to = has_ended ? other : one;
    if (!may_hand_over(*from.surface, *to.surface) || reaches(*other.surface) != has_ended)
      continue;
    hand_over(list, from.entry, to.entry);
    return true;
  }
  return false;
}

}  // namespace dust::particles
