// SPDX-License-Identifier: Apache-2.0
#include "airborne/surface_transport.hpp"

#include <algorithm>
#include <cmath>

namespace dust::airborne {
namespace {

using sdk::Vec3;

/// A piece of surface shorter than this share of a cell hands on all it has in a sub-step.
constexpr double k_shortest_piece = 0.1;

/// [m/s] Of a surface across the face that it passes, along itself: v_d / sqrt(1 - n_d^2), positive
/// out of the piece, never more than its speed.
double speed_across(Vec3 velocity, Vec3 normal, int d, double sign) {
  const double speed = norm(velocity);
  const double sine = std::sqrt(std::max(0.0, 1.0 - normal[d] * normal[d]));
  const double across = sign * velocity[d];
  // Rounding moves nothing sideways.
  if (!(across > 1e-9 * speed)) return 0.0;
  return across >= sine * speed ? speed : across / sine;
}

/// The velocity in the plane of the piece: a surface that runs along itself keeps its speed there.
Vec3 in_plane(const SurfaceMotion& motion, Vec3 normal) {
  if (motion.displaces) return motion.velocity;
  const Vec3 along = motion.velocity - dot(motion.velocity, normal) * normal;
  const double length = norm(along);
  return length > 0.0 ? (norm(motion.velocity) / length) * along : Vec3{};
}

}  // namespace

void SurfaceTransport::prepare(const fluid::Grid& grid, const Flow& flow, Layers& layers) {
  shortest_ = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
  layers.match(flow.walls);
  routes_.find(grid, flow);
  if (layers.left_behind().empty()) return;
  std::vector<std::pair<Layers::Place, std::int32_t>> moves;
  for (const auto& [place, layer] : layers.left_behind()) {
    if (const auto piece = routes_.nearest(place.first, place.second)) {
      moves.emplace_back(place, *piece);
    }
  }
  for (const auto& [place, piece] : moves) layers.bring(place, static_cast<std::size_t>(piece));
}

void SurfaceTransport::find_rates(const Flow& flow) {
  rate_.assign(routes_.edges().size(), 0.0);
  whole_.assign(routes_.pieces().size(), 0.0);
  for (std::size_t p = 0; p < routes_.pieces().size(); ++p) {
    const SurfaceRoutes::Piece& piece = routes_.pieces()[p];
    const auto& motion = flow.surface_motions[static_cast<std::size_t>(piece.number)];
    const Vec3 velocity = in_plane(motion, piece.normal);
    for (std::size_t e = piece.begin; e < piece.end; ++e) {
      const SurfaceRoutes::Edge& edge = routes_.edges()[e];
      rate_[e] =
          speed_across(velocity, piece.normal, edge.direction, edge.sign) * edge.length_over_area;
      whole_[p] += rate_[e];
    }
  }
}

/// [1/s] That sub-steps must resolve.
double SurfaceTransport::largest_rate(const Flow& flow) const {
  double largest = 0.0;
  for (std::size_t p = 0; p < routes_.pieces().size(); ++p) {
    const auto number = static_cast<std::size_t>(routes_.pieces()[p].number);
    const double speed = norm(flow.surface_motions[number].velocity);
    largest = std::max(largest, std::min(whole_[p], speed / (k_shortest_piece * shortest_)));
  }
  return largest;
}

void SurfaceTransport::make_step(double step, std::size_t classes, const Flow& flow, Layers& layers,
                                 std::vector<std::vector<double>>& carried_out) {
  before_.assign(layers.rows().begin(), layers.rows().end());
  for (std::size_t p = 0; p < routes_.pieces().size(); ++p) {
    if (!(whole_[p] > 0.0)) continue;
    const SurfaceRoutes::Piece& piece = routes_.pieces()[p];
    const auto number = static_cast<std::size_t>(piece.number);
    const double share = std::min(1.0, whole_[p] * step);
    for (std::size_t n = 0; n < classes; ++n) {
      const double lies = before_[classes * number + n];
      if (!(lies > 0.0)) continue;
      double gone = 0.0;
      for (std::size_t e = piece.begin; e < piece.end; ++e) {
        if (!(rate_[e] > 0.0)) continue;
        const double moved = std::min(lies - gone, lies * (share * (rate_[e] / whole_[p])));
        gone += moved;
        const std::int32_t to = routes_.edges()[e].to;
        if (to == SurfaceRoutes::k_outside) {
          carried_out[n][static_cast<std::size_t>(flow.walls[number].surface)] += moved;
        } else {
          layers.add(static_cast<std::size_t>(to), n, moved);
        }
      }
      layers.add(number, n, -gone);
    }
  }
}

void SurfaceTransport::advance(const Flow& flow, double step, Layers& layers,
                               std::vector<std::vector<double>>& carried_out) {
  find_rates(flow);
  const auto parts = static_cast<int>(std::ceil(step * largest_rate(flow)));
  for (int part = 0; part < parts; ++part) {
    make_step(step / parts, carried_out.size(), flow, layers, carried_out);
  }
}

}  // namespace dust::airborne
