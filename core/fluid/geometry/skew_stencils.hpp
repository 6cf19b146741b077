// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/geometry/body_field.hpp"
#include "fluid/geometry/geometry.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <vector>

namespace dust::fluid {

/// A point of a body's surface that a stencil refers to, before points are grouped by body.
struct SurfacePoint {
  sdk::Vec3 place;
  sdk::Vec3 normal;
  int body = 0;
};

/// Size of a cell along a direction.
[[nodiscard]] inline double spacing_along(const Grid& grid, sdk::Vec3 n) {
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) sum += std::pow(n[d] * grid.spacing[d], 2);
  return std::sqrt(sum);
}

/// Finds the faces beside surfaces that move along themselves, and convection along the surface
/// there: SkewFace and SkewNode of a Geometry.
class SkewStencils {
 public:
  /// What is known of grid and bodies by then; kept by reference.
  struct SolverParts {
    const Grid& grid;
    const bodies::BodySet& bodies;
    const SideKinds& sides;
    const FaceProperties& properties;
    const BodyField& field;
    const CellField& distance;                               ///< [m] of cell centres
    const std::array<std::vector<std::uint8_t>, 3>& closed;  ///< of faces, 2 = blocked
  };
  /// Adds to `geometry`, whose faces have their kinds, and to `points`.
  SkewStencils(const SolverParts& parts, Geometry& geometry, std::vector<SurfacePoint>& points);
  void find();

 private:
  using Hit = BodyField::Hit;
  using Vec3 = sdk::Vec3;
  struct Beside {
    Hit hit;
    std::int32_t wall_point = -1;  ///< its foot, if that is near
    bool is_usable = false;        ///< beside a surface that moves along itself
  };
  struct Frame {
    Vec3 place;
    Hit hit;
    Vec3 tangent;
    int along = 1;
  };
  struct PatchPoint {
    std::int32_t from = 0;
    double x = 0.0;  ///< along the surface, in cells
    double z = 0.0;  ///< distance from the surface less that of the face, in cells
    double weight = 0.0;
  };
  [[nodiscard]] bool is_turning(int body) const;
  void find_beside(int d);
  /// Adds the point of the surface next to `place`; its number.
  std::int32_t add_foot(Vec3 place, const Hit& hit);
  void find_skew(int d);
  void add_skew(int d, const std::array<int, 3>& c);
  /// Fills patch_ with what is round a place; false if the surface there is not one and smooth.
  bool gather(int d, const std::array<int, 3>& c, const Frame& frame, bool& is_askew);
  bool fit(int d, const std::array<int, 3>& c, const Frame& frame, std::ptrdiff_t self,
           std::vector<SkewNode>& nodes, bool& is_askew);

  SolverParts around_;
  const Grid& grid_;
  const SideKinds& sides_;
  Geometry& g_;
  std::vector<SurfacePoint>& points_;
  std::array<std::vector<std::int32_t>, 3> beside_index_;  ///< per face, -1 = far
  std::array<std::vector<Beside>, 3> beside_;
  std::vector<PatchPoint> patch_;
};

}  // namespace dust::fluid
