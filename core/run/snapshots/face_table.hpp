// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "fluid/fluid_solver.hpp"

#include <cstddef>
#include <vector>

namespace dust::run {

/// What passes the faces of the fluid's cells, in single precision without halo, for sensors that
/// want it.
class FaceTable {
 public:
  explicit FaceTable(const fluid::Grid& grid);

  /// Before a step there is the velocity alone: it may not obey continuity yet.
  enum class Moment { before_step, after_step };
  void publish(fluid::FluidSolver& solver, const fluid::CellField& void_fraction, Moment moment);
  [[nodiscard]] sdk::FaceColumns columns() const;

 private:
  /// Of the faces across one direction.
  struct Faces {
    std::vector<float> flux, open, void_fraction;
  };
  void publish_row(int d, int j, int k, const fluid::FaceField& open,
                   const fluid::CellField& void_fraction);

  fluid::Grid grid_;
  fluid::FaceField throughflow_;  ///< [m/s]
  Faces faces_[3];
};

}  // namespace dust::run
