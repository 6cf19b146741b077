// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "bodies/mesh/mesh.hpp"
#include "bodies/shape_kinds.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <array>
#include <cmath>

namespace dust::bodies {
namespace {

using sdk::SchemaOf;
using sdk::Vec3;
namespace dimension = sdk::dimension;

std::string millimetres(double metres) { return base::plain_text(1e3 * metres, 4) + " mm"; }
std::string place_of(Vec3 p) {
  return "(" + millimetres(p.x) + ", " + millimetres(p.y) + ", " + millimetres(p.z) + ")";
}

/// A shape whose surface is a mesh; a sheet is thickened by half its thickness on either side.
class MeshShape : public Shape {
 public:
  MeshShape(const std::vector<Vec3>& corners, Mesh::Sides sides, double thickness)
      : mesh_(corners, sides), half_(0.5 * thickness), sides_(sides) {}

  void expect_spheres(double largest_radius) override {
    mesh_.expect_spheres(largest_radius + half_);
  }
  [[nodiscard]] SurfacePoint nearest(Vec3 point) const override {
    return thickened(mesh_.nearest(point));
  }
  [[nodiscard]] int parts() const override { return mesh_.parts(); }
  [[nodiscard]] SurfacePoint contact(int part, Vec3 point, double reach) const override {
    return thickened(mesh_.contact(part, point, reach + half_));
  }
  void touch(int part, const ClosestPoints& t) const override {
    for (std::size_t n = 0; n < t.count; ++n) {
      const Vec3 centre{t.x[n], t.y[n], t.z[n]};
      t.put(n, thickened(mesh_.contact(part, centre, t.reach[n] + half_, &t.hint[n])));
    }
  }
  [[nodiscard]] bool is_within(int part, Vec3 point, double reach) const override {
    return mesh_.is_within(part, point, reach + half_);
  }
  void find_within(Vec3 point, double reach, std::vector<std::int32_t>& parts) const override {
    mesh_.find_within(point, reach + half_, parts);
  }
  [[nodiscard]] bool is_solid() const override { return sides_ == Mesh::Sides::one || half_ > 0.0; }
  [[nodiscard]] Vec3 lateral_axis() const override { return {0, 1, 0}; }
  [[nodiscard]] Triangles triangles(Vec3, Vec3, double) const override { return mesh_.triangles(); }

 protected:
  /// [m] Of a sheet its thickness.
  [[nodiscard]] double mesh_wall() const {
    return sides_ == Mesh::Sides::both ? 2.0 * half_ : mesh_.thinnest_wall();
  }

  Mesh mesh_;

