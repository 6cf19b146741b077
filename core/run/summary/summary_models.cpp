// SPDX-License-Identifier: Apache-2.0
#include "run/summary/summary_models.hpp"

#include "base/finite.hpp"
#include "bodies/shape.hpp"

#include <algorithm>
#include <cmath>
#include <optional>
#include <set>
#include <tuple>
#include <utility>

namespace dust::run {
namespace {

using Json = nlohmann::ordered_json;
using scenario::ModelChoice;
using sdk::Vec3;

/// A parameter of a model that is a point, if it has one of that name.
std::optional<Vec3> point_of(const registry::Entry& entry, const ModelChoice& choice,
                             const char* name) {
  for (std::size_t n = 0; n < choice.values.size() && n < entry.info.parameters.size(); ++n) {
    const auto& p = entry.info.parameters[n];
    if (p.name != name || !(p.dimension == sdk::dimension::length)) continue;
    const auto* v = std::get_if<Vec3>(&choice.values[n]);
    // Of a list of places the first.
    const auto* list = std::get_if<std::vector<Vec3>>(&choice.values[n]);
    if (list != nullptr && !list->empty()) v = &list->front();
    if (v != nullptr && base::is_finite(*v)) return *v;
  }
  return std::nullopt;
}

/// A point of a turned frame in the domain's.
Vec3 in_domain(const scenario::Setup& setup, Vec3 at, int frame_index) {
  if (frame_index < 0) return at;
  const auto& frame = setup.frames[static_cast<std::size_t>(frame_index)];
  return frame.origin + rotate(at - frame.origin, frame.axis / norm(frame.axis), frame.angle);
}

Json vector_json(Vec3 v) { return {v.x, v.y, v.z}; }

/// [m] A parameter of a model that is a length, 0 if it has none of that name.
double length_of(const registry::Entry& entry, const ModelChoice& choice, const char* name) {
  for (std::size_t n = 0; n < choice.values.size() && n < entry.info.parameters.size(); ++n) {
    const auto* v = std::get_if<double>(&choice.values[n]);
    if (entry.info.parameters[n].name == name && v != nullptr) return *v;
  }
  return 0.0;
}

/// The corners of the box round a cylinder or frustum between two points.
std::pair<Vec3, Vec3> box_round(Vec3 from, double radius, Vec3 to, double end_radius) {
  const Vec3 axis = (to - from) / norm(to - from);
  Vec3 low, high;
  for (int d = 0; d < 3; ++d) {
    const double square = std::sqrt(std::max(0.0, 1.0 - axis[d] * axis[d]));
    low[d] = std::min(from[d] - square * radius, to[d] - square * end_radius);
    high[d] = std::max(from[d] + square * radius, to[d] + square * end_radius);
  }
  return {low, high};
}

/// The place of a thing that reaches from one point to another: of a round one the box round it.
void add_reach(Vec3 from, Vec3 to, double radius, double end_radius, Json& j) {
  if (!(radius > 0.0) || from == to) {
    j["at"] = vector_json(from);
    j["to"] = vector_json(to);
    return;
  }
  const auto [low, high] = box_round(from, radius, to, end_radius > 0.0 ? end_radius : radius);
  j["min"] = vector_json(low);
  j["max"] = vector_json(high);
}

/// Name, model and place of an emitter or a sensor.
Json thing_json(const scenario::Setup& setup, const registry::Registry& registry,
                const std::string& name, const ModelChoice& choice, int frame) {
  Json j = {{"name", name}, {"model", choice.name}};
  const registry::Entry* entry = registry.find(choice.kind, choice.name);
  if (entry == nullptr) return j;
  j["what"] = entry->info.summary;
  const auto min = point_of(*entry, choice, "min");
  const auto max = point_of(*entry, choice, "max");
  const bool is_box = min && max && *min != *max;
  if (is_box) {
    j["min"] = vector_json(in_domain(setup, *min, frame));
    j["max"] = vector_json(in_domain(setup, *max, frame));
    return j;
  }
  const auto from = point_of(*entry, choice, "from");
  const auto to = point_of(*entry, choice, "to");
  if (from && to) {
    add_reach(in_domain(setup, *from, frame), in_domain(setup, *to, frame),
              length_of(*entry, choice, "radius"), length_of(*entry, choice, "end_radius"), j);
    return j;
  }
  for (const char* key : {"from", "point", "position", "positions", "origin", "center", "centre"}) {
    if (const auto at = point_of(*entry, choice, key)) {
      j["at"] = vector_json(in_domain(setup, *at, frame));
      break;
    }
  }
  return j;
}

/// Outer radius of the pulley that a belt goes round [m]; 0 where the shape has none.
double pulley_radius(const ModelChoice& shape) {
  double radius = 0.0;
  for (const auto& kind : bodies::shape_catalogue()) {
    if (kind.name != shape.name || !kind.name.ends_with("conveyor")) continue;
    for (std::size_t n = 0; n < shape.values.size() && n < kind.parameters.size(); ++n) {
      const std::string& name = kind.parameters[n].name;
      const auto* value = std::get_if<double>(&shape.values[n]);
      if (value != nullptr && (name == "radius" || name == "thickness")) radius += *value;
    }
  }
  return radius;
}

/// The middle of the pulley that a belt's load leaves [m], where the shape has one.
std::optional<Vec3> head_pulley(const ModelChoice& shape) {
  for (const auto& kind : bodies::shape_catalogue()) {
    if (kind.name != shape.name) continue;
    for (std::size_t n = 0; n < shape.values.size() && n < kind.parameters.size(); ++n) {
      const auto* value = std::get_if<Vec3>(&shape.values[n]);
      if (value != nullptr && kind.parameters[n].name == "head") return *value;
    }
  }
  return std::nullopt;
}

/// Level bodies whose surface moves at one speed: the start of a free flight.
Json belts_json(const scenario::Setup& setup, const registry::Registry& registry) {
  Json list = Json::array();
  for (const auto& body : setup.bodies) {
    const bool is_level =
        body.frame < 0 || setup.frames[static_cast<std::size_t>(body.frame)].angle == 0.0;
    for (const auto& motion : body.motions) {
      const registry::Entry* entry = registry.find(motion.kind, motion.name);
      if (entry == nullptr || !is_level) continue;
      for (std::size_t n = 0; n < motion.values.size(); ++n) {
        const auto& p = entry->info.parameters[n];
        const auto* speed = std::get_if<double>(&motion.values[n]);
        if (p.name == "speed" && p.dimension == sdk::dimension::velocity && speed != nullptr) {
          Json belt = {{"name", body.name}, {"speed", *speed}};
          if (const double radius = pulley_radius(body.shape); radius > 0.0)
            belt["radius"] = radius;
          if (const auto head = head_pulley(body.shape)) {
            belt["head"] = vector_json(in_domain(setup, *head, body.frame));
          }
          list.push_back(std::move(belt));
        }
      }
    }
  }
  return list;
}

const char* word_of(scenario::GrainSide side) {
  switch (side) {
    case scenario::GrainSide::open:
      return "open";
    case scenario::GrainSide::wall:
      return "wall";
    case scenario::GrainSide::periodic:
      return "periodic";
  }
  return "";
}

/// Boxes of other fluids, as far as they lie in the domain.
Json regions_json(const scenario::Setup& setup) {
  Json list = Json::array();
  if (!setup.fluid) return list;
  for (const auto& region : setup.fluid->regions) {
    Vec3 low = region.min;
    Vec3 high = region.max;
    for (int d = 0; d < 3; ++d) {
      low[d] = std::max(low[d], setup.domain.min[d]);
      high[d] = std::min(high[d], setup.domain.max[d]);
    }
    list.push_back({{"min", vector_json(low)}, {"max", vector_json(high)}});
  }
  return list;
}

}  // namespace

nlohmann::ordered_json plugins_json(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry) {
  std::set<std::tuple<std::string, std::string, std::string>> used;
  const auto add = [&](const ModelChoice& choice) {
    // Shapes are the core's own and have no entry.
    if (const auto* entry = registry.find(choice.kind, choice.name)) {
      used.emplace(choice.kind, choice.name, entry->info.version);
    }
  };
  const auto add_if = [&](const std::optional<ModelChoice>& choice) {
    if (choice) add(*choice);
  };
  for (const auto& pair : setup.interactions) {
    add(pair.contact);
    add_if(pair.rolling);
    add_if(pair.cohesion);
  }
  for (const auto& body : setup.bodies) {
    for (const auto& motion : body.motions) add(motion);
  }
  for (const auto& emitter : setup.emitters) add(emitter.model);
  for (const auto& sensor : setup.sensors) add(sensor.model);
  for (const auto& side : setup.domain.sides) add_if(side.air);
  add_if(setup.drag);
  for (const auto& force : setup.fluid_forces) add(force);
  add_if(setup.voidage);
  add_if(setup.turbulence);
  add_if(dust.liberation);
  Json list = Json::array();
  for (const auto& [kind, name, version] : used) {
    list.push_back({{"kind", kind}, {"name", name}, {"version", version}});
  }
  return list;
}

nlohmann::ordered_json setting_json(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry) {
  Json j;
  j["domain"] = {{"min", vector_json(setup.domain.min)}, {"max", vector_json(setup.domain.max)}};
  j["gravity"] = vector_json(setup.gravity);
  j["sides"] = Json::array();
  for (std::size_t n = 0; n < setup.domain.sides.size(); ++n) {
    const auto& side = setup.domain.sides[n];
    j["sides"].push_back({{"name", scenario::k_side_names[n]},
                          {"grains", word_of(side.grains)},
                          {"air", side.air ? side.air->name : ""}});
    if (side.grains == scenario::GrainSide::wall) {
      j["sides"].back()["material"] = setup.materials[static_cast<std::size_t>(side.material)].name;
    }
  }
  for (const scenario::SideOpeningSpec& opening : dust.openings) {
    j["sides"][static_cast<std::size_t>(opening.side)]["flow_m3_per_s"] = opening.flow;
  }
  j["bodies"] = Json::array();
  for (const auto& body : setup.bodies) {
    Json motions = Json::array();
    for (const auto& motion : body.motions) motions.push_back(motion.name);
    j["bodies"].push_back(
        {{"name", body.name},
         {"shape", body.shape.name},
         {"motions", motions},
         {"material", setup.materials[static_cast<std::size_t>(body.material)].name}});
    if (body.suction) j["bodies"].back()["flow_m3_per_s"] = body.suction->flow;
  }
  j["regions"] = regions_json(setup);
  j["belts"] = belts_json(setup, registry);
  j["emitters"] = Json::array();
  for (const auto& e : setup.emitters) {
    Json emitter = thing_json(setup, registry, e.name, e.model, e.frame);
    const scenario::MaterialSpec& material = setup.materials[static_cast<std::size_t>(e.material)];
    emitter["density"] = material.properties.density;
    const double l = material.coarse_graining;
    if (setup.fluid && l != 1.0) emitter["stands_for"] = l * l * l;  // smaller grains, in the fluid
    j["emitters"].push_back(std::move(emitter));
  }
  if (setup.fluid && setup.fluid->regions.empty()) {
    j["fluid"] = {{"density", setup.fluid->density}, {"viscosity", setup.fluid->viscosity}};
  }
  j["sensors"] = Json::array();
  for (const auto& s : setup.sensors) {
    j["sensors"].push_back(thing_json(setup, registry, s.name, s.model, -1));
  }
  return j;
}

}  // namespace dust::run
