// SPDX-License-Identifier: Apache-2.0
#include "report/setup_document.hpp"

#include "report/pictures/outline.hpp"
#include "report/space/space.hpp"

namespace dust::report {
namespace {

using nlohmann::json;

/// Outlines with the cuts, as Dust.Picture draws them.
json bodies_json(const scenario::DomainSpec& domain, const bodies::BodySet& bodies) {
  json list = json::array();
  const json outline = outline_of(domain, bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    json segments = json::array();
    for (const json& piece : outline[b]["segments"]) {
      segments.push_back({piece[0][0], piece[0][1], piece[1][0], piece[1][1]});
    }
    list.push_back({{"name", bodies[b].name},
                    {"polygons", json::array()},
                    {"segments", std::move(segments)},
                    {"triangles", json::array()},
                    {"section", section_of(domain, bodies[b])}});
  }
  return list;
}

Surfaces surfaces_of(const scenario::DomainSpec& domain, const bodies::BodySet& bodies) {
  constexpr double k_edge_share = 1.0 / 100.0;  // of the diagonal: what is round looks so
  Surfaces all;
  const double edge = k_edge_share * norm(domain.max - domain.min);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const auto corners = bodies[b].triangles(domain.min, domain.max, edge);
    for (std::size_t c = 0; c < corners.size(); ++c) {
      all.corners.push_back(static_cast<std::int64_t>(all.points.size() / 3));
      for (int d = 0; d < 3; ++d) all.points.push_back(static_cast<float>(corners[c][d]));
      if (c % 3 == 0) all.body.push_back(static_cast<std::int64_t>(b));
    }
  }
  return all;
}

}  // namespace

json setup_document(const scenario::Setup& setup, const bodies::BodySet& bodies,
                    const json& setting, const json& check) {
  const auto& domain = setup.domain;
  const Box box{{domain.min.x, domain.min.y, domain.min.z},
                {domain.max.x, domain.max.y, domain.max.z}};
  std::vector<std::string> names;
  for (const auto& body : bodies) names.push_back(body.name);
  return {{"schema", "dust.report/1"},
          {"kind", "setup"},
          {"title", setup.name},
          {"setting", setting},
          {"check", check},
          {"view", {domain.min.x, domain.min.z, domain.max.x, domain.max.z}},
          {"bodies", bodies_json(domain, bodies)},
          {"grains", nullptr},
          {"air", nullptr},
          {"space",
           {{"min", box.min},
            {"max", box.max},
            {"is_thin", box.is_thin()},
            {"surfaces", surfaces_json(names, surfaces_of(domain, bodies), box)},
            {"air", nullptr}}}};
}

}  // namespace dust::report
