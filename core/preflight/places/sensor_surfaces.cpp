// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/sensor_surfaces.hpp"

#include "base/text.hpp"
#include "bodies/survey/surface_in_box.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <optional>
#include <string>
#include <string_view>
#include <variant>

namespace dust::preflight {
namespace {

using sdk::Vec3;

/// The sensors whose places mean something for a surface.
constexpr std::string_view k_wear = "wear";
constexpr std::string_view k_belt_load = "belt_load";
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
           const scenario::SensorSpec& spec, const sdk::ParameterSchema& parameters)
      : setup_(setup), bodies_(bodies), spec_(spec), parameters_(parameters) {}

  void check_wear(scenario::Diagnostics& diagnostics) const {
    const auto* low = get<Vec3>("min");
    const auto* high = get<Vec3>("max");
    if (low == nullptr || high == nullptr || has_surface(*low, *high)) return;
    diagnostics.warning(spec_.model.where,
                        spec_.model.path + ".min: no wall has a part in the box from " +
                            base::place_text(*low) + " to " + base::place_text(*high) +
                            ": the wear there is 0; move it round the surface that is meant");
  }

  void check_belt_load(scenario::Diagnostics& diagnostics) const {
    const auto* point = get<Vec3>("point");
    const auto* direction = get<Vec3>("direction");
    const auto* up = get<Vec3>("up");
    const auto* length = get<double>("length");
    const auto* height = get<double>("height");
    if (point == nullptr || direction == nullptr || up == nullptr || length == nullptr ||
        height == nullptr || !(norm(*direction) > 0.0) || !(norm(*up) > 0.0)) {
      return;
    }
    const Vec3 along = *direction / norm(*direction);
    const Vec3 middle = *point + 0.5 * *length * along;
    const auto below = nearest(middle);
    // Grains up to `height` belong to the load: with the surface farther off none of them lies.
    if (!below || std::abs(below->point.distance) > *height) {
      diagnostics.warning(
          spec_.model.where,
          spec_.model.path + ".point: " +
              (below ? "the surface nearest to the middle of the stretch, of '" +
                           bodies_[below->body].name + "', is " +
                           base::length_text(std::abs(below->point.distance)) + " away from it"
                     : "there is no body") +
              ": it looks at no belt; put the point on the belt's top");
      return;
    }
    check_way(bodies_[below->body], middle, along, diagnostics);
  }

 private:
  struct Nearest {
    std::size_t body;
    bodies::SurfacePoint point;
  };

  template <class T>
  [[nodiscard]] const T* get(std::string_view name) const {
    for (std::size_t n = 0; n < parameters_.size() && n < spec_.model.values.size(); ++n) {
      if (parameters_[n].name == name) return std::get_if<T>(&spec_.model.values[n]);
    }
    return nullptr;
  }

  [[nodiscard]] bool has_surface(Vec3 low, Vec3 high) const {
    for (std::size_t side = 0; side < 6; ++side) {
      if (setup_.domain.sides[side].grains != scenario::GrainSide::wall) continue;
      const int d = static_cast<int>(side / 2);
      const double at = side % 2 == 0 ? setup_.domain.min[d] : setup_.domain.max[d];
      if (low[d] <= at && at <= high[d]) return true;
    }
    const Vec3 half = 0.5 * (high - low);
    const Vec3 middle = low + half;
    return std::any_of(bodies_.begin(), bodies_.end(), [&](const bodies::Body& body) {
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

  void check_way(const bodies::Body& body, Vec3 middle, Vec3 along,
                 scenario::Diagnostics& diagnostics) const {
    if (body.motions.empty() || body.displaces()) return;
    const auto found = body.nearest(middle);
    Vec3 fastest;
    for (int step = 0; step <= k_times; ++step) {
      const Vec3 v = body.surface_velocity(middle - found.distance * found.normal, found.normal,
                                           setup_.time.end * step / k_times);
      if (norm(v) > norm(fastest)) fastest = v;
    }
    const double speed = norm(fastest);
    if (!(speed > 0.0) || dot(fastest, along) >= k_along * speed) return;
    diagnostics.warning(
        spec_.model.where,
        spec_.model.path + ".direction: is " +
            (dot(fastest, along) < -k_along * speed ? "against the way" : "across the way") +
            " that '" + body.name + "' runs there, " + base::digits_text(speed, 3) +
            " m/s along [" + base::digits_text(fastest.x / speed, 2) + ", " +
            base::digits_text(fastest.y / speed, 2) + ", " +
            base::digits_text(fastest.z / speed, 2) + "]: give that direction");
  }

  static constexpr std::array<double, 2> k_ends{0.0, 1.0};

  const scenario::Setup& setup_;
  const bodies::BodySet& bodies_;
  const scenario::SensorSpec& spec_;
  const sdk::ParameterSchema& parameters_;
};

}  // namespace

void check_sensor_surfaces(const scenario::Setup& setup, const bodies::BodySet& bodies,
                           const registry::Registry& registry, scenario::Diagnostics& diagnostics) {
  for (const scenario::SensorSpec& sensor : setup.sensors) {
    if (diagnostics.has_error_below(sensor.model.path)) continue;
    const registry::Entry* entry = registry.find("sensor", sensor.model.name);
    if (entry == nullptr) continue;
    const Surfaces surfaces(setup, bodies, sensor, entry->info.parameters);
    if (sensor.model.name == k_wear) surfaces.check_wear(diagnostics);
    if (sensor.model.name == k_belt_load) surfaces.check_belt_load(diagnostics);
  }
}

}  // namespace dust::preflight
