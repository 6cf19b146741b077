// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/body_suction.hpp"

#include "fluid/geometry/body_field.hpp"

#include <array>
#include <cmath>
#include <vector>

namespace dust::fluid {
namespace {

using sdk::Vec3;

/// Points per direction at which a cell's part of an opening is measured.
constexpr int k_points = 8;
/// Widening of an opening, in cells: a flat one has no depth.
constexpr double k_depth = 1e-6;
/// Cosine up to which a surface counts as across another one, whatever rounding says.
constexpr double k_across = 1e-6;

}  // namespace

bool BodySuction::holds(const Opening& opening, Vec3 p, double rounding) {
  for (int d = 0; d < 3; ++d) {
    if (p[d] < opening.min[d] - rounding || p[d] > opening.max[d] + rounding) return false;
  }
  return true;
}

BodySuction::BodySuction(const bodies::BodySet& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (!bodies[b].suction) continue;
    const auto& s = *bodies[b].suction;
    openings_.push_back({.body = b,
                         .flow = s.flow,
                         .min = s.min,
                         .max = s.max,
                         .over_time = sdk::Table(s.times, s.factors, "times", "factors"),
                         .cell = {},
                         .share = {}});
  }
}

double BodySuction::covered(const Opening& opening, const Grid& grid, Vec3 centre, Vec3 facing,
                            const BodyField& field, const bodies::Placement& at) const {
  std::array<int, 3> n{};
  for (int d = 0; d < 3; ++d) n[d] = k_points;
  int inside = 0;
  int all = n[0] * n[1] * n[2];
  for (int c = 0; c < n[2]; ++c) {
    for (int b = 0; b < n[1]; ++b) {
      for (int a = 0; a < n[0]; ++a) {
        const Vec3 p{centre.x + ((a + 0.5) / n[0] - 0.5) * grid.spacing.x,
                     centre.y + ((b + 0.5) / n[1] - 0.5) * grid.spacing.y,
                     centre.z + ((c + 0.5) / n[2] - 0.5) * grid.spacing.z};
        const auto hit = field.nearest(p);
        if (hit.body != static_cast<int>(opening.body)) continue;
        if (dot(hit.normal, facing) < -k_across * norm(facing)) {
          --all;
          continue;
        }
        if (holds(opening, at.to_body(p - hit.distance * hit.normal), rounding_)) ++inside;
      }
    }
  }
  return all > 0 ? static_cast<double>(inside) / all : 0.0;
}

/// Adds the cells in which the surface of an opening lies. `which`: those open at the time, or also
/// those that have just closed but were open since the grid was cut before.
void BodySuction::add_cells(Opening& opening, const Scene& scene, Cells which) const {
  const Grid& grid = scene.grid;
  const double reach = norm(grid.spacing);
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        const std::ptrdiff_t o = grid.index(i, j, k);
        if (which == Cells::open && !(scene.geometry.open_fraction[o] > 0.0)) continue;
        // The areas of a cell's faces that fluid passes and the surface in it close upon
        // themselves.
        Vec3 area;
        for (int d = 0; d < 3; ++d) {
          const auto& a = scene.passable.component[d];
          area[d] = (a[o + grid.stride[d]] - a[o]) * grid.cell_volume() / grid.spacing[d];
        }
        if (!(norm(area) > 0.0)) continue;
        const Vec3 centre = grid.centre(i, j, k);
        if (std::abs(scene.field.nearest(centre).distance) > reach) continue;
        const double part =
            norm(area) * covered(opening, grid, centre, area, scene.field, scene.at);
        if (!(part > 0.0)) continue;
        opening.cell.push_back(static_cast<std::int32_t>(o));
        opening.share.push_back(part);
        opening.area += part;
      }
    }
  }
}

void BodySuction::find_cells(const Grid& grid, const bodies::BodySet& bodies,
                             const Geometry& geometry, double time) {
  if (openings_.empty()) return;
  const BodyField field(grid, bodies, time, BodyField::Which::all);
  const FaceField passable = passable_area(grid, geometry);
  rounding_ = k_depth * norm(grid.spacing);
  for (Opening& opening : openings_) {
    opening.cell.clear();
    opening.share.clear();
    opening.area = 0.0;
    const bodies::Body& body = bodies[opening.body];
    if (body.is_removed()) continue;
    const Scene scene{grid, geometry, passable, field, body.placement(time)};
    add_cells(opening, scene, Cells::open);
    // A surface that has come to lie on a plane of the grid has closed the cell it was in.
    if (!(opening.area > 0.0)) add_cells(opening, scene, Cells::passable);
    if (!(opening.area > 0.0)) {
      throw OpeningError(
          opening.body,
          "bodies." + body.name +
              ".suction: no part of the body's surface between min and max meets the fluid: give "
              "the corners of a box round the opening, on the surface as the body stands in its "
              "own frame, where no other body covers it");
    }
    for (double& share : opening.share) share /= opening.area * grid.cell_volume();
  }
}

void BodySuction::add_to(Geometry& geometry, const bodies::BodySet& bodies, double time) const {
  if (openings_.empty()) return;
  WallPoints& wall = geometry.wall;
  // What is sucked in stays in the body: nothing of it passes a thin one to its other side.
  std::vector<char> is_at_blocked_face(wall.x.size(), 0);
  for (const auto& ghosts : geometry.ghost) {
    for (const GhostFace& ghost : ghosts) {
      if (ghost.is_blocked) is_at_blocked_face[static_cast<std::size_t>(ghost.wall_point)] = 1;
    }
  }
  for (const Opening& opening : openings_) {
    if (!(opening.area > 0.0)) continue;
    const double speed = opening.flow * opening.over_time(time) / opening.area;
    const bodies::Placement at = bodies[opening.body].placement(time);
    const std::size_t first = wall.body_begin[opening.body];
    const std::size_t last = wall.body_begin[opening.body + 1];
    const bool is_kept = bodies[opening.body].motions.empty();  // then nobody else sets it
    for (std::size_t n = first; n < last; ++n) {
      const Vec3 p{wall.x[n], wall.y[n], wall.z[n]};
      const Vec3 normal{wall.normal_x[n], wall.normal_y[n], wall.normal_z[n]};
      const bool is_open = is_at_blocked_face[n] == 0 && holds(opening, at.to_body(p), rounding_);
      const double own = is_open ? speed : 0.0;
      for (int d = 0; d < 3; ++d) {
        wall.velocity[d][n] = (is_kept ? 0.0 : wall.velocity[d][n]) - own * normal[d];
      }
    }
  }
}

void BodySuction::add_sinks(const Opening& opening, double flow,
                            std::vector<Continuity::Sink>& sinks) {
  for (std::size_t n = 0; n < opening.cell.size(); ++n) {
    sinks.push_back(
        {opening.cell[n], flow * opening.share[n], static_cast<std::int32_t>(opening.body)});
  }
}

void BodySuction::set_sinks(std::vector<Continuity::Sink>& sinks, double time) const {
  sinks.clear();
  for (const Opening& opening : openings_) {
    add_sinks(opening, opening.flow * opening.over_time(time), sinks);
  }
}

void BodySuction::set_mean_sinks(std::vector<Continuity::Sink>& sinks, Interval over) const {
  sinks.clear();
  for (const Opening& opening : openings_) {
    add_sinks(opening, opening.flow * opening.over_time.mean(over.begin, over.end), sinks);
  }
}

}  // namespace dust::fluid
