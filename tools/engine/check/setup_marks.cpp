// SPDX-License-Identifier: Apache-2.0
#include "check/setup_marks.hpp"

#include "base/text.hpp"
#include "bodies/survey/bounds_of.hpp"
#include "preflight/emissions.hpp"
#include "preflight/particle_models.hpp"
#include "run/summary/summary_models.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <optional>
#include <variant>

namespace dust::engine {
namespace {

using preflight::Derived;
using scenario::Setup;
using sdk::Vec3;
using Kind = SetupMark::Kind;

/// Instants of the run at which a belt's speed is asked for: it may start late or stop.
constexpr int k_times = 16;
/// [-] Of the domain's width: longer belts have several arrows.
constexpr double k_long = 0.25;

Vec3 unit(Vec3 v) { return norm(v) > 0.0 ? v / norm(v) : Vec3{}; }

/// The box of a body as far as it is in the domain.
bodies::Bounds visible(const Setup& setup, const bodies::Body& body) {
  const auto& domain = setup.domain;
  const double edge = 0.02 * norm(domain.max - domain.min);
  const bodies::Bounds all =
      bodies::bounds_of(body, body.placement(0.0), domain.min, domain.max, 0.0, edge);
  return bodies::common(all, {domain.min, domain.max});
}

/// The surface below a place, where it is looked at from above; nothing where it is not below.
std::optional<bodies::SurfacePoint> below(const bodies::Body& body, Vec3& place, double lowest) {
  const bodies::Placement at = body.placement(0.0);
  const double near = 1e-4 * (place.z - lowest);
  for (int n = 0; n < 400 && place.z > lowest; ++n) {
    const bodies::SurfacePoint s = body.nearest(place, at);
    if (s.distance <= near) return s;
    place.z -= s.distance;
  }
  return std::nullopt;
}

void add_belt(const Setup& setup, const bodies::Body& belt, std::vector<SetupMark>& marks) {
  const bodies::Bounds box = visible(setup, belt);
  if (box.is_empty()) return;
  const double width = box.high.x - box.low.x;
  const bool is_long = width > k_long * (setup.domain.max.x - setup.domain.min.x);
  const std::vector<double> shares =
      is_long ? std::vector<double>{0.5, 0.2, 0.8} : std::vector<double>{0.5};
  for (const double share : shares) {
    Vec3 place{box.low.x + share * width, 0.5 * (box.low.y + box.high.y), box.high.z};
    place.z += 0.01 * (setup.domain.max.z - setup.domain.min.z);
    const auto top = below(belt, place, box.low.z);
    if (!top) continue;
    Vec3 fastest;
    for (int n = 0; n <= k_times; ++n) {
      const Vec3 v = belt.surface_velocity(place, top->normal, setup.time.end * n / k_times);
      if (norm(v) > norm(fastest)) fastest = v;
    }
    const bool is_first = share == shares.front();
    marks.push_back(
        {Kind::belt,
         is_first ? belt.name + ", " + base::digits_text(norm(fastest), 3) + " m/s" : "", place,
         place, unit(fastest)});
  }
}

void add_suction(const bodies::Body& body, std::vector<SetupMark>& marks) {
  const auto& s = *body.suction;
  const bodies::Placement at = body.placement(0.0);
  bodies::Bounds box;
  for (int corner = 0; corner < 8; ++corner) {
    Vec3 p =
        at.to_domain({(corner & 1) != 0 ? s.max.x : s.min.x, (corner & 2) != 0 ? s.max.y : s.min.y,
                      (corner & 4) != 0 ? s.max.z : s.min.z});
    for (int d = 0; d < 3; ++d) {
      box.low[d] = std::min(box.low[d], p[d]);
      box.high[d] = std::max(box.high[d], p[d]);
    }
  }
  const Vec3 out = body.nearest(0.5 * (box.low + box.high), at).normal;
  const bool is_in = s.flow < 0.0;
  marks.push_back(
      {Kind::opening,
       body.name + (is_in ? ", blows " : ", draws ") + base::volume_flow_text(std::abs(s.flow)),
       box.low, box.high, is_in ? out : -out, !is_in});
}

/// The box that the parameters of a side's air name; the whole side without one.
bodies::Bounds box_of_air(const Setup& setup, const registry::Registry& registry, std::size_t n,
                          bool& has_box) {
  const auto& domain = setup.domain;
  const auto& air = *domain.sides[n].air;
  bodies::Bounds box{domain.min, domain.max};
  const registry::Entry* entry = registry.find(air.kind, air.name);
  for (std::size_t p = 0; entry != nullptr && p < air.values.size(); ++p) {
    const sdk::Parameter& parameter = entry->info.parameters[p];
    const auto* corner = std::get_if<Vec3>(&air.values[p]);
    if (corner == nullptr || parameter.dimension != sdk::dimension::length) continue;
    if (parameter.name == "min") box.low = *corner;
    if (parameter.name == "max") box.high = *corner;
    has_box = has_box || parameter.name == "min";
  }
  const int d = static_cast<int>(n / 2);
  box.low[d] = box.high[d] = n % 2 == 0 ? domain.min[d] : domain.max[d];
  return bodies::common(box, {domain.min, domain.max});
}

void add_sides(const Setup& setup, const registry::Registry& registry, const Derived& derived,
               std::vector<SetupMark>& marks) {
  for (std::size_t n = 0; n < 6; ++n) {
    const scenario::SideSpec& side = setup.domain.sides[n];
    if (!side.air) continue;
    const double flow = derived.side_flows[n];
    bool has_box = false;
    const bodies::Bounds box = box_of_air(setup, registry, n, has_box);
    if (!has_box && flow == 0.0) continue;
    Vec3 way;
    if (flow != 0.0) way[static_cast<int>(n / 2)] = (n % 2 == 0) == (flow > 0.0) ? 1.0 : -1.0;
    std::string text = std::string(scenario::k_side_names[n]) + ": " + side.air->name;
    if (flow != 0.0) {
      text += ", " + base::volume_flow_text(std::abs(flow)) + (flow > 0.0 ? " in" : " out");
    }
    marks.push_back({Kind::opening, text, box.low, box.high, way, flow < 0.0});
  }
}

void add_feeds(const Setup& setup, const scenario::DustSetup& dust,
               const registry::Registry& registry, const Derived& derived,
               preflight::ParticleModels& models, std::vector<SetupMark>& marks) {
  const auto setting = run::setting_json(setup, dust, registry);
  const auto first = preflight::first_grains(setup, models, false);
  const Vec3 edges = setup.domain.max - setup.domain.min;
  for (std::size_t n = 0; n < setup.emitters.size(); ++n) {
    const auto& thing = setting["emitters"][n];
    const auto corner = [&](const char* key) {
      const auto& at = thing[key];
      return Vec3{at[0].template get<double>(), at[1].template get<double>(),
                  at[2].template get<double>()};
    };
    const bool has_box = thing.contains("min") && thing.contains("max");
    if (!has_box && !thing.contains("at")) continue;
    SetupMark mark{Kind::feed,
                   setup.emitters[n].name,
                   corner(has_box ? "min" : "at"),
                   corner(has_box ? "max" : "at"),
                   {}};
    const double flow = derived.emissions[n].mass_flow;
    if (flow > 0.0) {
      mark.text += ", " + base::mass_flow_text(flow, std::max({edges.x, edges.y, edges.z}));
      if (!first[n].empty()) mark.way = unit(first[n].front().velocity);
      if (norm(mark.way) == 0.0) mark.way = unit(setup.gravity);
    }
    marks.push_back(mark);
  }
}

}  // namespace

std::vector<SetupMark> setup_marks(const Setup& setup, const scenario::DustSetup& dust,
                                   const registry::Registry& registry, const Derived& derived) {
  preflight::ParticleModels models = preflight::make_particle_models(setup, registry);
  std::vector<SetupMark> marks;
  for (const bodies::Body& body : models.bodies) {
    const bool is_belt = !body.motions.empty() && !body.is_carried();
    if (is_belt) add_belt(setup, body, marks);
    if (body.suction) add_suction(body, marks);
  }
  add_feeds(setup, dust, registry, derived, models, marks);
  add_sides(setup, registry, derived, marks);
  for (const bodies::Body& body : models.bodies) {
    if ((!body.motions.empty() && !body.is_carried()) || body.suction) continue;
    const bodies::Bounds box = visible(setup, body);
    if (box.is_empty()) continue;
    const Vec3 middle = 0.5 * (box.low + box.high);
    marks.push_back({Kind::body, body.name, middle, middle, {}});
  }
  return marks;
}

}  // namespace dust::engine
