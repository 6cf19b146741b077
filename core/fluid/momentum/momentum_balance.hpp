// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/step/step_void_fraction.hpp"

namespace dust::fluid {

/// What the fluid of each face's control volume has received in excess of what the equation gives
/// it, kept so that it can be taken back: with grains in it the scheme conserves momentum to its
/// order only (docs/theory/fluid.md, eq. (8)). Per cell volume [N s/m3], over a fluid step,
///   excess = rho (eps u)_end - rho (eps u)_begin
///            + dt (rho sum F u_f - w (source - coefficient u_drag - grad p + div tau)) ,
/// F the fluxes that carried the momentum, p and tau means over the step, w = eps (set III: 1).
/// Sums of F u_f, grad p and div tau over a domain without sides vanish. Faces next to bodies and
/// on sides are not counted.
class MomentumBalance {
 public:
  MomentumBalance(const Grid& grid, const Geometry& geometry, const FaceProperties& properties);

  /// At the beginning of a fluid step: the fluid as it is, and the source with what is taken back
  /// over `step` [s]. Keeps the void fraction of now; that of the step is to be set anew.
  void begin(const FaceField& u, StepVoidFraction& void_fraction, const FaceField& source,
             double step);
  [[nodiscard]] const FaceField& source() const { return source_; }
  /// A row of component d from padded index `o` on: its convection u . grad u and what flows
  /// through its control volumes, which acted for `time` [s].
  void add_convection(int d, std::ptrdiff_t o, double time, const double* u, const double* eps,
                      const double* convection, const RowFlux& flux);
  /// What acted on the fluid.
  struct Acted {
    const FaceField& source;       ///< as begin() had it, and what was added since
    const FaceField& coefficient;  ///< of drag
  };
  /// At the end; `last` the share of the step of its last part.
  void end(const FaceField& u, const CellField& eps, const Acted& acted,
           const FaceField& drag_velocity, const FaceField& stress, double step, double last);

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  /// Calls work(d, j, k, padded index of the first face, number of faces) for every row.
  template <class Work>
  void each_row(const Work& work) const;
  void leave_out_bodies(int d, int j, int k);
  void leave_out_sides(int d, int j, int k);

  const Grid& grid_;
  const Geometry& geometry_;
  const FaceProperties& properties_;
  FaceField excess_;
  /// Of the excess, what is to be taken back. The rest is the momentum of the fluid that the last
  /// change of the void fraction has yet to push aside: convection reckons with the change before.
  FaceField deferred_;
  FaceField source_;
  CellField eps_before_;
};

}  // namespace dust::fluid
