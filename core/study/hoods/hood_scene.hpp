// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"
#include "report/fluid_grid.hpp"
#include "report/run_text.hpp"

#include <array>
#include <cstddef>
#include <filesystem>
#include <vector>

namespace dust::study {

/// A place of low mean pressure that a sensor of a run has found.
struct LowPressurePlace {
  int number = 0;          ///< from 1 on, the deepest first
  sdk::Vec3 position;      ///< [m]
  double depth = 0.0;      ///< [Pa] below zero
  double dust_near = 0.0;  ///< [kg/m3] of dust, in the mean round it; of ranked_places
};

/// The places that a run's sensors of low pressure report, by the role of their figures; the
/// deepest first, of several sensors all of them.
[[nodiscard]] std::vector<LowPressurePlace> places_of(const report::RunText& run);

/// Whether grains of a run are dust.
[[nodiscard]] bool has_dust_grains(const report::RunText& run);
/// Whether grains or concentrations of a run are dust.
[[nodiscard]] bool has_dust(const report::RunText& run);

/// Dust at a place: a grain, or what a cell of a dust field holds.
struct DustPoint {
  sdk::Vec3 position;  ///< [m]
  double mass = 0.0;   ///< [kg]
};

/// A grain that is no dust.
struct CoarseGrain {
  sdk::Vec3 position;   ///< [m]
  double radius = 0.0;  ///< [m]
};

/// Where a hood can stand in a finished run: bodies and the stream as cells of the fluid's grid,
/// grains as they lie at the end, a dust field in the mean of the later frames.
class HoodScene {
 public:
  /// Cells with more solids in the mean of the later frames belong to the stream.
  static constexpr double k_largest_solids_fraction = 1e-3;

  /// Reads results.h5 of a run. Throws base::UserError where it holds no air.
  HoodScene(const std::filesystem::path& folder, const report::RunText& run);
  /// Of given cells, x fastest: whether a body or the stream is there.
  HoodScene(report::FluidGrid grid, std::vector<char> is_taken, std::vector<DustPoint> dust,
            std::vector<CoarseGrain> coarse);

  [[nodiscard]] const report::FluidGrid& grid() const { return grid_; }
  [[nodiscard]] sdk::Vec3 min() const;  ///< [m] of the domain
  [[nodiscard]] sdk::Vec3 max() const;  ///< [m]
  /// [m] From the periodic sides of each direction that bodies which do not reach beyond both have
  /// to keep: a diameter of the largest grain, which would miss their ends (periodic_check.hpp).
  /// 0: not periodic, or no grains.
  [[nodiscard]] sdk::Vec3 periodic_clearance() const { return periodic_clearance_; }
  void set_periodic_clearance(sdk::Vec3 clearance) { periodic_clearance_ = clearance; }
  /// Whether neither a body nor the stream reaches into the box, nor a coarse grain that lies there
  /// at the end. What reaches beyond the domain does not count.
  [[nodiscard]] bool is_clear(sdk::Vec3 low, sdk::Vec3 high) const;
  /// [kg] of dust in the box.
  [[nodiscard]] double dust_in(sdk::Vec3 low, sdk::Vec3 high) const;
  /// [m] middle of the cells that bodies and the stream take; that of the domain where there are
  /// none.
  [[nodiscard]] sdk::Vec3 middle_of_taken() const;

 private:
  report::FluidGrid grid_;
  std::vector<char> is_taken_;
  std::vector<DustPoint> dust_;
  std::vector<CoarseGrain> coarse_;
  sdk::Vec3 periodic_clearance_;
};

}  // namespace dust::study
