// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/momentum/momentum_balance.hpp"
#include "fluid/sides.hpp"
#include "fluid/step/drag_velocity.hpp"
#include "fluid/velocity_forcing.hpp"

namespace dust::fluid {

/// A sub-step: its instant, and what acts in it.
struct SubStep {
  double time;              ///< [s] at its beginning
  double step;              ///< [s]
  double share;             ///< [-] of the fluid step
  double smoothness;        ///< [m2/s2] as Momentum::convection_row
  const FaceField& source;  ///< [N/m3]
  const FaceField& drag;    ///< [kg/(m3 s)] coefficient
  bool has_drag;
  DragVelocity* drag_velocity;  ///< null where the mean of the stages is not asked for
  MomentumBalance* balance;     ///< null where none is kept
};

/// The two implicit stages of a sub-step before its projection: docs/theory/fluid.md,
/// section 3.
class TwoStages {
 public:
  /// References are kept.
  TwoStages(const Grid& grid, const Geometry& geometry, Sides& sides,
            const FaceProperties& properties, Momentum& momentum);

  /// Advances `u`. Fills the halos of the `pressure`, and of the velocity as far as the steps need
  /// them; all of them with `fills_halos`.
  void advance(const SubStep& part, const CellField& eps, bool fills_halos, CellField& pressure,
               FaceField& u);
  /// Halos of a velocity as advance() fills them.
  void fill(FaceField& u, bool fills_halos) const {
    fills_halos ? sides_.fill_velocity(u) : sides_.fill_varying(u);
  }
  /// Forces on what the stages predict; null: none.
  void use(VelocityForcing& forcing) { forcing_ = &forcing; }
  [[nodiscard]] VelocityForcing* forcing() { return forcing_; }
  /// The field that takes turns with the velocity; free between two calls.
  [[nodiscard]] FaceField& other() { return next_; }

 private:
  /// Calls body(d, index of the first face, faces, 1 / spacing) for the rows of all components that
  /// may move.
  template <class Body>
  void each_moving_row(const Body& body) const;
  void convect_first(const SubStep& part, const FaceField& u, const CellField& eps);
  void convect_second(const SubStep& part, const CellField& eps);
  void balance_row(const SubStep& part, const FaceField& v, const CellField& eps, int d, int j,
                   int k, const double* row, double time) const;
  void solve(bool fills_halos);

  const Grid& grid_;
  const Geometry& geometry_;
  Sides& sides_;
  const FaceProperties& properties_;
  Momentum& momentum_;
  FaceField next_, right_, sum_;
  VelocityForcing* forcing_ = nullptr;
};

}  // namespace dust::fluid
