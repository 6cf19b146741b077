// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "bodies/belt/cleats.hpp"
#include "bodies/belt/local_axes.hpp"
#include "bodies/belt/running_parts.hpp"
#include "bodies/belt/trough.hpp"
#include "bodies/shape_kinds.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <optional>
#include <string>
#include <vector>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

struct Parameters {
  Vec3 head;
  Vec3 tail;
  double radius = 0.0;
  double thickness = 0.0;
  double width = 0.0;
  double trough_angle = 0.0;
  double centre_roll = 0.0;
  double bend_radius = 0.0;
  double transition = 0.0;
  double tail_transition = 0.0;
  double pulley_rise = 0.0;
  double idler_spacing = 0.0;
  double sag = 0.0;
  double cleat_height = 0.0;
  double cleat_thickness = 0.0;
  double cleat_spacing = 0.0;
  std::string cleat_profile = "bar";
  Vec3 up{0, 0, 1};
};

void declare_belt(SchemaOf<Parameters>& s) {
  s.vector(&Parameters::head, "head", dimension::length,
           "Middle of the head pulley's axis; the belt runs from tail to head on top.");
  s.vector(&Parameters::tail, "tail", dimension::length,
           "Middle of the tail pulley's axis; it may lie outside the domain.");
  s.number(&Parameters::radius, "radius", dimension::length, "Radius of both pulleys.")
      .symbol("R")
      .above(0);
  s.number(&Parameters::thickness, "thickness", dimension::length, "Thickness of the belt.")
      .symbol("d")
      .above(0);
  s.number(&Parameters::width, "width", dimension::length, "Width of the belt, laid flat.")
      .symbol("B")
      .above(0);
}

void declare_trough(SchemaOf<Parameters>& s) {
  const auto optional_length = [&s](double Parameters::*member, const char* name,
                                    const char* sentence) {
    s.number(member, name, dimension::length, sentence).at_least(0).optional();
  };
  s.number(&Parameters::trough_angle, "trough_angle", dimension::angle,
           "Angle of the two wing rolls; 0 = a flat belt.")
      .symbol("\\beta")
      .at_least(0)
      .at_most(std::numbers::pi / 3)
      .optional();
  optional_length(&Parameters::centre_roll, "centre_roll",
                  "Width of the belt on the centre roll; 0 = 38 % of the belt's.");
  optional_length(&Parameters::bend_radius, "bend_radius",
                  "Radius to which the belt bends between centre and wing rolls: grains of a "
                  "smaller radius touch the belt once everywhere. 0 = a quarter of the width, or "
                  "as large as the rolls allow.");
  optional_length(&Parameters::transition, "transition",
                  "From the last troughed idler to the head pulley; 0 = 1.6 widths.");
  optional_length(&Parameters::tail_transition, "tail_transition",
                  "The same at the tail pulley; 0 = as at the head.");
  optional_length(&Parameters::pulley_rise, "pulley_rise",
                  "How far the tops of the pulleys are above the line of the centre rolls.");
  optional_length(&Parameters::sag, "sag", "Sag of the belt midway between two idlers.");
  optional_length(&Parameters::idler_spacing, "idler_spacing",
                  "Distance between idlers, for the sag: a whole number of them goes between the "
                  "pulleys, the distance nearest to this.");
}

void declare_cleats(SchemaOf<Parameters>& s) {
  const auto length = [&s](double Parameters::*member, const char* name, const char* sentence) {
    s.number(member, name, dimension::length, sentence).at_least(0).optional();
  };
  length(&Parameters::cleat_height, "cleat_height",
         "Height over the belt of crossbars as wide as it that run with it; 0 = a plain belt. In "
         "a trough they fit its section.");
  length(&Parameters::cleat_thickness, "cleat_thickness", "Of the crossbars, along the belt.");
  length(&Parameters::cleat_spacing, "cleat_spacing",
         "From one crossbar to the next; a whole number goes round the belt, the spacing nearest "
         "to this. At time 0 one is over the head pulley's axis.");
  s.text(
       &Parameters::cleat_profile, "cleat_profile",
       "Section of the crossbars. bar: a box. round: a segment of a disc, at most half as high as "
       "it is thick; where the spacing is the thickness they touch, and the belt's surface is a "
       "wave.")
      .one_of({"bar", "round"})
      .optional();
}

