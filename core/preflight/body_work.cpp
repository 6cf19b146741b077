// SPDX-License-Identifier: Apache-2.0
#include "preflight/body_work.hpp"

#include "fluid/geometry/body_field.hpp"
#include "fluid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <string_view>

namespace dust::preflight {
namespace {

/// [s] What a shape's surface costs, on the machine that the constants of cost.cpp belong to.
struct SurfaceRate {
  std::string_view shape;
  double touch;    ///< where a sphere beside it touches, with what the contact's law takes
  double within;   ///< whether it is near a sphere, for lists
  double nearest;  ///< the point nearest to a point of the grid
};
// Parts of a mesh are asked one by one; a trough has a section for every place along it.
constexpr SurfaceRate k_mesh{"mesh", 2.2e-7, 1.8e-7, 3e-7};
constexpr SurfaceRate k_trough{"belt_conveyor", 2.8e-7, 2.8e-7, 3e-7};
/// Planes and shapes of revolution.
constexpr SurfaceRate k_plain{"", 4e-9, 8e-9, 6e-8};
/// The velocity of a surface that a motion carries or turns, at each touch.
constexpr double k_moving_touch = 4e-8;

/// Steps from one list of neighbours to the next, in a stream.
constexpr double k_steps_per_list = 15.0;

// Cutting: each cell and its three faces ask for the nearest body; the faces look at nine instants
// whether a body that moves is near. Where one is, cells and faces are divided.
constexpr double k_face_instants = 24.0;
constexpr double k_near_cell = 4.2e-5;
constexpr double k_near_questions = 240.0;  ///< each to all bodies
constexpr double k_predict_questions = 90.0;
/// How far from a surface cells are near, in edges of a cell: less than one and a half, so that
/// they are three layers along a surface that goes with the grid, too.
constexpr double k_near_reach = 1.5 - 1e-6;
/// Way of a body, in cells, after which the grid is cut anew (CutGrid).
constexpr double k_max_way = 0.5;

const SurfaceRate& rate_of(const scenario::BodySpec& spec) {
  if (spec.shape.name == k_mesh.shape) return k_mesh;
  return spec.shape.name == k_trough.shape ? k_trough : k_plain;
}

/// Cells that have air and are near a body that goes to other places. Of many cells a sample,
/// spread evenly over the domain, so that any grid has its answer in time.
double cells_near(const bodies::BodySet& bodies, const fluid::Grid& grid) {
  constexpr double k_sample = 40000.0;
  constexpr double k_golden = 0.6180339887498949;
  const fluid::BodyField field(grid, bodies, 0.0, fluid::BodyField::Which::all);
  const double edge = std::cbrt(grid.cell_volume());
  const auto& n = grid.count;
  const double cells = static_cast<double>(n[0]) * n[1] * n[2];
  const double asked = std::min(cells, k_sample);
  double near = 0.0;
  for (double k = 0.0; k < asked; ++k) {
    const double place = asked < cells ? std::fmod(k * k_golden, 1.0) * cells : k;
    const auto cell = static_cast<std::int64_t>(std::min(place, cells - 1.0));
    const sdk::Vec3 centre =
        grid.centre(static_cast<int>(cell % n[0]), static_cast<int>(cell / n[0] % n[1]),
                    static_cast<int>(cell / n[0] / n[1]));
    if (field.is_far_from_moving_bodies(centre, k_near_reach * edge)) continue;
    if (field.nearest(centre).distance > -edge) near += cells / asked;
  }
  return near;
}

/// Work of the bodies that go to other places.
void add_cutting(const scenario::Setup& setup, const bodies::BodySet& bodies, double nearest,
                 BodyWork& work) {
  double displacing_nearest = 0.0;
  double speed = 0.0;
  const auto& count = setup.fluid->cells;
  const fluid::Grid grid = fluid::Grid::make(setup.domain.min, setup.domain.max, count, {});
  const double cells = static_cast<double>(count[0]) * count[1] * count[2];
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    if (!bodies[n].displaces()) continue;
    displacing_nearest += rate_of(setup.bodies[n]).nearest;
    speed = std::max(speed, bodies[n].largest_displacing_speed());
  }
  if (!(displacing_nearest > 0.0)) return;
  work.near_cells = cells_near(bodies, grid);
  const sdk::Vec3 h = grid.spacing;
  const double least = std::min({h.x, h.y, h.z});
  const double near = work.near_cells;
  const double cuts =
      std::max(1.0, std::ceil(speed * setup.time.fluid_step / (k_max_way * least) - 1e-9));
  work.cut = cuts * (cells * (nearest + k_face_instants * displacing_nearest) +
                     near * (k_near_cell + k_near_questions * nearest));
  work.predict = cells * displacing_nearest + near * k_predict_questions * nearest;
}

/// [B] Of a frame with all surfaces: a triangle has three numbers of corners and that of its body,
/// and every second one a corner of its own.
double surface_bytes(const scenario::DomainSpec& domain, const bodies::BodySet& bodies) {
  constexpr double k_bytes_per_triangle = 4.0 * 4.0 + 0.5 * 3.0 * 4.0;
  const double edge = bodies::written_edge(domain.min, domain.max);
  double corners = 0.0;
  for (const bodies::Body& body : bodies) {
    corners += static_cast<double>(
        body.triangles(domain.min, domain.max, edge, body.placement(0.0)).size());
  }
  return corners / 3.0 * k_bytes_per_triangle;
}

}  // namespace

BodyWork body_work(const scenario::Setup& setup, const bodies::BodySet& bodies) {
  BodyWork work;
  double nearest = 0.0;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    const SurfaceRate& rate = rate_of(setup.bodies[n]);
    work.touch.push_back(rate.touch + (bodies[n].is_carried() ? k_moving_touch : 0.0));
    work.search += rate.within / k_steps_per_list;
    nearest += rate.nearest;
    const auto& motions = setup.bodies[n].motions;
    work.is_shaking |= std::any_of(motions.begin(), motions.end(),
                                   [](const auto& motion) { return motion.name == "oscillate"; });
  }
  if (setup.fluid) add_cutting(setup, bodies, nearest, work);
  if (bodies::do_surfaces_change(setup, bodies))
    work.frame_bytes = surface_bytes(setup.domain, bodies);
  return work;
}

}  // namespace dust::preflight
