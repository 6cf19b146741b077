// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/mesh/box_tree.hpp"
#include "bodies/mesh/triangle_surface.hpp"
#include "bodies/shape.hpp"

#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace dust::bodies {

/// A surface of triangles with an exact nearest point. It is cut into parts along edges where it
/// folds towards the grains, so that a sphere in a corner touches each side of it, while on a part
/// it touches once: nothing is counted twice at edges between triangles, and a sphere rolls over
/// them as over one face. Hollows narrower than the spheres are cut into strips.
class Mesh {
 public:
  enum class Sides {
    one,   ///< solid behind the triangles: they look outwards
    both,  ///< a thin sheet
  };
  /// Three corners per triangle [m], anticlockwise seen from outside.
  Mesh(const std::vector<sdk::Vec3>& corners, Sides sides);
  /// Cuts it into the parts that spheres up to this radius [m] touch at once.
  void expect_spheres(double largest_radius);

  [[nodiscard]] const MeshHealth& health() const { return surface_.health; }
  [[nodiscard]] int parts() const { return static_cast<int>(trees_.size()); }
  /// [m] Least distance straight through the solid between two faces that look away from each
  /// other, measured in the middle of triangles; 0 where there are no such faces, or no inside.
  [[nodiscard]] double thinnest_wall() const;

  /// Nearest point of everything; the distance is negative inside (sides: one).
  [[nodiscard]] SurfacePoint nearest(sdk::Vec3 point) const;
  /// The contact of a part with a sphere round `point`: infinitely far when the part has no point
  /// nearer than `reach`, when the point lies behind it, or when an edge it shares with another
  /// part is that part's to touch. `hint`: the triangle found last time, or -1; looked at first, so
  /// that all that is farther is left out, and set to the one found.
  [[nodiscard]] SurfacePoint contact(int part, sdk::Vec3 point, double reach,
                                     std::int32_t* hint = nullptr) const;
  /// Whether the part has a point nearer than `reach`, on whichever side.
  [[nodiscard]] bool is_within(int part, sdk::Vec3 point, double reach) const;
  /// The parts of which that is so, ascending; `parts` is emptied first.
  void find_within(sdk::Vec3 point, double reach, std::vector<std::int32_t>& parts) const;
  [[nodiscard]] Triangles triangles() const;

 private:
  enum class Feature : std::uint8_t { face, edge, vertex };
  struct Foot {
    double distance2 = std::numeric_limits<double>::infinity();
    sdk::Vec3 place;
    std::int32_t triangle = -1;
    Feature feature = Feature::face;
    int corner = 0;  ///< of the vertex, or where the edge begins
  };
  void divide(double largest_radius);
  void grow_trees();
  void descend(std::int32_t part, sdk::Vec3 point, Foot& best) const;
  [[nodiscard]] Foot foot_on(std::int32_t triangle, sdk::Vec3 point) const;
  [[nodiscard]] sdk::Vec3 normal_at(const Foot& foot) const;
  [[nodiscard]] bool belongs_to_other(const Foot& foot, int part, sdk::Vec3 point) const;
  [[nodiscard]] SurfacePoint surface_point(const Foot& foot, sdk::Vec3 point) const;

  Sides sides_;
  TriangleSurface surface_;
  std::vector<BoxTree> trees_;  ///< one per part, of its triangles
  BoxTree tree_of_parts_;
  double largest_radius_ = 0.0;  ///< [m] of the spheres it is cut for
};

/// The corners of the triangles of an STL file, binary or text, in the file's own unit. Throws a
/// ParameterError that says what is wrong with it.
std::vector<sdk::Vec3> read_stl(const std::string& file);

}  // namespace dust::bodies