TroughParameters trough_of(const Parameters& p) {
  TroughParameters t;
  t.length = norm(p.head - p.tail);
  t.half_width = 0.5 * p.width;
  t.half_centre = 0.5 * (p.centre_roll > 0.0 ? p.centre_roll : 0.38 * p.width);
  t.rise = p.pulley_rise;
  t.sag = p.sag;
  if (p.idler_spacing > 0.0) {
    // The belt lies on the tops of both pulleys.
    t.idler_spacing = t.length / std::max(1.0, std::round(t.length / p.idler_spacing));
  }
  if (t.half_centre >= t.half_width) {
    throw sdk::ParameterError("centre_roll is not shorter than the width");
  }
  if (p.sag > 0.0 && !(p.idler_spacing > 0.0)) {
    throw sdk::ParameterError("sag needs the idler_spacing");
  }
  t.slope = std::tan(0.5 * p.trough_angle);
  const double room = std::min(t.half_centre, t.half_width - t.half_centre);
  if (t.slope > 0.0) {
    t.bend = std::min(0.9 * room, 0.25 * p.width * t.slope);
    if (p.bend_radius > 0.0) t.bend = p.bend_radius * t.slope;
    if (t.bend >= room) throw sdk::ParameterError("bend_radius is too large for the rolls");
  }
  if (t.slope > 0.0 || t.rise > 0.0) {
    t.head_transition = p.transition > 0.0 ? p.transition : 1.6 * p.width;
    t.tail_transition = p.tail_transition > 0.0 ? p.tail_transition : t.head_transition;
    if (t.head_transition + t.tail_transition > t.length) {
      throw sdk::ParameterError(
          "both transitions, " + base::length_text(t.head_transition) + " and " +
          base::length_text(t.tail_transition) + ", do not fit between head and tail, which are " +
          base::length_text(t.length) + " apart" +
          (p.transition > 0.0
               ? ": make them shorter"
               : " (1.6 times the width each): is the unit of width right? Or give a "
                 "shorter transition"));
    }
  }
  return t;
}

std::optional<Cleats> cleats_of(const Parameters& p, const Trough& trough) {
  const double h = p.cleat_height;
  const double t = p.cleat_thickness;
  const double s = p.cleat_spacing;
  const bool is_round = p.cleat_profile == "round";
  if (h == 0.0 && t == 0.0 && s == 0.0 && !is_round) return std::nullopt;
  const auto refuse = [](const char* why) { throw sdk::ParameterError(why); };
  if (h == 0.0) refuse("cleat_height is 0: cleats need a height");
  if (t == 0.0) refuse("cleat_thickness is 0: cleats need a thickness");
  if (s == 0.0) refuse("cleat_spacing is 0: cleats need a spacing");
  const bool is_flat = p.trough_angle == 0.0 && p.pulley_rise == 0.0 && p.sag == 0.0;
  if (p.trough_angle > 0.0) {
    const TroughParameters& section = trough.parameters();
    if (h + 0.5 * p.thickness >= section.bend / section.slope) {
      refuse("cleat_height is not below bend_radius: a cleat would fold where the belt bends");
    }
  }
  if (is_round && h > 0.5 * t) {
    refuse("cleat_height is more than half of cleat_thickness: a round cleat would overhang");
  }
  const Cleats cleats({.length = norm(p.head - p.tail),
                       .reach = p.radius + 0.5 * p.thickness,
                       .half_width = 0.5 * p.width,
                       .face = 0.5 * p.thickness,
                       .height = h,
                       .thickness = t,
                       .spacing = s,
                       .profile = is_round ? BarSection::Profile::round : BarSection::Profile::bar,
                       .trough = is_flat ? std::nullopt : std::optional<Trough>(trough)});
  if (is_round) {
    if (cleats.gap() < cleats.thickness()) refuse("cleat_spacing is shorter than cleat_thickness");
  } else if (s <= t || cleats.gap() <= t) {
    refuse("cleat_spacing is not longer than cleat_thickness");
  }
  return cleats;
}

