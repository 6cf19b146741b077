// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/sampling.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <limits>
#include <span>
#include <string>
#include <utility>
#include <vector>

/// Grains in a box: which came in, which left, and when, between two samples as well.
namespace dust::sdk {

/// The part of a straight path that lies in a box, as fractions of the path.
struct PathPart {
  double from = 0.0;
  double to = 1.0;
  [[nodiscard]] bool is_none() const { return !(from < to); }
};

/// Cut by the three pairs of faces in turn (Kay and Kajiya 1986, doi:10.1145/15886.15916). Corners
/// may be infinitely far.
inline PathPart part_in_box(const Path& path, Vec3 min, Vec3 max) {
  PathPart part;
  for (int d = 0; d < 3; ++d) {
    const double way = path.now[d] - path.before[d];
    if (way == 0.0) {
      if (path.now[d] < min[d] || path.now[d] >= max[d]) return {1.0, 0.0};
      continue;
    }
    const double low = (min[d] - path.before[d]) / way;
    const double high = (max[d] - path.before[d]) / way;
    part.from = std::max(part.from, std::min(low, high));
    part.to = std::min(part.to, std::max(low, high));
  }
  return part;
}

/// A grain that is in a box.
struct Stay {
  std::int64_t id = 0;
  double since = 0.0;  ///< [s] when it came in, or was born there
  double mass = 0.0;   ///< [kg] with its statistical weight

  /// Of one that was there before anybody looked.
  static constexpr double k_unknown = -std::numeric_limits<double>::infinity();
};

/// The grains in the box [min, max) [m] from sample to sample. Paths between two samples are taken
/// as straight, so that a grain comes in and goes out within an interval; one that is gone from the
/// domain left in the middle of it.
class Stays {
 public:
  Stays(Vec3 min, Vec3 max) : min_(min), max_(max) {}

  /// Grains that are there already: they have not come in, and nobody knows since when they stay.
  template <class Takes>
  void begin(const WorldView& world, const Takes& takes) {
    const GrainColumns& g = world.grains;
    stays_.clear();
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!takes(g.diameter[i]) || !is_in_box({g.x[i], g.y[i], g.z[i]}, min_, max_)) continue;
      stays_.push_back({g.id[i], Stay::k_unknown, g.weight[i] * g.mass[i]});
    }
  }

  /// One sample. `takes(diameter [m])`: whether a grain counts at all; `enter(stay)` and
  /// `leave(stay, time [s])` are called in the order of the ids.
  template <class Takes, class Enter, class Leave>
  void update(const WorldView& world, const Takes& takes, const Enter& enter, const Leave& leave) {
    const GrainColumns& g = world.grains;
    const double begin = world.time - world.interval;
    next_.clear();
    std::size_t known = 0;
    const auto gone_before = [&](std::int64_t id) {
      for (; known < stays_.size() && stays_[known].id < id; ++known) {
        leave(stays_[known], begin + 0.5 * world.interval);
      }
    };
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      gone_before(g.id[i]);
      const bool was_inside = known < stays_.size() && stays_[known].id == g.id[i];
      if (!was_inside && !takes(g.diameter[i])) continue;
      const PathPart part = part_in_box(path_of(world, i), min_, max_);
      if (!was_inside && part.is_none()) continue;
      Stay stay{g.id[i], begin + part.from * world.interval, g.weight[i] * g.mass[i]};
      if (was_inside) {
        stay = stays_[known++];
      } else {
        enter(stay);
      }
      if (is_in_box({g.x[i], g.y[i], g.z[i]}, min_, max_)) {
        next_.push_back(stay);
      } else {
        leave(stay, begin + (part.is_none() ? 0.0 : part.to) * world.interval);
      }
    }
    gone_before(std::numeric_limits<std::int64_t>::max());
    std::swap(stays_, next_);
  }

  /// Ascending by id.
  [[nodiscard]] std::span<const Stay> all() const { return stays_; }
  /// [kg] in the box.
  [[nodiscard]] double mass() const {
    double sum = 0.0;
    for (const Stay& s : stays_) sum += s.mass;
    return sum;
  }
  /// The grain of this id, null if it is not in the box.
  [[nodiscard]] const Stay* find(std::int64_t id) const {
    const auto at =
        std::lower_bound(stays_.begin(), stays_.end(), id,
                         [](const Stay& s, std::int64_t wanted) { return s.id < wanted; });
    return at != stays_.end() && at->id == id ? &*at : nullptr;
  }

  void save(ArchiveWriter& archive, const std::string& name) const {
    std::vector<std::int64_t> ids;
    std::vector<double> numbers;
    for (const Stay& s : stays_) {
      ids.push_back(s.id);
      numbers.insert(numbers.end(), {s.since, s.mass});
    }
    archive.integers(name + "_ids", ids);
    archive.numbers(name + "_numbers", numbers);
  }
  void load(ArchiveReader& archive, const std::string& name) {
    const std::vector<std::int64_t> ids = archive.integers(name + "_ids");
    const std::vector<double> numbers = archive.numbers(name + "_numbers");
    if (numbers.size() != 2 * ids.size()) {
      throw ModelError("the saved grains '" + name + "' do not fit together");
    }
    stays_.clear();
    for (std::size_t n = 0; n < ids.size(); ++n) {
      stays_.push_back({ids[n], numbers[2 * n], numbers[2 * n + 1]});
    }
  }

 private:
  Vec3 min_, max_;
  std::vector<Stay> stays_;
  std::vector<Stay> next_;  ///< kept for its memory
};

}  // namespace dust::sdk
