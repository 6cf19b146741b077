// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/periodic_check.hpp"

#include "base/text.hpp"
#include "bodies/survey/bounds_of.hpp"
#include "fluid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <string>

namespace dust::preflight {
namespace {

using sdk::Vec3;

constexpr const char* k_axes[3] = {"x", "y", "z"};

bool is_periodic(const scenario::Setup& setup, int d) {
  return setup.domain.sides[static_cast<std::size_t>(2 * d)].grains ==
         scenario::GrainSide::periodic;
}

/// [m] Of a body along one direction.
struct Extent {
  double low = 0.0, high = 0.0;
};

/// What meets bodies: grains, or the air alone, as grains without a size would.
struct Scale {
  double largest = 0.0;    ///< [m] diameter of grains
  double near = 0.0;       ///< [m] how far off its surface a body is looked at
  double tolerance = 0.0;  ///< [m] by which its surface may lie elsewhere at the other side
};

/// A body at an instant of the run, and what meets it.
struct Scene {
  const scenario::DomainSpec& domain;
  const bodies::Body& body;
  bodies::Placement place;
  Scale scale;
};

/// Grains lose or gain m g times the tolerance as they pass: less than contacts give way by
/// themselves. Cells are cut a thousandth of their size otherwise.
std::optional<Scale> scale_of(const scenario::Setup& setup, const ParticleModels& models) {
  constexpr double k_tolerance = 1e-3;
  if (!models.class_diameters.empty()) {
    const double largest = models.class_diameters.back();
    return Scale{largest, 0.5 * largest, k_tolerance * models.class_diameters.front()};
  }
  if (!setup.fluid) return std::nullopt;
  const Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  const double cell = std::min({h.x, h.y, h.z});
  return Scale{0.0, 0.5 * cell, k_tolerance * cell};
}

/// Of a body along d, as far as a box far beyond the domain.
Extent extent_of(const Scene& scene, int d) {
  const auto& [domain, body, place, scale] = scene;
  const double far = 2.0 * (norm(domain.max - domain.min) + scale.largest);
  const bodies::Bounds box = bodies::bounds_of(body, place, domain.min, domain.max, far, far);
  return {box.low[d], box.high[d]};
}

/// Grains are put back once they are found a radius beyond a periodic side: a body has to be there
/// as far, or so far away that none of them would touch its other end. They are looked at now and
/// then only, and fly no farther than a diameter meanwhile: fast ones miss a body's end before.
struct Reach {
  bool spans = false;       ///< from a radius beyond one side to as far beyond the other
  bool spans_fast = false;  ///< a diameter
  bool misses = false;      ///< is nowhere near them

  static Reach of(const Extent& body, double low, double high, double diameter) {
    const double rounding = 1e-9 * (high - low);
    const double radius = 0.5 * diameter - rounding;
    diameter -= rounding;
    const bool lies_inside = body.low >= low + diameter && body.high <= high - diameter;
    const bool lies_outside = body.low >= high + diameter || body.high <= low - diameter;
    return {body.low <= low - radius && body.high >= high + radius,
            body.low <= low - diameter && body.high >= high + diameter,
            lies_inside || lies_outside};
  }
};

/// Compares the sections of a body where grains leave through one periodic side and come back
/// through the other: its surface has to be as far from a grain that is put back as it was before.
class Sections {
 public:
  Sections(const Scene& scene, int d) : scene_(scene), d_(d) {}

  /// A point at the low side where a grain would find the surface elsewhere, if there is one.
  std::optional<Vec3> difference() {
    const double radius = 0.5 * scene_.scale.largest;
    const int e = (d_ + 1) % 3;
    const int f = (d_ + 2) % 3;
    const Vec3 middle = 0.5 * (scene_.domain.min + scene_.domain.max);
    const Vec3 half = 0.5 * (scene_.domain.max - scene_.domain.min);
    for (const double offset : {-radius, radius}) {
      Vec3 at = middle;
      at[d_] = scene_.domain.min[d_] + offset;
      look_round(at, e, half[e] + radius, f, half[f] + radius);
    }
    return found_;
  }
  [[nodiscard]] double here() const { return here_; }    ///< [m] from that point to the surface
  [[nodiscard]] double there() const { return there_; }  ///< [m] from its place at the high side

 private:
  /// Looks at the middle of a rectangle with half edges a along e and b along f, and at its
  /// quarters where the surface may be as near as a grain's radius to any of it.
  void look_round(Vec3 at, int e, double a, int f, double b) {
    if (found_) return;
    Vec3 other = at;
    other[d_] += scene_.domain.max[d_] - scene_.domain.min[d_];
    const double here = scene_.body.nearest(at, scene_.place).distance;
    const double there = scene_.body.nearest(other, scene_.place).distance;
    const auto& [largest, reach, tolerance] = scene_.scale;
    const double near = std::min(std::abs(here), std::abs(there));
    // Within the body on both sides there are no grains, and its ends may be nearer.
    const bool is_outside = std::max(here, there) > tolerance;
    if (is_outside && near < reach && std::abs(here - there) > tolerance) {
      found_ = at;
      here_ = here;
      there_ = there;
      return;
    }
    if (near > reach + std::hypot(a, b)) return;
    if (std::max(a, b) < finest()) return;
    const bool is_long = a > b;
    (is_long ? a : b) *= 0.5;
    for (const double way : {-1.0, 1.0}) {
      Vec3 part = at;
      part[is_long ? e : f] += way * (is_long ? a : b);
      look_round(part, e, a, f, b);
    }
  }
  /// [m] Half as far, but no finer than a thousandth of the domain: bounded work.
  [[nodiscard]] double finest() const {
    return std::max(0.5 * scene_.scale.near, 1e-3 * norm(scene_.domain.max - scene_.domain.min));
  }