 private:
  [[nodiscard]] SurfacePoint thickened(SurfacePoint s) const {
    s.distance -= half_;
    return s;
  }
  double half_;
  Mesh::Sides sides_;
};

/// A part drawn elsewhere.
class StlMesh final : public MeshShape {
 public:
  struct Parameters {
    std::string file;
    double unit = 0.0;
    Vec3 rotated_about{0, 0, 1};
    double rotated_by = 0.0;
    Vec3 moved_by;
    bool flip = false;
    std::string open = "refused";
    double thickness = 0.0;
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.text(&Parameters::file, "file", "STL file, binary or text, seen from the scenario's folder.")
        .refers_to(sdk::Refers::file);
    s.number(&Parameters::unit, "unit", dimension::length,
             "Length of one unit of the file, which has none of its own: 1 mm for most.")
        .above(0);
    s.vector(&Parameters::rotated_about, "rotated_about", dimension::none,
             "Direction of the axis through the file's origin that the part is turned about.")
        .optional();
    s.number(&Parameters::rotated_by, "rotated_by", dimension::angle,
             "Angle it is turned by, right-handed.")
        .optional();
    s.vector(&Parameters::moved_by, "moved_by", dimension::length,
             "Shift of the turned part to its place.")
        .optional();
    s.boolean(&Parameters::flip, "flip",
              "Turns all triangles round: for a mesh that is inside out.")
        .optional();
    s.text(&Parameters::open, "open",
           "allowed: a mesh with open edges is a thin sheet that grains touch from both sides.")
        .one_of({"refused", "allowed"})
        .optional();
    s.number(&Parameters::thickness, "thickness", dimension::length,
             "Thickness of an open sheet, half on either side.")
        .at_least(0)
        .optional();
    return s.build();
  }
  explicit StlMesh(const Parameters& p)
      : MeshShape(placed(p), p.open == "allowed" ? Mesh::Sides::both : Mesh::Sides::one,
                  p.open == "allowed" ? p.thickness : 0.0),
        file_(p.file) {
    const MeshHealth& h = mesh_.health();
    const std::string mesh = "the mesh " + p.file;
    if (h.triangles == h.slivers) throw sdk::ParameterError(mesh + " has no triangle with an area");
    if (p.open == "allowed") return;
    if (p.thickness > 0.0) {
      throw sdk::ParameterError("thickness is for open sheets: give open: allowed with it");
    }
    if (!h.is_closed()) {
      const bool has_holes = h.open_edges > 0;
      throw sdk::ParameterError(
          mesh + " is open: " +
          (has_holes ? std::to_string(h.open_edges) +
                           " edges have one triangle only, the first at " + place_of(h.open_place)
                     : std::to_string(h.crowded_edges) + " edges have more than two triangles") +
          "; close it where it was drawn, or give open: allowed if it is a thin sheet");
    }
    if (h.opposing_edges > 0) {
      throw sdk::ParameterError(mesh + ": at " + std::to_string(h.opposing_edges) +
                                " edges the triangles look to different sides, the first at " +
                                place_of(h.opposing_place) +
                                "; make all normals look outwards where it was drawn");
    }
    if (h.inside_out > 0) {
      throw sdk::ParameterError(
          mesh + " is inside out" +
          (h.shells > 1 ? " (" + std::to_string(h.inside_out) + " of its " +
                              std::to_string(h.shells) + " shells)"
                        : "") +
          ": its triangles look inwards; give flip: " + (p.flip ? "false" : "true"));
    }
  }
  [[nodiscard]] std::vector<std::string> notes() const override {
    const MeshHealth& h = mesh_.health();
    return {file_ + ": " + std::to_string(h.triangles) + " triangles, " +
            std::to_string(h.vertices) + " points, " + std::to_string(h.shells) +
            (h.shells == 1 ? " shell, " : " shells, ") +
            (h.is_closed() ? "closed, volume " + base::volume_text(h.volume)
                           : std::to_string(h.open_edges) + " open edges") +
            ", area " + base::area_text(h.area) + ", " + std::to_string(mesh_.parts()) +
            " parts that a grain can touch at once; edges " + base::length_text(h.shortest_edge) +
            " to " + base::length_text(h.longest_edge) + ", median " +
            base::length_text(h.median_edge)};
  }
  [[nodiscard]] std::vector<std::string> warnings() const override {
    const MeshHealth& h = mesh_.health();
    std::vector<std::string> all;
    const auto add = [&](std::size_t count, const char* what) {
      if (count > 0) all.push_back(file_ + ": " + std::to_string(count) + what);
    };
    add(h.duplicates, " triangles were given twice: left out");
    add(h.collapsed, " triangles have two corners in one point: left out");
    add(h.slivers, " triangles have no area: they hold the mesh together but are not touched");
    return all;
  }
  [[nodiscard]] double shortest_edge() const override { return mesh_.health().shortest_edge; }
  [[nodiscard]] double thinnest_wall() const override { return mesh_wall(); }

