// SPDX-License-Identifier: Apache-2.0
#include "run/dust/dust_walls.hpp"

#include "bodies/survey/surface_in_box.hpp"
#include "run/dust/cancelled_area.hpp"

#include <algorithm>
#include <cmath>

namespace dust::run {
namespace {

using fluid::Grid;

/// The surface that a thin body which keeps two cells apart turns to the one of them, seen from the
/// middle of that.
fluid::BodyField::Hit hit_between(const fluid::BodyField& bodies, sdk::Vec3 centre,
                                  sdk::Vec3 opposite) {
  const auto from = bodies.outside(centre);
  const auto to = bodies.outside(opposite);
  const auto way = from && to ? bodies.passes_through(*from, *to) : std::nullopt;
  if (!way) return bodies.nearest(0.5 * (centre + opposite));
  const sdk::Vec3 point = *from + (*way / norm(*to - *from)) * (*to - *from);
  fluid::BodyField::Hit hit = bodies.nearest(point);
  hit.distance = dot(centre - point, hit.normal);
  return hit;
}

/// Of half the diagonal of a face: a surface that is nearer to it meets it.
constexpr double k_finest_part = 0.03;

std::size_t slot(std::ptrdiff_t index) { return static_cast<std::size_t>(index); }

}  // namespace

DustWalls::DustWalls(const scenario::Setup& setup, const Models& models, const FluidStage& fluid,
                     const DustSides& sides, bool has_shear)
    : setup_(setup), models_(models), fluid_(fluid), sides_(sides), passable_area_(fluid.grid()) {
  if (has_shear) shear_.emplace(fluid.grid(), setup.fluid->viscosity / setup.fluid->density);
}

void DustWalls::add_sides(const Cell& cell) {
  const Grid& grid = fluid_.grid();
  const std::ptrdiff_t o = grid.index(cell[0], cell[1], cell[2]);
  for (std::size_t side = 0; side < 6; ++side) {
    const std::size_t d = side / 2;
    const bool is_high = side % 2 != 0;
    if (grid.is_periodic[d] || cell[d] != (is_high ? grid.count[d] - 1 : 0)) continue;
    if (!sides_.settles_on(side, cell)) continue;
    const int axis = static_cast<int>(d);
    const std::ptrdiff_t face = is_high ? o + grid.stride[d] : o;
    const double open = passable_area_.component[d][slot(face)];
    sdk::Vec3 normal;
    normal[axis] = (is_high ? open : -open) / grid.spacing[axis];
    pieces_.push_back({static_cast<std::int32_t>(o), static_cast<std::int32_t>(side), normal,
                       static_cast<std::int32_t>(face)});
    if (shear_) shear_->add_side(cell, axis, is_high ? -1.0 : 1.0);
  }
}

void DustWalls::add_body(const Cell& cell, const fluid::BodyField::Hit& hit, sdk::Vec3 area,
                         double cancelled) {
  const Grid& grid = fluid_.grid();
  if (!(norm(area) * grid.spacing.x > 1e-9) || hit.body < 0) return;
  const sdk::Vec3 centre = grid.centre(cell[0], cell[1], cell[2]);
  airborne::WallPiece& piece = pieces_.emplace_back();
  piece.cell = static_cast<std::int32_t>(grid.index(cell[0], cell[1], cell[2]));
  piece.surface = 6 + hit.body;
  piece.area = area;
  piece.cancelled = cancelled;
  if (!models_.bodies[static_cast<std::size_t>(hit.body)].motions.empty()) {
    running_.push_back(
        {pieces_.size() - 1, cell, hit.body, hit.normal, centre - hit.distance * hit.normal});
  }
  if (shear_) shear_->add_body(centre, hit);
}

/// As the open areas of the cell's faces leave them over: of the body that is nearest. What a thin
/// body takes of these faces is its own.
void DustWalls::add_bodies(const Cell& cell, const fluid::BodyField& bodies) {
  const Grid& grid = fluid_.grid();
  const fluid::FaceField& open = fluid_.solver().open_area();
  const std::ptrdiff_t o = grid.index(cell[0], cell[1], cell[2]);
  const sdk::Vec3 centre = grid.centre(cell[0], cell[1], cell[2]);
  struct Part {
    fluid::BodyField::Hit hit;
    sdk::Vec3 area;
  };
  std::array<Part, 7> parts{};
  std::size_t count = 1;
  for (int axis = 0; axis < 3; ++axis) {
    const auto d = static_cast<std::size_t>(axis);
    const std::size_t low = slot(o), high = slot(o + grid.stride[d]);
    parts[0].area[axis] = (open.component[d][low] - open.component[d][high]) / grid.spacing[axis];
    for (const bool is_high : {false, true}) {
      const std::size_t face = is_high ? high : low;
      const double blocked = open.component[d][face] - passable_area_.component[d][face];
      if (!(blocked > 0.0)) continue;
      sdk::Vec3 opposite = centre;
      opposite[axis] += (is_high ? 1.0 : -1.0) * grid.spacing[axis];
      const fluid::BodyField::Hit hit = hit_between(bodies, centre, opposite);
      std::size_t n = 1;
      while (n < count && parts[n].hit.body != hit.body) ++n;
      if (n == count) parts[count++].hit = hit;
      parts[n].area[axis] += (is_high ? blocked : -blocked) / grid.spacing[axis];
    }
  }
  if (count == 1 && !(norm(parts[0].area) * grid.spacing.x > 1e-9)) return;
  parts[0].hit = bodies.nearest(centre);
  for (std::size_t n = 1; n < count; ++n) {
    if (parts[n].hit.body == parts[0].hit.body) parts[0].area += parts[n].area;
  }
  // Of a thin body the other surface belongs to another cell.
  const double cancelled = count == 1 ? cancelled_in(cell, bodies) : 0.0;
  add_body(cell, parts[0].hit, parts[0].area, cancelled);
  for (std::size_t n = 1; n < count; ++n) {
    if (parts[n].hit.body != parts[0].hit.body) add_body(cell, parts[n].hit, parts[n].area, 0.0);
  }
}

/// A surface that ends before a side does not pass it, however coarse the cell that both share: it
/// does where it meets the face of the cell that is a part of the side.
std::uint8_t DustWalls::sides_passed(const Cell& cell, int body, double time) const {
  const Grid& grid = fluid_.grid();
  unsigned passed = 0;
  for (unsigned side = 0; side < 6; ++side) {
    const std::size_t d = side / 2;
    const bool is_high = side % 2 != 0;
    if (grid.is_periodic[d] || cell[d] != (is_high ? grid.count[d] - 1 : 0)) continue;
    const int axis = static_cast<int>(d);
    sdk::Vec3 middle = grid.centre(cell[0], cell[1], cell[2]);
    middle[axis] += (is_high ? 0.5 : -0.5) * grid.spacing[axis];
    sdk::Vec3 half = 0.5 * grid.spacing;
    half[axis] = 0.0;
    const bodies::Body& b = models_.bodies[static_cast<std::size_t>(body)];
    const double finest = k_finest_part * norm(half);
    if (bodies::may_meet_box(b, b.placement(time), middle, half, finest)) passed |= 1U << side;
  }
  return static_cast<std::uint8_t>(passed);
}

double DustWalls::cancelled_in(const Cell& cell, const fluid::BodyField& bodies) {
  const double gravity = norm(setup_.gravity);
  if (!(gravity > 0.0)) return 0.0;
  const Grid& grid = fluid_.grid();
  const sdk::Vec3 centre = grid.centre(cell[0], cell[1], cell[2]);
  const sdk::Vec3 up = -setup_.gravity / gravity;
  // Those that move may leave the cell by the next time.
  const bool stays = !bodies.has_moving_bodies() ||
                     bodies.is_far_from_moving_bodies(centre, 2.0 * norm(grid.spacing));
  if (!stays) return cancelled_area(bodies, centre, grid.spacing, up);
  const auto number = static_cast<std::int32_t>(grid.index(cell[0], cell[1], cell[2]));
  const auto [found, is_new] = cancelled_.try_emplace(number, 0.0);
  if (is_new) found->second = cancelled_area(bodies, centre, grid.spacing, up);
  return found->second;
}

void DustWalls::find(double time, bool is_anew, airborne::Flow& flow) {
  const Grid& grid = fluid_.grid();
  const fluid::CellField& share = fluid_.solver().open_fraction();
  const fluid::BodyField bodies(grid, models_.bodies, time, fluid::BodyField::Which::all);
  passable_area_ = fluid_.solver().passable_area();
  pieces_.clear();
  running_.clear();
  if (is_anew) cancelled_.clear();
  if (shear_) shear_->clear();
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) {
        if (!(share[slot(grid.index(i, j, k))] > 0.0)) continue;
        add_sides({i, j, k});
        add_bodies({i, j, k}, bodies);
      }
    }
  }
  find_running(time, flow.surface_motions);
}

