// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/boundary_condition.hpp"
#include "fluid/geometry/geometry.hpp"
#include "fluid/grid.hpp"
#include "fluid/properties.hpp"
#include "fluid/step/time_mean.hpp"

#include <array>
#include <vector>

namespace dust::fluid {

/// The six sides of the domain: values from the boundary models and the filling of halos.
class Sides {
 public:
  /// Sides in the order of scenario::k_side_names; null where periodic. Throws
  /// sdk::ParameterError on combinations that cannot be solved.
  Sides(const Grid& grid, const std::array<const sdk::BoundaryCondition*, 6>& conditions);

  [[nodiscard]] const SideKinds& kinds() const { return kinds_; }
  /// What models that prescribe flows need to know: before the first evaluation, and again
  /// whenever bodies have cut the grid anew.
  void set_flow_data(const FaceField& open_area, const Properties& properties);
  /// Asks the models for their velocities and pressures at `time`; `eps` with filled halo.
  void evaluate_velocity(double time, const CellField& eps);
  void evaluate_pressure(double time);
  /// Velocities given normal to the sides; empty: as they are.
  struct Inflow {
    std::array<std::vector<double>, 6> velocity;
    std::array<bool, 3> passes_idle{};  ///< directions that are idle but for it

    [[nodiscard]] bool is_empty() const;
  };
  /// Their means over an interval of time, where they vary in it.
  [[nodiscard]] Inflow mean_inflow(Interval over, const CellField& eps);
  /// Takes `other` in place of the present ones, which it gives back.
  void swap_inflow(Inflow& other);
  /// Halo such that linear interpolation meets the side's rule: mirrored, copied or wrapped.
  void fill_velocity(FaceField& u) const;
  /// The same, but for the halos along idle directions.
  void fill_varying(FaceField& u) const;
  /// Halo for the implicit sweeps: the side's own velocity where it is given; wrapped copies.
  void fill_for_sweeps(FaceField& u) const;
  void wrap(std::vector<double>& component, int d) const;
  /// Copies of the edge cells, or wrapped.
  void fill_cells(CellField& values) const;
  /// Pressure halo such that (p[0] - p[-1]) / h is the gradient over half a cell where the
  /// pressure on the side is given.
  void fill_pressure(CellField& p, bool is_increment) const;
  [[nodiscard]] bool is_any_periodic() const;
  /// Is there one cell along the direction and does nothing vary along it? Then the halo there
  /// counts only for who reads the finished field.
  [[nodiscard]] bool is_idle(int direction) const { return is_idle_[direction]; }
  /// Is the velocity along an idle direction 0, now and at the last evaluation?
  [[nodiscard]] bool is_still(int direction) const {
    return is_idle_[direction] && !has_inflow_[direction] && !had_inflow_[direction];
  }
  /// Does the kinetic energy of entering fluid come from the pressure (total pressure)?
  [[nodiscard]] bool is_total_pressure(int side) const {
    return kinds_.rules[side].pressure == sdk::SideRule::pressure;
  }
  /// Does entering fluid bring no velocity along the side, though leaving fluid takes its own out?
  [[nodiscard]] bool enters_at_rest(int side) const {
    return is_total_pressure(side) &&
           kinds_.rules[side].tangential_velocity == sdk::SideRule::gradient;
  }

 private:
  /// Values on one side: velocity components at their own points, pressure at face centres.
  struct Values {
    const sdk::BoundaryCondition* condition = nullptr;
    std::array<std::vector<double>, 3> velocity;
    std::vector<double> pressure;
    /// Places per component (and of the pressure), as far as values are wanted there.
    std::array<std::array<std::vector<double>, 3>, 4> place;
    /// Where the model writes what is not wanted.
    std::array<std::vector<double>, 3> unused;
    bool needs_flow = false;
    std::vector<double> area;           ///< [m2] of the faces' open parts
    std::vector<double> density;        ///< [kg/m3]
    std::vector<double> void_fraction;  ///< in the edge cells
  };
  [[nodiscard]] std::array<int, 2> plane_size(int side, int component) const;
  void set_places(int side, int component);
  void evaluate_at(int side, int component, double time, const CellField* eps);
  void read_void_fraction(int side, int component, const CellField& eps);
  void fill_component(std::vector<double>& v, int d, int direction, bool for_sweeps) const;
  void fill_corners(FaceField& u, bool for_sweeps) const;
  void fill_corner(std::vector<double>& v, int side, int d, int high, bool for_sweeps) const;

  [[nodiscard]] bool find_idle(int direction) const;

  Grid grid_;
  SideKinds kinds_;
  std::array<Values, 6> values_;
  std::array<bool, 3> is_idle_{};
  std::array<bool, 3> has_inflow_{true, true, true};
  std::array<bool, 3> had_inflow_{true, true, true};
};

}  // namespace dust::fluid
