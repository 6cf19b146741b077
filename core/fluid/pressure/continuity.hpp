// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "fluid/face_properties.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/momentum/momentum.hpp"
#include "fluid/pressure/pressure_solver.hpp"
#include "fluid/pressure/room_flows.hpp"
#include "fluid/sides.hpp"

#include <array>
#include <cstdint>
#include <memory>
#include <vector>

namespace dust::fluid {

/// Continuity on the cut grid and the projection that makes a velocity obey it:
///   d(theta eps)/dt + sum_f a eps u A / V + sinks = 0 ,   docs/theory/fluid.md, eq. (13),
/// theta the open share of the cell, a that of the face.
class Continuity {
 public:
  /// References are kept; `geometry` may be built anew, see geometry_changed.
  Continuity(const Grid& grid, const Geometry& geometry, const Sides& sides,
             const FaceProperties& properties, const Momentum& momentum);

  /// After the geometry was built anew. Cells that open take the mean pressure of their open
  /// neighbours.
  void geometry_changed(CellField& pressure);
  [[nodiscard]] bool is_open(std::ptrdiff_t cell) const { return solver_->is_open(cell); }
  /// Which cells are open, as numbers for a checkpoint; and back, before geometry_changed.
  [[nodiscard]] std::vector<std::int64_t> open_cells() const;
  void was_open(const std::vector<std::int64_t>& cells);

  /// [1/s] d(theta eps)/dt per cell, to be set before `project`.
  [[nodiscard]] CellField& rate() { return given_.rate; }
  /// [1/s] d(theta)/dt per cell: what bodies that move make of the open volume. Empty: none move.
  [[nodiscard]] CellField& moved() { return given_.moved; }
  /// Fluid that goes out of a cell into a body.
  struct Sink {
    std::int32_t cell = 0;
    double rate = 0.0;  ///< [1/s] of the cell's volume
    std::int32_t body = -1;
  };
  [[nodiscard]] std::vector<Sink>& sinks() { return given_.sinks; }

  /// Makes `v` obey continuity over `step` by the pressure increment; returns the solver's
  /// iterations. Throws sdk::ModelError where a closed room would have to change its volume.
  /// `is_plain`: no drag and no solids; the equation is then the last one if that was plain, too.
  int project(FaceField& v, const CellField& eps, double step, const FaceField& drag, bool is_plain,
              double tolerance);
  /// [Pa] of the last projection; docs/theory/fluid.md, eq. (6).
  [[nodiscard]] const CellField& increment() const { return increment_; }
  /// Faces that fluid may pass and whose flux the pressure can change.
  [[nodiscard]] const FaceField& pattern() const { return pattern_; }
  /// Coefficients of the last projection: positive where the increment drives a flow.
  [[nodiscard]] const FaceField& coefficients() const { return solver_->coefficients(); }
  [[nodiscard]] const std::vector<Sink>& sinks() const { return given_.sinks; }
  /// [m/s] What passes the faces over their whole area, a eps u, as the equation counts it; the
  /// shift at cut faces is that of the last projection. Faces 0 to count of each row.
  void find_throughflow(const FaceField& v, const CellField& eps, FaceField& throughflow) const;
  /// Largest |d(theta eps)/dt + div(eps u)| [1/s] over the open cells.
  [[nodiscard]] double largest_divergence(const FaceField& v, const CellField& eps);

 private:
  /// What the flow has to make up for.
  struct VolumeChanges {
    CellField rate;           ///< [1/s] d(theta eps)/dt
    std::vector<Sink> sinks;  ///< into bodies
    CellField moved;          ///< [1/s] d(theta)/dt, by bodies that move
  };
  [[nodiscard]] FaceField find_pattern() const;
  void find_open_parts(const FaceField& v);
  void find_divergence(const FaceField& v, const CellField& eps);
  void prepare(const CellField& eps, double step, const FaceField& drag);
  void check_balance(const FaceField& v, const CellField& eps) const;
  void add_side_flows(const FaceField& v, const CellField& eps, RoomFlows& flows) const;
  void add_sheet_flows(const FaceField& v, RoomFlows& flows) const;
  void scale_side(std::vector<double>& v, int d, int high, double factor) const;

  const Grid& grid_;
  const Geometry& geometry_;
  const Sides& sides_;
  const FaceProperties& properties_;
  const Momentum& momentum_;
  FaceField pattern_;  ///< faces that fluid may pass and whose flux the pressure can change
  std::unique_ptr<PressureSolver> solver_;
  bool is_plain_ = false;       ///< as the equation is prepared
  std::vector<char> was_open_;  ///< only for geometries that change
  VolumeChanges given_;
  CellField residual_;
  CellField increment_;
  std::array<std::vector<double>, 3> open_part_shift_;
  std::vector<double> partial_;
};

/// Copies face 0 of direction d to the last face of the row.
void wrap_last_face(const Grid& grid, int d, std::vector<double>& values);

}  // namespace dust::fluid
