// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/columns.hpp"
#include "dust/sdk/model.hpp"
#include "dust/sdk/vec3.hpp"

#include <cstddef>

namespace dust::sdk {

/// Columns of `count` grains and of the fluid around each. Those a model has not asked for
/// (FluidForce::needs) are null.
struct FluidForceBatch {
  std::size_t count = 0;
  double interval = 0.0;  ///< [s] from now on, for which the force is held
  Vec3 gravity;           ///< [m/s2]

  const double* diameter = nullptr;       ///< [m]
  const double* mass = nullptr;           ///< [kg] of one real grain
  VectorColumns angular_velocity;         ///< [rad/s] of the grain
  const double* density = nullptr;        ///< [kg/m3] of the fluid
  const double* viscosity = nullptr;      ///< [Pa s] of the fluid
  const double* void_fraction = nullptr;  ///< [-] in (0, 1]
  VectorColumns slip;                     ///< [m/s] w = u_f - u_p, interstitial
  VectorColumns vorticity;                ///< [1/s] curl u_f, if needed
  VectorColumns acceleration;       ///< [m/s2] d(u_f)/dt along the path of the grain, if needed
  VectorColumns pressure_gradient;  ///< [Pa/m] without the hydrostatic part, if needed
  VectorColumns viscous_stress;     ///< [N/m3] div tau, if needed
  const double* gap = nullptr;  ///< [m] to the nearest wall, > 0; infinite beyond reach; if needed
  VectorColumns wall_normal;    ///< [-] from that wall to the grain
  VectorColumns wall_velocity;  ///< [m/s] of its surface there

  // Written by the model; all zero before the call.
  MutableVectorColumns force;  ///< [N] on one grain
  /// [kg] the grain feels - added_mass du_p/dt besides; taken implicitly.
  double* added_mass = nullptr;
  /// [kg/s] the grain feels - resistance (u_p - u_wall) . n n besides; taken implicitly.
  double* resistance = nullptr;
  /// FluidForce::history_size numbers per grain, one grain after another; zero for a new grain.
  /// They stay with the grain and are saved.
  double* history = nullptr;
};

/// What of the columns above a model reads. Asked once, at the start.
struct FluidForceNeeds {
  bool vorticity = false;
  bool acceleration = false;
  bool stresses = false;    ///< pressure_gradient and viscous_stress
  double wall_reach = 0.0;  ///< [diameters] gaps up to this are looked for; 0 = none
};

/// Forces that act without being named: the core leaves them to a model that takes them over.
struct FluidForceParts {
  bool pressure_gradient = false;  ///< by the pressure the fluid solver knows
  bool viscous_stress = false;
  bool buoyancy = false;  ///< by the hydrostatic pressure
};

/// Who receives the opposite of the force.
enum class FluidForceReaction {
  fluid,         ///< the air around the grain, as with drag
  momentum_set,  ///< the momentum equation of the fluid holds it already
  wall           ///< the nearest wall
};

/// A force of the fluid on single grains besides drag, batch-wise. Must not: allocate, lock, clamp
/// without saying so, keep state of a grain elsewhere than in `history`. Called from several
/// threads at once, once per grain and refresh of the coupling.
class FluidForce : public Model {
 public:
  static constexpr const char* k_kind = "fluid_force";
  virtual void evaluate(const FluidForceBatch& batch) const = 0;
  [[nodiscard]] virtual FluidForceNeeds needs() const { return {}; }
  [[nodiscard]] virtual FluidForceParts takes_over() const { return {}; }
  [[nodiscard]] virtual FluidForceReaction reaction() const { return FluidForceReaction::fluid; }
  /// Numbers kept per grain between calls.
  [[nodiscard]] virtual int history_size() const { return 0; }
};

}  // namespace dust::sdk
