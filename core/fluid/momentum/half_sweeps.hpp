// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/parallel.hpp"

#include <tbb/parallel_for.h>
#include <tbb/task_arena.h>
#include <algorithm>

namespace dust::fluid {

/// Slabs of planes that go through all half sweeps while they are in the cache.
class SweepSlabs {
 public:
  /// `halves` half sweeps over `planes` planes. A slab is at least twice as thick as it has half
  /// sweeps; thinner and more of them for more threads.
  SweepSlabs(int halves, int planes, int threads) : halves_(halves), planes_(planes) {
    const int least = 2 * halves + 1;
    thickness_ = std::max(least, std::min(k_thickness, planes / std::max(1, 2 * threads)));
    count_ = std::max(1, planes / thickness_);
  }
  [[nodiscard]] int count() const { return count_; }

  /// Calls work(half, plane) such that the neighbours of a plane have gone through the half sweeps
  /// before this one and through none but this one since: the colours of red-black sweeps then see
  /// each other as if each half sweep went through all planes at once.
  ///
  /// First part, slabs in any order: half sweep h leaves out the h planes next to other slabs.
  template <class Work>
  void inside(int slab, const Work& work) const {
    const int low = begin(slab);
    const int high = begin(slab + 1);
    const int shrinks_low = slab > 0 ? 1 : 0;
    const int shrinks_high = slab + 1 < count_ ? 1 : 0;
    for (int front = low; front < high + halves_; ++front) {
      for (int half = 0; half < halves_; ++half) {
        const int plane = front - half;
        if (plane < low + shrinks_low * half || plane >= high - shrinks_high * half) continue;
        work(half, plane);
      }
    }
  }
  /// Second part, after all slabs: what they left out below slab `slab` > 0 and at its bottom.
  template <class Work>
  void between(int slab, const Work& work) const {
    const int middle = begin(slab);
    for (int half = 1; half < halves_; ++half) {
      for (int plane = middle - half; plane < middle + half; ++plane) work(half, plane);
    }
  }

 private:
  static constexpr int k_thickness = 64;

  [[nodiscard]] int begin(int slab) const { return slab == count_ ? planes_ : slab * thickness_; }

  int halves_;
  int planes_;
  int thickness_;
  int count_;
};

/// Calls body(half, j, k) for `halves` red-black half sweeps over rows of `n0` numbers; a row reads
/// the rows around it. The result is that of one half sweep after the other over all rows.
template <class Body>
void for_half_sweeps(int halves, int n0, int n1, int n2, const Body& body) {
  const int threads = static_cast<long>(n0) * n1 * n2 < k_serial_below
                          ? 1
                          : tbb::this_task_arena::max_concurrency();
  const SweepSlabs slabs(halves, n2, threads);
  if (slabs.count() < threads) {
    for (int half = 0; half < halves; ++half) {
      for_rows(n0, n1, n2, [&](int j, int k) { body(half, j, k); });
    }
    return;
  }
  const auto plane = [&](int half, int k) {
    for (int j = 0; j < n1; ++j) body(half, j, k);
  };
  if (threads == 1) {
    for (int s = 0; s < slabs.count(); ++s) slabs.inside(s, plane);
    for (int s = 1; s < slabs.count(); ++s) slabs.between(s, plane);
    return;
  }
  tbb::parallel_for(0, slabs.count(), [&](int s) { slabs.inside(s, plane); });
  tbb::parallel_for(1, slabs.count(), [&](int s) { slabs.between(s, plane); });
}

}  // namespace dust::fluid
