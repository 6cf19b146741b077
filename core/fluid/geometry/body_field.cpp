// SPDX-License-Identifier: Apache-2.0
#include "fluid/geometry/body_field.hpp"

#include "bodies/belt/running_parts.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>

namespace dust::fluid {
namespace {

using sdk::Vec3;

/// Product of two normals below which they look away from each other: the walls of a right-angled
/// edge do not, however a file rounds its vertices.
constexpr double k_look_away = -0.05;
/// And above which they are those of one plane.
constexpr double k_same_plane = 1.0 - 1e-9;
/// Distance from a surface (in cells) at which one goes round an edge of it.
constexpr double k_round = 0.02;
/// A point this close to a surface (in cells) counts as being on it, so inside the body.
constexpr double k_on_surface = 1e-6;
/// Openings smaller than this are closed, larger than one minus this are whole.
constexpr double k_min_opening = 1e-4;
/// Sub-boxes per direction in which an open share is measured.
constexpr int k_sub_boxes = 8;
constexpr int k_block = k_sub_boxes / 2;
/// Distance from a surface (in cells) of the points that stand for cells with their centre inside.
constexpr double k_beside = 1e-3;
/// Walls that one is pushed out of in a corner.
constexpr int k_ways_out = 6;
/// Share of the distance that a step goes: a sheet is met on the side one comes from.
constexpr double k_stride = 0.99;
/// By how much more a distance is allowed for to change than one goes, for shapes whose distance is
/// not quite one.
constexpr double k_not_quite_one = 1.5;
/// Whether a block of sub-boxes is all of one kind.
enum class Whole : std::uint8_t { no, open, closed };
/// Steps along a straight way, each as long as the distance from the surfaces; for ways that come
/// near one at a small angle more.
constexpr int k_few_steps = 200, k_more_steps = 4000;
constexpr double k_far = std::numeric_limits<double>::max();

/// The sub-boxes of a box.
struct SubBoxes {
  SubBoxes(Vec3 centre, Vec3 edges) : box_centre(centre), box_size(edges) {
    for (int d = 0; d < 3; ++d) {
      count[static_cast<std::size_t>(d)] = edges[d] > 0.0 ? k_sub_boxes : 1;
      size[d] = edges[d] / count[static_cast<std::size_t>(d)];
    }
  }
  /// Of sub-box a, b, c, or between two of them.
  [[nodiscard]] Vec3 middle(double a, double b, double c) const {
    return {box_centre.x + ((a + 0.5) / count[0] - 0.5) * box_size.x,
            box_centre.y + ((b + 0.5) / count[1] - 0.5) * box_size.y,
            box_centre.z + ((c + 0.5) / count[2] - 0.5) * box_size.z};
  }

  Vec3 box_centre, box_size;
  std::array<int, 3> count{};
  Vec3 size;
};

/// Blocks of sub-boxes that no surface comes near are as open as their middle. `distance`(point) is
/// that to the nearest surface, which goes `moved` [m] meanwhile.
template <class Distance>
std::array<Whole, 8> whole_blocks(const SubBoxes& boxes, double moved, const Distance& distance) {
  std::array<Whole, 8> blocks{};
  const double clear = 0.25 * norm(boxes.box_size) + 0.5 * norm(boxes.size) + moved;
  for (int block = 0; block < 8; ++block) {
    const auto middle_of = [&](int d) {
      return boxes.count[static_cast<std::size_t>(d)] == 1
                 ? 0.0
                 : ((block >> d) % 2) * k_block + 0.5 * (k_block - 1);
    };
    const double found = distance(boxes.middle(middle_of(0), middle_of(1), middle_of(2)));
    blocks[static_cast<std::size_t>(block)] = found > clear    ? Whole::open
                                              : found < -clear ? Whole::closed
                                                               : Whole::no;
  }
  return blocks;
}

}  // namespace

BodyField::BodyField(const Grid& grid, const bodies::BodySet& bodies, double time, Which which) {
  for (int d = 0; d < 3; ++d) {
    const double h = grid.spacing[d];
    if (grid.count[d] > 1 && (smallest_ == 0.0 || h < smallest_)) smallest_ = h;
  }
  if (smallest_ == 0.0) smallest_ = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    const bodies::Body& body = bodies[b];
    if (body.is_removed()) continue;
    const bool is_moving = body.displaces();
    const bool has_static_part = is_moving && bodies::running_parts(body) != nullptr;
    const int number = static_cast<int>(b);
    if (!is_moving || has_static_part) {
      // A surface that only moves along itself stays where the scenario puts it, to the last bit.
      const int part = has_static_part ? bodies::RunningParts::k_static : k_whole;
      static_bodies_.push_back(
          {&body, number,
           bodies::Placement::turned(body.frame_origin, body.frame_axis, body.frame_angle), part});
    }
    if (!is_moving || which == Which::static_bodies) continue;
    if (has_static_part) {
      for (int part = bodies::RunningParts::k_running; part < body.shape->parts(); ++part) {
        moving_bodies_.push_back({&body, number, body.placement(time), part});
      }
    } else {
      moving_bodies_.push_back({&body, number, body.placement(time), k_whole});
    }
    largest_speed_ = std::max(largest_speed_, body.largest_displacing_speed());
  }
}

