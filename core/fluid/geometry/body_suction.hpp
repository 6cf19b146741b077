// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/table.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/pressure/continuity.hpp"
#include "fluid/step/time_mean.hpp"

#include <cstddef>
#include <cstdint>
#include <string>
#include <vector>

namespace dust::fluid {

/// An opening of a body that meets no fluid; which body, so that its place can be given.
class OpeningError : public sdk::ModelError {
 public:
  OpeningError(std::size_t body, const std::string& text) : sdk::ModelError(text), body_(body) {}
  [[nodiscard]] std::size_t body() const { return body_; }

 private:
  std::size_t body_;
};

/// Openings in the surfaces of bodies that suck a given volume flow: extraction hoods, nozzles.
/// Each cell at the opening gives off its share of the flow by the area of the surface in it, which
/// is what the open areas of its faces leave over; so the flow out of the fluid is the given one
/// whatever the grid. The surface's velocity there points into the body.
class BodySuction {
 public:
  explicit BodySuction(const bodies::BodySet& bodies);

  /// Finds the cells at the openings. Throws OpeningError for an opening that meets no fluid.
  void find_cells(const Grid& grid, const bodies::BodySet& bodies, const Geometry& geometry,
                  double time);
  /// Adds the velocity into the openings to that of the surface's points.
  void add_to(Geometry& geometry, const bodies::BodySet& bodies, double time) const;
  void set_sinks(std::vector<Continuity::Sink>& sinks, double time) const;
  /// The same with the mean flows over an interval of time.
  void set_mean_sinks(std::vector<Continuity::Sink>& sinks, Interval over) const;

 private:
  struct Opening {
    std::size_t body = 0;
    double flow = 0.0;  ///< [m3/s]
    sdk::Vec3 min;      ///< in the body's frame
    sdk::Vec3 max;
    sdk::Table over_time;
    std::vector<std::int32_t> cell;
    std::vector<double> share;  ///< of the flow, over the cell's volume [1/m3]
    double area = 0.0;          ///< [m2]
  };
  /// What the cells of an opening are found on.
  struct Scene {
    const Grid& grid;
    const Geometry& geometry;
    const FaceField& passable;
    const class BodyField& field;
    bodies::Placement at;
  };
  enum class Cells { open, passable };
  static void add_sinks(const Opening& opening, double flow, std::vector<Continuity::Sink>& sinks);
  void add_cells(Opening& opening, const Scene& scene, Cells which) const;
  [[nodiscard]] static bool holds(const Opening& opening, sdk::Vec3 p, double rounding);
  /// Share of the surface in the cell round `centre` that belongs to the opening. `facing`: where
  /// the surface that the cell's gas meets looks to; the other side of a thin body does not count.
  [[nodiscard]] double covered(const Opening& opening, const Grid& grid, sdk::Vec3 centre,
                               sdk::Vec3 facing, const class BodyField& field,
                               const bodies::Placement& at) const;

  std::vector<Opening> openings_;
  double rounding_ = 0.0;  ///< [m]
};

}  // namespace dust::fluid
