// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/grid.hpp"
#include "fluid/pressure/pressure_solver.hpp"

#include <string>
#include <vector>

namespace dust::fluid {

/// What goes in and out of the rooms whose pressure has no datum: parts of the domain that walls
/// and bodies part from every side that gives way. Nothing can make up there for flows that do not
/// cancel; docs/theory/fluid.md, section 4.
class RoomFlows {
 public:
  RoomFlows(const Grid& grid, const PressureSolver& solver);

  /// [m3/s] into a cell: through a side, and by a thin body that moves.
  void add_given(std::ptrdiff_t cell, double flow) { add(cell, flow, false); }
  void add_pushed(std::ptrdiff_t cell, double flow) { add(cell, flow, true); }
  /// [m3/s] out of a cell into a body.
  void add_sink(std::ptrdiff_t cell, double flow);
  /// [1/s] d(theta)/dt of all cells, by bodies that move.
  void add_moved(const CellField& rate);
  /// Throws sdk::ModelError for the first room that would gain or lose fluid.
  void check() const;

 private:
  struct Room {
    double net = 0.0;    ///< [m3/s] in less out
    double gross = 0.0;  ///< [m3/s] in plus out
    double moved = 0.0;  ///< [m3/s] the part of `gross` that bodies make which move
    bool has_sink = false;
  };
  void add(std::ptrdiff_t cell, double flow, bool is_moved);
  [[nodiscard]] std::string message(std::size_t room) const;
  [[nodiscard]] sdk::Vec3 place_in(std::size_t room) const;

  const Grid& grid_;
  const PressureSolver& solver_;
  std::vector<Room> rooms_;
  double moved_ = 0.0;      ///< [m3/s] by all bodies that move, in all rooms and outside them
  double in_closed_ = 0.0;  ///< [m3/s] given to cells that nothing passes to
};

}  // namespace dust::fluid
