// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/sides.hpp"

#include <array>
#include <vector>

namespace dust::fluid {

/// Fluxes along a row of control volumes: through[e][i] belongs to the lower face of a cell in
/// direction e, and a control volume has the mean of two cells, `across` apart. What flows out per
/// volume [1/s] is the sum over e of per_length[e] times the difference along stride[e].
struct RowFlux {
  std::array<const double*, 3> through;
  std::array<std::ptrdiff_t, 3> stride;
  std::array<double, 3> per_length;  ///< [1/m]
  std::ptrdiff_t across;
};

/// Convection, viscous stencils and the implicit solve of the momentum equation.
class Momentum {
 public:
  Momentum(const Grid& grid, const Geometry& geometry, const Sides& sides,
           const FaceProperties& properties);

  /// After the geometry was built anew.
  void geometry_changed();
  /// flux = mean void fraction x velocity, halos included; docs/theory/fluid.md, eq. (3).
  void find_flux(const FaceField& u, const CellField& eps);
  /// out = u . grad u of component `d` at row (j, k) (extent_x numbers), from the last find_flux.
  /// `smoothness` [m2/s2]: squared steps of velocity below this are taken as smooth.
  void convection_row(const FaceField& u, const CellField& eps, double smoothness, int d, int j,
                      int k, double* out) const;

  /// What flows through the control volumes of that row, from the last find_flux; meaningless on
  /// the sides themselves.
  [[nodiscard]] RowFlux row_flux(int d, int j, int k) const;

  /// Prepares (1 + implicit (coefficient - viscosity laplace) / inertia) for `solve`; implicit [s].
  /// `has_drag` = false: the coefficient is 0 everywhere.
  void prepare(double implicit, const FaceField& coefficient, bool has_drag);
  /// Solves the prepared system for `u` (start values in, halos filled for sweeps).
  void solve(const FaceField& right, FaceField& u);

  /// out = viscosity laplace(u) [N/m3] at unknown faces, 0 elsewhere; halos filled for velocity.
  void viscous_force(const FaceField& u, FaceField& out) const;
  /// Velocity inside the bodies. Deep ghosts hold the surface's velocity and change with it alone;
  /// uncrossed ones are those through whose faces no fluid passes.
  enum class Ghosts { all, but_deep, uncrossed };
  void extend(FaceField& u, Ghosts which) const;
  /// Largest sum over the directions of |u| / h [1/s] and largest |component| [m/s]; infinite
  /// where a number is not finite.
  struct Rates {
    double courant = 0.0;
    double speed = 0.0;
  };
  [[nodiscard]] Rates rates(const FaceField& u);

 private:
  struct RowWeights {
    double y_low, y_high, z_low, z_high;
  };
  [[nodiscard]] RowWeights row_weights(int d, int j, int k) const;
  /// A component of the system that is solved; a, ax: weights of the neighbours.
  struct HalfSweep {
    int d;
    double a, ax;
    const double* right;
    double* u;
  };
  void sweep_row_and_cuts(const HalfSweep& s, int half, int j, int k) const;
  /// Nothing of component d varies along e.
  [[nodiscard]] bool is_even(int d, int e) const;
  /// viscosity / h^2 of a neighbour of component d along e; 0 where nothing varies: what lies there
  /// beyond the sides is not kept up to date.
  [[nodiscard]] double neighbour_weight(double viscosity, int d, int e) const;
  /// Puts convection along the surface in the place of that along the grid where SkewFace says so.
  void skew_row(const FaceField& u, const CellField& eps, double smoothness, int d, int j, int k,
                double* out) const;
  /// Convection of the normal component on open sides themselves.
  void open_side_row(const FaceField& u, int d, int j, int k, double* out) const;
  /// Adds what the fluid takes up that enters beside the row from rest, times the void fraction;
  /// docs/theory/fluid.md, section 4.
  void entering_row(const FaceField& u, int d, int j, int k, double* out) const;

  const Grid& grid_;
  const Geometry& geometry_;
  const Sides& sides_;
  const FaceProperties& properties_;
  double implicit_ = 0.0;
  bool is_plain_ = false;  ///< prepared for a uniform fluid without drag
  double relaxation_ = 1.0;
  int sweeps_ = 1;
  FaceField flux_;
  FaceField inverse_;  ///< of the diagonal; 0 where the plain stencil does not hold
  std::array<std::vector<double>, 3> cut_inverse_;
  std::vector<double> partial_;
  std::vector<double> partial_speed_;
};

}  // namespace dust::fluid
