// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstddef>
#include <cstdint>
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

/// A triangle of a surface; edge k runs from corner k to corner k + 1.
struct SurfaceTriangle {
  std::int32_t corner[3] = {0, 0, 0};  ///< vertices
  std::int32_t edge[3] = {0, 0, 0};
  sdk::Vec3 normal;
  std::int32_t part = 0;
  bool is_sliver = false;
};

struct SurfaceEdge {
  std::int32_t from = 0, to = 0;     ///< vertices, from < to
  std::int32_t first = 0, last = 0;  ///< its triangles in edge_triangles
  sdk::Vec3 normal;                  ///< mean of its triangles'
  bool is_border = false;            ///< between parts
};

/// Triangles that know their neighbours.
struct TriangleSurface {
  double tolerance = 0.0;  ///< [m] points closer than this are one
  MeshHealth health;
  std::vector<SurfaceTriangle> triangles;
  std::vector<SurfaceEdge> edges;
  std::vector<std::int32_t> edge_triangles;
  std::vector<sdk::Vec3> vertices;
  std::vector<sdk::Vec3> vertex_normals;
  std::vector<std::uint8_t> vertex_is_border;  ///< between parts
  std::vector<std::int32_t> vertex_begin;      ///< its triangles in vertex_triangles
  std::vector<std::int32_t> vertex_triangles;
  int parts = 0;

  [[nodiscard]] sdk::Vec3 at(const SurfaceTriangle& t, int corner) const {
    return vertices[static_cast<std::size_t>(t.corner[corner % 3])];
  }
};

/// The surface that three corners per triangle [m] make, anticlockwise seen from
/// outside. Points closer than the tolerance become one; triangles without extent or given twice
/// are left out. What is odd about it stands in `health`.
TriangleSurface connect_triangles(const std::vector<sdk::Vec3>& corners);

/// Cuts the surface into parts where it folds towards the grains; all folds do that if grains are
/// on both sides of a thin sheet. Smooth hollows narrower than the largest sphere, of this radius
/// [m], are cut too (mesh_parts.cpp).
void divide_into_parts(TriangleSurface& surface, double largest_radius, bool is_sheet);

}  // namespace dust::bodies
