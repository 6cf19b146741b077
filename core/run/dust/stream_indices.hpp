// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sampling.hpp"
#include "dust/sdk/sensor.hpp"
#include "particles/dem.hpp"
#include "run/archive_parts.hpp"
#include "run/dust/dust_stage.hpp"
#include "run/dust/liberation_stage.hpp"
#include "run/dust/steady_window.hpp"
#include "run/fluid_stage.hpp"
#include "setup/setup.hpp"

#include <cstddef>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// The indices by which practice ranks transfer points, in the steady stream: energy of impacts,
/// air that the stream carries down, looseness of the stream; docs/theory/dust.md, eq. (22).
///
/// Levels are layers of cells across the direction of gravity. Of a level of height \f$ h \f$, over
/// its grains that go down: \f$ F = \sum w m v/h \f$ [kg/s], their solids fraction weighted by
/// \f$ F \f$, and the gas that goes down in cells that hold grains, \f$ Q = \sum A\, \theta
/// \varepsilon u \f$ [m3/s]. The stream passes where the mean of \f$ F \f$ is at least half of what
/// is fed.
class StreamIndices {
 public:
  /// All are kept by reference; `liberation` may be null: impacts are then not counted.
  /// `steady_after` in s.
  StreamIndices(const scenario::Setup& setup, const FluidStage& fluid, const DustStage& dust,
                const LiberationStage* liberation, particles::Dem& particles, double steady_after);

  /// Means begin anew, at `time` [s].
  void begin_at(double time);
  /// At the end of a fluid step of `step` [s], at `time` [s].
  void sample(double time, double step);

  /// "observed" [s]. Of what is known: "impact/all/power" [W] and of each cause, with material that
  /// is fed also "impact/all/per_load" [J/kg]; where the stream passes a level "entrained_air/flow"
  /// [m3/s], "entrained_air/per_load" [m3/t], "entrained_air/height" [m] of the level that carries
  /// most; "looseness/void_fraction" [1] and "looseness/height" of the loosest level,
  /// "looseness/densest_void_fraction", and "looseness/expansion" [1] of the loosest over the
  /// densest.
  void report(sdk::FigureSink& sink) const;
  /// [kg/s] fed in the steady stream; 0 where nothing is.
  [[nodiscard]] double load() const { return means_.mean(k_load); }

  void add_parts(SaveParts& parts) const;
  void add_parts(LoadParts& parts);

 private:
  static constexpr std::size_t k_load = 0, k_power = 1;
  /// Columns of a level.
  enum Column : std::size_t { mass_flow, solids_flow, air_flow };
  static constexpr std::size_t k_columns = 3;

  [[nodiscard]] std::size_t column(std::size_t level, Column which) const {
    return first_level_ + k_columns * level + which;
  }
  void find_grains();
  void find_air();
  [[nodiscard]] double height(std::size_t level) const;
  [[nodiscard]] double void_fraction(std::size_t level) const;
  [[nodiscard]] double power() const;
  [[nodiscard]] double error_of_power(double by_power, double by_load, double value) const;
  void report_impacts(sdk::FigureSink& sink) const;
  void report_levels(sdk::FigureSink& sink) const;

  const FluidStage& fluid_;
  const DustStage& dust_;
  const LiberationStage* liberation_;
  particles::Dem& particles_;  ///< looked at only
  SteadyWindow steady_;
  int axis_ = 2;               ///< nearest to gravity
  double down_ = -1.0;         ///< sign of gravity along it
  std::size_t levels_ = 0;     ///< none without gravity
  std::size_t first_level_;    ///< column
  std::optional<double> fed_;  ///< [kg] up to the step before; nothing: not known
  std::vector<double> now_;
  sdk::BatchMeans means_;
};

}  // namespace dust::run
