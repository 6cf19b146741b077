// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/force_buffer.hpp"

#include "contact/aligned.hpp"

#include <algorithm>
#include <exception>

namespace dust::particles {
namespace {

std::span<double> memory_of_thread(std::size_t size) {
  thread_local contact::AlignedVector<double> memory;
  if (memory.size() < size) memory.resize(size, 0.0);
  return std::span(memory).first(size);
}

}  // namespace

ForceBuffer::ForceBuffer(Tile tile, std::size_t ghosts)
    : rows_(memory_of_thread(k_force_row * (tile.size() + ghosts))),
      own_(k_force_row * tile.size()),
      exceptions_(std::uncaught_exceptions()) {}

ForceBuffer::~ForceBuffer() {
  if (std::uncaught_exceptions() > exceptions_) std::fill(rows_.begin(), rows_.end(), 0.0);
}

}  // namespace dust::particles
