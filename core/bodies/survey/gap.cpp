// SPDX-License-Identifier: Apache-2.0
#include "bodies/survey/gap.hpp"

#include "bodies/survey/bounds_of.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <queue>
#include <utility>
#include <vector>

namespace dust::bodies {
namespace {

using sdk::Vec3;

constexpr double k_finest = 1.0 / 8.0;    ///< of the limit: triangles below are not halved
constexpr double k_touching = 1e-6;       ///< of the limit: nearer is no gap
constexpr std::size_t k_candidates = 16;  ///< places from which closest points are looked for
constexpr int k_projections = 40;

/// A triangle of the first body's surface.
struct Piece {
  std::array<Vec3, 3> corner;
  double least = 0.0;   ///< [m] no point of it is nearer to the second body
  double radius = 0.0;  ///< [m] of a sphere round its middle

  [[nodiscard]] Vec3 middle() const { return (corner[0] + corner[1] + corner[2]) / 3.0; }
};

struct IsFarther {
  bool operator()(const Piece& p, const Piece& q) const { return p.least > q.least; }
};

class Search {
 public:
  Search(const Body& a, const Body& b, const GapSearch& search)
      : a_(a), b_(b), at_a_(a.placement(0.0)), at_b_(b.placement(0.0)), search_(search) {}

  Gap run() {
    // Finer than what a person can see of a curve, coarse enough for long conveyors.
    const double edge = std::max(search_.limit, norm(search_.max - search_.min) / 100.0);
    const Triangles of_a = a_.triangles(search_.min, search_.max, edge, at_a_);
    const Bounds of_b = bounds_of(b_, at_b_, search_.min, search_.max, 0.0, edge);
    if (distance(bounds_of(of_a), of_b) > search_.limit + edge) return gap_;
    for (std::size_t n = 0; n + 2 < of_a.size() && !is_done(); n += 3) {
      look_at({{of_a[n], of_a[n + 1], of_a[n + 2]}});
    }
    while (!pieces_.empty() && !is_done()) {
      const Piece piece = pieces_.top();
      pieces_.pop();
      if (piece.least >= bound()) break;  // nor can any other
      halve(piece);
    }
    gap_.is_whole = pieces_.empty() || pieces_.top().least >= bound() || gap_.width == 0.0;
    refine();
    gap_.work = work_;
    return gap_;
  }

 private:
  [[nodiscard]] double bound() const { return std::min(gap_.width, search_.limit); }
  [[nodiscard]] bool is_done() const { return gap_.width == 0.0 || work_ >= search_.work; }

  /// [m] From a point to the box that is looked through.
  [[nodiscard]] double outside(Vec3 point) const {
    return distance(Bounds{point, point}, Bounds{search_.min, search_.max});
  }

  /// [m] From a point of the first surface to the second body. Sheets are told by their middle
  /// surface, curved faces by chords: as deep as the point lies in the first body it is nearer.
  double width_at(Vec3 point) {
    work_ += 2;
    return b_.nearest(point, at_b_).distance + std::min(a_.nearest(point, at_a_).distance, 0.0);
  }

  void look_at(Piece piece) {
    const Vec3 middle = piece.middle();
    for (const Vec3& c : piece.corner) piece.radius = std::max(piece.radius, norm(c - middle));
    const double beyond = outside(middle);
    if (beyond > piece.radius) return;
    const double width = width_at(middle);
    piece.least = width - piece.radius;
    if (piece.least >= bound()) return;
    if (beyond == 0.0) offer(width, middle);
    if (piece.radius > k_finest * search_.limit) pieces_.push(piece);
  }

  /// A place that may be the narrowest or near to it.
  void offer(double width, Vec3 place) {
    if (width < gap_.width) {
      gap_.width = width > k_touching * search_.limit ? width : 0.0;
      gap_.place = place;
    }
    candidates_.emplace_back(width, place);
    if (candidates_.size() < 4 * k_candidates) return;
    keep_nearest();
  }
  void keep_nearest() {
    const auto is_nearer = [](const auto& p, const auto& q) { return p.first < q.first; };
    std::stable_sort(candidates_.begin(), candidates_.end(), is_nearer);
    candidates_.resize(std::min(candidates_.size(), k_candidates));
  }

  void halve(const Piece& piece) {
    std::size_t longest = 0;
    for (std::size_t k = 1; k < 3; ++k) {
      if (length(piece, k) > length(piece, longest)) longest = k;
    }
    const Vec3 from = piece.corner[longest];
    const Vec3 to = piece.corner[(longest + 1) % 3];
    const Vec3 opposite = piece.corner[(longest + 2) % 3];
    const Vec3 half = 0.5 * (from + to);
    look_at({{from, half, opposite}});
    look_at({{half, to, opposite}});
  }
  static double length(const Piece& piece, std::size_t k) {
    return norm(piece.corner[(k + 1) % 3] - piece.corner[k]);
  }

  /// From surface to surface: each projection brings the points nearer to each other.
  void refine() {
    keep_nearest();
    for (const auto& [width, start] : candidates_) {
      Vec3 on_a = start;
      double last = width;
      for (int n = 0; n < k_projections && gap_.width > 0.0; ++n) {
        const SurfacePoint to_b = b_.nearest(on_a, at_b_);
        const Vec3 on_b = on_a - to_b.distance * to_b.normal;
        const SurfacePoint to_a = a_.nearest(on_b, at_a_);
        on_a = on_b - to_a.distance * to_a.normal;
        work_ += 2;
        if (outside(on_b) > 0.0) break;
        if (to_a.distance < gap_.width) {
          gap_.width = to_a.distance > k_touching * search_.limit ? to_a.distance : 0.0;
          gap_.place = on_b;
        }
        if (to_a.distance > last - k_touching * search_.limit) break;
        last = to_a.distance;
      }
    }
    if (gap_.width > search_.limit) gap_.width = std::numeric_limits<double>::infinity();
  }

  const Body& a_;
  const Body& b_;
  Placement at_a_;
  Placement at_b_;
  GapSearch search_;
  Gap gap_;
  std::size_t work_ = 0;
  std::priority_queue<Piece, std::vector<Piece>, IsFarther> pieces_;
  std::vector<std::pair<double, Vec3>> candidates_;
};

}  // namespace

Gap smallest_gap(const Body& a, const Body& b, const GapSearch& search) {
  return Search(a, b, search).run();
}

}  // namespace dust::bodies
