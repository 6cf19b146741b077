// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/velocity_forcing.hpp"
#include "resolved/face_stencil.hpp"
#include "resolved/marker_lattice.hpp"
#include "resolved/sphere.hpp"

#include <array>
#include <cstddef>
#include <map>
#include <memory>
#include <vector>

namespace dust::resolved {

/// Drives the fluid at the markers of spheres to the velocity of their surfaces (direct forcing,
/// Uhlmann 2005, 10.1016/j.jcp.2005.03.017, in several loops, Breugem 2012,
/// 10.1016/j.jcp.2012.02.026): docs/theory/resolved.md, eq. (1). The forces of the part before act
/// during the prediction, so that the implicit viscous step knows of the surface; only what is
/// missing is given after it. Sums run in the order of the spheres and their markers: the same bits
/// for any number of threads.
class MarkerForcing final : public fluid::VelocityForcing {
 public:
  /// `density` [kg/m3] of the fluid; the grid is kept by reference.
  MarkerForcing(const fluid::Grid& grid, double density);

  /// Forces [N] on the fluid at the markers of a sphere.
  using Forces = std::vector<sdk::Vec3>;

  /// For the coming fluid step: the spheres in the order of their ids, and the forces at their
  /// markers at the end of the step before; empty where there was none. `velocity` of the fluid
  /// with filled halo.
  void begin_step(std::vector<Sphere> spheres, std::vector<Forces> forces,
                  const fluid::FaceField& velocity);

  const fluid::FaceField& add_to(const fluid::FaceField& given, const fluid::ForcedFluid& fluid,
                                 const fluid::ForcedPart& part) override;
  void force(fluid::FaceField& velocity, const fluid::ForcedFluid& fluid,
             const fluid::ForcedPart& part) override;
  const fluid::FaceField& add_mean_to(const fluid::FaceField& given,
                                      const fluid::CellField& eps) override;

  [[nodiscard]] const std::vector<Sphere>& spheres() const { return spheres_; }
  /// What the markers of sphere `n` gave the fluid in this fluid step.
  [[nodiscard]] const Impulse& given(std::size_t n) const { return marked_[n].given; }
  [[nodiscard]] const Forces& forces(std::size_t n) const { return marked_[n].forces; }
  /// [rad/s] How much faster its markers turn, and the fluid inside with them.
  [[nodiscard]] sdk::Vec3 turning_ahead(std::size_t n) const { return marked_[n].turning_ahead; }
  [[nodiscard]] std::size_t markers() const;
  /// [m/s] Largest difference between the fluid, as the markers see it where they stood last, and
  /// the surface there; `velocity` with filled halo.
  [[nodiscard]] double largest_slip(const fluid::FaceField& velocity) const;

 private:
  /// What belongs to a sphere for a fluid step.
  struct Marked {
    std::shared_ptr<const MarkerLattice> lattice;
    Forces forces;
    Forces change;                                     ///< [N] of a loop
    std::vector<char> has_left;                        ///< markers beyond a side of the domain
    std::array<std::vector<FaceStencil>, 3> stencils;  ///< per component, where they stand
    std::array<FacePatch, 3> patches;                  ///< [N] per face
    Impulse given;
    sdk::Vec3 turning_ahead;  ///< [rad/s] of the sphere
  };

  [[nodiscard]] std::shared_ptr<const MarkerLattice> lattice_of(double diameter);
  void find_turning(const fluid::FaceField& velocity);
  void place_markers(double time);
  void find_change(const fluid::FaceField& velocity, double step);
  void spread(Forces Marked::*forces);
  /// Calls take(component, padded index, force [N]) for the faces that were spread to.
  template <class Take>
  void each_face(const fluid::ForcedFluid& fluid, const Take& take);
  void note_given(Forces Marked::*forces, double step);
  [[nodiscard]] sdk::Vec3 surface_velocity(std::size_t sphere, std::size_t marker) const;
  /// Calls work(sphere, component) for all, side by side.
  template <class Work>
  void each_part(const Work& work) const;

  const fluid::Grid& grid_;
  double density_;
  double spacing_;                                                   ///< [m]
  std::map<double, std::shared_ptr<const MarkerLattice>> lattices_;  ///< by diameter
  std::vector<Sphere> spheres_;
  std::vector<Marked> marked_;
  fluid::FaceField source_;
  fluid::FaceField mean_;  ///< [N/m3] over the fluid step, of the whole volume
};

}  // namespace dust::resolved
