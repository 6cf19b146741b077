// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>

namespace dust::particles {

/// How long pair lists are made for, and how wide skins are: chosen from what the lists before have
/// cost. Arithmetic on counts alone (docs/decisions/0006_inner_pair_list.md,
/// 0010_lists_fit_the_flow.md).
///
/// The outer list names who may meet until its lifetime ends; the inner list, made of it again and
/// again, who may meet within a few steps. Lifetimes are in coarse steps.
class ListTuner {
 public:
  /// What an inner list was like at its end.
  struct InnerStatistics {
    bool was_left = false;      ///< a particle left its skin, so that it had to end
    std::int64_t steps = 0;     ///< that it lasted
    std::int64_t entries = 0;   ///< pairs and walls looked at
    std::int64_t contacts = 0;  ///< of them, in touch at the last step
  };
  /// What an outer list that has just been made is like, and how the one before ended.
  struct OuterStatistics {
    bool is_early = false;      ///< the last one was given up before its end, with nobody new
    bool is_half_used = false;  ///< the last one was given up in the first half of its lifetime
    std::int64_t pairs = 0;
    std::int64_t close_pairs = 0;  ///< of them, nearer than touch and both skins now
    std::int64_t particles = 0;
  };

  [[nodiscard]] std::int64_t inner_lifetime() const { return inner_lifetime_; }
  void record(const InnerStatistics& s);

  [[nodiscard]] std::int64_t outer_lifetime() const { return outer_lifetime_; }
  /// Begins a new outer list, in which no particle flies more than a diameter: `flight_steps`
  /// coarse steps at the largest speed. Returns its lifetime.
  std::int64_t begin_outer(double flight_steps);
  void record(const OuterStatistics& s);

  /// Skin of a coarse particle of the next outer list, in diameters. Least for beds; in dilute
  /// flow, where pairs are few and every collision throws a particle off its trajectory, lists with
  /// wider skins last longer and cost little.
  [[nodiscard]] double skin_in_diameters() const;
  /// Whether lists of so many pairs are short enough for wider skins.
  [[nodiscard]] bool may_widen_skins(std::int64_t pairs, std::int64_t particles) const;

  /// Four numbers of a checkpoint.
  struct State {
    std::int64_t outer_lifetime, next_outer_lifetime, skin_level, inner_lifetime;
  };
  [[nodiscard]] State state() const;
  void restore(const State& s);

 private:
  std::int64_t outer_lifetime_ = 0;
  std::int64_t next_outer_lifetime_ = 32;
  std::int64_t skin_level_ = 1;
  std::int64_t inner_lifetime_ = 64;
};

}  // namespace dust::particles