/// Belt of finite width round two equal pulleys: all points within half a thickness of the belt's
/// middle surface, and the pulleys. Nothing of it is made of facets: the carrying run is a Trough,
/// the rest cylinders and planes; they meet smoothly. Each row of cleats is a part more.
class BeltConveyor final : public Shape, public LocalAxes, public RunningParts {
 public:
  using Parameters = bodies::Parameters;
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    declare_belt(s);
    declare_trough(s);
    declare_cleats(s);
    s.vector(&Parameters::up, "up", dimension::none,
             "Direction towards the carrying side; its length does not matter.")
        .optional();
    return s.build();
  }

  explicit BeltConveyor(const Parameters& p)
      : head_(p.head), trough_(direct(p)), cleats_(cleats_of(p, trough_)) {
    half_thickness_ = 0.5 * p.thickness;
    reach_ = p.radius + half_thickness_;
    half_width_ = 0.5 * p.width;
    length_ = norm(p.head - p.tail);
    along_ = (p.head - p.tail) / length_;
    across_ = cross(unit_direction(p.up, "up"), along_);
    if (!(norm(across_) > 1e-3)) throw sdk::ParameterError("up is along the belt");
    across_ = across_ / norm(across_);
    up_ = cross(along_, across_);
    is_flat_ = p.trough_angle == 0.0 && p.pulley_rise == 0.0 && p.sag == 0.0;
    if (!cleats_) return;
    largest_factor_ = cleats_->largest_factor();
    // In a transition the belt is lower beside a cleat than below it.
    farthest_tip_ = cleats_->tip_radius() - reach_ - half_thickness_ +
                    (is_flat_ ? 0.0 : 0.5 * p.cleat_thickness);
  }

  [[nodiscard]] SurfacePoint nearest(Vec3 point) const override {
    return cleats_ ? nearest_after(0.0, point) : nearest_of_belt(point);
  }
  [[nodiscard]] int parts() const override { return cleats_ ? 1 + cleats_->rows() : 1; }
  [[nodiscard]] SurfacePoint contact(int part, Vec3 point, double reach) const override {
    return contact_after(0.0, part, point, reach);
  }
  void touch(int part, const ClosestPoints& t) const override {
    for (std::size_t n = 0; n < t.count; ++n) {
      t.put(n, contact_after(0.0, part, {t.x[n], t.y[n], t.z[n]}, t.reach[n]));
    }
  }
  /// However far the cleats have run, and for a point that is up to their spacing behind its place.
  [[nodiscard]] bool is_within(int part, Vec3 point, double reach) const override {
    if (!cleats_) return nearest_of_belt(point).distance < reach;
    if (part != k_static) reach += farthest_tip_;
    const Vec3 q = to_belt(point);
    const double spacing = cleats_->spacing();
    // Over the carrying run it is as far from the belt wherever it is.
    const bool is_over = q.z > reach_ && is_alike(q.x, q.x + spacing, reach);
    const Vec3 middle = q + Vec3{0.5 * spacing, 0.0, 0.0};
    return is_over ? carrying(q).distance < reach
                   : nearest_face(middle).distance < reach + 0.5 * spacing;
  }
  [[nodiscard]] std::vector<std::string> notes() const override {
    if (!cleats_) return {};
    return {std::to_string(cleats_->count()) + " cleats, " + base::length_text(cleats_->gap()) +
            " apart: a whole number round the belt"};
  }
  /// Inside the loop beside a pulley: from a radius before the place where the sphere touches
  /// pulley and run at once, to the pulley's axis.
  [[nodiscard]] std::string nip_at(Vec3 point, double radius) const override {
    const Vec3 q = to_belt(point);
    const double reach = 2.0 * std::sqrt(reach_ * (half_thickness_ + radius)) + radius;
    const bool is_at_tail = q.x >= -length_ && q.x < reach - length_;
    if (!is_at_tail && !(q.x <= 0.0 && q.x > -reach)) return {};
    const double above = q.z - reach_;
    if (std::abs(q.y) > half_width_ || q.z < -reach_ - half_thickness_) return {};
    if (q.z > 0.0 && above > trough_.foot({q.x, q.y, above}).z) return {};
    return is_at_tail ? "the nip of the tail pulley" : "the nip of the head pulley";
  }
  [[nodiscard]] Vec3 lateral_axis() const override { return across_; }
  [[nodiscard]] const LocalAxes* local_axes() const override { return this; }
  [[nodiscard]] Vec3 lateral_axis_at(Vec3 point, Vec3 normal) const override {
    // The point of the middle surface below: nothing has to be searched for.
    const Vec3 n{dot(normal, along_), dot(normal, across_), dot(normal, up_)};
    const Vec3 q = to_belt(point) - half_thickness_ * n;
    const double x = q.x > 0.0 ? q.x : std::min(q.x + length_, 0.0);  // beyond a pulley's axis
    Vec3 direction{q.z > 0.0 ? 1.0 : -1.0, 0.0, 0.0};
    if (x != 0.0) {
      direction = Vec3{q.z, 0.0, -x};
    } else if (q.z > 0.0) {
      direction = trough_.running_direction({q.x, q.y, q.z - reach_});
    }
    direction = from_belt(direction);
    // Round the edge the normal is not square to the way of the belt's middle.
    direction -= dot(direction, normal) * normal;
    const double length = norm(direction);
    return length > 1e-6 ? cross(normal, direction / length) : Vec3{};
  }
  [[nodiscard]] bool is_bent() const override { return true; }
  /// Round the pulleys alone: what a carrying run bends in transitions and between idlers is small.
  [[nodiscard]] Vec3 bend_at(Vec3 point) const override {
    const Vec3 q = to_belt(point);
    const Vec3 arm{q.x > 0.0 ? q.x : std::min(q.x + length_, 0.0), 0.0, q.z};
    return arm.x != 0.0 ? from_belt(arm / dot(arm, arm)) : Vec3{};
  }
  [[nodiscard]] Triangles triangles(Vec3 min, Vec3 max, double edge) const override {
    return triangles_after(0.0, min, max, edge);
  }

  [[nodiscard]] const RunningParts* running_parts() const override {
    return cleats_ ? this : nullptr;
  }
  [[nodiscard]] double spacing() const override { return cleats_->spacing(); }
  [[nodiscard]] Vec3 running_direction() const override { return along_; }
  [[nodiscard]] double largest_factor() const override { return largest_factor_; }
  [[nodiscard]] SurfacePoint nearest_after(double run, Vec3 point) const override {
    const Vec3 q = to_belt(point);
    SurfacePoint s = nearest_face(q);
    for (int row = 0; row < cleats_->rows(); ++row) {
      const SurfacePoint cleat = cleats_->nearest(run, row, q, s.distance).point;
      if (cleat.distance < s.distance) s = cleat;
    }
    return {s.distance, from_belt(s.normal)};
  }
  [[nodiscard]] SurfacePoint contact_after(double run, int part, Vec3 point,
                                           double reach) const override {
    if (part == k_static) return nearest_of_belt(point);
    const SurfacePoint s = cleats_->nearest(run, part - k_running, to_belt(point), reach).point;
    if (!(s.distance < reach)) return {std::numeric_limits<double>::infinity(), {}};
    return {s.distance, from_belt(s.normal)};
  }
  [[nodiscard]] Triangles triangles_after(double run, Vec3 min, Vec3 max,
                                          double edge) const override;
  [[nodiscard]] VelocityQuery velocity_query_after(double run, Vec3 point,
                                                   Vec3 normal) const override {
    const Vec3 q = to_belt(point);
    auto cleat = cleats_->nearest(run, 0, q);
    for (int row = 1; row < cleats_->rows(); ++row) {
      const auto other = cleats_->nearest(run, row, q);
      if (other.point.distance < cleat.point.distance) cleat = other;
    }
    if (std::abs(cleat.point.distance) < std::abs(nearest_face(q).distance)) {
      if (cleat.stand.is_in_trough) return query_for(cleats_->velocity_in_trough(cleat.stand, q));
      if (!cleat.stand.is_on_pulley) return {across_, from_belt(cleat.stand.out), 1.0, {}};
      const Vec3 arm{q.x - cleat.stand.pulley, 0.0, q.z};
      return {across_, from_belt(arm / norm(arm)), norm(arm) / reach_,
              from_belt(arm / dot(arm, arm))};
    }
    return {lateral_axis_at(point, normal), normal, 1.0, bend_at(point)};
  }

 private:
  [[nodiscard]] SurfacePoint nearest_of_belt(Vec3 point) const {
    const SurfacePoint n = nearest_face(to_belt(point));
    return {n.distance, from_belt(n.normal)};
  }
  /// Whether what is within `reach` of a point over the belt is the same at all places from one to
  /// the other.
  [[nodiscard]] bool is_alike(double from, double to, double reach) const {
    if (is_flat_) return from > -length_ && to < 0.0;
    const double pulleys = reach + reach_ + half_thickness_;
    return from > pulleys - length_ && to < -pulleys && trough_.is_even(from - reach, to + reach);
  }
  /// What to ask for a velocity of `way` times the belt's.
  [[nodiscard]] VelocityQuery query_for(Vec3 way) const {
    const double factor = norm(way);
    Vec3 normal = cross(way, Vec3{0.0, 1.0, 0.0});  // never along y: a cleat runs along x
    normal = normal / norm(normal);
    return {from_belt(cross(normal, way / factor)), from_belt(normal), factor, {}};
  }
  static TroughParameters direct(const Parameters& p) {
    if (!(norm(p.head - p.tail) > 0.0)) {
      throw sdk::ParameterError("head and tail are the same point");
    }
    return trough_of(p);
  }
  [[nodiscard]] Vec3 to_belt(Vec3 point) const {
    const Vec3 q = point - head_;
    return {dot(q, along_), dot(q, across_), dot(q, up_)};
  }
  [[nodiscard]] Vec3 from_belt(Vec3 v) const { return v.x * along_ + v.y * across_ + v.z * up_; }

  [[nodiscard]] SurfacePoint nearest_face(Vec3 q) const {
    SurfacePoint best = carrying(q);
    const auto look = [&best](const SurfacePoint& n) {
      if (n.distance < best.distance) best = n;
    };
    // A pulley or the return run is nearer than its box only where the point is near to that.
    if (std::abs(q.x) < best.distance + reach_ + half_thickness_) look(pulley(q, 0.0));
    if (std::abs(q.x + length_) < best.distance + reach_ + half_thickness_) {
      look(pulley(q, -length_));
    }
    if (q.z + reach_ - half_thickness_ < best.distance) look(return_run(q));
    return best;
  }
  struct Chain;
  void add_carrying(Chain& chain, double x, const std::vector<double>& widths) const;
  void add_level(Chain& chain, Vec3 at, Vec3 normal, const std::vector<double>& widths) const;
  void add_faces(Triangles& t, const Chain& chain, bool has_underside) const;
  void add_pulley(Triangles& t, double x, double sign, double edge,
                  const std::vector<double>& widths) const;

  [[nodiscard]] SurfacePoint carrying(Vec3 q) const {
    const Vec3 p{q.x, q.y, q.z - reach_};
    if (cleats_ && is_flat_) {
      return sheet(
          p, {std::clamp(p.x, -length_, 0.0), std::clamp(p.y, -half_width_, half_width_), 0.0});
    }
    const Vec3 foot = trough_.foot(p);
    return sheet(p, foot);
  }
  [[nodiscard]] SurfacePoint return_run(Vec3 q) const {
    const Vec3 foot{std::clamp(q.x, -length_, 0.0), std::clamp(q.y, -half_width_, half_width_),
                    -reach_};
    return sheet(q, foot);
  }
  [[nodiscard]] SurfacePoint sheet(Vec3 p, Vec3 foot) const {
    const Vec3 off = p - foot;
    const double d = norm(off);
    return {d - half_thickness_, d > 0.0 ? off / d : Vec3{0, 0, 1}};
  }
  /// A disc of radius R + thickness, its rims rounded as the belt's edges are.
  [[nodiscard]] SurfacePoint pulley(Vec3 q, double x) const {
    const double dx = q.x - x;
    const double r = std::sqrt(dx * dx + q.z * q.z);
    const Vec3 radial = r > 0.0 ? Vec3{dx / r, 0.0, q.z / r} : Vec3{1, 0, 0};
    const Vec3 sideways{0.0, q.y < 0.0 ? -1.0 : 1.0, 0.0};
    const double over = r - reach_;
    const double beside = std::abs(q.y) - half_width_;
    if (over > 0.0 && beside > 0.0) {
      const double d = std::sqrt(over * over + beside * beside);
      return {d - half_thickness_, (over / d) * radial + (beside / d) * sideways};
    }
    return over > beside ? SurfacePoint{over - half_thickness_, radial}
                         : SurfacePoint{beside - half_thickness_, sideways};
  }

  Vec3 head_;
  Trough trough_;
  std::optional<Cleats> cleats_;
  Vec3 along_, across_, up_;
  double length_ = 0.0;
  double reach_ = 0.0;  ///< [m] of the middle surface, from the pulley's axis
  double half_thickness_ = 0.0;
  double half_width_ = 0.0;
  bool is_flat_ = true;  ///< no trough, no raised pulleys, no sag
  double largest_factor_ = 1.0;
  double farthest_tip_ = 0.0;  ///< [m] of a cleat from the belt's face
};

