// SPDX-License-Identifier: Apache-2.0
#include "preflight/dust_check.hpp"

#include "airborne/dust_class.hpp"
#include "base/text.hpp"
#include "bodies/placement.hpp"
#include "fluid/grid.hpp"
#include "preflight/journey.hpp"
#include "scenario/text/units.hpp"
#include "setup/draws_out.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <deque>
#include <string>
#include <utility>

namespace dust::preflight {
namespace {

using scenario::BodySpec;
using scenario::DustSetup;
using scenario::EmitterSpec;
using scenario::Setup;
using sdk::Vec3;

/// [-] Of the time on bodies: a grain that is so long on a belt rides on it.
constexpr double k_riding = 0.3;
/// Cells across the narrowest turn that a grid resolves well.
constexpr double k_turn_cells = 4.0;

bool is_in_box(Vec3 p, Vec3 min, Vec3 max, double more, int without = -1) {
  for (int d = 0; d < 3; ++d) {
    if (d == without) continue;
    if (p[d] < min[d] - more || p[d] > max[d] + more) return false;
  }
  return true;
}

/// Something that draws out what touches it, and where its opening is.
struct Taker {
  std::string path;
  const bodies::Body* body = nullptr;  ///< null: a side
  int side = -1;
  Vec3 min, max;

  [[nodiscard]] bool takes(const Setup& setup, const sdk::InsertionRequest& grain) const {
    const double radius = 0.5 * grain.diameter;
    const Vec3 x = grain.position;
    if (body != nullptr) {
      const bodies::Placement at = body->placement(0.0);
      return is_in_box(at.to_body(x), min, max, radius) && body->nearest(x, at).distance <= radius;
    }
    const int d = side / 2;
    const double wall = side % 2 == 1 ? setup.domain.max[d] : setup.domain.min[d];
    return std::abs(x[d] - wall) <= radius && is_in_box(x, min, max, 0.0, d);
  }
};

std::vector<Taker> takers(const Setup& setup, const DustSetup& dust,
                          const bodies::BodySet& bodies) {
  std::vector<Taker> all;
  for (std::size_t n = 0; n < setup.bodies.size(); ++n) {
    const auto& suction = setup.bodies[n].suction;
    if (!suction || !scenario::draws_out(*suction)) continue;
    all.push_back({"bodies." + setup.bodies[n].name + ".suction", &bodies[n], -1, suction->min,
                   suction->max});
  }
  for (const scenario::SideOpeningSpec& o : dust.openings) {
    all.push_back({std::string("domain.boundaries.") +
                       scenario::k_side_names[static_cast<std::size_t>(o.side)] + ".air",
                   nullptr, o.side, o.min, o.max});
  }
  return all;
}

void look_at(const Setup& setup, const EmitterSpec& spec, const std::vector<Taker>& all,
             const std::vector<sdk::InsertionRequest>& grains, scenario::Diagnostics& diagnostics) {
  for (const Taker& taker : all) {
    const auto count = std::count_if(grains.begin(), grains.end(),
                                     [&](const auto& g) { return taker.takes(setup, g); });
    if (count == 0) continue;
    const bool is_all = static_cast<std::size_t>(count) == grains.size();
    const std::string text =
        spec.model.path + ": " + taker.path + " lies over it and draws out " +
        (is_all ? "all grains"
                : std::to_string(count) + " of " + std::to_string(grains.size()) + " grains") +
        " as they come in: move the emitter or the opening (min, max)";
    if (is_all) {
      diagnostics.error(spec.model.where, text);
    } else {
      diagnostics.warning(spec.model.where, text);
    }
  }
}

/// Looks for the surface of a body in the box of its suction, as the run begins.
class SurfaceSearch {
 public:
  /// Boxes smaller than `finest` [m] that come that near the surface count as on it.
  SurfaceSearch(const Setup& setup, const bodies::Body& body, double finest)
      : domain_(setup.domain), body_(body), at_(body.placement(0.0)), finest_(finest) {}