bodies::SurfacePoint BodyField::Placed::nearest(Vec3 p, double limit) const {
  return part == k_whole ? body->nearest(p, at) : body->contact(part, p, limit, at);
}

class BodyField::Near {
 public:
  Near(const BodyField& field, Vec3 p, double reach) : field_(field) {
    std::array<Seen, k_max> seen;
    std::size_t count = 0;
    for (const auto* list : {&field.static_bodies_, &field.moving_bodies_}) {
      for (const Placed& b : *list) {
        const auto s = b.nearest(p, hit_.distance + 2.0 * k_not_quite_one * reach);
        if (s.distance < hit_.distance) hit_ = {s.distance, s.normal, b.number};
        if (count < k_max) seen[count] = {&b, s.distance};
        ++count;
      }
    }
    has_many_ = count > k_max;
    if (has_many_) return;
    // A distance changes by no more than one goes. The half more covers shapes whose distance is
    // not quite one.
    const double limit = hit_.distance + 2.0 * k_not_quite_one * reach;
    for (std::size_t n = 0; n < count; ++n) {
      if (seen[n].distance <= limit) bodies_[count_++] = seen[n].body;
    }
  }
  /// At p itself.
  [[nodiscard]] const Hit& hit() const { return hit_; }
  [[nodiscard]] Hit nearest(Vec3 q) const {
    if (has_many_) return field_.nearest(q);
    Hit hit;
    for (std::size_t n = 0; n < count_; ++n) {
      const Placed& b = *bodies_[n];
      const auto s = b.nearest(q, hit.distance);
      if (s.distance < hit.distance) hit = {s.distance, s.normal, b.number};
    }
    return hit;
  }

 private:
  static constexpr std::size_t k_max = 32;
  struct Seen {
    const Placed* body;
    double distance;
  };
  const BodyField& field_;
  Hit hit_;
  bool has_many_ = false;
  std::array<const Placed*, k_max> bodies_{};
  std::size_t count_ = 0;
};

BodyField::Hit BodyField::nearest(Vec3 p) const {
  Hit hit;
  for (const auto* list : {&static_bodies_, &moving_bodies_}) {
    for (const Placed& b : *list) {
      const auto s = b.nearest(p, hit.distance);
      if (s.distance < hit.distance) hit = {s.distance, s.normal, b.number};
    }
  }
  return hit;
}

bool BodyField::is_far_from_moving_bodies(Vec3 p, double reach) const {
  return std::all_of(moving_bodies_.begin(), moving_bodies_.end(), [&](const Placed& b) {
    return b.nearest(p, std::nextafter(reach, k_far)).distance > reach;
  });
}

bool BodyField::is_inside(Vec3 p) const { return nearest(p).distance <= k_on_surface * smallest_; }

double BodyField::own_way(const Hit& hit, Vec3 p, double smear) const {
  if (smear == 0.0) return 0.0;
  for (const Placed& b : moving_bodies_) {
    if (b.number == hit.body)
      return smear * std::abs(bodies::normal_speed(*b.body, b.at, p, hit.normal));
  }
  return 0.0;
}

double BodyField::open_part(const Hit& hit, Vec3 p, Vec3 size, double smear) const {
  // Speeds of a surface are dear: asked for where they could matter. Twice the fastest, for a point
  // beside a body that turns goes faster than any of the body.
  const double most = size.x + size.y + size.z + 2.0 * smear * largest_speed_;
  double width = 2.0 * std::abs(hit.distance) <= most ? own_way(hit, p, smear) : 0.0;
  for (int d = 0; d < 3; ++d) width += std::abs(hit.normal[d]) * size[d];
  if (width > k_on_surface * smallest_) return std::clamp(0.5 + hit.distance / width, 0.0, 1.0);
  return hit.distance > k_on_surface * smallest_ ? 1.0 : 0.0;
}

double BodyField::open_share(Vec3 centre, Vec3 size, Vec3* middle, double smear) const {
  const double reach = 0.5 * norm(size);
  const Near near(*this, centre, reach);
  const Hit& at_centre = near.hit();
  const double far = reach + 0.5 * own_way(at_centre, centre, smear);
  if (at_centre.distance >= far) return 1.0;
  if (at_centre.distance <= -far) return 0.0;
  const SubBoxes boxes(centre, size);
  const auto blocks =
      whole_blocks(boxes, smear * largest_speed_, [&](Vec3 p) { return near.nearest(p).distance; });
  const auto& n = boxes.count;
  double sum = 0.0;
  Vec3 moment;
  const double clear = norm(boxes.size) + smear * largest_speed_;
  for (int c = 0; c < n[2]; ++c) {
    for (int b = 0; b < n[1]; ++b) {
      // The next ones in the row are whole where this one is far from the surface.
      int whole_before = 0;
      double whole_part = 0.0;
      for (int a = 0; a < n[0]; ++a) {
        const Whole whole =
            blocks[static_cast<std::size_t>(a / k_block + 2 * (b / k_block) + 4 * (c / k_block))];
        if (whole == Whole::closed) continue;
        const Vec3 p = boxes.middle(a, b, c);
        double part = whole == Whole::open ? 1.0 : whole_part;
        if (whole == Whole::no && a >= whole_before) {
          const Hit hit = near.nearest(p);
          part = open_part(hit, p, boxes.size, smear);
          const double spare = std::abs(hit.distance) - clear;
          if (spare > 0.0 && n[0] > 1) {
            whole_before = a + 1 + static_cast<int>(spare / (k_not_quite_one * boxes.size.x));
            whole_part = part;
          }
        }
        sum += part;
        moment += part * (p - centre);
      }
    }
  }
  if (middle != nullptr && sum > 0.0) *middle = centre + moment / sum;
  const double share = sum / (n[0] * n[1] * n[2]);
  if (share < k_min_opening) return 0.0;
  return share > 1.0 - k_min_opening ? 1.0 : share;
}