/// Stations along the middle surface, one after the other: points and normals from edge to edge.
struct BeltConveyor::Chain {
  std::vector<std::vector<Vec3>> middle;
  std::vector<std::vector<Vec3>> normal;
};

void BeltConveyor::add_carrying(Chain& chain, double x, const std::vector<double>& widths) const {
  chain.middle.emplace_back();
  chain.normal.emplace_back();
  const double aside = 1e-6 * half_width_;
  for (const double w : widths) {
    const Vec3 here = trough_.at(x, w);
    const Vec3 to_side = trough_.at(x, std::min(w + aside, half_width_)) -
                         trough_.at(x, std::max(w - aside, -half_width_));
    const Vec3 normal = cross(trough_.running_direction(here), to_side);
    chain.middle.back().push_back(here + Vec3{0, 0, reach_});
    chain.normal.back().push_back(normal / norm(normal));
  }
}

void BeltConveyor::add_level(Chain& chain, Vec3 at, Vec3 normal,
                             const std::vector<double>& widths) const {
  chain.middle.emplace_back();
  chain.normal.emplace_back(widths.size(), normal);
  for (const double w : widths) chain.middle.back().push_back(at + Vec3{0, w, 0});
}

/// The faces of a chain and its rounded edges; round a pulley there is no underside.
void BeltConveyor::add_faces(Triangles& t, const Chain& chain, bool has_underside) const {
  const auto point = [&](std::size_t n, std::size_t k, double side) {
    return head_ + from_belt(chain.middle[n][k] + side * half_thickness_ * chain.normal[n][k]);
  };
  const auto tip = [&](std::size_t n, bool is_last) {
    const auto& m = chain.middle[n];
    const std::size_t k = is_last ? m.size() - 1 : 0;
    const Vec3 out = m[k] - m[is_last ? k - 1 : 1];
    return head_ + from_belt(m[k] + (half_thickness_ / norm(out)) * out);
  };
  for (std::size_t n = 0; n + 1 < chain.middle.size(); ++n) {
    const std::size_t last = chain.middle[n].size() - 1;
    for (std::size_t k = 0; k < last; ++k) {
      add_quad(t, point(n, k, 1), point(n + 1, k, 1), point(n + 1, k + 1, 1), point(n, k + 1, 1));
      if (!has_underside) continue;
      add_quad(t, point(n, k, -1), point(n, k + 1, -1), point(n + 1, k + 1, -1),
               point(n + 1, k, -1));
    }
    for (const bool is_last : {false, true}) {
      const std::size_t k = is_last ? last : 0;
      const auto edge = [&](double side_before, double side_after) {
        const auto at = [&](std::size_t m, double side) {
          return side == 0.0 ? tip(m, is_last) : point(m, k, side);
        };
        add_quad(t, at(n, side_before), at(n + 1, side_before), at(n + 1, side_after),
                 at(n, side_after));
      };
      const double first = is_last ? 1.0 : -1.0;
      if (has_underside || is_last) edge(first, 0.0);
      if (has_underside || !is_last) edge(0.0, -first);
    }
  }
}

