// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "support/engine.hpp"

#include <array>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <numbers>
#include <string>
#include <vector>

/// Meshes for tests, three corners per triangle, anticlockwise from outside.
namespace dust::test {

using Corners = std::vector<sdk::Vec3>;

inline void add_quad(Corners& c, sdk::Vec3 a, sdk::Vec3 b, sdk::Vec3 d, sdk::Vec3 e) {
  c.insert(c.end(), {a, b, d, a, d, e});
}

/// A box with each face cut into `pieces` x `pieces` squares of two triangles.
inline Corners box_mesh(sdk::Vec3 min, sdk::Vec3 max, int pieces = 1) {
  Corners c;
  for (int d = 0; d < 3; ++d) {
    for (int side = 0; side < 2; ++side) {
      const int e = (d + 1) % 3;
      const int f = (d + 2) % 3;
      for (int m = 0; m < pieces * pieces; ++m) {
        const auto at = [&](int i, int j) {
          sdk::Vec3 p;
          p[d] = side == 1 ? max[d] : min[d];
          p[e] = min[e] + (max[e] - min[e]) * (m % pieces + i) / pieces;
          p[f] = min[f] + (max[f] - min[f]) * (m / pieces + j) / pieces;
          return p;
        };
        if (side == 1) {
          add_quad(c, at(0, 0), at(1, 0), at(1, 1), at(0, 1));
        } else {
          add_quad(c, at(0, 0), at(0, 1), at(1, 1), at(1, 0));
        }
      }
    }
  }
  return c;
}

/// A torus round z: bends both ways, closed.
inline Corners torus_mesh(double large, double small, int round, int across) {
  const auto at = [&](int i, int j) {
    const double a = 2 * std::numbers::pi * (i % round) / round;
    const double b = 2 * std::numbers::pi * (j % across) / across;
    const double r = large + small * std::cos(b);
    return sdk::Vec3{r * std::cos(a), r * std::sin(a), small * std::sin(b)};
  };
  Corners c;
  for (int i = 0; i < round; ++i) {
    for (int j = 0; j < across; ++j) {
      add_quad(c, at(i, j), at(i + 1, j), at(i + 1, j + 1), at(i, j + 1));
    }
  }
  return c;
}

/// A ring round z of flat faces: its section in r and z goes round anticlockwise, as r points to
/// the right and z up.
inline Corners ring_mesh(const std::vector<std::array<double, 2>>& section, int faces) {
  const auto at = [&](const std::array<double, 2>& p, int n) {
    const double a = 2 * std::numbers::pi * (n % faces) / faces;
    return sdk::Vec3{p[0] * std::cos(a), p[0] * std::sin(a), p[1]};
  };
  Corners c;
  for (int n = 0; n < faces; ++n) {
    for (std::size_t e = 0; e < section.size(); ++e) {
      const auto& p = section[e];
      const auto& q = section[(e + 1) % section.size()];
      add_quad(c, at(p, n), at(p, n + 1), at(q, n + 1), at(q, n));
    }
  }
  return c;
}

/// A solid whose section in x and z, clockwise and seen whole from its first point, goes along y.
inline Corners extruded_mesh(const std::vector<std::array<double, 2>>& section, double from,
                             double to) {
  const std::size_t count = section.size();
  const auto at = [&](std::size_t n, double y) {
    return sdk::Vec3{section[n % count][0], y, section[n % count][1]};
  };
  Corners c;
  for (std::size_t n = 0; n < count; ++n)
    add_quad(c, at(n, from), at(n + 1, from), at(n + 1, to), at(n, to));
  for (std::size_t n = 1; n + 1 < count; ++n) {
    c.insert(c.end(), {at(0, from), at(n + 1, from), at(n, from)});
    c.insert(c.end(), {at(0, to), at(n, to), at(n + 1, to)});
  }
  return c;
}

/// An L-shaped solid: floor of height 1 for x < 2, wall up to z = 2 for x < 0.
inline Corners corner_mesh() {
  return extruded_mesh({{{-1, 0}, {-1, 2}, {0, 2}, {0, 1}, {2, 1}, {2, 0}}}, -1, 1);
}

inline std::string write_binary_stl(const std::filesystem::path& file, const Corners& corners) {
  std::ofstream out(file, std::ios::binary);
  char header[80] = "solid only in name";
  out.write(header, sizeof header);
  const auto count = static_cast<std::uint32_t>(corners.size() / 3);
  out.write(reinterpret_cast<const char*>(&count), 4);
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    float value[12] = {};
    for (std::size_t k = 0; k < 3; ++k) {
      for (int d = 0; d < 3; ++d) {
        value[3 + 3 * k + static_cast<std::size_t>(d)] = static_cast<float>(corners[n + k][d]);
      }
    }
    out.write(reinterpret_cast<const char*>(value), sizeof value);
    out.write("\0\0", 2);
  }
  return file.string();
}

inline std::string write_text_stl(const std::filesystem::path& file, const Corners& corners) {
  std::ofstream out(file);
  out.precision(9);
  out << "solid part\n";
  for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
    out << "facet normal 0 0 0\n outer loop\n";
    for (std::size_t k = 0; k < 3; ++k) {
      const sdk::Vec3 p = corners[n + k];
      out << "  vertex " << p.x << ' ' << p.y << ' ' << p.z << '\n';
    }
    out << " endloop\nendfacet\n";
  }
  out << "endsolid part\n";
  return file.string();
}

}  // namespace dust::test
