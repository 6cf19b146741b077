// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/sensor_surfaces.hpp"

#include "base/text.hpp"
#include "bodies/survey/surface_in_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>
#include <span>
#include <string>
#include <string_view>

namespace dust::preflight {
namespace {

using sdk::Vec3;

/// Of half the diagonal of a box: a surface that near counts as in it.
constexpr double k_finest_part = 0.01;
/// [-] Cosine between a belt's way and the direction it is looked at in, below which that is not
/// its way.
constexpr double k_along = 0.7;
/// Instants of the run at which a belt's speed is asked for: it may start late or stop.
constexpr int k_times = 16;

class Surfaces {
 public:
  Surfaces(const scenario::Setup& setup, const bodies::BodySet& bodies,
           const scenario::SensorSpec& spec, scenario::Diagnostics& diagnostics)
      : setup_(setup), bodies_(bodies), spec_(spec), diagnostics_(diagnostics) {}

  /// `names`: of the walls that are meant; empty: any.
  void check(const sdk::SurfacesWanted::Box& box, std::span<const std::string> names) const {
    if (has_surface(box.min, box.max, names)) return;
    warn((names.empty() ? std::string(": no wall") : ": none of its walls") +
         " has a part in the box from " + base::place_text(box.min) + " to " +
         base::place_text(box.max) +
         ": what it tells of walls there is 0; move it round the surface that is meant");
  }

  void check(const sdk::SurfacesWanted::Stretch& stretch) const {
    const auto below = nearest(stretch.middle);
    if (below && std::abs(below->point.distance) <= stretch.reach) {
      check_way(bodies_[below->body], stretch);
      return;
    }
    warn(": looks at no belt: " +
         (below ? "the surface nearest to the middle of the stretch, " +
                      base::place_text(stretch.middle) + ", is that of '" +
                      bodies_[below->body].name + "', " +
                      base::length_text(std::abs(below->point.distance)) + " away"
                : std::string("there is no body")) +
         "; put its point on the belt's top");
  }

 private:
  struct Nearest {
    std::size_t body;
    bodies::SurfacePoint point;
  };

  void warn(const std::string& text) const {
    diagnostics_.warning(spec_.model.where, spec_.model.path + text);
  }

  [[nodiscard]] bool has_surface(Vec3 low, Vec3 high, std::span<const std::string> names) const {
    const auto is_meant = [&](std::string_view name) {
      return names.empty() || std::find(names.begin(), names.end(), name) != names.end();
    };
    for (std::size_t side = 0; side < 6; ++side) {
      if (setup_.domain.sides[side].grains != scenario::GrainSide::wall) continue;
      if (!is_meant(scenario::k_side_names[side])) continue;
      const int d = static_cast<int>(side / 2);
      const double at = side % 2 == 0 ? setup_.domain.min[d] : setup_.domain.max[d];
      if (low[d] <= at && at <= high[d]) return true;
    }
    const Vec3 half = 0.5 * (high - low);
    const Vec3 middle = low + half;
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const bodies::Body& body) {
      if (!is_meant(body.name) && (body.group.empty() || !is_meant(body.group))) return false;
      return std::any_of(k_ends.begin(), k_ends.end(), [&](double share) {
        return bodies::may_meet_box(body, body.placement(share * setup_.time.end), middle, half,
                                    k_finest_part * norm(half));
      });
    });
  }

  /// Of all bodies, at the beginning and at the end.
  [[nodiscard]] std::optional<Nearest> nearest(Vec3 place) const {
    std::optional<Nearest> best;
    for (std::size_t n = 0; n < bodies_.size(); ++n) {
      for (const double share : k_ends) {
        const auto found = bodies_[n].nearest(place, bodies_[n].placement(share * setup_.time.end));
        if (best && std::abs(found.distance) >= std::abs(best->point.distance)) continue;
        best = Nearest{n, found};
      }
    }
    return best;
  }

  void check_way(const bodies::Body& body, const sdk::SurfacesWanted::Stretch& stretch) const {
    if (body.motions.empty() || body.displaces()) return;
    const auto found = body.nearest(stretch.middle);
    Vec3 fastest;
    for (int step = 0; step <= k_times; ++step) {
      const Vec3 v = body.surface_velocity(stretch.middle - found.distance * found.normal,
                                           found.normal, setup_.time.end * step / k_times);
      if (norm(v) > norm(fastest)) fastest = v;
    }
    const double speed = norm(fastest);
    const double cosine = speed > 0.0 ? dot(fastest, stretch.along) / speed : 1.0;
    if (cosine >= k_along) return;
    warn(std::string(": looks ") + (cosine < -k_along ? "against" : "across") + " the way that '" +
         body.name + "' runs there, " + base::digits_text(speed, 3) + " m/s along [" +
         base::digits_text(fastest.x / speed, 2) + ", " + base::digits_text(fastest.y / speed, 2) +
         ", " + base::digits_text(fastest.z / speed, 2) + "]: give that direction");
  }

  static constexpr std::array<double, 2> k_ends{0.0, 1.0};

  const scenario::Setup& setup_;
  const bodies::BodySet& bodies_;
  const scenario::SensorSpec& spec_;
  scenario::Diagnostics& diagnostics_;
};

}  // namespace

void check_sensor_surfaces(const scenario::Setup& setup, const bodies::BodySet& bodies,
                           const scenario::SensorSpec& spec, const sdk::Sensor& sensor,
                           scenario::Diagnostics& diagnostics) {
  const auto wanted = sensor.wanted_surfaces();
  const Surfaces surfaces(setup, bodies, spec, diagnostics);
  if (wanted.wall_in) surfaces.check(*wanted.wall_in, wanted.walls);
  if (wanted.stretch) surfaces.check(*wanted.stretch);
}

}  // namespace dust::preflight