void BeltConveyor::add_pulley(Triangles& t, double x, double sign, double edge,
                              const std::vector<double>& widths) const {
  const int pieces = std::max(8, static_cast<int>(std::ceil(std::numbers::pi * reach_ / edge)));
  Chain chain;
  for (int n = 0; n <= pieces; ++n) {
    const double angle = std::numbers::pi * n / pieces;
    const Vec3 radial{sign * std::sin(angle), 0.0, sign * std::cos(angle)};
    add_level(chain, Vec3{x, 0.0, 0.0} + reach_ * radial, radial, widths);
  }
  add_faces(t, chain, false);
  for (const double side : {-1.0, 1.0}) {
    const Vec3 centre{x, side * (half_width_ + half_thickness_), 0.0};
    for (int n = 0; n < 2 * pieces; ++n) {
      const auto rim = [&](int k) {
        const double angle = std::numbers::pi * k / pieces;
        return head_ + from_belt(centre + reach_ * Vec3{std::cos(angle), 0, std::sin(angle)});
      };
      const Vec3 a = rim(side > 0.0 ? n + 1 : n);
      const Vec3 b = rim(side > 0.0 ? n : n + 1);
      t.insert(t.end(), {head_ + from_belt(centre), a, b});
    }
  }
}

Triangles BeltConveyor::triangles_after(double run, Vec3 min, Vec3 max, double edge) const {
  std::vector<double> widths;
  const int across = std::clamp(static_cast<int>(std::ceil(2.0 * half_width_ / edge)), 12, 48);
  for (int n = 0; n <= across; ++n) widths.push_back((2.0 * n / across - 1.0) * half_width_);
  // The part beside the box, however the belt lies in it.
  double from = 0.0;
  double to = -length_;
  for (int corner = 0; corner < 8; ++corner) {
    const Vec3 c{(corner & 1) != 0 ? max.x : min.x, (corner & 2) != 0 ? max.y : min.y,
                 (corner & 4) != 0 ? max.z : min.z};
    from = std::clamp(std::min(from, to_belt(c).x), -length_, 0.0);
    to = std::clamp(std::max(to, to_belt(c).x), -length_, 0.0);
  }
  Triangles t;
  Chain carrying;
  Chain back;
  const int along = std::clamp(static_cast<int>(std::ceil((to - from) / edge)), 1, 400);
  for (int n = 0; n <= along; ++n) {
    add_carrying(carrying, from + (to - from) * n / along, widths);
  }
  add_level(back, {to, 0.0, -reach_}, {0, 0, -1}, widths);
  add_level(back, {from, 0.0, -reach_}, {0, 0, -1}, widths);
  add_faces(t, carrying, true);
  add_faces(t, back, true);
  if (to == 0.0) add_pulley(t, 0.0, 1.0, edge, widths);
  if (from == -length_) add_pulley(t, -length_, -1.0, edge, widths);
  if (cleats_) {
    for (const Vec3& p : cleats_->triangles(run, from, to, widths))
      t.push_back(head_ + from_belt(p));
  }
  return t;
}

}  // namespace

ShapeKind belt_conveyor_kind() {
  return make_kind<BeltConveyor>(
      "belt_conveyor",
      "Belt of finite width round a head and a tail pulley, in any direction, flat or troughed on "
      "three rolls, plain or with cleats. Nothing keeps grains out of its loop, whose pulleys draw "
      "in "
      "what lies on the return run.");
}

}  // namespace dust::bodies
