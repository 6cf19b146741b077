// SPDX-License-Identifier: Apache-2.0
#include "preflight/body_work.hpp"

#include "bodies/belt/running_parts.hpp"
#include "fluid/grid.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
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
/// Layers of cells beside a surface that are near.
constexpr double k_near_layers = 3.0;
/// Way of a body, in cells, after which the grid is cut anew (CutGrid).
constexpr double k_max_way = 0.5;

const SurfaceRate& rate_of(const scenario::BodySpec& spec) {
  if (spec.shape.name == k_mesh.shape) return k_mesh;
  return spec.shape.name == k_trough.shape ? k_trough : k_plain;
}

/// [m2] Within the domain, of the surface that goes to other places: of a cleated belt its cleats.
double displacing_area(const bodies::Body& body, const scenario::DomainSpec& domain) {
  constexpr double k_edges = 20.0;
  constexpr double k_on_surface = 1e-6;  // [m]
  constexpr double k_anywhere = std::numeric_limits<double>::infinity();
  const sdk::Vec3 size = domain.max - domain.min;
  const bodies::Placement at = body.placement(0.0);
  const auto surface =
      body.triangles(domain.min, domain.max, std::max({size.x, size.y, size.z}) / k_edges, at);
  const bool has_static_part = bodies::running_parts(body) != nullptr;
  const auto stands = [&](sdk::Vec3 p) {
    const auto s = body.contact(bodies::RunningParts::k_static, p, k_anywhere, at);
    return s.distance < k_on_surface;
  };
  double area = 0.0;
  for (std::size_t n = 0; n + 2 < surface.size(); n += 3) {
    const sdk::Vec3 middle = (surface[n] + surface[n + 1] + surface[n + 2]) / 3.0;
    if (has_static_part && stands(middle)) continue;
    area += 0.5 * sdk::norm(sdk::cross(surface[n + 1] - surface[n], surface[n + 2] - surface[n]));
  }
  return area;
}

/// Work of the bodies that go to other places.
void add_cutting(const scenario::Setup& setup, const bodies::BodySet& bodies, double nearest,
                 BodyWork& work) {
  double displacing_nearest = 0.0;
  double area = 0.0;
  double speed = 0.0;
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    if (!bodies[n].displaces()) continue;
    displacing_nearest += rate_of(setup.bodies[n]).nearest;
    area += displacing_area(bodies[n], setup.domain);
    speed = std::max(speed, bodies[n].largest_displacing_speed());
  }
  if (!(displacing_nearest > 0.0)) return;
  const auto& count = setup.fluid->cells;
  const sdk::Vec3 h = fluid::Grid::make(setup.domain.min, setup.domain.max, count, {}).spacing;
  const double cells = static_cast<double>(count[0]) * count[1] * count[2];
  const double least = std::min({h.x, h.y, h.z});
  const double near = std::min(cells, k_near_layers * area / std::pow(h.x * h.y * h.z, 2.0 / 3.0));
  const double cuts =
      std::max(1.0, std::ceil(speed * setup.time.fluid_step / (k_max_way * least) - 1e-9));
  work.cut = cuts * (cells * (nearest + k_face_instants * displacing_nearest) +
                     near * (k_near_cell + k_near_questions * nearest));
  work.predict = cells * displacing_nearest + near * k_predict_questions * nearest;
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
  }
  if (setup.fluid) add_cutting(setup, bodies, nearest, work);
  return work;
}

}  // namespace dust::preflight
