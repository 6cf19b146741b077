// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/flow.hpp"
#include "airborne/plane_cut.hpp"
#include "fluid/grid.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <map>
#include <optional>
#include <utility>
#include <vector>

namespace dust::airborne {

/// Which piece of a surface comes after each edge of another: the ways that what lies on a surface
/// takes when it runs.
class SurfaceRoutes {
 public:
  static constexpr std::int32_t k_outside = -1;  ///< out of the domain
  /// An edge of a piece, where the surface passes a face of its cell.
  struct Edge {
    std::int32_t to = k_outside;    ///< piece
    int direction = 0;              ///< of the face's normal
    double sign = 1.0;              ///< 1: the upper face
    double length_over_area = 0.0;  ///< [1/m]
  };
  /// A piece that may run, with its edges.
  struct Piece {
    std::int32_t number = 0;  ///< of Flow::walls
    sdk::Vec3 normal;         ///< unit, into the gas
    std::size_t begin = 0, end = 0;
  };

  /// For all pieces that have a motion.
  void find(const fluid::Grid& grid, const Flow& flow);
  [[nodiscard]] const std::vector<Piece>& pieces() const { return pieces_; }
  [[nodiscard]] const std::vector<Edge>& edges() const { return edges_; }
  /// The piece of a surface that is nearest to a cell, within two cells of it.
  [[nodiscard]] std::optional<std::int32_t> nearest(std::int32_t cell, std::int32_t surface) const;

 private:
  using Cell = std::array<int, 3>;
  /// Where a piece is in its cell.
  struct Location {
    Cell cell{};
    PlaneCut cut;
  };
  [[nodiscard]] Cell cell_of(std::int32_t index) const;
  /// The cell `step` away, round the ends of periodic directions; nothing outside of a side.
  [[nodiscard]] std::optional<Cell> shifted(Cell cell, const std::array<int, 3>& step) const;
  [[nodiscard]] std::int32_t piece_at(Cell cell, std::int32_t surface) const;
  [[nodiscard]] bool goes_on(std::size_t piece, std::int32_t other) const;
  [[nodiscard]] std::int32_t after(std::size_t piece, int direction, double sign) const;
  [[nodiscard]] std::int32_t nearest_ahead(std::size_t piece, sdk::Vec3 exit,
                                           sdk::Vec3 ahead) const;
  void add_edges(std::size_t piece, const Flow& flow);

  fluid::Grid grid_;
  std::vector<Piece> pieces_;
  std::vector<Location> locations_;  ///< by piece of pieces_
  std::vector<Edge> edges_;
  /// By cell and surface, the place in pieces_.
  std::map<std::pair<std::int32_t, std::int32_t>, std::int32_t> at_;
  std::vector<std::int32_t> surface_;  ///< by piece of pieces_
};

}  // namespace dust::airborne
