// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"
#include "fluid/momentum_set.hpp"
#include "fluid/properties.hpp"

#include <array>

namespace dust::fluid {

/// What a row of faces knows of the fluid: one number, or one per face where `each` is not null.
struct RowProperty {
  double one = 0.0;
  const double* each = nullptr;
};

/// Inertia and viscosity of the fluid at faces: two numbers for a uniform fluid, fields elsewhere.
/// A face between two cells has the mean of their properties.
class FaceProperties {
 public:
  /// In set III the inertia is density times void fraction (docs/theory/fluid.md, section 1).
  FaceProperties(const Grid& grid, const scenario::FluidSpec& fluid);

  /// Do inertia or viscosity differ from face to face?
  [[nodiscard]] bool is_varying() const { return is_varying_; }
  [[nodiscard]] MomentumSet momentum_set() const { return set_; }
  [[nodiscard]] const Properties& by_place() const { return properties_; }
  /// Takes note of the void fraction (halo filled), before it is used.
  void set_void_fraction(const CellField& eps);

  /// [kg/m3] the fluid's own density: what pressures are scaled with.
  [[nodiscard]] double density() const { return properties_.own().density; }
  [[nodiscard]] double viscosity() const { return properties_.own().viscosity; }
  /// [m3/kg] 1 / inertia of the row of component d that begins at `o`; `one` is the density.
  [[nodiscard]] RowProperty inertia(int d, std::ptrdiff_t o) const {
    return {density(), is_varying_ ? &inverse_inertia_.component[d][o] : nullptr};
  }
  /// [Pa s]
  [[nodiscard]] RowProperty viscosity(int d, std::ptrdiff_t o) const {
    return {viscosity(), is_varying_ ? &viscosity_.component[d][o] : nullptr};
  }
  [[nodiscard]] double inverse_inertia_at(int d, std::ptrdiff_t o) const {
    return is_varying_ ? inverse_inertia_.component[d][o] : 1.0 / density();
  }
  [[nodiscard]] double viscosity_at(int d, std::ptrdiff_t o) const {
    return is_varying_ ? viscosity_.component[d][o] : viscosity();
  }
  /// [m2/s] largest viscosity over inertia.
  [[nodiscard]] double largest_kinematic_viscosity() const { return largest_; }

 private:
  Grid grid_;
  Properties properties_;
  MomentumSet set_;
  bool is_varying_;
  FaceField density_;          ///< [kg/m3], if varying
  FaceField inverse_inertia_;  ///< [m3/kg], if varying
  FaceField viscosity_;        ///< [Pa s], if varying
  double largest_ = 0.0;
};

}  // namespace dust::fluid
