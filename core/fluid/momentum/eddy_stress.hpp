// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/turbulence_model.hpp"
#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/sides.hpp"

#include <array>
#include <vector>

namespace dust::fluid {

/// Stress of the motion smaller than a cell, by the eddy viscosity of a model:
///   tau_ij = mu_t (d_i u_j + d_j u_i) ;   docs/theory/fluid.md, eq. (15).
/// There is none at walls, where eddies end: not on sides at which the fluid sticks, nor at bodies,
/// nor through those thinner than a cell.
/// Taken explicitly and as differences of fluxes between neighbouring faces: what one loses the
/// next one gains. In cubic cells a model of their size is stable wherever convection is: with mu_t
/// of (0.2 h)^2 rho |S| the diffusion number is below 0.25 times the Courant number. In flat cells
/// it is not: rate() limits the step.
class EddyStress {
 public:
  EddyStress(const Grid& grid, const Geometry& geometry, const Sides& sides,
             const FaceProperties& properties, const bodies::BodySet& bodies,
             const sdk::TurbulenceModel& model);

  /// Distances from the bodies where they are at `time` [s].
  void bodies_moved(const bodies::BodySet& bodies, double time);
  /// Eddy viscosity and force for a velocity with filled halos.
  void update(const FaceField& u);
  /// [Pa s] per cell; 0 in bodies.
  [[nodiscard]] const CellField& eddy_viscosity() const { return viscosity_; }
  /// [1/s] Largest rate at which the stress evens out velocities, \f$ 8 \nu_t \sum_d 1 / h_d^2 \f$
  /// over cells; of the normal stress, which is the stiffest, in all directions.
  [[nodiscard]] double rate() const;
  /// `source` with the force of the last update; valid until the next call.
  const FaceField& add_to(const FaceField& source);
  /// [N/m3] div tau at unknown faces, 0 elsewhere.
  [[nodiscard]] const FaceField& force() const { return force_; }
  /// Adds the present force, which acts for a `share` of a fluid step, to the mean over it.
  void add_to_mean(double share, bool is_first);
  [[nodiscard]] const FaceField& mean_force() const { return mean_force_; }

 private:
  /// Where eddies end.
  struct Walls {
    std::array<bool, 6> is_side{};
    CellField body_distance;  ///< [m] to the nearest body
    /// Of edges, by the direction along them, at the cell whose lower edge they are: 0 at walls,
    /// else 1.
    std::array<std::vector<double>, 3> edge;
    std::array<std::vector<char>, 3> is_blocked;  ///< faces that a thin body closes
  };
  [[nodiscard]] std::array<bool, 6> sides_that_are_walls(const FaceField& u) const;
  void find_distances(const bodies::BodySet& bodies, double time);
  void add_sides();
  void find_edges();
  /// Whether a face of component d, which may lie beyond a periodic side, is in or next to a body.
  [[nodiscard]] bool is_in_body(int d, std::array<int, 3> face) const;
  [[nodiscard]] bool is_at_wall(int d, int e, const std::array<int, 3>& edge) const;
  void find_viscosity(const FaceField& u);
  [[nodiscard]] double slope(const std::vector<double>& v, std::ptrdiff_t o, std::ptrdiff_t own,
                             int e) const;
  void force_row(const FaceField& u, int d, int j, int k);

  const Grid& grid_;
  const Geometry& geometry_;
  const Sides& sides_;
  const FaceProperties& properties_;
  const sdk::TurbulenceModel& model_;
  double filter_width_ = 0.0;
  Walls walls_;
  CellField distance_;  ///< [m] to the nearest body or wall among the sides
  CellField density_;
  CellField molecular_;
  CellField rate_;  ///< [1/s]
  CellField viscosity_;
  FaceField force_;
  FaceField mean_force_;
  FaceField sum_;  ///< storage of add_to()
};

}  // namespace dust::fluid
