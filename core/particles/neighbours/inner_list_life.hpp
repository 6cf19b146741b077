// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <cstdint>

namespace dust::particles {

/// How long an inner list lives: the one place where its end is decided.
///
/// An inner list holds who may touch while every particle goes on along its straight trajectory,
/// give or take its skin. is_over() is asked before every coarse step; once it says so the
/// particles in free flight catch up and a new list is pruned from the outer one. Beside that,
/// whoever looks at or changes particles ends a list (Dem::synchronise()).
///
/// To end lists by another criterion: let the life know what it needs - count_step() is called once
/// per step, note() after every look at a tile's active particles (ActiveSet::check) - keep it
/// here, and use it in is_over(). A list that lives longer than its trajectories hold misses
/// contacts: they are counted when the next one is pruned (`contacts_seen_late`).
class InnerListLife {
 public:
  /// A new list, made for at most `lifetime` coarse steps (ListTuner::inner_lifetime()).
  void begin(std::int64_t lifetime);
  void end() { is_running_ = false; }

  [[nodiscard]] bool is_over() const;
  /// A list is there; its end need not have been noticed yet.
  [[nodiscard]] bool is_running() const { return is_running_; }

  /// A coarse step has been made.
  void count_step() { ++steps_; }
  [[nodiscard]] std::int64_t steps() const { return steps_; }

  /// Coarse steps between two looks at the active particles: seldom where lists last long, because
  /// little moves there.
  [[nodiscard]] static std::int64_t check_interval(std::int64_t lifetime) {
    return std::clamp<std::int64_t>(lifetime / 8, 4, 16);
  }
  [[nodiscard]] std::int64_t check_interval() const { return check_interval(lifetime_); }
  /// Whether the step in hand ends with a look.
  [[nodiscard]] bool is_check_due() const { return (steps_ + 1) % check_interval() == 0; }
  /// A look has found one that uses up its skin before the next look.
  void note_skin_used_up() { is_skin_used_up_ = true; }
  [[nodiscard]] bool is_skin_used_up() const { return is_skin_used_up_; }

 private:
  std::int64_t lifetime_ = 0;
  std::int64_t steps_ = 0;
  bool is_running_ = false;
  bool is_skin_used_up_ = false;
};

inline void InnerListLife::begin(std::int64_t lifetime) {
  lifetime_ = lifetime;
  steps_ = 0;
  is_running_ = true;
  is_skin_used_up_ = false;
}

/// Over when its lifetime has passed, or sooner when an active particle has used up its skin.
inline bool InnerListLife::is_over() const {
  return !is_running_ || is_skin_used_up_ || steps_ >= lifetime_;
}

}  // namespace dust::particles