  const Scene& scene_;
  int d_;
  std::optional<Vec3> found_;
  double here_ = 0.0, there_ = 0.0;
};

std::string sides_text(int d) {
  const auto side = static_cast<std::size_t>(2 * d);
  return std::string(scenario::k_side_names[side]) + " and " + scenario::k_side_names[side + 1];
}

std::string end_problem(const Scene& scene, int d, const Extent& extent) {
  const double low = scene.domain.min[d];
  const double high = scene.domain.max[d];
  const double diameter = scene.scale.largest;
  const auto text = [](double length) { return base::length_text(length); };
  const std::string what =
      diameter > 0.0 ? "grains that pass through would miss it: let it reach beyond both, from "
                     : "the air would find it cut off: let it reach to both, from ";
  return "ends near the periodic sides " + sides_text(d) + " (" + k_axes[d] + " from " +
         text(extent.low) + " to " + text(extent.high) + "), where " + what + text(low - diameter) +
         " to " + text(high + diameter) + ", or keep it between " + text(low + diameter) + " and " +
         text(high - diameter);
}

/// What to tell of a body that fast grains may miss.
std::string short_reach(const Scene& scene, int d) {
  const double diameter = scene.scale.largest;
  return "reaches less than a grain's diameter beyond the periodic sides " + sides_text(d) +
         ": grains are put back late, so that fast ones may miss its ends; let it reach along " +
         k_axes[d] + " from " + base::length_text(scene.domain.min[d] - diameter) + " to " +
         base::length_text(scene.domain.max[d] + diameter);
}

std::string section_problem(const Scene& scene, int d, Vec3 at, const Sections& sections) {
  const auto text = [](double length) { return base::length_text(length); };
  Vec3 other = at;
  other[d] += scene.domain.max[d] - scene.domain.min[d];
  return "is not the same at the periodic sides " + sides_text(d) + ": its surface is " +
         text(sections.here()) + " from " + base::place_text(at) + ", but " +
         text(sections.there()) + " from " + base::place_text(other) +
         (scene.scale.largest > 0.0 ? ", and grains that pass would be thrust out of it or drop"
                                    : ", and the air would find it cut off") +
         ": let it run along " + k_axes[d] +
         " unchanged (for a slope, incline gravity in place of the body)";
}

/// What is wrong with a body at the periodic sides of direction d at one instant; empty: nothing.
std::string problem_of(const Scene& scene, int d) {
  const Extent extent = extent_of(scene, d);
  const Reach reach =
      Reach::of(extent, scene.domain.min[d], scene.domain.max[d], scene.scale.largest);
  if (!reach.spans) return reach.misses ? "" : end_problem(scene, d, extent);
  Sections sections(scene, d);
  const std::optional<Vec3> at = sections.difference();
  return at ? section_problem(scene, d, *at, sections) : "";
}

bool is_short(const Scene& scene, int d) {
  const Reach reach =
      Reach::of(extent_of(scene, d), scene.domain.min[d], scene.domain.max[d], scene.scale.largest);
  return reach.spans && !reach.spans_fast;
}

/// Instants at which a body that goes to other places is looked at: a period of a vibration that
/// is not much shorter than the run is seen.
constexpr int k_instants = 32;

void check_body(const scenario::Setup& setup, std::size_t b, const bodies::Body& body, int d,
                const Scale& scale, scenario::Diagnostics& diagnostics) {
  const int last = body.displaces() ? k_instants : 0;
  for (int n = 0; n <= last; ++n) {
    const double time = setup.time.end * n / k_instants;
    const Scene scene{setup.domain, body, body.placement(time), scale};
    const std::string problem = problem_of(scene, d);
    if (problem.empty()) {
      if (n == 0 && is_short(scene, d)) {
        diagnostics.warning(setup.bodies[b].where,
                            "bodies." + body.name + ": " + short_reach(scene, d));
      }
      continue;
    }
    const std::string when = n > 0 ? "after " + base::duration_text(time) + " it " : "";
    diagnostics.error(setup.bodies[b].where, "bodies." + body.name + ": " + when + problem);
    return;
  }
}

}  // namespace

void check_bodies_at_periodic_sides(const scenario::Setup& setup, const ParticleModels& models,
                                    scenario::Diagnostics& diagnostics) {
  if (!is_periodic(setup, 0) && !is_periodic(setup, 1) && !is_periodic(setup, 2)) return;
  const std::optional<Scale> scale = scale_of(setup, models);
  if (!scale) return;
  for (int d = 0; d < 3; ++d) {
    if (!is_periodic(setup, d)) continue;
    for (std::size_t b = 0; b < models.bodies.size(); ++b) {
      check_body(setup, b, models.bodies[b], d, *scale, diagnostics);
    }
  }
}

}  // namespace dust::preflight
