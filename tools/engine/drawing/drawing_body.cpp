// SPDX-License-Identifier: Apache-2.0
#include "drawing/drawing_body.hpp"

#include "bodies/seen_edges.hpp"

#include <algorithm>
#include <cmath>

namespace dust::engine {
namespace {

using sdk::Vec3;

/// [px] side of the squares that look for the section of a body.
constexpr double k_square = 3.0;

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
  std::string path;
  for (const auto& [from, to] : bodies::visible_edges(corners, view.depth(), longest)) {
    const double x1 = view.x(from);
    const double y1 = view.y(from);
    const double x2 = view.x(to);
    const double y2 = view.y(to);
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
