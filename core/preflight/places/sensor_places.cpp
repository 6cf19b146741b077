// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/sensor_places.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace dust::preflight {
namespace {

using sdk::Vec3;

/// [-] of the domain's diagonal: places on a side are in the domain, however they were rounded.
constexpr double k_rounding = 1e-9;

class Places {
 public:
  Places(const scenario::Setup& setup, const bodies::BodySet& bodies,
         const scenario::SensorSpec& spec, const std::vector<sdk::Parameter>& parameters)
      : domain_(setup.domain),
        bodies_(bodies),
        specs_(setup.bodies),
        gravity_(setup.gravity),
        spec_(spec),
        parameters_(parameters),
        slack_(k_rounding * norm(setup.domain.max - setup.domain.min)) {}

  void check(scenario::Diagnostics& diagnostics) const {
    const auto* low = get<Vec3>("min");
    const auto* high = get<Vec3>("max");
    if (low != nullptr && high != nullptr && !meets(*low, *high)) {
      diagnostics.error(spec_.model.where,
                        path("min") + ": the box from " + base::place_text(*low) + " to " +
                            base::place_text(*high) + " lies outside" + domain_text());
    }
    check_plane(diagnostics);
    check_point(diagnostics);
    check_drops(diagnostics);
    for (const std::string_view name : {"from", "to"}) {
      if (const auto* place = get<Vec3>(name)) check_place(name, *place, diagnostics);
    }
    if (const auto* points = get<std::vector<Vec3>>("points")) {
      for (const Vec3& place : *points) {
        check_place("points", place, diagnostics);
        check_air(place, diagnostics);
      }
    }
  }

 private:
  template <class T>
  [[nodiscard]] const T* get(std::string_view name,
                             sdk::Dimension dimension = sdk::dimension::length) const {
    for (std::size_t n = 0; n < parameters_.size() && n < spec_.model.values.size(); ++n) {
      if (parameters_[n].name != name || parameters_[n].dimension != dimension) continue;
      return std::get_if<T>(&spec_.model.values[n]);
    }
    return nullptr;
  }
  /// A rectangle that a box cuts out of a plane.
  void check_plane(scenario::Diagnostics& diagnostics) const {
    const auto* low = get<Vec3>("min");
    const auto* high = get<Vec3>("max");
    const auto* point = get<Vec3>("point");
    const auto* normal = get<Vec3>("normal", sdk::dimension::none);
    if (low == nullptr || high == nullptr || point == nullptr || normal == nullptr) return;
    const Vec3 half = 0.5 * (*high - *low);
    const double reach =
        std::abs(normal->x) * half.x + std::abs(normal->y) * half.y + std::abs(normal->z) * half.z;
    const double apart = std::abs(dot(*low + half - *point, *normal));
    if (apart <= reach + slack_ * norm(*normal)) return;
    diagnostics.error(spec_.model.where,
                      path("point") + ": the plane through it does not meet the box from " +
                          base::place_text(*low) + " to " + base::place_text(*high) +
                          ": nothing is seen there; move one of them");
  }
  /// A place that nothing else goes with, or a plane without ends.
  void check_point(scenario::Diagnostics& diagnostics) const {
    const auto* point = get<Vec3>("point");
    if (point == nullptr || get<Vec3>("min") != nullptr) return;
    const auto* normal = get<Vec3>("normal", sdk::dimension::none);
    if (normal != nullptr) return;
    if (meets(*point, *point)) check_stretch(*point, diagnostics);
    check_place("point", *point, diagnostics);
  }
  /// A stretch from a point on: sums over it are divided by the whole of its length.
  void check_stretch(Vec3 begin, scenario::Diagnostics& diagnostics) const {
    const auto* direction = get<Vec3>("direction", sdk::dimension::none);
    const auto* length = get<double>("length");
    if (direction == nullptr || length == nullptr || !(norm(*direction) > 0.0)) return;
    const Vec3 end = begin + *length / norm(*direction) * *direction;
    if (meets(end, end)) return;
    diagnostics.error(spec_.model.where,
                      path("length") + ": the stretch from " + base::place_text(begin) +
                          " ends at " + base::place_text(end) + ", outside" + domain_name() +
                          ": nothing is seen there, and what it tells would be too small; make it "
                          "shorter");
  }
  /// Levels below a place, along gravity.
  void check_drops(scenario::Diagnostics& diagnostics) const {
    const auto* from = get<Vec3>("from");
    const auto* drops = get<std::vector<double>>("drops");
    if (from == nullptr || drops == nullptr || !(norm(gravity_) > 0.0)) return;
    const Vec3 down = gravity_ / norm(gravity_);
    double lowest = 0.0;
    for (int d = 0; d < 3; ++d) {
      lowest += ((down[d] > 0.0 ? domain_.max[d] : domain_.min[d]) - (*from)[d]) * down[d];
    }
    for (const double drop : *drops) {
      if (drop <= lowest + slack_) continue;
      diagnostics.error(spec_.model.where, path("drops") + ": " + base::length_text(drop) +
                                               " below " + base::place_text(*from) + " lies below" +
                                               domain_name() + ", which ends " +
                                               base::length_text(std::max(0.0, lowest)) +
                                               " below it: nothing is seen there; leave it out");
    }
  }
  [[nodiscard]] bool meets(Vec3 low, Vec3 high) const {
    for (int d = 0; d < 3; ++d) {
      if (high[d] < domain_.min[d] - slack_ || low[d] > domain_.max[d] + slack_) return false;
    }
    return true;
  }
  void check_place(std::string_view name, Vec3 place, scenario::Diagnostics& diagnostics) const {
    if (meets(place, place)) return;
    diagnostics.error(spec_.model.where, path(name) + ": " + base::place_text(place) +
                                             " lies outside" + domain_text());
  }
  /// What is asked at points is of the air.
  void check_air(Vec3 place, scenario::Diagnostics& diagnostics) const {
    for (std::size_t n = 0; n < bodies_.size(); ++n) {
      const bodies::Body& body = bodies_[n];
      if (specs_[n].removal || body.displaces()) continue;
      if (body.nearest(place).distance >= -slack_) continue;
      diagnostics.warning(spec_.model.where, path("points") + ": " + base::place_text(place) +
                                                 " lies in the body '" + body.name +
                                                 "', where there is no air: what is told of it is "
                                                 "0; move it out");
    }
  }
  [[nodiscard]] std::string path(std::string_view name) const {
    return spec_.model.path + "." + std::string(name);
  }
  [[nodiscard]] std::string domain_name() const {
    return " the domain, from " + base::place_text(domain_.min) + " to " +
           base::place_text(domain_.max);
  }
  [[nodiscard]] std::string domain_text() const {
    return domain_name() + ": nothing is seen there; move it inside";
  }

  const scenario::DomainSpec& domain_;
  const bodies::BodySet& bodies_;
  const std::vector<scenario::BodySpec>& specs_;
  Vec3 gravity_;
  const scenario::SensorSpec& spec_;
  const std::vector<sdk::Parameter>& parameters_;
  double slack_;
};

}  // namespace

void check_sensor_places(const scenario::Setup& setup, const bodies::BodySet& bodies,
                         const scenario::SensorSpec& spec, const sdk::ParameterSchema& parameters,
                         scenario::Diagnostics& diagnostics) {
  Places(setup, bodies, spec, parameters).check(diagnostics);
}

}  // namespace dust::preflight
