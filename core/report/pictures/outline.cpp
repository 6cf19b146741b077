// SPDX-License-Identifier: Apache-2.0
#include "report/pictures/outline.hpp"

#include "bodies/seen_edges.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <set>
#include <utility>

namespace dust::report {

using Json = nlohmann::ordered_json;

Json outline_of(const scenario::DomainSpec& domain, const bodies::BodySet& bodies) {
  Json all = Json::array();
  const sdk::Vec3 size = domain.max - domain.min;
  const double longest = std::max({size.x, size.y, size.z});
  constexpr double k_pieces = 100.0;  // of what is round, along the longest side
  for (const auto& body : bodies) {
    // A turned body is cut in its own frame: a larger box, the picture clips.
    const sdk::Vec3 more = body.frame_angle != 0.0 ? size : sdk::Vec3{};
    const auto t = body.triangles(domain.min - more, domain.max + more, longest / k_pieces);
    // Front and back edges lie on each other: one is enough.
    std::set<std::array<double, 4>> lines;
    for (const auto& [a, b] : bodies::visible_edges(t, 1, longest)) {
      const auto rounded = [&](double v) { return 1e-6 * longest * std::round(1e6 * v / longest); };
      std::array<double, 4> line{rounded(a.x), rounded(a.z), rounded(b.x), rounded(b.z)};
      if (std::pair(line[2], line[3]) < std::pair(line[0], line[1])) {
        line = {line[2], line[3], line[0], line[1]};
      }
      // An edge along y is seen from its end.
      if (line[0] != line[2] || line[1] != line[3]) lines.insert(line);
    }
    Json segments = Json::array();
    for (const auto& l : lines) segments.push_back({{l[0], l[1]}, {l[2], l[3]}});
    all.push_back({{"body", body.name}, {"segments", segments}});
  }
  return all;
}

Json section_of(const scenario::DomainSpec& domain, const bodies::Body& body) {
  Json rows = Json::array();
  if (!body.shape->is_solid()) return rows;
  constexpr double k_squares = 300.0;  // along the longer side
  const sdk::Vec3 size = domain.max - domain.min;
  const double side = std::max(size.x, size.z) / k_squares;
  const int across = std::max(1, static_cast<int>(std::lround(size.x / side)));
  const int up = std::max(1, static_cast<int>(std::lround(size.z / side)));
  const double wide = size.x / across;
  const double high = size.z / up;
  for (int j = 0; j < up; ++j) {
    const double z = domain.min.z + j * high;
    int begin = -1;
    for (int i = 0; i <= across; ++i) {
      const sdk::Vec3 middle{domain.min.x + (i + 0.5) * wide, 0.5 * (domain.min.y + domain.max.y),
                             z + 0.5 * high};
      const bool is_inside = i < across && body.nearest(middle).distance < 0.0;
      if (is_inside && begin < 0) begin = i;
      if (is_inside || begin < 0) continue;
      rows.push_back({domain.min.x + begin * wide, z, domain.min.x + i * wide, z + high});
      begin = -1;
    }
  }
  return rows;
}

}  // namespace dust::report
