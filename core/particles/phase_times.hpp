// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dust::particles {

/// How the time of the tiles is shared by the phases of a step, from a sample of the steps:
/// contact, force, integration. Tiles may be timed at once.
class PhaseTimes {
 public:
  static constexpr std::size_t k_contact = 0;
  static constexpr std::size_t k_force = 1;
  static constexpr std::size_t k_integration = 2;
  using Seconds = std::array<double, 3>;

  /// One step in so many is timed.
  static constexpr std::int64_t k_interval = 16;
  [[nodiscard]] static bool is_due(std::int64_t step) { return step % k_interval == 0; }

  /// Adds the time since the last stop to one phase of a tile after the other.
  class Clock {
   public:
    Clock(Seconds& seconds, bool is_on)
        : seconds_(seconds), is_on_(is_on), last_(is_on ? Steady::now() : Steady::time_point()) {}
    void stop(std::size_t phase) {
      if (!is_on_) return;
      const auto now = Steady::now();
      seconds_[phase] += std::chrono::duration<double>(now - last_).count();
      last_ = now;
    }

   private:
    using Steady = std::chrono::steady_clock;
    Seconds& seconds_;
    bool is_on_;
    Steady::time_point last_;
  };

  /// New tiles; what the old ones took is kept.
  void restart(std::size_t tiles) {
    before_ = sum();
    tiles_.assign(tiles, {});
  }
  [[nodiscard]] Clock clock(std::size_t tile, bool is_on) { return {tiles_[tile], is_on}; }
  /// Of contact, force and integration; they sum to one, or are zeros before the first step.
  [[nodiscard]] Seconds shares() const {
    Seconds s = sum();
    const double all = s[k_contact] + s[k_force] + s[k_integration];
    for (double& one : s) one = all > 0.0 ? one / all : 0.0;
    return s;
  }

 private:
  [[nodiscard]] Seconds sum() const {
    Seconds s = before_;
    for (const Seconds& t : tiles_) {
      for (std::size_t phase = 0; phase < s.size(); ++phase) s[phase] += t[phase];
    }
    return s;
  }
  Seconds before_{};
  std::vector<Seconds> tiles_;
};

}  // namespace dust::particles