/// Of all pieces; of none where all stand.
void DustWalls::find_running(double time, std::vector<airborne::SurfaceMotion>& motions) const {
  const Grid& grid = fluid_.grid();
  motions.clear();
  if (running_.empty()) return;
  motions.resize(pieces_.size());
  for (const RunningPiece& running : running_) {
    airborne::SurfaceMotion& motion = motions[running.piece];
    motion.point = running.point;
    motion.area = -grid.cell_volume() * pieces_[running.piece].area;
    motion.displaces = models_.bodies[static_cast<std::size_t>(running.body)].displaces();
    motion.sides_passed = sides_passed(running.cell, running.body, time);
  }
}

void DustWalls::fill(double time, airborne::Flow& flow) {
  for (const RunningPiece& running : running_) {
    airborne::SurfaceMotion& motion = flow.surface_motions[running.piece];
    motion.velocity = models_.bodies[static_cast<std::size_t>(running.body)].surface_velocity(
        motion.point, running.normal, time);
  }
  flow.walls = pieces_;
  for (airborne::WallPiece& piece : flow.walls) {
    const double eps = fluid_.void_fraction()[static_cast<std::size_t>(piece.cell)];
    piece.area = eps * piece.area;
    piece.cancelled *= eps;
  }
  if (shear_) {
    shear_->find(fluid_.solver().velocity(), flow.surface_motions, flow.friction_velocity);
  }
}

}  // namespace dust::run
