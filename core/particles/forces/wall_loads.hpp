// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "particles/forces/wall_sliding.hpp"
#include "particles/surfaces.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dust::particles {

class InnerList;
struct ContactScene;

/// What grains did to walls since the last time it was asked, added up in a fixed order.
class WallLoads {
 public:
  /// Sums of one wall: impulse [N s], angular impulse about the origin [N m s], work [J].
  static constexpr std::size_t k_sums = 7;

  void begin(const std::vector<Surface>& surfaces, std::size_t walls, bool has_sliding = false);
  [[nodiscard]] bool is_on() const { return !name_.empty(); }
  [[nodiscard]] std::size_t walls() const { return name_.size(); }
  [[nodiscard]] bool has_sliding() const { return has_sliding_; }

  /// Adds sums (k_sums per wall), impacts and slidings, and empties all.
  void take(std::vector<double>& sums, std::vector<sdk::WallImpact>& impacts,
            WallSlidings& slidings);
  /// Ends the interval [s]: what was added becomes the means of `columns`.
  void close(double interval);
  /// What touches walls now.
  void note_contacts(const ContactScene& scene, const InnerList& lists);
  [[nodiscard]] sdk::WallColumns columns() const;

 private:
  std::vector<std::string> name_, group_;
  std::vector<double> sums_;
  std::vector<sdk::WallImpact> open_impacts_;
  std::vector<sdk::Vec3> force_, torque_;
  std::vector<double> power_, mass_;
  std::vector<std::int64_t> count_;
  std::vector<sdk::WallImpact> impacts_;
  bool has_sliding_ = false;
  std::vector<sdk::WallSliding> open_slidings_, slidings_;
};

/// Adds to the sums of one wall what the grain's side of a contact says: force [N] and torque [N m]
/// about its centre, both on the grain, for a time [s], in which the wall spends `power` [W].
inline void add_load(double* sums, sdk::Vec3 centre, sdk::Vec3 force, sdk::Vec3 torque,
                     double power, double weighted_time) {
  const sdk::Vec3 moment = cross(centre, force) + torque;
  for (int d = 0; d < 3; ++d) {
    sums[d] -= weighted_time * force[d];
    sums[3 + d] -= weighted_time * moment[d];
  }
  sums[6] += weighted_time * power;
}

/// The impact of a grain that has just touched: `relative` is the velocity [m/s] of its surface
/// relative to the wall's, `normal` the wall's.
inline sdk::WallImpact impact_of(std::int32_t wall, double mass, double weight, sdk::Vec3 relative,
                                 sdk::Vec3 normal) {
  const double approach = -dot(relative, normal);
  const sdk::Vec3 along = relative + approach * normal;
  return {wall, approach > 0.0 ? 0.5 * mass * approach * approach : 0.0,
          0.5 * mass * dot(along, along), weight};
}

}  // namespace dust::particles
