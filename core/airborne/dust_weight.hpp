// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_field.hpp"
#include "fluid/grid.hpp"

namespace dust::airborne {

/// Force [N/m3] of the dust on the gas it is in, at the faces: the weight that drag hands over,
/// less what the gas that the dust displaces weighs; docs/theory/dust.md, eq. (16).
class DustWeight {
 public:
  DustWeight(const fluid::Grid& grid, sdk::Vec3 gravity, double dust_density, double gas_density);

  /// In cells filled by gas to `volume` [-]; kept until the next call. A face has the dust and the
  /// gas of both its cells: what has come off in a sliver weighs what it weighs, not what a whole
  /// cell of that concentration would.
  const fluid::FaceField& find(const DustField& field, const fluid::CellField& volume);

 private:
  fluid::Grid grid_;
  sdk::Vec3 immersed_gravity_;  ///< [m/s2]
  fluid::CellField mass_;       ///< [kg/m3] of whole cells, of all classes
  fluid::FaceField force_;
};

}  // namespace dust::airborne
