// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/outlet_check.hpp"

#include "base/text.hpp"
#include "preflight/places/shape_parameter.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace dust::preflight {
namespace {

using sdk::Vec3;

/// [-] Width of a round outlet over the diameter of the grains below which spheres clog it within
/// some avalanches: 4.94 (Zuriguel et al. 2005, Physical Review E 71, 051303).
constexpr double k_arching = 4.94;
/// Grains that come at once; fewer do not build an arch.
constexpr std::int64_t k_few = 20;

/// A hole that grains fall through.
struct Outlet {
  const char* what = "";
  double width = 0.0;  ///< [m] 0 = none
  Vec3 axis;           ///< of any length, out of it
  bool is_two_way = false;
};

/// Zero where there is none.
double length_of(const scenario::ModelChoice& shape, std::string_view name) {
  const auto* length = shape_parameter<double>(shape, name);
  return length != nullptr ? *length : 0.0;
}

Outlet outlet_of(const scenario::ModelChoice& shape) {
  const auto* given = shape_parameter<Vec3>(shape, "axis");
  const Vec3 axis = given != nullptr ? *given : Vec3{};
  if (shape.name == "disc") {
    return {"its hole", 2.0 * length_of(shape, "hole_radius"), axis, true};
  }
  if (shape.name != "frustum" || !(length_of(shape, "thickness") > 0.0)) return {};
  const double first = length_of(shape, "radius");
  const double last = length_of(shape, "end_radius");
  return {"its narrow end", 2.0 * std::min(first, last), first < last ? -1.0 * axis : axis};
}

/// Whether an outlet of a body leads along gravity, within 45 degrees.
bool looks_down(const scenario::Setup& setup, const scenario::BodySpec& body,
                const Outlet& outlet) {
  Vec3 direction = outlet.axis;
  if (body.frame >= 0) {
    const scenario::FrameSpec& frame = setup.frames[static_cast<std::size_t>(body.frame)];
    direction = rotate(direction, frame.axis / norm(frame.axis), frame.angle);
  }
  const double along = dot(direction, setup.gravity);
  return (outlet.is_two_way ? std::abs(along) : along) >
         std::sqrt(0.5) * norm(direction) * norm(setup.gravity);
}

bool brings_many(const sdk::Emitter& emitter) {
  const sdk::EmitterRequest request = emitter.request();
  return request.mass_flow > 0.0 || request.mass > 0.0 || request.count > k_few;
}

/// [m] Of those that come in numbers.
double largest_of_many(const ParticleModels& models) {
  double largest = 0.0;
  for (const auto& emitter : models.emitters) {
    const std::vector<double> diameters = emitter->diameters();
    if (!diameters.empty() && brings_many(*emitter)) largest = std::max(largest, diameters.back());
  }
  return largest;
}

/// What happens at an outlet of this width to many grains of this diameter [m].
std::string stopped_text(double width, double diameter) {
  const std::string grains = "the largest grains (" + base::length_text(diameter, 3) + ")";
  if (width < diameter) return "is narrower than " + grains + ": they lie on it and block it";
  return "is " + base::digits_text(width / diameter, 2) + " times as wide as " + grains +
         ": below some 5 times they arch over it and the flow stops, and Beverloo's correlation "
         "does not hold";
}

}  // namespace

void check_outlets(const scenario::Setup& setup, const ParticleModels& models,
                   scenario::Diagnostics& diagnostics) {
  const double largest = largest_of_many(models);
  for (const scenario::BodySpec& body : setup.bodies) {
    const Outlet outlet = outlet_of(body.shape);
    if (!(outlet.width > 0.0) || !(outlet.width < k_arching * largest)) continue;
    if (!looks_down(setup, body, outlet)) continue;
    diagnostics.warning(body.shape.where,
                        "bodies." + body.name + ": " + outlet.what + " of " +
                            base::length_text(outlet.width, 3) + " " +
                            stopped_text(outlet.width, largest) + "; make it at least " +
                            base::length_text(5.0 * largest, 3) + ", if they are to flow");
  }
}

}  // namespace dust::preflight
