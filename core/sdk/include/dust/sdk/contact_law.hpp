// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/columns.hpp"
#include "dust/sdk/model.hpp"

#include <cstddef>

namespace dust::sdk {

/// Elastic constants of one side of a contact.
struct MaterialProperties {
  double density = 0.0;        ///< [kg/m3]
  double young_modulus = 0.0;  ///< [Pa]
  double poisson_ratio = 0.0;  ///< [-]
};

/// E* [Pa] of a pair: \f$ 1/E^* = (1 - \nu_i^2)/E_i + (1 - \nu_j^2)/E_j \f$.
inline double effective_young_modulus(const MaterialProperties& i, const MaterialProperties& j) {
  const auto compliance = [](const MaterialProperties& m) {
    return (1.0 - m.poisson_ratio * m.poisson_ratio) / m.young_modulus;
  };
  return 1.0 / (compliance(i) + compliance(j));
}

/// A batch of contacts between one pair of materials, as columns of `count` numbers. All contacts
/// of a batch share the law's parameters and the time step.
///
/// Side i is the grain that receives the result, side j the other grain or a wall. The unit normal
/// points from j to i. Velocities are those at the same instant as the positions: for dampers. What
/// a spring remembers grows by `displacement` and `angle`, which are exact, and not by a velocity
/// times the time step: that would damp the spring or feed it, by a part of first order in the
/// step. For a wall, effective_radius and effective_mass are the grain's own.
///
/// The core pads the columns: `count` is a multiple of 8 and rows beyond the true number hold a
/// harmless contact. Inputs are read only; a law writes the output columns of its own stage and its
/// own history columns, nothing else. Columns are 64-byte aligned and never overlap.
struct ContactBatch {
  std::size_t count = 0;
  double time_step = 0.0;  ///< [s] the step this contact is integrated with

  // Geometry and kinematics, written by the core.
  const double* overlap = nullptr;  ///< [m] > 0 in touch; < 0 within a law's range
  VectorColumns normal;             ///< [-]
  VectorColumns velocity;           ///< [m/s] of i relative to j at the contact point
  VectorColumns angular_velocity;   ///< [rad/s] of i relative to j
  /// [m] Displacement of i relative to j at the contact point since the law was last asked about
  /// this contact, or since the two began to touch. Its part along the normal is no overlap.
  VectorColumns displacement;
  VectorColumns angle;  ///< [rad] rotation of i relative to j over the same time
  const double* effective_radius = nullptr;  ///< [m] R*
  const double* effective_mass = nullptr;    ///< [kg] m*

  // Written by the contact stage, read by the later stages.
  double* normal_force = nullptr;          ///< [N] > 0 repulsive, may be negative (damping)
  double* normal_stiffness = nullptr;      ///< [N/m] k_n, secant: elastic force / overlap
  double* tangential_stiffness = nullptr;  ///< [N/m] k_t
  MutableVectorColumns force;              ///< [N] total force on i; j receives the opposite

  // Written by the rolling stage: couple on i, j receives the opposite. Forces' own torque about
  // the centres is added by the core.
  MutableVectorColumns torque;  ///< [N m]

  /// History columns of the stage being run, as many as it declared; zero when a contact begins.
  /// Vectors kept here are in the domain's frame; the law turns them with the normal.
  double* const* history = nullptr;

  // The two sides one by one, written by the core. A wall has the radius of the grain and no
  // inverse mass.
  const double* radius_i = nullptr;        ///< [m]
  const double* radius_j = nullptr;        ///< [m]
  const double* inverse_mass_i = nullptr;  ///< [1/kg] as the contact feels it
  const double* inverse_mass_j = nullptr;  ///< [1/kg]
  /// [N m] For the contact stage: the couple on i that the rolling law's spring held at the last
  /// look; null where there is none (RollingLaw::couple_column()).
  VectorColumns couple;
};

/// Contact stage: normal and tangential force.
/// Owns: its coefficients. May: read inputs, write normal_force, normal_stiffness,
/// tangential_stiffness, force, history. Must not: allocate, lock, look at particles, keep
/// per-contact state elsewhere. Without touch (overlap <= 0) every output is zero.
/// Called: once per batch and step, from several threads at once (evaluate is const).
class ContactLaw : public Model {
 public:
  static constexpr const char* k_kind = "contact";

  /// Called once with the two materials before any batch, in the order in which the scenario names
  /// them. That order has nothing to do with the sides of a batch: i of a contact may be of either
  /// material. So a law has to give the same in both orders, as effective_young_modulus() does.
  virtual void prepare(const MaterialProperties& i, const MaterialProperties& j) = 0;
  /// At most 16, and at most 24 with those of the rolling and the cohesive law of the same pair.
  [[nodiscard]] virtual int history_size() const = 0;
  virtual void evaluate(const ContactBatch& batch) const = 0;

  /// Duration [s] of an elastic head-on collision at `speed` [m/s] of a pair with
  /// `effective_radius` [m] and `effective_mass` [kg]; the core derives time steps from it.
  [[nodiscard]] virtual double collision_time(double effective_radius, double effective_mass,
                                              double speed) const = 0;
  /// Shortest period scale [s] at a given `overlap` [m]: pi sqrt(m* / (dF_n/d overlap)).
  [[nodiscard]] virtual double half_period(double effective_radius, double effective_mass,
                                           double overlap) const = 0;
  /// How far beyond touch [m] the law still acts.
  [[nodiscard]] virtual double range() const { return 0.0; }
  /// True if the elastic normal force is that of Hertz, 4/3 E* sqrt(R*) overlap^(3/2).
  [[nodiscard]] virtual bool has_hertz_force() const { return false; }
};

/// Rolling stage: couple against relative rotation, after the contact stage of the same batch,
/// whose outputs it may read.
class RollingLaw : public Model {
 public:
  static constexpr const char* k_kind = "rolling";

  /// As ContactLaw::prepare().
  virtual void prepare(const MaterialProperties& i, const MaterialProperties& j) = 0;
  [[nodiscard]] virtual int history_size() const = 0;
  virtual void evaluate(const ContactBatch& batch) const = 0;

  /// The first of the three history columns that hold the couple of the law's spring on i [N m];
  /// below 0 without a spring. The contact law of the next step is shown them.
  [[nodiscard]] virtual int couple_column() const { return -1; }
};

}  // namespace dust::sdk
