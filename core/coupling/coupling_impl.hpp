// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "coupling/coupling.hpp"
#include "coupling/face_exchange.hpp"
#include "coupling/face_void.hpp"
#include "coupling/foresight.hpp"
#include "coupling/grain_memory.hpp"
#include "coupling/graining.hpp"
#include "coupling/lattice.hpp"
#include "coupling/own_disturbance.hpp"
#include "coupling/smooth_kernel.hpp"
#include "coupling/stress_book.hpp"
#include "coupling/void_fraction.hpp"
#include "coupling/wide_kernel.hpp"
#include "fluid/properties.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <cmath>
#include <memory>
#include <numbers>
#include <span>
#include <sstream>
#include <string>
#include <vector>

namespace dust::coupling {

/// Grains per call of the law and per task.
inline constexpr std::size_t k_batch = ForceTerms::k_batch;
static_assert(k_batch == SpotBatch::k_size);
/// Rounding allowed in D / dx at the rule's limit (cells of exactly two diameters).
inline constexpr double k_ratio_rounding = 1e-9;

/// Columns of a batch of grains.
struct Batch {
  std::array<double, k_batch> reynolds, void_fraction, factor, size_ratio;
};

/// The parts written one after another, numbers to six digits.
template <class... Part>
std::string text(const Part&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

/// State of the coupling. map.cpp: void fraction and implicit coefficients; own_flow.cpp: what a
/// grain does to the fluid by itself; refresh.cpp: the action on the grains, and what they
/// received.
struct Coupling::Impl {
  Impl(const scenario::Setup& setup, const scenario::FluidSpec& fluid, const fluid::Grid& grid,
       const fluid::CellField& open_fraction, const sdk::VoidageRule& rule, const sdk::DragLaw& law)
      : lattice(grid, open_fraction),
        drag(law),
        voidage(rule),
        void_fraction(lattice, rule),
        face_void(lattice),
        own_flow_is(fluid.is_one_way ? scenario::OwnDisturbance::felt : fluid.own_disturbance),
        faces(lattice, face_void, rule, fluid.momentum_set == "III"),
        properties(fluid),
        own_per_kinematic_viscosity(properties.own().density / properties.own().viscosity),
        graining(setup.materials),
        gravity(setup.gravity),
        is_set_three(fluid.momentum_set == "III"),
        initial_velocity{fluid.initial_velocity.x, fluid.initial_velocity.y,
                         fluid.initial_velocity.z},
        is_one_way(fluid.is_one_way),
        is_overlapped(fluid.overlaps_grains),
        needs_size_ratio(law.needs_size_ratio()),
        step(setup.time.fluid_step) {
    least_spacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    mean_spacing = std::cbrt(lattice.cell_volume());
    refreshes = refreshes_for(step, 0.0);
    // Where the air overlaps, the stress that grains see is a step older than that of the air: as a
    // debt it would rock a dense bed.
    if (!is_one_way && !is_set_three && !is_overlapped && properties.is_uniform()) {
      stress_book = std::make_unique<StressBook>(lattice, rule);
    }
  }

  /// `fastest`: largest rate of relaxation of a grain [1/s].
  [[nodiscard]] double refreshes_for(double fluid_step, double fastest) const {
    constexpr double k_steps_per_relaxation = 4.0;
    constexpr double k_crossing_speed = 2.0;  // [m/s]
    constexpr double k_refreshes_per_cell = 8.0;
    constexpr double k_most_refreshes = 64.0;
    const double relaxing = k_steps_per_relaxation * fluid_step * fastest;
    const double crossing = k_refreshes_per_cell * k_crossing_speed * fluid_step / least_spacing;
    // The allowance keeps rounding of a whole number from costing one more refresh.
    constexpr double k_allowance = 1e-9;
    const double wanted = std::ceil(std::max(relaxing, crossing) * (1.0 - k_allowance));
    return std::clamp(wanted, 1.0, k_most_refreshes);
  }

  using Rows = std::span<const std::int32_t>;
  /// Runs `work(batch, rows)` over the batches of grains in the order of the cells.
  template <class Work>
  void for_batches(const Work& work) {
    tbb::parallel_for(std::size_t{0}, spots.batches.size(),
                      [&](std::size_t b) { work(b, spots.rows(b)); });
  }
  /// Orders the grains by the cells they are in.
  void sort(const particles::GrainRows& grains);
  /// The rows may be in another order than at map().
  void sort_if_changed(const particles::GrainRows& grains);
  /// Makes the spots of a batch those of its grains, flown on for `ahead` [s]; returns whether they
  /// were others.
  bool locate(const particles::GrainRows& grains, Rows rows, SpotBatch& batch,
              double ahead = 0.0) const;

  /// F of the rows first..last; the batch's Reynolds numbers and void fractions are set.
  void evaluate(Batch& batch, std::size_t count) const {
    drag.evaluate({count, batch.reynolds.data(), batch.void_fraction.data(), batch.factor.data(),
                   needs_size_ratio ? batch.size_ratio.data() : nullptr});
  }
  using Fluid = fluid::Properties::Values;
  [[nodiscard]] Fluid fluid_at(const double* position) const {
    if (properties.is_uniform()) return properties.own();
    return properties.at({position[0], position[1], position[2]});
  }
  /// Density over viscosity [s/m2] at a place.
  [[nodiscard]] double per_kinematic_viscosity(const double* position) const {
    if (properties.is_uniform()) return own_per_kinematic_viscosity;
    const Fluid fluid = fluid_at(position);
    return fluid.density / fluid.viscosity;
  }
  /// Reynolds number of the grains that a row stands for.
  [[nodiscard]] double reynolds(const particles::GrainRows& grains, std::size_t row, double eps,
                                double slip) const {
    const double* position = grains.position + 4 * row;
    return eps * slip * 2.0 * position[3] * per_kinematic_viscosity(position) /
           graining.of(grains, row);
  }
  /// K = 3 pi mu D F [kg/s]: of l^3 grains of diameter D / l, l^2 times as much.
  [[nodiscard]] double coefficient(const particles::GrainRows& grains, std::size_t row,
                                   double factor) const {
    const double* position = grains.position + 4 * row;
    const double l = graining.of(grains, row);
    return 3.0 * std::numbers::pi * fluid_at(position).viscosity * 2.0 * position[3] * factor *
           (l * l);
  }
  /// What the drag on a grain is made of K by: set III puts the pressure's part into it.
  [[nodiscard]] double share_of_set(double eps) const { return is_set_three ? 1.0 / eps : 1.0; }

  /// Drag and force by the stress of the own drag, over the drag.
  [[nodiscard]] double stress_part(std::size_t row) const {
    return memory.is_smooth(row) ? 1.0 + memory.own_flow(row).self_stress : 1.0;
  }

  void map(const particles::GrainRows& grains, double fluid_step);
  void find_slips(const particles::GrainRows& grains, std::size_t batch, Rows rows, Batch& columns);
  void find_steepness(Batch& columns, std::size_t count, double* steepness) const;
  /// `coefficient` [kg/s] and `steepness` [-] per grain: GivenDrag.
  void remember(const particles::GrainRows& grains, std::size_t batch, Rows rows,
                double* coefficient, double* steepness);
  /// Void fraction that a grain in the cell `own` has around it; sets `wide` for a grain larger
  /// than a cell.
  [[nodiscard]] double void_fraction_at(const double* position, std::ptrdiff_t own,
                                        WideKernel& wide) const {
    const fluid::CellField& eps = void_fraction.after();
    if (!wide.takes(position[3])) return eps[lattice.host_cell(own, position)];
    wide.set(position, position[3]);
    return wide.mean(eps);
  }
  /// What the faces around a batch of grains show.
  struct Seen {
    std::array<SpotBatch::Reals, 3> slip;    ///< [m/s] interstitial
    std::array<SpotBatch::Reals, 3> ratio;   ///< of the drag on the grain to the law's
    std::array<SpotBatch::Reals, 3> stress;  ///< [N/m3]
  };
  void look(const particles::GrainRows& grains, SpotBatch& spot, Rows rows, const FluidState& fluid,
            Seen& seen, Batch& batch);
  void look_ahead(const particles::GrainRows& grains, Rows rows, double held, const Seen& seen,
                  Batch& batch, Foresight& ahead);
  void begin_action(const particles::GrainRows& grains, Rows rows, const Seen& seen, Batch& batch);
  bool look_into_cells(const SpotBatch& spot, Rows rows, const FluidState& fluid, Seen& seen,
                       Batch& batch);
  void look_wide(const SpotBatch& spot, int d, const FluidState& fluid, const double* v,
                 const FaceSumColumns& sums, double* flux, double* stress) const;
  /// Share of the slip from which on what a grain makes by itself is taken off [-].
  [[nodiscard]] double worth() const {
    return own_flow_is == scenario::OwnDisturbance::taken_off ? 0.0 : own_disturbance::k_worth;
  }
  [[nodiscard]] bool has_candidates(const particles::GrainRows& grains) const;
  [[nodiscard]] bool is_candidate(const particles::GrainRows& grains, std::size_t row) const;
  [[nodiscard]] double own_part(const particles::GrainRows& grains, std::size_t row, double eps,
                                double slip) const;
  bool take_own_off(const particles::GrainRows& grains, std::size_t row, double slip,
                    SmoothKernel& kernel, double& eps);
  [[nodiscard]] static double void_of_others(const OwnFlow& own, const Triple& of_faces);
  [[nodiscard]] double own_weight(const particles::GrainRows& grains, std::size_t row) const;
  [[nodiscard]] double crowding(const particles::GrainRows& grains, std::size_t row) const;
  void spread_smoothly(const particles::GrainRows& grains);
  void find_own_solids(const particles::GrainRows& grains, std::size_t row,
                       const SmoothKernel& kernel);
  void find_own_flow(const particles::GrainRows& grains, std::size_t row,
                     const SmoothKernel& kernel, double eps, double slip);
  void advance_own_flow();
  void look_smooth(const SpotBatch& spot, Rows rows, const FluidState& fluid,
                   const std::array<SpotBatch::Reals, 3>& v, Seen& seen, Batch& batch);
  void look_at_kernel(const double* position, const SmoothKernel& kernel, const FluidState& fluid,
                      OwnFlow::Seen& seen) const;
  [[nodiscard]] double beside_sides(const double* position, int d, double k) const;
  void map_solids(const particles::GrainRows& grains);
  void start(const particles::GrainRows& grains);
  void settle(const fluid::FaceField& velocity);
  void refresh(const particles::GrainRows& grains, std::size_t batch, Rows rows,
               const FluidState& fluid);
  void act(const particles::GrainRows& grains, std::size_t row, std::size_t n,
           double drag_coefficient, const Triple& relative, double held,
           const ForceTerms::Sums& sums);
  /// Part of the weight that the DEM's gravity is.
  [[nodiscard]] double weight_share(double inverse_mass, double volume) const {
    return forces ? forces->weight_share(1.0 / inverse_mass, volume)
                  : 1.0 - properties.own().density * volume * inverse_mass;
  }
  [[nodiscard]] double held(const FluidState& fluid) const {
    return fluid.held > 0.0 ? fluid.held : step / refreshes;
  }
  void collect(const particles::GrainRows& grains, double fluid_step);
  void find_size_ratios(const particles::GrainRows& grains);

  Lattice lattice;
  const sdk::DragLaw& drag;
  const sdk::VoidageRule& voidage;
  VoidFraction void_fraction;
  FaceVoid face_void;
  GrainMemory memory;
  Spots spots;
  std::atomic<bool> are_spots_of_map{false};  ///< not those of a later refresh()
  Spots mapped_spots;                         ///< those of map(), where it is overlapped
  scenario::OwnDisturbance own_flow_is;       ///< what a grain does to the fluid by itself
  /// What the sides of the domain are to a grain's own flow, where not periodic.
  std::array<own_disturbance::Side, 6> sides{
      own_disturbance::Side::wall, own_disturbance::Side::wall, own_disturbance::Side::wall,
      own_disturbance::Side::wall, own_disturbance::Side::wall, own_disturbance::Side::wall};
  FaceExchange faces;
  std::unique_ptr<ForceTerms> forces;       ///< null without forces besides drag
  std::unique_ptr<StressBook> stress_book;  ///< null where grains and fluid do not see one stress
  CouplingReport report;
  fluid::Properties properties;
  double own_per_kinematic_viscosity;  ///< [s/m2] of the uniform fluid
  Graining graining;
  sdk::Vec3 gravity;
  bool is_set_three;
  Triple initial_velocity;
  bool is_one_way;
  bool is_overlapped;  ///< the grains move while the fluid that they were mapped for is solved
  bool needs_size_ratio;
  std::vector<Triple> stress_received;  ///< [N s] per row, weight included, between two steps
  std::vector<std::array<double, 2>> size_sums;  ///< per cell W D^3 and W D^2, if needed
  double step;
  double least_spacing = 0.0;
  double mean_spacing = 0.0;        ///< [m] edge of the cube of a cell's volume
  double refreshes = 1.0;           ///< per fluid step
  std::int64_t done_refreshes = 0;  ///< since map()
  double last_held = 0.0;           ///< [s] from the last refresh to the one in hand, 0 = none yet
  bool is_settled = true;           ///< Remembered::given belongs to the last map()
};

}  // namespace dust::coupling
