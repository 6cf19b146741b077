// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/drag_law.hpp"
#include "dust/sdk/voidage_rule.hpp"
#include "fluid/grid.hpp"
#include "particles/grain_rows.hpp"
#include "scenario/setup.hpp"

#include <cstdint>
#include <memory>
#include <vector>

namespace dust::coupling {

/// Limiters and checks, counted since the start; none of them is silent.
struct CouplingReport {
  std::int64_t moved_shares = 0;      ///< shares of grain volume given to a neighbour (body, side, full cell)
  double smallest_void_fraction = 1;  ///< after mapping, since the start
  double largest_imbalance = 0.0;     ///< |impulse on grains + impulse on fluid| / scale, per exchange
  double largest_diameter_over_spacing = 0.0;
};

/// Momentum exchange between grains and fluid. During a fluid step:
///   map()      void fraction of the grains where they are, implicit coefficients for the fluid
///   (the fluid solver advances with exchange())
///   refresh()  several times during the DEM cycle: target velocity and rate of each grain from the
///              fluid at its place; grains integrate drag exactly in between
///   collect()  what the grains really received; the difference to what the fluid was given is
///              handed to the next fluid step, so that the sum over time is exact.
class Coupling {
 public:
  /// `open_fraction`: share of each cell outside all bodies (FluidSolver::open_fraction).
  Coupling(const scenario::Setup& setup, const fluid::Grid& grid,
           const fluid::CellField& open_fraction, const sdk::VoidageRule& voidage,
           const sdk::DragLaw& drag);
  ~Coupling();
  Coupling(const Coupling&) = delete;
  Coupling& operator=(const Coupling&) = delete;

  void map(const particles::GrainRows& grains, double fluid_step);
  [[nodiscard]] const fluid::CellField& void_fraction_before() const;
  [[nodiscard]] const fluid::CellField& void_fraction() const;
  [[nodiscard]] const fluid::Exchange& exchange() const;

  /// `velocity` and `stress_divergence` as FluidSolver gives them.
  void refresh(const particles::GrainRows& grains, const fluid::FaceField& velocity,
               const fluid::FaceField& stress_divergence);
  /// Interval [s] after which refresh() is due again; fluid_step divided by a whole number.
  [[nodiscard]] double refresh_interval() const;
  void collect(const particles::GrainRows& grains, double fluid_step);

  /// Momentum exchange with the grains per cell [N/m3], 3 per interior cell (x fastest), for output.
  void momentum_exchange(std::vector<float>& per_cell) const;
  [[nodiscard]] const CouplingReport& report() const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dust::coupling
