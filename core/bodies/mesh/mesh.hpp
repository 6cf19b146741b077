// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/shape.hpp"

#include <array>
#include <cstdint>
#include <limits>
#include <string>
#include <vector>

namespace dust::bodies {

/// What was found in a mesh as given.
struct MeshHealth {
  std::size_t triangles = 0;       ///< kept
  std::size_t vertices = 0;        ///< after points closer than the tolerance became one
  std::size_t shells = 0;          ///< connected pieces
  std::size_t collapsed = 0;       ///< left out: two corners are one point
  std::size_t slivers = 0;         ///< without area, kept for the connection only
  std::size_t duplicates = 0;      ///< left out: given before
  std::size_t open_edges = 0;      ///< with one triangle
  std::size_t crowded_edges = 0;   ///< with more than two
  std::size_t opposing_edges = 0;  ///< whose two triangles look to different sides
  std::size_t inside_out = 0;      ///< shells with negative volume that are not a cavity
  double volume = 0.0;             ///< [m3]
  double area = 0.0;               ///< [m2]
  double shortest_edge = 0.0, median_edge = 0.0, longest_edge = 0.0;  ///< [m]
  sdk::Vec3 open_place;      ///< [m] middle of an open edge
  sdk::Vec3 opposing_place;  ///< [m] middle of an edge whose triangles disagree

  [[nodiscard]] bool is_closed() const { return open_edges == 0 && crowded_edges == 0; }
};

/// A surface of triangles with an exact nearest point. It is cut into parts along edges where it
/// folds towards the grains, so that a sphere in a corner touches each side of it, while on a part
/// it touches once: nothing is counted twice at edges between triangles, and a sphere rolls over
/// them as over one face.
class Mesh {
 public:
  enum class Sides {
    one,   ///< solid behind the triangles: they look outwards
    both,  ///< a thin sheet
  };
  /// Three corners per triangle [m], anticlockwise seen from outside.
  Mesh(const std::vector<sdk::Vec3>& corners, Sides sides);

  [[nodiscard]] const MeshHealth& health() const { return health_; }
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
  struct Triangle {
    std::int32_t corner[3] = {0, 0, 0};
    std::int32_t edge[3] = {0, 0, 0};  ///< edge k runs from corner k to corner k + 1
    sdk::Vec3 normal;
    std::int32_t part = 0;
    bool is_sliver = false;
  };
  struct Edge {
    std::int32_t from = 0, to = 0;     ///< vertices, from < to
    std::int32_t first = 0, last = 0;  ///< its triangles in edge_triangle_
    sdk::Vec3 normal;                  ///< mean of its triangles'
    bool is_border = false;            ///< between parts
  };
  struct Node {
    sdk::Vec3 low, high;
    std::int32_t first = 0, count = 0;  ///< triangles of a leaf; count 0: the second child is first
  };
  using Tree = std::vector<Node>;

  // mesh.cpp
  std::vector<std::int32_t> weld(const std::vector<sdk::Vec3>& corners);
  void add_triangles(const std::vector<std::int32_t>& index);
  void connect_edges();
  void connect_vertices();
  void find_shells();
  void measure();
  // mesh_parts.cpp
  void find_parts();
  void mark_borders();
  // mesh_query.cpp
  void grow_trees();
  void grow(Tree& tree, std::int32_t begin, std::int32_t end);
  void descend(const Tree& tree, sdk::Vec3 point, Foot& best) const;
  [[nodiscard]] Foot foot_on(std::int32_t triangle, sdk::Vec3 point) const;
  [[nodiscard]] sdk::Vec3 normal_at(const Foot& foot) const;
  [[nodiscard]] bool belongs_to_other(const Foot& foot, int part, sdk::Vec3 point) const;
  [[nodiscard]] SurfacePoint surface_point(const Foot& foot, sdk::Vec3 point) const;

  [[nodiscard]] sdk::Vec3 at(const Triangle& t, int corner) const {
    return vertex_[static_cast<std::size_t>(t.corner[corner % 3])];
  }

  Sides sides_;
  double tolerance_ = 0.0;  ///< [m] points closer than this are one
  MeshHealth health_;
  std::vector<sdk::Vec3> vertex_;
  std::vector<sdk::Vec3> vertex_normal_;
  std::vector<std::uint8_t> vertex_is_border_;
  std::vector<Triangle> triangle_;
  std::vector<Edge> edge_;
  std::vector<std::int32_t> edge_triangle_;
  std::vector<std::int32_t> vertex_begin_, vertex_triangle_;
  std::vector<std::int32_t> order_;  ///< triangles by part and tree
  std::vector<Tree> trees_;          ///< one per part
};

/// The corners of the triangles of an STL file, binary or text, in the file's own unit. Throws a
/// ParameterError that says what is wrong with it.
std::vector<sdk::Vec3> read_stl(const std::string& file);

}  // namespace dust::bodies
