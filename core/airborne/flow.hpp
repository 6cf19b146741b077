// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"

#include <array>
#include <cstdint>
#include <vector>

namespace dust::airborne {

/// Gas that is drawn out of a cell.
struct Sink {
  std::int32_t cell = 0;
  double rate = 0.0;  ///< [1/s] of the cell's volume
  int outlet = 0;     ///< number of the hood
};

/// A piece of a surface in a cell, seen from the gas: the part that dust of a given drift meets.
struct WallPiece {
  std::int32_t cell = 0;
  std::int32_t surface = 0;  ///< number of the side or body
  sdk::Vec3 area;            ///< [1/m] out of the gas, over the volume of the whole cell
  std::int32_t face = -1;    ///< of the grid, in a side, which gas may pass; -1: of a body
  /// [1/m] In plan, of parts that look up and which parts that look down cancel in `area`.
  double cancelled = 0.0;
};

/// How the surface of a piece of wall runs. What stands has no velocity.
struct SurfaceMotion {
  sdk::Vec3 point;         ///< [m] of the surface, nearest to the middle of the cell
  sdk::Vec3 area;          ///< [m2] into the gas, whatever else the gas shares the cell with
  sdk::Vec3 velocity;      ///< [m/s] of the surface there
  bool displaces = false;  ///< the surface goes to other places; else it runs along itself
  /// Bit n: side n of the domain, along whose plane the surface passes out of this cell.
  std::uint8_t sides_passed = 0;
};

/// What dust is told of the gas in a fluid step. Shares are of whole cells and faces.
struct Flow {
  fluid::CellField volume_before;     ///< [-] filled by gas: open share times void fraction, at the
  fluid::CellField volume_after;      ///< beginning and at the end; 0 in bodies
  fluid::CellField void_fraction;     ///< [-] among grains, at the end; 1 where there are none
  fluid::FaceField throughflow;       ///< [m/s] volume flow of the gas over the area of the face
  fluid::FaceField passage;           ///< [-] share of the face that gas fills; on sides that are
                                      ///< walls 0
  fluid::CellField eddy_diffusivity;  ///< [m2/s] empty: laminar
  std::vector<Sink> sinks;
  std::vector<WallPiece> walls;
  std::int64_t walls_found = 0;                ///< how often they have been found anew
  std::vector<SurfaceMotion> surface_motions;  ///< by piece of wall; empty: all surfaces stand
  std::vector<double> friction_velocity;       ///< [m/s] by piece of wall; empty: nobody asks
  /// [m2/s] Kinematic, of the gas at smooth walls, to which turbulence brings dust; 0: none does.
  double smooth_wall_viscosity = 0.0;
  /// By face of a side (side, second direction, third direction): the hood that draws there, -1.
  std::array<std::vector<std::int32_t>, 6> side_outlet;

  explicit Flow(const fluid::Grid& grid)
      : volume_before(grid.size, 0.0),
        volume_after(grid.size, 0.0),
        void_fraction(grid.size, 1.0),
        throughflow(grid),
        passage(grid) {}
};

}  // namespace dust::airborne
