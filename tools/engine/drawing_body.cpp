// SPDX-License-Identifier: Apache-2.0
#include "drawing_body.hpp"

#include <array>
#include <cstdint>
#include <map>
#include <tuple>
#include <vector>

namespace dust::engine {
namespace {

using sdk::Vec3;

/// [px] side of the squares that look for the section of a body.
constexpr double k_square = 3.0;
/// Cosine of the angle between two triangles from which on their common edge is drawn.
constexpr double k_sharp = 0.87;

/// Grey squares where the middle plane lies inside the body, as one rectangle per row and run.
std::string section_of(const bodies::Body& body, const SideView& view) {
  std::string path;
  for (double y = view.top(); y < view.bottom() - 1e-9; y += k_square) {
    double begin = -1.0;
    for (double x = view.left();; x += k_square) {
      const bool is_end = x > view.right() - 1e-9;
      const bool is_inside =
          !is_end &&
          body.nearest(view.in_middle(x + 0.5 * k_square, y + 0.5 * k_square)).distance < 0.0;
      if (is_inside && begin < 0.0) begin = x;
      if (!is_inside && begin >= 0.0) {
        path += "M" + px(begin) + " " + px(y) + "H" + px(std::min(x, view.right())) + "v" +
                px(k_square) + "H" + px(begin) + "Z";
        begin = -1.0;
      }
      if (is_end) break;
    }
  }
  if (path.empty()) return "";
  return "<path fill=\"#c4c4c4\" stroke=\"none\" shape-rendering=\"crispEdges\" d=\"" + path +
         "\"/>\n";
}

using Key = std::tuple<std::int64_t, std::int64_t, std::int64_t>;

/// A corner on a grid fine enough that equal corners are found again.
Key key_of(Vec3 p, double step) {
  return {std::llround(p.x / step), std::llround(p.y / step), std::llround(p.z / step)};
}

struct Edge {
  Vec3 from, to;
  std::vector<Vec3> normals;  ///< of the triangles that share it
};

/// Whether an edge is to be seen: rims, sharp bends, and where the surface turns from the eye.
bool is_drawn(const Edge& edge, int depth) {
  if (edge.normals.size() != 2) return true;
  const Vec3& a = edge.normals[0];
  const Vec3& b = edge.normals[1];
  if (dot(a, b) < k_sharp) return true;
  constexpr double k_level = 1e-9;
  const bool faces_a = a[depth] > k_level;
  const bool faces_b = b[depth] > k_level;
  return faces_a != faces_b;
}

}  // namespace

BodyPicture draw_body(const bodies::Body& body, const scenario::DomainSpec& domain,
                      const SideView& view) {
  BodyPicture picture;
  picture.svg = section_of(body, view);
  const Vec3 size = domain.max - domain.min;
  constexpr double k_pieces = 100.0;
  const double longest = std::max({size.x, size.y, size.z});
  // A turned body is cut in its own frame: a larger box, the picture clips.
  const Vec3 more = body.frame_angle != 0.0 ? size : Vec3{};
  const auto corners = body.triangles(domain.min - more, domain.max + more, longest / k_pieces);
  std::map<std::pair<Key, Key>, Edge> edges;
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    const Vec3 normal = cross(corners[n + 1] - corners[n], corners[n + 2] - corners[n]);
    const double area = norm(normal);
    if (!(area > 0.0)) continue;
    for (std::size_t c = 0; c < 3; ++c) {
      const Vec3 from = corners[n + c];
      const Vec3 to = corners[n + (c + 1) % 3];
      Key a = key_of(from, 1e-7 * longest);
      Key b = key_of(to, 1e-7 * longest);
      if (b < a) std::swap(a, b);
      Edge& edge = edges[{a, b}];
      edge.from = from;
      edge.to = to;
      edge.normals.push_back(normal / area);
    }
  }
  std::string path;
  for (const auto& [key, edge] : edges) {
    if (!is_drawn(edge, view.depth())) continue;
    const double x1 = view.x(edge.from);
    const double y1 = view.y(edge.from);
    const double x2 = view.x(edge.to);
    const double y2 = view.y(edge.to);
    if (std::hypot(x2 - x1, y2 - y1) < 0.05) continue;  // seen from its end
    path += "M" + px(x1) + " " + px(y1) + "L" + px(x2) + " " + px(y2);
  }
  for (const Vec3& p : corners) {
    const double x = std::clamp(view.x(p), view.left(), view.right());
    const double y = std::clamp(view.y(p), view.top(), view.bottom());
    // A corner far outside says nothing of where the body is seen.
    if (std::hypot(x - view.x(p), y - view.y(p)) > 1.0) continue;
    if (!picture.mark || y < picture.mark->second - 0.5) picture.mark = {x, y};
  }
  if (!path.empty()) {
    picture.svg +=
        "<path fill=\"none\" stroke=\"#444\" stroke-width=\"1.2\" "
        "stroke-linecap=\"round\" d=\"" +
        path + "\"/>\n";
  }
  return picture;
}

}  // namespace dust::engine
