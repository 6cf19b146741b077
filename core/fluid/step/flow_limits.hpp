// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/cached.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/momentum.hpp"

namespace dust::fluid {

/// How far a velocity may be advanced at once, and whether it is one at all.
class FlowLimits {
 public:
  using Rates = Momentum::Rates;

  /// References are kept.
  FlowLimits(const Grid& grid, const Geometry& geometry, Momentum& momentum, double largest_cfl)
      : grid_(grid), geometry_(geometry), momentum_(momentum), largest_cfl_(largest_cfl) {}

  /// The velocity or the grid is another.
  void velocity_changed() { rates_.invalidate(); }
  /// Rates of the velocity `u` at `time` [s]. Throws sdk::ModelError where it has diverged.
  const Rates& find(const FaceField& u, double time);
  /// Sub-steps of the velocity `u` for `left` [s] of the fluid step from `begin` [s] on, of which
  /// `done` were made; `diffusion` [1/s] the rate of what is diffused explicitly
  /// (EddyStress::rate). Throws sdk::ModelError where they are too many.
  [[nodiscard]] int sub_steps(const FaceField& u, double left, const Rates& rates, double diffusion,
                              int done, double begin) const;

 private:
  struct FastFace {
    int component = 0;
    sdk::Vec3 place;
    double velocity = 0.0;  ///< [m/s]
  };
  /// The first face of the fluid that is as fast as `speed` [m/s], or the first of all that is not
  /// a number: what is found where Rates::speed is at least that.
  [[nodiscard]] FastFace first_as_fast_as(double speed, const FaceField& u) const;
  void check_finite(const FaceField& u, double time, const Rates& rates) const;

  const Grid& grid_;
  const Geometry& geometry_;
  Momentum& momentum_;
  double largest_cfl_;
  Cached<Rates> rates_;
};

}  // namespace dust::fluid