 private:
  static std::vector<Vec3> placed(const Parameters& p) {
    std::vector<Vec3> corners = read_stl(p.file);
    const Vec3 axis = unit_direction(p.rotated_about, "rotated_about");
    for (Vec3& c : corners) c = rotate(p.unit * c, axis, p.rotated_by) + p.moved_by;
    if (p.flip) {
      for (std::size_t n = 0; n + 2 < corners.size(); n += 3) std::swap(corners[n], corners[n + 1]);
    }
    return corners;
  }
  std::string file_;
};

/// A vessel with flat walls: the space inside is given, sides may be open.
class Container final : public MeshShape {
 public:
  struct Parameters {
    Vec3 min;
    Vec3 max;
    double thickness = 0.0;
    std::vector<std::string> open = {"top"};
  };
  static sdk::ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", dimension::length, "Lower corner of the space inside.");
    s.vector(&Parameters::max, "max", dimension::length, "Upper corner of the space inside.");
    s.number(&Parameters::thickness, "thickness", dimension::length, "Thickness of the walls.")
        .above(0);
    s.texts(&Parameters::open, "open", "Sides without a wall.")
        .one_of({"left", "right", "front", "back", "bottom", "top"})
        .optional();
    return s.build();
  }
  explicit Container(const Parameters& p) : MeshShape(walls(p), Mesh::Sides::one, 0.0) {}

 private:
  /// Walls as blocks on a grid of 3 x 3 x 3; the faces between blocks and nothing are the surface.
  static std::vector<Vec3> walls(const Parameters& p) {
    const std::array<const char*, 6> names = {"left", "right", "front", "back", "bottom", "top"};
    double plane[3][4];
    bool is_open[3][2];
    bool has_walls = false;
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d]))
        throw sdk::ParameterError("max is not above min in each direction");
      plane[d][0] = p.min[d] - p.thickness;
      plane[d][1] = p.min[d];
      plane[d][2] = p.max[d];
      plane[d][3] = p.max[d] + p.thickness;
      for (int side = 0; side < 2; ++side) {
        is_open[d][side] = std::find(p.open.begin(), p.open.end(),
                                     names[static_cast<std::size_t>(2 * d + side)]) != p.open.end();
        has_walls = has_walls || !is_open[d][side];
      }
    }
    if (!has_walls) throw sdk::ParameterError("open names all sides: there are no walls");
    using Cell = std::array<int, 3>;
    const auto is_solid = [&](Cell c) {
      bool is_wall = false;
      for (std::size_t d = 0; d < 3; ++d) {
        if (c[d] < 0 || c[d] > 2) return false;
        if (c[d] == 1) continue;
        if (is_open[d][c[d] / 2]) return false;
        is_wall = true;
      }
      return is_wall;
    };
    std::vector<Vec3> corners;
    for (int n = 0; n < 27; ++n) {
      const Cell c = {n % 3, n / 3 % 3, n / 9};
      if (!is_solid(c)) continue;
      for (int d = 0; d < 3; ++d) {
        for (int side = 0; side < 2; ++side) {
          Cell next = c;
          next[static_cast<std::size_t>(d)] += 2 * side - 1;
          if (is_solid(next)) continue;
          const int e = (d + 1) % 3;
          const int f = (d + 2) % 3;
          const auto corner = [&](int high_e, int high_f) {
            Vec3 q;
            q[d] = plane[d][c[static_cast<std::size_t>(d)] + side];
            q[e] = plane[e][c[static_cast<std::size_t>(e)] + high_e];
            q[f] = plane[f][c[static_cast<std::size_t>(f)] + high_f];
            return q;
          };
          add_quad(corners, corner(0, 0), corner(side, 1 - side), corner(1, 1),
                   corner(1 - side, side));
        }
      }
    }
    return corners;
  }
};

}  // namespace

ShapeKind mesh_kind() {
  return make_kind<StlMesh>("mesh", "Part drawn elsewhere, as triangles in an STL file.");
}
ShapeKind container_kind() {
  return make_kind<Container>("container",
                              "Box-shaped vessel with flat walls, open at some sides.");
}

}  // namespace dust::bodies
