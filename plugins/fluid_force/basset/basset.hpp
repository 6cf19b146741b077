// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cmath>
#include <cstddef>
#include <numbers>

namespace dust::model::basset {

/// Factor of the history integral [kg/s^(1/2)], \f$ C = \frac32 D^2 \sqrt{\pi \rho_f \mu} \f$.
/// Source: Basset, A treatise on hydrodynamics, vol. 2 (1888), chapter 22.
inline double factor(double diameter, double density, double viscosity) {
  return 1.5 * diameter * diameter * std::sqrt(std::numbers::pi * density * viscosity);
}

/// Mean over the next `interval` of the integral of 1 / sqrt(t - t') over a past piece of unit rate
/// that began `oldest` and ended `youngest` [s] ago; [s^(1/2)].
inline double mean_kernel(double youngest, double oldest, double interval) {
  const auto power = [](double x) { return x * std::sqrt(x); };
  return 4.0 / (3.0 * interval) *
         (power(oldest + interval) - power(oldest) - power(youngest + interval) + power(youngest));
}

/// The same of a jump of size 1 that was `age` ago [s^(-1/2)].
inline double mean_jump_kernel(double age, double interval) {
  return 2.0 * (std::sqrt(age + interval) - std::sqrt(age)) / interval;
}

/// The past of the slip of one grain as pieces of constant rate, the older the longer: levels of
/// `k_slots` pieces; when one is full, its two oldest become one of the next. The integral over
/// pieces is exact, and a piece is never longer than a quarter of its age: 3 % of the force after a
/// jump, far less where the slip changes smoothly.
/// Lives on a row of numbers that the core keeps and saves.
class History {
 public:
  static constexpr int k_levels = 11;
  static constexpr int k_slots = 8;
  static constexpr int k_numbers = 5 + k_levels * (1 + 4 * k_slots);

  explicit History(double* row) : row_(row) {}

  /// Takes note of the slip [m/s] now; the last call was told `interval` [s] ago.
  /// `is_sudden`: a grain that is new came into its slip at this instant, else it had it before.
  void note(sdk::Vec3 slip, bool is_sudden) {
    const bool is_new = row_[0] == 0.0;
    const sdk::Vec3 last{row_[1], row_[2], row_[3]};
    if (!is_new) {
      push(0, {slip - last, row_[4]});
    } else if (is_sudden) {
      push(0, {slip, 0.0});
    }
    row_[0] = 1.0;
    for (int d = 0; d < 3; ++d) row_[1 + d] = slip[d];
  }

  /// Mean over the next `interval` [s] of the integral of (dw/dt') / sqrt(t - t') over the past, no
  /// farther back than `window` [s]; [m/s^(3/2)].
  sdk::Vec3 past(double interval, double window) {
    row_[4] = interval;
    sdk::Vec3 sum;
    double age = 0.0;
    for (int level = 0; level < k_levels; ++level) {
      for (int slot = count(level) - 1; slot >= 0; --slot) {
        if (age >= window) return sum;
        const double* p = piece(level, slot);
        const double kernel = p[3] > 0.0 ? mean_kernel(age, age + p[3], interval) / p[3]
                                         : mean_jump_kernel(age, interval);
        sum += kernel * sdk::Vec3{p[0], p[1], p[2]};
        age += p[3];
      }
    }
    return sum;
  }

 private:
  struct Piece {
    sdk::Vec3 change;       ///< [m/s]
    double duration = 0.0;  ///< [s]
  };
  [[nodiscard]] int count(int level) const { return static_cast<int>(row_[5 + level]); }
  /// Slot 0 is the oldest.
  [[nodiscard]] double* piece(int level, int slot) const {
    return row_ + 5 + k_levels + 4 * (level * k_slots + slot);
  }
  void push(int level, Piece p) {
    if (level == k_levels) return;  // older than 8 * 2^11 intervals
    if (count(level) == k_slots) {
      const double* a = piece(level, 0);
      const double* b = piece(level, 1);
      push(level + 1, {{a[0] + b[0], a[1] + b[1], a[2] + b[2]}, a[3] + b[3]});
      double* all = piece(level, 0);
      for (int n = 0; n < 4 * (k_slots - 2); ++n) all[n] = all[n + 8];
      row_[5 + level] -= 2.0;
    }
    double* to = piece(level, count(level));
    for (int d = 0; d < 3; ++d) to[d] = p.change[d];
    to[3] = p.duration;
    row_[5 + level] += 1.0;
  }

  double* row_;
};

}  // namespace dust::model::basset
