// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/cached.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/eddy_stress.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/sides.hpp"

namespace dust::fluid {

/// The force of the fluid's stress, -grad p + div tau [N/m3] at faces.
class StressField {
 public:
  /// References are kept.
  StressField(const Grid& grid, const Geometry& geometry, const Sides& sides,
              const Momentum& momentum)
      : grid_(grid),
        geometry_(geometry),
        sides_(sides),
        momentum_(momentum),
        stress_(FaceField(grid)) {}

  /// The flow has changed.
  void flow_changed() { stress_.invalidate(); }
  /// Of the flow as it is, found when first asked for; fills the halos of the pressure.
  const FaceField& of_flow(const FaceField& u, CellField& pressure, EddyStress* eddies);
  /// From now on the mean over a step: of mean velocity and mean pressure, with the eddies' mean.
  const FaceField& of_mean(const FaceField& mean_velocity, CellField& mean_pressure,
                           EddyStress* eddies);
  /// To be written.
  FaceField& write() { return stress_.write(); }

 private:
  void find(const FaceField& v, CellField& pressure, EddyStress* eddies, const FaceField* force,
            FaceField& stress);

  const Grid& grid_;
  const Geometry& geometry_;
  const Sides& sides_;
  const Momentum& momentum_;
  Cached<FaceField> stress_;
};

}  // namespace dust::fluid
