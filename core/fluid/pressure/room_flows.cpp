// SPDX-License-Identifier: Apache-2.0
#include "fluid/pressure/room_flows.hpp"

#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dust::fluid {
namespace {

/// Net given inflow over the sum of the given flows that counts as zero in a closed room.
constexpr double k_flux_balance = 1e-6;
/// The same with bodies that move, whose shares of cells are measured to about a per cent: of what
/// they move in the whole domain, since pockets of some cells between them come and go.
constexpr double k_moving_balance = 0.1;

/// Calls body(cell, i, j, k) for all cells.
template <class Body>
void each_cell(const Grid& grid, const Body& body) {
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      for (int i = 0; i < grid.count[0]; ++i) body(grid.index(i, j, k), i, j, k);
    }
  }
}

}  // namespace

RoomFlows::RoomFlows(const Grid& grid, const PressureSolver& solver)
    : grid_(grid), solver_(solver), rooms_(solver.rooms()) {}

void RoomFlows::add(std::ptrdiff_t cell, double flow, bool is_moved) {
  if (is_moved) moved_ += std::abs(flow);
  const std::int32_t room = solver_.room(cell);
  if (!is_moved && !solver_.is_open(cell)) in_closed_ += std::abs(flow);
  if (room < 0) return;
  Room& r = rooms_[static_cast<std::size_t>(room)];
  r.net += flow;
  r.gross += std::abs(flow);
  if (is_moved) r.moved += std::abs(flow);
}

void RoomFlows::add_sink(std::ptrdiff_t cell, double flow) {
  add(cell, -flow, false);
  const std::int32_t room = solver_.room(cell);
  if (room >= 0 && flow != 0.0) rooms_[static_cast<std::size_t>(room)].has_sink = true;
}

void RoomFlows::add_moved(const CellField& rate) {
  each_cell(grid_, [&](std::ptrdiff_t o, int, int, int) {
    if (rate[o] != 0.0) add(o, -rate[o] * grid_.cell_volume(), true);
  });
}

void RoomFlows::check() const {
  for (std::size_t n = 0; n < rooms_.size(); ++n) {
    const Room& r = rooms_[n];
    // What surfaces that only slide seem to move by rounding is less than the first limit.
    const double limit = r.moved > k_flux_balance * moved_ ? k_moving_balance : k_flux_balance;
    const double allowed = limit * std::max(r.gross, moved_) + in_closed_;
    if (!(std::abs(r.net) <= allowed)) throw sdk::ModelError(message(n));
  }
}

std::string RoomFlows::message(std::size_t room) const {
  const Room& r = rooms_[room];
  bool is_whole = true;
  each_cell(grid_, [&](std::ptrdiff_t o, int, int, int) {
    is_whole = is_whole && (!solver_.is_open(o) || solver_.room(o) == static_cast<int>(room));
  });
  char text[400];
  if (is_whole) {
    std::snprintf(text, sizeof text,
                  "the sides%s let %.4g m3/s more air in than out and none of them gives way; make "
                  "one a total_pressure, static_pressure or zero_gradient side",
                  r.moved > 0.0 || r.has_sink ? " and bodies" : "", r.net);
    return text;
  }
  const sdk::Vec3 p = place_in(room);
  std::snprintf(text, sizeof text,
                "the closed room round [%.4g, %.4g, %.4g] m would %s %.4g m3/s: its given flows, "
                "suctions and bodies that move do not cancel, and walls and bodies part it from "
                "every side that gives way; leave it an opening to such a side, at least a cell "
                "wide, or make its flows cancel",
                p.x, p.y, p.z, r.net > 0.0 ? "gain" : "lose", std::abs(r.net));
  return text;
}

/// The centre of the room's cell that is nearest to the middle of all of them.
sdk::Vec3 RoomFlows::place_in(std::size_t room) const {
  sdk::Vec3 middle;
  double cells = 0.0;
  const auto each_in_room = [&](const auto& body) {
    each_cell(grid_, [&](std::ptrdiff_t o, int i, int j, int k) {
      if (solver_.room(o) == static_cast<int>(room)) body(grid_.centre(i, j, k));
    });
  };
  each_in_room([&](sdk::Vec3 p) {
    middle = middle + p;
    cells += 1.0;
  });
  middle = middle / cells;
  sdk::Vec3 nearest;
  double distance = -1.0;
  each_in_room([&](sdk::Vec3 p) {
    const double d = norm(p - middle);
    if (distance >= 0.0 && d >= distance) return;
    distance = d;
    nearest = p;
  });
  return nearest;
}

}  // namespace dust::fluid