  /// False only where no part of the surface lies in the box and the domain: boxes that are farther
  /// from either than they reach are left out, others halved along their longest edge.
  bool may_be_in(Vec3 min, Vec3 max) {
    constexpr int k_max_boxes = 20000;
    const Vec3 half = 0.5 * (max - min);
    const double reach = norm(half) + finest_;
    const Vec3 middle = at_.to_domain(0.5 * (min + max));
    if (!body_.is_carried() && !is_in_box(middle, domain_.min, domain_.max, reach)) return false;
    if (std::abs(body_.nearest(middle, at_).distance) > reach) return false;
    if (reach < 2.0 * finest_ || ++boxes_ > k_max_boxes) return true;
    int d = half.y > half.x ? 1 : 0;
    if (half.z > half[d]) d = 2;
    Vec3 low_max = max, high_min = min;
    low_max[d] = high_min[d] = min[d] + half[d];
    return may_be_in(min, low_max) || may_be_in(high_min, max);
  }
  /// Whether the part of the surface in the box has an area: an edge or a line of it has none.
  /// `rounding`: how far beyond the box the run still counts a place to it.
  bool has_area_in(Vec3 min, Vec3 max, double rounding) const {
    constexpr int k_max_boxes = 20000;
    std::deque<std::pair<Vec3, Vec3>> boxes{{min, max}};
    // The larger ones first: what is looked at lies evenly along the surface.
    for (int n = 0; n < k_max_boxes && !boxes.empty(); ++n, boxes.pop_front()) {
      const auto [low, high] = boxes.front();
      const Vec3 half = 0.5 * (high - low);
      const double reach = norm(half) + finest_;
      const Vec3 middle = at_.to_domain(low + half);
      if (std::abs(body_.nearest(middle, at_).distance) > reach) continue;
      const auto is_open = [&](Vec3 place) {
        return is_in_box(at_.to_body(place), min, max, rounding) &&
               (body_.is_carried() || is_in_box(place, domain_.min, domain_.max, finest_));
      };
      if (is_patch(middle, is_open)) return true;
      if (reach < 2.0 * finest_) continue;
      int d = half.y > half.x ? 1 : 0;
      if (half.z > half[d]) d = 2;
      Vec3 low_max = high, high_min = low;
      low_max[d] = high_min[d] = low[d] + half[d];
      boxes.emplace_back(low, low_max);
      boxes.emplace_back(high_min, high);
    }
    return false;
  }
  /// The place of the surface nearest to a place in the body's frame, in that frame.
  [[nodiscard]] Vec3 nearest(Vec3 place) const {
    const Vec3 there = at_.to_domain(place);
    const bodies::SurfacePoint s = body_.nearest(there, at_);
    return at_.to_body(there - s.distance * s.normal);
  }

 private:
  /// Whether the surface is open where it is nearest to a place, and all round it.
  template <class IsOpen>
  bool is_patch(Vec3 place, const IsOpen& is_open) const {
    const bodies::SurfacePoint s = body_.nearest(place, at_);
    const Vec3 foot = place - s.distance * s.normal;
    if (!is_open(foot)) return false;
    int d = std::abs(s.normal.y) < std::abs(s.normal.x) ? 1 : 0;
    if (std::abs(s.normal.z) < std::abs(s.normal[d])) d = 2;
    Vec3 axis;
    axis[d] = 1.0;
    Vec3 along = cross(s.normal, axis);
    along = along / norm(along);
    const Vec3 across = cross(s.normal, along);
    return std::ranges::all_of(std::array{along, -along, across, -across}, [&](Vec3 way) {
      const Vec3 beside = foot + finest_ * way;
      const bodies::SurfacePoint there = body_.nearest(beside, at_);
      return is_open(beside - there.distance * there.normal);
    });
  }

