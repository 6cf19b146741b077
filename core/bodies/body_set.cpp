// SPDX-License-Identifier: Apache-2.0
#include "bodies/body_set.hpp"

#include "bodies/belt/local_axes.hpp"
#include "bodies/belt/running_parts.hpp"

#include <algorithm>
#include <cmath>
#include <stdexcept>

namespace dust::bodies {

using sdk::Vec3;

namespace {

/// Points at which motions are asked for surface velocities at once.
constexpr std::size_t k_block = 128;

void set_to_zero(const sdk::MutableVectorColumns& velocity, std::size_t count) {
  std::fill_n(velocity.x, count, 0.0);
  std::fill_n(velocity.y, count, 0.0);
  std::fill_n(velocity.z, count, 0.0);
}

void add_to(const sdk::MutableVectorColumns& columns, std::size_t q, Vec3 v) {
  columns.x[q] += v.x;
  columns.y[q] += v.y;
  columns.z[q] += v.z;
}

/// Of the body as a whole.
void add_rigid_velocities(const Placement& at, const PointsOnSurface& points,
                          const sdk::MutableVectorColumns& velocity) {
  for (std::size_t q = 0; q < points.count; ++q) {
    add_to(velocity, q, at.velocity_at(points.position[q]));
  }
}

Vec3 turned_back(const Placement& at, Vec3 v) {
  return at.is_turned ? Vec3{dot(v, at.column[0]), dot(v, at.column[1]), dot(v, at.column[2])} : v;
}

/// The placement of running parts before the frame turns it.
Placement placement_of(const RunningParts& parts,
                       const std::vector<std::unique_ptr<sdk::Motion>>& motions, double time) {
  double run = 0.0;
  double speed = 0.0;
  for (const auto& motion : motions) {
    const sdk::RigidPose pose = motion->pose(time);
    run += pose.shift.x;
    speed += pose.velocity.x;
  }
  run = std::fmod(run, parts.spacing());
  if (run < 0.0) run += parts.spacing();
  Placement at;
  at.shift = run * parts.running_direction();
  at.velocity = speed * parts.running_direction();
  return at;
}

}  // namespace

const RunningParts* running_parts(const Body& body) {
  const LocalAxes* const local = body.shape->local_axes();
  return local != nullptr ? local->running_parts() : nullptr;
}

double run_at(const Body& body, const RunningParts& parts, const Placement& at) {
  const Vec3 shift =
      at.is_turned ? at.shift - body.frame_origin + at.turn(body.frame_origin) : at.shift;
  return dot(shift, at.turn(parts.running_direction()));
}

double normal_speed(const Body& body, const Placement& at, Vec3 point, Vec3 normal) {
  const RunningParts* const parts = running_parts(body);
  if (parts == nullptr) return dot(at.velocity_at(point), normal);
  const double run = run_at(body, *parts, at);
  const auto query = parts->velocity_query_after(
      run, at.to_body(point) + run * parts->running_direction(), turned_back(at, normal));
  const double speed = dot(at.velocity, at.turn(parts->running_direction()));
  return query.factor * speed * dot(at.turn(cross(query.axis, query.normal)), normal);
}

std::string motion_conflict(const Body& body) {
  if (running_parts(body) == nullptr) return {};
  for (const auto& motion : body.motions) {
    if (motion->moves_body()) {
      return "cleats run on a belt that stays where it is: motion: belt alone, without motions "
             "that move the body";
    }
  }
  return {};
}

bool Body::displaces() const {
  if (running_parts(*this) != nullptr) return is_carried();
  for (const auto& motion : motions) {
    if (!motion->moves_body()) continue;
    const sdk::RigidPose pose = motion->pose(0.0);
    const bool only_turns = motion->largest_angular_velocity() > 0.0 &&
                            motion->largest_speed() == 0.0 && motions.size() == 1;
    if (!(only_turns && shape->is_unchanged_by_turning(pose.pivot, pose.axis))) return true;
  }
  return false;
}

Placement Body::placement(double time) const {
  Placement at;
  if (const RunningParts* const parts = running_parts(*this)) {
    at = placement_of(*parts, motions, time);
  } else {
    for (const auto& motion : motions) {
      if (motion->moves_body()) at = Placement::of(motion->pose(time)).after(at);
    }
  }
  return Placement::turned(frame_origin, frame_axis, frame_angle).after(at);
}

bool Body::is_carried() const {
  if (running_parts(*this) != nullptr) return !motions.empty();
  return std::any_of(motions.begin(), motions.end(),
                     [](const auto& motion) { return motion->moves_body(); });
}

SurfacePoint Body::nearest(Vec3 point) const {
  return nearest(point, Placement::turned(frame_origin, frame_axis, frame_angle));
}

SurfacePoint Body::nearest(Vec3 point, const Placement& at) const {
  SurfacePoint s;
  if (const RunningParts* const parts = running_parts(*this)) {
    const double run = run_at(*this, *parts, at);
    s = parts->nearest_after(run, at.to_body(point) + run * parts->running_direction());
  } else {
    s = shape->nearest(at.to_body(point));
  }
  s.normal = at.turn(s.normal);
  return s;
}

std::string Body::nip_at(Vec3 point, double radius, const Placement& at) const {
  Vec3 q = at.to_body(point);
  if (const RunningParts* const parts = running_parts(*this)) {
    q += run_at(*this, *parts, at) * parts->running_direction();
  }
  return shape->nip_at(q, radius);
}

SurfacePoint Body::contact(int part, Vec3 point, double reach, const Placement& at) const {
  SurfacePoint s;
  if (const RunningParts* const parts = running_parts(*this)) {
    const double run = run_at(*this, *parts, at);
    s = parts->contact_after(run, part, at.to_body(point) + run * parts->running_direction(),
                             reach);
  } else {
    s = shape->contact(part, at.to_body(point), reach);
  }
  s.normal = at.turn(s.normal);
  return s;
}

void Body::touch(int part, const ClosestPoints& all, const Placement& at) const {
  if (running_parts(*this) != nullptr) {
    for (std::size_t n = 0; n < all.count; ++n) {
      all.put(n, contact(part, {all.x[n], all.y[n], all.z[n]}, all.reach[n], at));
    }
    return;
  }
  double centre[3][k_block];
  for (std::size_t first = 0; first < all.count; first += k_block) {
    const ClosestPoints t{.count = std::min(k_block, all.count - first),
                          .x = centre[0],
                          .y = centre[1],
                          .z = centre[2],
                          .reach = all.reach + first,
                          .hint = all.hint + first,
                          .distance = all.distance + first,
                          .normal_x = all.normal_x + first,
                          .normal_y = all.normal_y + first,
                          .normal_z = all.normal_z + first};
    for (std::size_t n = 0; n < t.count; ++n) {
      const Vec3 q = at.to_body({all.x[first + n], all.y[first + n], all.z[first + n]});
      for (int d = 0; d < 3; ++d) centre[d][n] = q[d];
    }
    shape->touch(part, t);
    for (std::size_t n = 0; at.is_turned && n < t.count; ++n) {
      const Vec3 turned = at.turn({t.normal_x[n], t.normal_y[n], t.normal_z[n]});
      t.put(n, {t.distance[n], turned});
    }
  }
}

void Body::surface_velocities(const sdk::SurfaceBatch& all) const {
  surface_velocities(all, placement(all.time));
}

void Body::surface_velocities(const sdk::SurfaceBatch& all, const Placement& at) const {
  const SurfaceMotion now{all.time, all.velocity, {}};
  find_motion({all.count, all.position, all.normal}, at, {&now, 1});
}

bool Body::is_turning() const {
  return std::any_of(motions.begin(), motions.end(), [&](const auto& motion) {
    return motion->moves_body() ? motion->largest_angular_velocity() > 0.0 : shape->is_bent();
  });
}

void Body::find_motion(const PointsOnSurface& all, const Placement& at,
                       std::span<const SurfaceMotion> instants) const {
  for (const SurfaceMotion& instant : instants) {
    set_to_zero(instant.velocity, all.count);
    if (instant.rotation.x != nullptr) set_to_zero(instant.rotation, all.count);
  }
  if (motions.empty()) return;
  if (shape->local_axes() != nullptr) {
    for (std::size_t q = 0; q < all.count; ++q) add_at_point(all, q, at, instants);
  } else {
    add_in_blocks(all, at, instants);
  }
  if (!is_carried() || running_parts(*this) != nullptr) return;  // their placement is not its own
  for (const SurfaceMotion& instant : instants) {
    add_rigid_velocities(at, all, instant.velocity);
    for (std::size_t q = 0; instant.rotation.x != nullptr && q < all.count; ++q) {
      add_to(instant.rotation, q, at.spin);
    }
  }
}

/// Where the lateral axis is the same everywhere.
void Body::add_in_blocks(const PointsOnSurface& all, const Placement& at,
                         std::span<const SurfaceMotion> instants) const {
  const Vec3 axis = at.turn(shape->lateral_axis());
  double bend[3][k_block];
  double* const bends[3] = {bend[0], bend[1], bend[2]};
  for (std::size_t first = 0; first < all.count; first += k_block) {
    const sdk::SurfaceBatch block{.count = std::min(k_block, all.count - first),
                                  .time = 0.0,
                                  .axis = axis,
                                  .position = all.position.from(first),
                                  .normal = all.normal.from(first),
                                  .velocity = {}};
    const bool is_asked = instants.front().rotation.x != nullptr && shape->is_bent();
    if (is_asked) find_bends(block, at, bends);
    add_along_surface(block, first, 1.0, is_asked ? bends : nullptr, instants);
  }
}

/// Of a block of points, in the domain's frame.
void Body::find_bends(const sdk::SurfaceBatch& block, const Placement& at,
                      double* const* bend) const {
  double point[3][k_block];
  const double* const points[3] = {point[0], point[1], point[2]};
  for (std::size_t q = 0; q < block.count; ++q) {
    const Vec3 p = at.to_body(block.position[q]);
    for (int d = 0; d < 3; ++d) point[d][q] = p[d];
  }
  shape->find_bends(block.count, points, bend);
  for (std::size_t q = 0; at.is_turned && q < block.count; ++q) {
    const Vec3 turned = at.turn({bend[0][q], bend[1][q], bend[2][q]});
    for (int d = 0; d < 3; ++d) bend[d][q] = turned[d];
  }
}

/// Where the lateral axis is another at each point.
void Body::add_at_point(const PointsOnSurface& all, std::size_t q, const Placement& at,
                        std::span<const SurfaceMotion> instants) const {
  const Vec3 normal = turned_back(at, all.normal[q]);
  const Vec3 point = at.to_body(all.position[q]);
  RunningParts::VelocityQuery query{{}, normal, 1.0, {}};
  if (const RunningParts* const parts = running_parts(*this)) {
    const double way = run_at(*this, *parts, at);
    query = parts->velocity_query_after(way, point + way * parts->running_direction(), normal);
  } else {
    query.axis = shape->local_axes()->lateral_axis_at(point, normal);
    query.bend = shape->local_axes()->bend_at(point);
  }
  const Vec3 asked = at.turn(query.normal);
  Vec3 bend = at.turn(query.bend);
  double* const bends[3] = {&bend.x, &bend.y, &bend.z};
  add_along_surface({.count = 1,
                     .time = 0.0,
                     .axis = at.turn(query.axis),
                     .position = all.position.from(q),
                     .normal = {&asked.x, &asked.y, &asked.z},
                     .velocity = {}},
                    q, query.factor, bends, instants);
}

/// Adds what motions along the surface say of a block of points, from `first` on. Null bends: flat.
void Body::add_along_surface(sdk::SurfaceBatch block, std::size_t first, double factor,
                             const double* const* bend,
                             std::span<const SurfaceMotion> instants) const {
  double run[3][k_block];
  block.velocity = {run[0], run[1], run[2]};
  for (const SurfaceMotion& instant : instants) {
    block.time = instant.time;
    for (const auto& motion : motions) {
      if (motion->moves_body()) continue;
      motion->surface_velocity(block);
      for (std::size_t q = 0; q < block.count; ++q) {
        instant.velocity.x[first + q] += factor * run[0][q];
        instant.velocity.y[first + q] += factor * run[1][q];
        instant.velocity.z[first + q] += factor * run[2][q];
      }
      if (bend == nullptr || instant.rotation.x == nullptr) continue;
      for (std::size_t q = 0; q < block.count; ++q) {
        // A point at `arm` from an axis with velocity v goes round it with arm x v / arm^2.
        const Vec3 velocity{factor * run[0][q], factor * run[1][q], factor * run[2][q]};
        add_to(instant.rotation, first + q, cross({bend[0][q], bend[1][q], bend[2][q]}, velocity));
      }
    }
  }
}

Vec3 Body::surface_velocity(Vec3 point, Vec3 normal, double time) const {
  Vec3 v;
  surface_velocities({.count = 1,
                      .time = time,
                      .axis = {},
                      .position = {&point.x, &point.y, &point.z},
                      .normal = {&normal.x, &normal.y, &normal.z},
                      .velocity = {&v.x, &v.y, &v.z}});
  return v;
}

double Body::largest_speed() const {
  double speed = 0.0;
  for (std::size_t n = 0; n < motions.size(); ++n) {
    speed += motions[n]->largest_speed();
    if (n < axis_distances.size())
      speed += axis_distances[n] * motions[n]->largest_angular_velocity();
  }
  const RunningParts* const parts = running_parts(*this);
  return parts != nullptr ? parts->largest_factor() * speed : speed;
}

double Body::largest_displacing_speed() const {
  if (!displaces()) return 0.0;
  if (running_parts(*this) != nullptr) return largest_speed();
  double speed = 0.0;
  for (std::size_t n = 0; n < motions.size(); ++n) {
    if (!motions[n]->moves_body()) continue;
    speed += motions[n]->largest_speed();
    if (n < axis_distances.size())
      speed += axis_distances[n] * motions[n]->largest_angular_velocity();
  }
  return speed;
}

namespace {

/// The box in a body's frame that holds a box in the domain's.
void box_in_body(const Placement& at, Vec3& min, Vec3& max) {
  const Vec3 corner[2] = {min, max};
  for (int n = 0; n < 8; ++n) {
    const Vec3 p = at.to_body({corner[n & 1].x, corner[n >> 1 & 1].y, corner[n >> 2].z});
    for (int d = 0; d < 3; ++d) {
      min[d] = n == 0 ? p[d] : std::min(min[d], p[d]);
      max[d] = n == 0 ? p[d] : std::max(max[d], p[d]);
    }
  }
}

}  // namespace

Triangles Body::triangles(Vec3 min, Vec3 max, double edge) const {
  return triangles(min, max, edge, Placement::turned(frame_origin, frame_axis, frame_angle));
}

Triangles Body::triangles(Vec3 min, Vec3 max, double edge, const Placement& at) const {
  // The shape clips in its own frame.
  Triangles t;
  box_in_body(at, min, max);
  if (const RunningParts* const parts = running_parts(*this)) {
    const double run = run_at(*this, *parts, at);
    const Vec3 way = run * parts->running_direction();
    for (int d = 0; d < 3; ++d) (way[d] > 0.0 ? max : min)[d] += way[d];
    t = parts->triangles_after(run, min, max, edge);
    for (Vec3& p : t) p -= run * parts->running_direction();
  } else {
    t = shape->triangles(min, max, edge);
  }
  for (Vec3& p : t) p = at.to_domain(p);
  return t;
}

double written_edge(Vec3 min, Vec3 max) {
  constexpr double k_share = 1.0 / 250.0;
  return k_share * norm(max - min);
}

namespace {

/// [m] Farthest that a point of a body in the domain can be from an axis that the body turns about.
double arm_of(const Body& body, const sdk::RigidPose& axis, const scenario::DomainSpec& domain) {
  const Placement frame = Placement::turned(body.frame_origin, body.frame_axis, body.frame_angle);
  const auto from_axis = [&](Vec3 point) {
    const Vec3 off = point - axis.pivot;
    return off - dot(off, axis.axis) * axis.axis;
  };
  const Vec3 middle = frame.to_body(0.5 * (domain.min + domain.max));
  const Vec3 centre = middle - from_axis(middle);  // on the axis
  double farthest = 0.0;
  double radius = 0.0;  // of a sphere round the centre that holds the domain
  for (int n = 0; n < 8; ++n) {
    const Vec3 corner = frame.to_body({(n & 1) != 0 ? domain.max.x : domain.min.x,
                                       (n & 2) != 0 ? domain.max.y : domain.min.y,
                                       (n & 4) != 0 ? domain.max.z : domain.min.z});
    farthest = std::max(farthest, norm(from_axis(corner)));
    radius = std::max(radius, norm(corner - centre));
  }
  // Wherever the body turns to, what is in the domain then is in this sphere now.
  const Vec3 reach{radius, radius, radius};
  const double edge = 0.05 * norm(domain.max - domain.min);
  double arm = 0.0;
  for (const Vec3& p : body.shape->triangles(centre - reach, centre + reach, edge)) {
    arm = std::max(arm, norm(from_axis(p)));
  }
  return std::min(arm, farthest);
}

}  // namespace

Body make_body(const scenario::Setup& setup, const scenario::BodySpec& spec,
               std::vector<std::unique_ptr<sdk::Motion>> motions) {
  Body body;
  body.name = spec.name;
  body.group = spec.group;
  body.material = spec.material;
  body.suction = spec.suction;
  body.motions = std::move(motions);
  const auto& catalogue = shape_catalogue();
  const auto kind = std::find_if(catalogue.begin(), catalogue.end(),
                                 [&](const ShapeKind& k) { return k.name == spec.shape.name; });
  if (kind == catalogue.end()) throw std::logic_error("unknown shape " + spec.shape.name);
  body.shape = kind->make(spec.shape.values);
  if (spec.frame >= 0) {
    const auto& frame = setup.frames.at(static_cast<std::size_t>(spec.frame));
    body.frame_origin = frame.origin;
    body.frame_axis = frame.axis / norm(frame.axis);
    body.frame_angle = frame.angle;
  }
  // Earlier motions carry the body away from later axes: all of it counts, as far as the domain.
  const double size = norm(setup.domain.max - setup.domain.min);
  for (const auto& motion : body.motions) {
    double arm = 0.0;
    if (motion->largest_angular_velocity() > 0.0) {
      arm = arm_of(body, motion->pose(0.0), setup.domain);
      if (body.motions.size() > 1) arm += size;
    }
    body.axis_distances.push_back(arm);
  }
  return body;
}

Body make_body(const scenario::Setup& setup, const scenario::BodySpec& spec,
               std::unique_ptr<sdk::Motion> motion) {
  std::vector<std::unique_ptr<sdk::Motion>> motions;
  if (motion) motions.push_back(std::move(motion));
  return make_body(setup, spec, std::move(motions));
}

bool do_surfaces_change(const scenario::Setup& setup, const BodySet& bodies) {
  for (std::size_t n = 0; n < bodies.size(); ++n) {
    if (setup.bodies[n].removal || bodies[n].displaces()) return true;
  }
  return false;
}

}  // namespace dust::bodies
