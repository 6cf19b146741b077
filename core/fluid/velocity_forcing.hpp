// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"

namespace dust::fluid {

/// A part of a fluid step, from one projection to the next.
struct ForcedPart {
  double until = 0.0;  ///< [s] its end, since the beginning of the fluid step
  double step = 0.0;   ///< [s]
  double share = 0.0;  ///< [-] of the fluid step
};

/// The fluid that is driven: only at the unknown faces.
struct ForcedFluid {
  const Geometry& geometry;
  const CellField& eps;  ///< with filled halo
};

/// Forces on the fluid that follow from its predicted velocity, as those of surfaces that the grid
/// does not know: docs/theory/resolved.md. Forces are per volume of fluid [N/m3], as in Exchange.
class VelocityForcing {
 public:
  virtual ~VelocityForcing() = default;

  /// Before the prediction of a part: `given` and what is known of the own forces beforehand.
  virtual const FaceField& add_to(const FaceField& given, const ForcedFluid& fluid,
                                  const ForcedPart& part) = 0;
  /// Between prediction and projection: what is missing is given to `velocity`. Halos are filled
  /// before; they are filled anew afterwards.
  virtual void force(FaceField& velocity, const ForcedFluid& fluid, const ForcedPart& part) = 0;
  /// After the last part: `given` and the mean of all own forces over the fluid step, over the void
  /// fraction `eps` of its end.
  virtual const FaceField& add_mean_to(const FaceField& given, const CellField& eps) = 0;
};

}  // namespace dust::fluid