double BodyField::wall_distance(Vec3 from, Vec3 to) const {
  const Near near(*this, 0.5 * (from + to), 0.5 * norm(to - from));
  double low = 0.0;
  double high = 1.0;
  for (int step = 0; step < 50; ++step) {
    const double mid = 0.5 * (low + high);
    (near.nearest(from + mid * (to - from)).distance > 0.0 ? low : high) = mid;
  }
  return high * norm(to - from);
}

std::optional<Vec3> BodyField::outside(Vec3 centre) const {
  const double beside = k_beside * smallest_;
  Vec3 p = centre;
  Hit hit = nearest(p);
  if (hit.distance >= beside) return p;
  // In a corner the way out of one wall leads along another, or into it.
  for (int way_out = 0; way_out < k_ways_out; ++way_out) {
    p += (beside - hit.distance) * hit.normal;
    hit = nearest(p);
    if (hit.distance >= 0.5 * beside) return p;
  }
  return std::nullopt;
}

BodyField::Met BodyField::meet(const Near& near, Vec3 from, Vec3 to, int steps_left) const {
  Met met;
  const double length = norm(to - from);
  if (!(length > 0.0)) return met;
  const Vec3 along = (to - from) / length;
  for (; steps_left > 0 && met.way < length; --steps_left) {
    met.hit = near.nearest(from + met.way * along);
    if (met.hit.distance <= 0.1 * k_beside * smallest_) {
      met.end = Met::End::surface;
      return met;
    }
    met.way += k_stride * met.hit.distance;
  }
  if (met.way < length) met.end = Met::End::unknown;
  return met;
}

std::optional<double> BodyField::passes_through(Vec3 from, Vec3 to) const {
  // The edge that a chord leads round lies up to its length away.
  const Near near(*this, 0.5 * (from + to), norm(to - from));
  Met in = meet(near, from, to, k_few_steps);
  if (in.end == Met::End::free) return std::nullopt;
  Met out = meet(near, to, from, k_few_steps);
  if (in.end == Met::End::unknown || out.end == Met::End::unknown) {
    // Along a surface, in steps as short as the distance from it: the same a little farther off.
    from = away(near, from);
    to = away(near, to);
    in = meet(near, from, to, k_more_steps);
    out = meet(near, to, from, k_more_steps);
  }
  if (in.end != Met::End::surface || out.end != Met::End::surface) return std::nullopt;
  // Through a thin body the two surfaces look away from each other. Otherwise it is the chord of an
  // edge or of a round body, or leads from the one side of an edge between two walls to the other.
  const Vec3 along = (to - from) / norm(to - from);
  const bool is_chord = dot(in.hit.normal, out.hit.normal) > k_look_away &&
                        leads_round(near, {from + in.way * along, in.hit.normal},
                                    {to - out.way * along, out.hit.normal});
  return is_chord ? std::nullopt : std::optional<double>(in.way);
}

/// A place at `k_round` from the surface that a place beside it is connected with, or that itself.
Vec3 BodyField::away(const Near& near, Vec3 place) const {
  const double wanted = k_round * smallest_;
  const Hit hit = near.nearest(place);
  if (hit.distance >= wanted) return place;
  const Vec3 farther = place + (wanted - hit.distance) * hit.normal;
  return near.nearest(farther).distance >= 0.5 * wanted ? farther : place;
}

/// Whether one gets from one place of a surface to the other along it, over the edge in which the
/// planes through them meet.
bool BodyField::leads_round(const Near& near, const Place& in, const Place& out) const {
  const double together = dot(in.normal, out.normal);
  if (together > k_same_plane) return true;
  const double above = k_round * smallest_;
  const double height = dot(in.point - out.point, out.normal);
  const double rest = 1.0 - together * together;
  const double b = (above - height - together * above) / rest;
  const Vec3 edge = in.point + (above - together * b) * in.normal + b * out.normal;
  return is_free(near, in.point + above * in.normal, edge) &&
         is_free(near, out.point + above * out.normal, edge);
}

bool BodyField::is_free(const Near& near, Vec3 from, Vec3 to) const {
  return meet(near, from, to, k_few_steps).end == Met::End::free;
}

}  // namespace dust::fluid
