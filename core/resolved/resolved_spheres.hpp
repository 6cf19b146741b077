// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "fluid/fluid_solver.hpp"
#include "particles/grain_rows.hpp"
#include "resolved/marker_forcing.hpp"
#include "resolved/sphere.hpp"

#include <cstddef>
#include <cstdint>
#include <functional>
#include <span>
#include <vector>

namespace dust::resolved {

/// What they meet.
struct FluidAround {
  double density = 0.0;  ///< [kg/m3] of the fluid
  double step = 0.0;     ///< [s] of the fluid
  sdk::Vec3 buoyancy;    ///< [N/m3] that the weight of the grains has not been reduced by
};

/// For the summary and run-time checks.
struct ResolvedReport {
  std::int64_t spheres = 0;
  std::int64_t markers = 0;
  double least_cells_per_diameter = 0.0;  ///< since the start; 0 = no sphere yet
  double largest_slip = 0.0;              ///< [m/s] at a marker after the last step
};

/// Spheres whose surfaces the fluid meets, instead of a drag law: docs/theory/resolved.md. During a
/// fluid step:
///   begin_step()  takes the spheres as they are, with the forces of the step before
///   (the fluid solver advances; forcing() acts on it)
///   evaluate()    what the fluid gave each sphere
///   act()         that as a force which is constant over the grains' cycle, and a change of spin
///   end_step()    what they really received; the difference is given in the next step
/// Spheres are recognised by their ids: rows may be reordered at any time.
class ResolvedSpheres {
 public:
  /// `materials`: indices of those whose grains are resolved. The grid is kept by reference.
  ResolvedSpheres(const fluid::Grid& grid, std::vector<std::int32_t> materials,
                  const FluidAround& around);

  [[nodiscard]] MarkerForcing& forcing() { return forcing_; }
  [[nodiscard]] const MarkerForcing& forcing() const { return forcing_; }
  [[nodiscard]] bool is_resolved(std::int32_t material) const;

  /// `velocity` of the fluid, with filled halo. Throws sdk::ModelError for a sphere that stands for
  /// several.
  void begin_step(const particles::GrainRows& grains, const fluid::FaceField& velocity);
  void evaluate(const fluid::FaceField& velocity);
  /// Writes drag_relaxation of the spheres. Calls turn(row, change of the angular velocity
  /// [rad/s]).
  using Turn = std::function<void(std::size_t, sdk::Vec3)>;
  void act(const particles::GrainRows& grains, const Turn& turn);
  /// Reads fluid_impulse of the spheres and sets it to zero.
  void end_step(const particles::GrainRows& grains);

  [[nodiscard]] const ResolvedReport& report() const { return report_; }
  /// [N s] of the fluid inside the spheres, and of what they have yet to receive.
  [[nodiscard]] sdk::Vec3 inner_momentum() const;
  [[nodiscard]] sdk::Vec3 deferred() const;

  /// Between end_step() and begin_step().
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  /// Of a sphere from step to step.
  struct State {
    std::int64_t id = -1;
    Impulse inner;                 ///< of the fluid inside
    Impulse due;                   ///< to be received in this step
    sdk::Vec3 deferred;            ///< [N s] not yet received
    sdk::Vec3 turned;              ///< [rad/s] change of the spin in the step before
    MarkerForcing::Forces forces;  ///< at the end of the step before
  };
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::size_t>> rows_of(
      const particles::GrainRows& grains) const;
  template <class Visit>
  void each_row(const particles::GrainRows& grains, const Visit& visit);
  State state_of(const Sphere& sphere, const fluid::FaceField& velocity);

  const fluid::Grid& grid_;
  std::vector<std::int32_t> materials_;
  FluidAround around_;
  MarkerForcing forcing_;
  std::vector<State> states_;  ///< in the order of the ids, as forcing_ has them
  ResolvedReport report_;
};

}  // namespace dust::resolved
