// SPDX-License-Identifier: Apache-2.0
#include "airborne/surface_routes.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::airborne {

using sdk::Vec3;

SurfaceRoutes::Cell SurfaceRoutes::cell_of(std::int32_t index) const {
  const std::ptrdiff_t padded = index - grid_.index(0, 0, 0);
  Cell cell{};
  // The longest stride first: of a flat grid it is that of y, else that of z.
  const std::array<std::size_t, 2> order = grid_.stride[1] > grid_.stride[2]
                                               ? std::array<std::size_t, 2>{1, 2}
                                               : std::array<std::size_t, 2>{2, 1};
  std::ptrdiff_t rest = padded;
  for (const std::size_t d : order) {
    cell[d] = static_cast<int>(rest / grid_.stride[d]);
    rest %= grid_.stride[d];
  }
  cell[0] = static_cast<int>(rest);
  return cell;
}

std::optional<SurfaceRoutes::Cell> SurfaceRoutes::shifted(Cell cell,
                                                          const std::array<int, 3>& step) const {
  for (std::size_t d = 0; d < 3; ++d) {
    const int n = grid_.count[d];
    cell[d] += step[d];
    if (grid_.is_periodic[d]) cell[d] = (cell[d] % n + n) % n;
    if (cell[d] < 0 || cell[d] >= n) return std::nullopt;
  }
  return cell;
}

std::int32_t SurfaceRoutes::piece_at(Cell cell, std::int32_t surface) const {
  const auto index = static_cast<std::int32_t>(grid_.index(cell[0], cell[1], cell[2]));
  const auto found = at_.find({index, surface});
  return found == at_.end() ? -1 : found->second;
}

/// Is there another piece that the surface may go on with?
bool SurfaceRoutes::goes_on(std::size_t piece, std::int32_t other) const {
  // A surface turns by a right angle at most from cell to cell: what faces away more is another
  // side of a thin body.
  constexpr double k_smallest_cosine = -0.2;
  return other >= 0 && static_cast<std::size_t>(other) != piece &&
         dot(pieces_[static_cast<std::size_t>(other)].normal, pieces_[piece].normal) >
             k_smallest_cosine;
}

/// What comes after an edge of a piece: the piece behind the face; where the surface bends away
/// from that cell, the nearest one ahead of those around. -1: there is none.
std::int32_t SurfaceRoutes::after(std::size_t piece, int direction, double sign) const {
  const Location& here = locations_[piece];
  const std::int32_t surface = surface_[piece];
  const auto d = static_cast<std::size_t>(direction);
  std::array<int, 3> step{};
  step[d] = sign > 0.0 ? 1 : -1;
  if (const auto cell = shifted(here.cell, step)) {
    const std::int32_t other = piece_at(*cell, surface);
    if (goes_on(piece, other)) return other;
  }
  const Vec3 exit = here.cut.edges[2 * d + (sign > 0.0 ? 1 : 0)].middle;
  Vec3 ahead;
  ahead[direction] = sign;
  const std::int32_t behind_face = nearest_ahead(piece, exit, ahead);
  // A surface that bends back before the face is there: along itself.
  return behind_face >= 0 ? behind_face : nearest_ahead(piece, exit, exit - here.cut.centre);
}

/// The piece around this one whose middle lies nearest to `exit` [m] from the middle of its cell,
/// not behind it as seen along `ahead`; -1: there is none.
std::int32_t SurfaceRoutes::nearest_ahead(std::size_t piece, Vec3 exit, Vec3 ahead) const {
  const Location& here = locations_[piece];
  const double rounding = 1e-9 * norm(ahead) * norm(grid_.spacing);
  std::int32_t best = -1;
  double nearest = std::numeric_limits<double>::infinity();
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const auto cell = shifted(here.cell, {i, j, k});
        if (!cell) continue;
        const std::int32_t other = piece_at(*cell, surface_[piece]);
        if (!goes_on(piece, other)) continue;
        const Vec3 way = Vec3{i * grid_.spacing.x, j * grid_.spacing.y, k * grid_.spacing.z} +
                         locations_[static_cast<std::size_t>(other)].cut.centre - exit;
        if (dot(way, ahead) < -rounding || norm(way) >= nearest) continue;
        nearest = norm(way);
        best = other;
      }
    }
  }
  return best;
}

void SurfaceRoutes::add_edges(std::size_t piece, const Flow& flow) {
  Piece& p = pieces_[piece];
  const Location& here = locations_[piece];
  const double area = norm(flow.surface_motions[static_cast<std::size_t>(p.number)].area);
  p.begin = edges_.size();
  for (int direction = 0; direction < 3; ++direction) {
    const auto d = static_cast<std::size_t>(direction);
    for (const double sign : {-1.0, 1.0}) {
      const double length = here.cut.edges[2 * d + (sign > 0.0 ? 1 : 0)].length;
      if (!(length > 0.0)) continue;
      const unsigned side = 2U * static_cast<unsigned>(direction) + (sign > 0.0 ? 1U : 0U);
      const unsigned passed = flow.surface_motions[static_cast<std::size_t>(p.number)].sides_passed;
      const std::int32_t other = after(piece, direction, sign);
      // Where the surface ends within the domain, what lies on it waits.
      if ((passed >> side & 1U) == 0U && other < 0) continue;
      edges_.push_back(
          {.to = other < 0 ? k_outside : pieces_[static_cast<std::size_t>(other)].number,
           .direction = direction,
           .sign = sign,
           .length_over_area = length / area});
    }
  }
  p.end = edges_.size();
}

void SurfaceRoutes::find(const fluid::Grid& grid, const Flow& flow) {
  grid_ = grid;
  pieces_.clear();
  locations_.clear();
  edges_.clear();
  at_.clear();
  surface_.clear();
  for (std::size_t n = 0; n < flow.surface_motions.size(); ++n) {
    const SurfaceMotion& motion = flow.surface_motions[n];
    const double area = norm(motion.area);
    if (!(area > 0.0)) continue;
    const WallPiece& wall = flow.walls[n];
    const Cell cell = cell_of(wall.cell);
    const Vec3 normal = motion.area / area;
    const double offset = dot(motion.point - grid.centre(cell[0], cell[1], cell[2]), normal);
    at_[{wall.cell, wall.surface}] = static_cast<std::int32_t>(pieces_.size());
    pieces_.push_back({.number = static_cast<std::int32_t>(n), .normal = normal});
    locations_.push_back({cell, cut_box_of_area(grid.spacing, normal, offset, area)});
    surface_.push_back(wall.surface);
  }
  for (std::size_t piece = 0; piece < pieces_.size(); ++piece) add_edges(piece, flow);
}

std::optional<std::int32_t> SurfaceRoutes::nearest(std::int32_t cell, std::int32_t surface) const {
  constexpr int k_reach = 2;
  const Cell from = cell_of(cell);
  std::optional<std::int32_t> best;
  double least = std::numeric_limits<double>::infinity();
  for (int k = -k_reach; k <= k_reach; ++k) {
    for (int j = -k_reach; j <= k_reach; ++j) {
      for (int i = -k_reach; i <= k_reach; ++i) {
        const auto to = shifted(from, {i, j, k});
        if (!to) continue;
        const std::int32_t other = piece_at(*to, surface);
        const double way =
            sdk::norm(sdk::Vec3{i * grid_.spacing.x, j * grid_.spacing.y, k * grid_.spacing.z});
        if (other < 0 || way >= least) continue;
        least = way;
        best = pieces_[static_cast<std::size_t>(other)].number;
      }
    }
  }
  return best;
}

}  // namespace dust::airborne
