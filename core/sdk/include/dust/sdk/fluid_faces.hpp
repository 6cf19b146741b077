// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"

#include <algorithm>
#include <cstddef>
#include <span>

namespace dust::sdk {

/// The faces across one direction of FluidColumns::faces, by place. Between two planes of faces the
/// flux is linear: so it is exact at faces, and what passes a duct is the same in each of its
/// sections.
class FluidFaces {
 public:
  FluidFaces(const FluidColumns& fluid, int d)
      : f_(fluid),
        d_(d),
        flux_(of(d, fluid.faces.flux_x, fluid.faces.flux_y, fluid.faces.flux_z)),
        open_(of(d, fluid.faces.open_x, fluid.faces.open_y, fluid.faces.open_z)),
        void_fraction_(of(d, fluid.faces.void_fraction_x, fluid.faces.void_fraction_y,
                          fluid.faces.void_fraction_z)) {}

  [[nodiscard]] bool is_empty() const { return flux_.empty(); }
  /// Faces along e.
  [[nodiscard]] int count(int e) const { return f_.count[e] + (e == d_ ? 1 : 0); }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(count(0)) *
               (static_cast<std::size_t>(j) +
                static_cast<std::size_t>(count(1)) * static_cast<std::size_t>(k));
  }
  /// [m/s] Volume over the area of the whole face.
  [[nodiscard]] double flux(std::size_t face) const { return flux_[face]; }
  /// [-] Share of the face that fluid passes.
  [[nodiscard]] double open(std::size_t face) const { return open_[face]; }
  [[nodiscard]] double void_fraction(std::size_t face) const { return void_fraction_[face]; }

  /// Two planes of faces round a place, and the share of the upper one; outside the grid its sides.
  struct Planes {
    int low = 0;
    int high = 0;
    double part = 0.0;
  };
  [[nodiscard]] Planes planes(double x) const {
    const double s = (x - f_.origin[d_]) / f_.spacing[d_];
    const double inside = std::clamp(s, 0.0, static_cast<double>(f_.count[d_]));
    const int low = std::min(static_cast<int>(inside), f_.count[d_] - 1);
    return {low, low + 1, inside - low};
  }

 private:
  using Column = std::span<const float>;
  static Column of(int d, Column x, Column y, Column z) { return d == 0 ? x : d == 1 ? y : z; }

  const FluidColumns& f_;
  int d_;
  Column flux_, open_, void_fraction_;
};

}  // namespace dust::sdk
