// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "placed_stream.hpp"

#include <dust/sdk/archive.hpp>
#include <dust/sdk/error.hpp>
#include <dust/sdk/random.hpp>
#include <dust/sdk/vec3.hpp>

#include <algorithm>
#include <cstdint>
#include <numeric>
#include <string>
#include <utility>
#include <vector>

namespace dust::model::feed {

/// The flat opening of a feed.
struct Opening {
  sdk::Vec3 min, max;  ///< [m] equal along `axis`
  int axis = 2;
  sdk::Vec3 velocity;  ///< [m/s] of all grains
  double speed = 0.0;  ///< [m/s] across the opening

  /// A random place at which a sphere lies wholly within the opening.
  [[nodiscard]] sdk::Vec3 draw(double radius, std::uint64_t number, std::uint32_t trial,
                               const sdk::Random& random) const {
    sdk::Vec3 x = min;
    for (int d = 0; d < 3; ++d) {
      if (d == axis) continue;
      const double room = max[d] - min[d] - 2.0 * radius;
      x[d] =
          min[d] + radius + room * random.uniform(number, trial, static_cast<std::uint32_t>(d) + 2);
    }
    return x;
  }
};

/// A stream of sizes so different that no large grain finds a place among small ones placed before
/// it: every grain is placed before all those that it could touch and that are of a smaller octave.
/// Octaves end at D, D/2, D/4, ... for a largest diameter D. Grains of the octave up to b are
/// placed as far as 2 b ahead of the opening; one that comes later is further ahead than 2 b and
/// touches nothing nearer than 2 b - (b + b/2)/2 = 1.25 b, and smaller octaves are placed up to b.
///
/// Each size is a stream of its own, one grain at a random instant of each interval 1/flow, so that
/// what lies ahead can be told size by size.
class LargeFirst {
 public:
  struct Size {
    double diameter = 0.0;     ///< [m]
    double flow = 0.0;         ///< [1/s] of computed grains
    double time_before = 0.0;  ///< [s] its place moves that long ahead of the others'
  };
  struct Grain {
    double time = 0.0;  ///< [s] when it is released
    std::size_t size = 0;
    sdk::Vec3 position;  ///< [m] in the opening
  };

  LargeFirst(const Opening& opening, double largest, std::size_t sizes)
      : opening_(opening), largest_(largest), placed_(largest), next_(sizes, 0) {}

  /// Grains with a time before `end` [s], in order of time; the stream flows from `first` to
  /// `last`. Consecutive calls with the same sizes. Throws ParameterError where a grain finds no
  /// place.
  std::vector<Grain> release(std::vector<Size> sizes, double end, double first, double last,
                             const sdk::Random& random) {
    sizes_ = std::move(sizes);
    std::vector<std::size_t> order(sizes_.size());
    std::iota(order.begin(), order.end(), std::size_t{0});
    std::stable_sort(order.begin(), order.end(), [this](std::size_t a, std::size_t b) {
      return sizes_[a].diameter > sizes_[b].diameter;
    });
    for (const std::size_t i : order) {
      if (!(sizes_[i].flow > 0.0)) continue;
      const double ahead = 2.0 * placed_.level_diameter(0.5 * sizes_[i].diameter);
      const double until = std::min(last, end + ahead / opening_.speed);
      for (double time = time_of(i, first, random); time < until;
           time = time_of(i, first, random)) {
        place(i, time, random);
        ++next_[i];
      }
    }
    std::vector<Grain> due;
    std::erase_if(planned_, [&](const Grain& g) {
      if (g.time < end) due.push_back(g);
      return g.time < end;
    });
    std::stable_sort(due.begin(), due.end(),
                     [](const Grain& a, const Grain& b) { return a.time < b.time; });
    // Nothing to come reaches further back.
    double longest_before = 0.0;
    for (const Size& s : sizes_) longest_before = std::max(longest_before, s.time_before);
    placed_.drop_before(end - longest_before - 2.0 * largest_ / opening_.speed);
    return due;
  }

  void save(sdk::ArchiveWriter& archive) const {
    archive.integers("large_first_next", std::vector<std::int64_t>(next_.begin(), next_.end()));
    std::vector<double> planned;
    for (const Grain& g : planned_) {
      planned.insert(planned.end(), {g.time, static_cast<double>(g.size), g.position.x,
                                     g.position.y, g.position.z});
    }
    archive.numbers("large_first_planned", planned);
    std::vector<double> placed;
    placed_.for_each([&](const StreamGrain& g) {
      placed.insert(placed.end(), {g.time, g.centre.x, g.centre.y, g.centre.z, g.radius});
    });
    archive.numbers("large_first_placed", placed);
  }

  void load(sdk::ArchiveReader& archive) {
    const auto next = archive.integers("large_first_next");
    next_.assign(next.begin(), next.end());
    const auto planned = archive.numbers("large_first_planned");
    planned_.clear();
    for (std::size_t n = 0; n + 4 < planned.size(); n += 5) {
      planned_.push_back({planned[n],
                          static_cast<std::size_t>(planned[n + 1]),
                          {planned[n + 2], planned[n + 3], planned[n + 4]}});
    }
    const auto placed = archive.numbers("large_first_placed");
    placed_ = PlacedStream(largest_);
    for (std::size_t n = 0; n + 4 < placed.size(); n += 5) {
      placed_.add({placed[n], {placed[n + 1], placed[n + 2], placed[n + 3]}, placed[n + 4]});
    }
  }

 private:
  static constexpr std::uint32_t k_tries = 100000;
  /// Free gap between placed grains relative to the sum of their radii.
  static constexpr double k_gap = 1e-6;

  [[nodiscard]] std::uint64_t number_of(std::size_t i) const {
    return next_[i] | (std::uint64_t{i} + 1) << 48;
  }
  [[nodiscard]] double time_of(std::size_t i, double first, const sdk::Random& random) const {
    return first +
           (static_cast<double>(next_[i]) + random.uniform(number_of(i), 0, 1)) / sizes_[i].flow;
  }

  void place(std::size_t i, double time, const sdk::Random& random) {
    const double radius = 0.5 * sizes_[i].diameter;
    const double passes = time - sizes_[i].time_before;
    for (std::uint32_t trial = 0; trial < k_tries; ++trial) {
      const sdk::Vec3 x = opening_.draw(radius, number_of(i), trial, random);
      const sdk::Vec3 centre = x - passes * opening_.velocity;
      if (!placed_.is_free(centre, radius, k_gap)) continue;
      placed_.add({passes, centre, radius});
      planned_.push_back({time, i, x});
      return;
    }
    throw sdk::ParameterError("no free place for a grain of " +
                              std::to_string(1e3 * sizes_[i].diameter) + " mm in the opening at " +
                              std::to_string(time) +
                              " s, though larger grains are placed first: widen the opening or "
                              "raise the speed");
  }

  Opening opening_;
  double largest_;  ///< [m] diameter
  std::vector<Size> sizes_;
  PlacedStream placed_;
  std::vector<std::uint64_t> next_;  ///< of each size, the number of the grain to be placed
  std::vector<Grain> planned_;       ///< placed, not yet released
};

}  // namespace dust::model::feed
