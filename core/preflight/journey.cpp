// SPDX-License-Identifier: Apache-2.0
#include "preflight/journey.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::preflight {
namespace {

using scenario::DomainSpec;
using scenario::GrainSide;
using scenario::Setup;
using sdk::Vec3;

/// Of grains on anything, where no more than its order is asked for.
constexpr double k_friction = 0.5;
/// Steps of one journey; a grain that is still there then stays.
constexpr int k_max_steps = 4000;
/// A step takes the grain by this share of its radius at most.
constexpr double k_step_share = 0.5;
/// Small grains go by coarser steps: this share of the domain's longest edge stands for the radius.
constexpr double k_min_radius = 2e-3;
/// Slower than this share of the speed of a fall by its radius, a grain on a surface rests.
constexpr double k_rest_share = 0.1;
/// Steps in a row that a grain must rest.
constexpr int k_rest_steps = 20;

constexpr double k_never = std::numeric_limits<double>::infinity();

class Traveller {
 public:
  Traveller(const Setup& setup, const bodies::BodySet& bodies, const sdk::InsertionRequest& grain)
      : setup_(setup), bodies_(bodies), x_(grain.position), v_(grain.velocity) {
    const Vec3 size = setup.domain.max - setup.domain.min;
    radius_ = std::max(0.5 * grain.diameter, k_min_radius * std::max({size.x, size.y, size.z}));
    slow_ = std::max(std::sqrt(norm(setup.gravity) * radius_), 1e-9);
  }

  Journey follow(double longest) {
    Journey j;
    j.on_body.assign(bodies_.size(), 0.0);
    int rested = 0;
    for (int n = 0; n < k_max_steps && j.duration < longest; ++n) {
      const double step = k_step_share * radius_ / std::max(norm(v_), slow_);
      v_ += step * setup_.gravity;
      x_ += step * v_;
      is_carried_ = false;
      if (is_out()) return j;
      for (std::size_t b = 0; b < bodies_.size(); ++b) {
        if (meet(bodies_[b], j.duration)) j.on_body[b] += step;
      }
      j.duration += step;
      if (!is_carried_) continue;
      j.first_touch = std::min(j.first_touch, j.duration);
      j.carried += step;
      j.carried_way += step * norm(v_);
      rested = norm(v_) < k_rest_share * slow_ ? rested + 1 : 0;
      if (rested == k_rest_steps) break;
    }
    j.duration = k_never;
    return j;
  }

 private:
  /// Walls hold it, periodic sides let it in again; true beyond an open one.
  bool is_out() {
    const DomainSpec& domain = setup_.domain;
    for (int d = 0; d < 3; ++d) {
      const double width = domain.max[d] - domain.min[d];
      for (const int upper : {0, 1}) {
        const double outside = upper == 1 ? x_[d] - domain.max[d] : domain.min[d] - x_[d];
        const scenario::SideSpec& side = domain.sides[static_cast<std::size_t>(2 * d + upper)];
        const double sign = upper == 1 ? -1.0 : 1.0;
        if (side.grains == GrainSide::wall) {
          if (outside + radius_ <= 0.0) continue;
          Vec3 normal;
          normal[d] = sign;
          touch(normal, outside + radius_, {});
        } else if (outside > 0.0) {
          if (side.grains == GrainSide::open) return true;
          x_[d] += sign * width;
        }
      }
    }
    return false;
  }

  bool meet(const bodies::Body& body, double time) {
    if (body.is_removed()) return false;
    const bodies::SurfacePoint near =
        body.displaces() ? body.nearest(x_, body.placement(time)) : body.nearest(x_);
    if (!(near.distance < radius_)) return false;
    const Vec3 foot = x_ - near.distance * near.normal;
    touch(near.normal, radius_ - near.distance, body.surface_velocity(foot, near.normal, time));
    return true;
  }

  void touch(Vec3 normal, double overlap, Vec3 surface) {
    is_carried_ = true;
    x_ += overlap * normal;
    const Vec3 slip = v_ - surface;
    const double into = -dot(slip, normal);
    if (!(into > 0.0)) return;
    v_ += into * normal;
    const Vec3 along = slip + into * normal;
    const double speed = norm(along);
    if (speed > 0.0) v_ -= (std::min(k_friction * into, speed) / speed) * along;
  }

  const Setup& setup_;
  const bodies::BodySet& bodies_;
  Vec3 x_, v_;
  double radius_;  ///< [m]
  double slow_;    ///< [m/s] of a fall by the radius
  bool is_carried_ = false;
};

}  // namespace

Journey follow_grain(const Setup& setup, const bodies::BodySet& bodies,
                     const sdk::InsertionRequest& grain, double longest) {
  return Traveller(setup, bodies, grain).follow(longest);
}

double grain_seconds(double begin, double end, double duration, double run_end) {
  const double last = std::min(end, run_end);
  if (!(last > begin)) return 0.0;
  // Those that come before `full` have gone by the end of the run.
  const double full = std::clamp(run_end - duration, begin, last);
  const double whole = full > begin ? duration * (full - begin) : 0.0;
  return whole + 0.5 * ((run_end - full) * (run_end - full) - (run_end - last) * (run_end - last));
}

double most_grains(double begin, double end, double duration, double run_end) {
  return std::max(0.0, std::min(duration, std::min(end, run_end) - begin));
}

}  // namespace dust::preflight
