// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/contact_law.hpp"

#include <cstddef>

namespace dust::sdk {

/// A batch of pairs in touch or within the law's range, as columns of `count` numbers; conventions
/// as in ContactBatch.
struct CohesionBatch {
  std::size_t count = 0;
  double time_step = 0.0;  ///< [s] the step this pair is integrated with

  // Written by the core.
  const double* overlap = nullptr;           ///< [m] > 0 in touch; < 0 within the law's range
  const double* effective_radius = nullptr;  ///< [m] R*; of a wall: the grain's radius
  const double* effective_mass = nullptr;    ///< [kg] m*; of a wall: the grain's mass
  const double* normal_velocity = nullptr;   ///< [m/s] > 0 while i and j part

  // Written by the law.
  /// [m] The overlap the contact law is to see: `overlap` itself, unless attraction deforms the
  /// grains so much that they press on each other at another one.
  double* contact_overlap = nullptr;
  /// [N] Pulls i towards j. Below 0 (it pushes) only against an approach.
  double* attraction = nullptr;

  /// History columns, as many as the law declared; zero when a pair comes within range. They live
  /// until it leaves the range.
  double* const* history = nullptr;
};

/// Cohesion stage: attraction of two grains, or of a grain and a wall, and what resists their
/// approach and parting before and after touch (a liquid), before the contact stage of the same
/// batch. The force on i is what the contact law gives at `contact_overlap`, less
/// `attraction` along the normal. Friction and rolling resistance are limited by the contact law's
/// force: the load with which the surfaces press on each other, attraction included.
/// Owns: its coefficients. May: read inputs, write contact_overlap, attraction, history. Must not:
/// allocate, lock, look at particles, keep per-contact state elsewhere.
/// Called: once per batch and step, from several threads at once (evaluate is const).
class CohesionLaw : public Model {
 public:
  static constexpr const char* k_kind = "cohesion";

  /// Called once with the two materials before any batch. Throws ParameterError if the law does not
  /// fit them.
  virtual void prepare(const MaterialProperties& i, const MaterialProperties& j) = 0;
  [[nodiscard]] virtual int history_size() const = 0;
  virtual void evaluate(const CohesionBatch& batch) const = 0;

  /// How far beyond touch [m] the law acts on any pair of up to `effective_radius` [m].
  [[nodiscard]] virtual double range(double effective_radius) const = 0;
  /// Contact overlap [m] at which a pair rests under its own attraction, as elastic spheres would:
  /// the core derives time steps from the contact's stiffness there. 0 of a law that resists motion
  /// and attracts nothing at rest.
  [[nodiscard]] virtual double resting_overlap(double effective_radius) const = 0;
  /// True if the law is made for the Hertz force and no other.
  [[nodiscard]] virtual bool needs_hertz_force() const { return false; }
};

}  // namespace dust::sdk