  const scenario::DomainSpec& domain_;
  const bodies::Body& body_;
  bodies::Placement at_;
  double finest_;
  int boxes_ = 0;
};

}  // namespace

bool has_openings(const Setup& setup, const DustSetup& dust) {
  const bool has_suction = std::any_of(setup.bodies.begin(), setup.bodies.end(),
                                       [](const BodySpec& b) { return b.suction.has_value(); });
  return setup.fluid && (has_suction || !dust.openings.empty());
}

void check_suctions(const Setup& setup, const ParticleModels& models,
                    scenario::Diagnostics& diagnostics) {
  constexpr double k_finest = 1e-3;    // of a cell: narrower openings count as none
  constexpr double k_rounding = 1e-6;  // of a cell: as in the run
  const bool has_suction = std::any_of(setup.bodies.begin(), setup.bodies.end(),
                                       [](const BodySpec& b) { return b.suction.has_value(); });
  if (!setup.fluid || !has_suction) return;
  const Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  for (std::size_t n = 0; n < setup.bodies.size(); ++n) {
    const auto& suction = setup.bodies[n].suction;
    if (!suction) continue;
    SurfaceSearch search(setup, models.bodies[n], k_finest * norm(h));
    if (search.may_be_in(suction->min, suction->max)) {
      if (search.has_area_in(suction->min, suction->max, k_rounding * norm(h))) continue;
      diagnostics.error(
          suction->where,
          "bodies." + setup.bodies[n].name +
              ".suction: the box from min to max only touches the body's surface, so that the "
              "opening has no area: move min or max so that a part of the surface lies in it");
      continue;
    }
    diagnostics.error(
        suction->where,
        "bodies." + setup.bodies[n].name +
            ".suction: no part of the body's surface lies between min and max in the domain; give "
            "the corners of a box round the opening, on the surface as the body stands in its own "
            "frame: nearest to the middle of this one it is at " +
            base::place_text(search.nearest(0.5 * (suction->min + suction->max))));
  }
}

void check_openings(const Setup& setup, const DustSetup& dust, const ParticleModels& models,
                    std::span<const std::vector<sdk::InsertionRequest>> first,
                    scenario::Diagnostics& diagnostics) {
  if (!has_openings(setup, dust)) return;
  const std::vector<Taker> all = takers(setup, dust, models.bodies);
  for (std::size_t n = 0; n < first.size(); ++n) {
    look_at(setup, setup.emitters[n], all, first[n], diagnostics);
  }
}

double narrowest_turn(double diameter, double density, double viscosity, double speed) {
  const double relaxation = density * diameter * diameter / (18.0 * viscosity);
  return relaxation * speed / airborne::k_largest_stokes_number;
}

void check_drift(const Setup& setup, const DustSetup& dust, double air_speed,
                 const ParticleModels& models, scenario::Diagnostics& diagnostics) {
  if (!setup.fluid || !dust.field || !dust.field->inertia) return;
  if (!(setup.fluid->viscosity > 0.0)) return;
  double speed = air_speed;
  for (const auto& body : models.bodies) speed = std::max(speed, body.largest_speed());
  for (const auto& emitter : models.emitters) speed = std::max(speed, emitter->largest_speed());
  const Vec3 h =
      fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
  const double resolved = k_turn_cells * std::min({h.x, h.y, h.z});
  for (const double diameter : dust.field->diameters) {
    const double turn =
        narrowest_turn(diameter, dust.field->density, setup.fluid->viscosity, speed);
    if (!(turn > resolved)) continue;
    diagnostics.warning(
        dust.field->where,
        "dust.field.classes: at " + base::digits_text(speed, 2) + " m/s dust of " +
            base::length_text(diameter, 3) + " follows the fluid round turns wider than " +
            base::length_text(turn, 2) + " only, and cells of " +
            base::length_text(resolved / k_turn_cells, 2) +
            " resolve narrower ones: there it drifts by inertia as finer dust does, and none of it "
            "hits walls by it; leave the class out, or let it be grains");
  }
}

void check_feeds(const Setup& setup, const DustSetup& dust, bool is_branch,
                 const ParticleModels& models, scenario::Diagnostics& diagnostics) {
  const double given = dust.given ? dust.given->steady_after : 0.0;
  if (!dust.field || !dust.liberation || (is_branch && !(given > 0.0))) return;
  const double from = given > 0.0 ? given : 0.5 * setup.time.end;
  const double end = setup.time.end;
  const auto seconds = [](double time) { return scenario::number_text(time) + " s"; };
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const sdk::EmitterRequest request = models.emitters[n]->request();
    if (!(request.mass_flow > 0.0 && request.begin < request.end)) continue;
    const auto is_inside = [&](double time) { return time > from && time < end; };
    if (!is_inside(request.begin) && !is_inside(request.end)) continue;
    const bool begins = is_inside(request.begin);
    diagnostics.warning(setup.emitters[n].model.where,
                        setup.emitters[n].model.path + (begins ? ": begins at " : ": ends at ") +
                            seconds(begins ? request.begin : request.end) +
                            ", while rates of dust are taken, from " + seconds(from) + " to " +
                            seconds(end) +
                            ": no amounts per tonne are told of a feed that is not even; " +
                            (begins ? "begin earlier, or give a later dust.steady_after"
                                    : "end later, or give an earlier time.end"));
  }
}

void check_feed_zones(const Setup& setup, const DustSetup& dust, const ParticleModels& models,
                      std::span<const std::vector<sdk::InsertionRequest>> first,
                      scenario::Diagnostics& diagnostics) {
  if (!dust.field || !dust.liberation || !dust.feed_zones.empty()) return;
  for (std::size_t n = 0; n < first.size(); ++n) {
    const auto material = static_cast<std::size_t>(setup.emitters[n].material);
    const bool is_dusty = material < dust.loads.size() && !dust.loads[material].share.empty();
    if (first[n].empty() || !is_dusty || !(models.emitters[n]->request().mass_flow > 0.0)) continue;
    const sdk::InsertionRequest& grain = first[n].front();
    const Journey way = follow_grain(setup, models.bodies, grain, setup.time.end);
    for (std::size_t b = 0; b < models.bodies.size(); ++b) {
      const bodies::Body& belt = models.bodies[b];
      const bool is_belt = !belt.motions.empty() && !belt.is_carried();
      if (!is_belt || !(way.on_body[b] > k_riding * way.carried)) continue;
      diagnostics.warning(
          setup.emitters[n].model.where,
          setup.emitters[n].model.path + ": its grains rain one by one onto '" + belt.name +
              "', which sets dust free that a load at rest on the belt keeps; name the box in "
              "which they land, as dust.feed_zones: {" +
              setup.emitters[n].name + ": {min: [...], max: [...]}} round " +
              base::place_text(grain.position));
      break;
    }
  }
}

sdk::DustProperties dust_properties(const Setup& setup, const scenario::DustFieldSpec& field) {
  return {.classes = field.diameters.size(),
          .diameter = field.diameters.data(),
          .density = field.density,
          .gas_density = setup.fluid->density,
          .gas_viscosity = setup.fluid->viscosity,
          .gravity = norm(setup.gravity)};
}

void check_liberation(const Setup& setup, const DustSetup& dust,
                      const registry::Registry& registry) {
  if (!dust.liberation || !dust.field || !setup.fluid) return;
  const auto law = registry.create_as<sdk::LiberationLaw>(*dust.liberation);
  registry::ask_at_place(*dust.liberation,
                         [&] { law->prepare(dust_properties(setup, *dust.field)); });
}

}  // namespace dust::preflight
