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

  /// From the concentrations in cells filled by gas to `volume` [-]; kept until the next call.
  const fluid::FaceField& find(const DustField& field, const fluid::CellField& volume);

 private:
  fluid::Grid grid_;
  sdk::Vec3 immersed_gravity_;  ///< [m/s2]
  fluid::CellField sum_, one_;  ///< [kg/m3] of gas, of all classes and of one
  fluid::FaceField force_;
};

}  // namespace dust::airborne
