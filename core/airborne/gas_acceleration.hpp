// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/flow.hpp"
#include "dust/sdk/archive.hpp"
#include "fluid/grid.hpp"

#include <array>
#include <vector>

namespace dust::airborne {

/// Acceleration of the gas as it goes along, Du/Dt = du/dt + (u grad) u, on faces, each along its
/// own normal: what dust cannot follow (docs/theory/dust.md, section 1). Central differences,
/// one-sided next to faces that are closed; second order where the flow is smooth. 0 on the sides
/// of the domain and in closed faces. Among grains, whose coming and going makes the velocity of a
/// cell's gas swing, it fades out: to nothing at a solids fraction of 1 %.
class GasAcceleration {
 public:
  /// `memory` [s]: the rate of change is that of the mean over so long a past, exponentially
  /// weighted. With the response time of the dust it is what dust feels of gas that changes faster:
  /// with less, it would be thrown about by what it is too slow to follow.
  GasAcceleration(const fluid::Grid& grid, double memory);

  /// Of the gas between the grains at the end of a fluid step of `step` [s].
  void find(const Flow& flow, double step);
  /// [m/s2] on faces along d.
  [[nodiscard]] const std::vector<float>& field(std::size_t d) const { return acceleration_[d]; }
  /// [1/s] |grad u_d| at the same places: how fast what goes with the gas meets another u_d.
  [[nodiscard]] const std::vector<float>& turn(std::size_t d) const { return turn_[d]; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  void find_velocity(const Flow& flow);
  void find_clear(const Flow& flow);
  /// Gives a periodic component values beyond both ends.
  void wrap(std::vector<double>& values, std::size_t component) const;
  /// `rate` [1/s]: of what the mean is behind, how much it makes up for during the step.
  void find_row(int d, int j, int k, double rate);
  void go_towards_velocity(double share);

  fluid::Grid grid_;
  fluid::FaceField velocity_;  ///< [m/s] of the gas between the grains; 0: nothing passes
  fluid::FaceField past_;      ///< [m/s] its mean over the past
  fluid::FaceField has_past_;  ///< 1 where that is known
  fluid::FaceField clear_;     ///< [-] how clear of grains a face is; 0: nothing passes
  double memory_;
  std::array<std::vector<float>, 3> acceleration_;
  std::array<std::vector<float>, 3> turn_;
  bool is_first_ = true;
};

}  // namespace dust::airborne
