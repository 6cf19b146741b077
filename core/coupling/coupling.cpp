// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling.hpp"

#include "base/error.hpp"
#include "coupling/face_exchange.hpp"
#include "coupling/grain_memory.hpp"
#include "coupling/lattice.hpp"
#include "coupling/own_disturbance.hpp"
#include "coupling/void_fraction.hpp"
#include "coupling/wide_kernel.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/sphere.hpp"
#include "fluid/properties.hpp"

#include <tbb/parallel_for.h>

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <numbers>
#include <sstream>
#include <stdexcept>
#include <string>

namespace dust::coupling {
namespace {

constexpr std::size_t k_batch = ForceTerms::k_batch;  ///< grains per call of the law and per task
constexpr double k_steps_per_relaxation = 4.0;
constexpr double k_crossing_speed = 2.0;  ///< [m/s]
constexpr double k_refreshes_per_cell = 8.0;
constexpr double k_most_refreshes = 64.0;
/// Rounding allowed in D / dx at the rule's limit (cells of exactly two diameters).
constexpr double k_ratio_rounding = 1e-9;
/// Least part of the true drag coefficient given to the fluid. The mean drag of a free grain falls
/// short of it when the grain follows the fluid within the step; a grain held by its neighbours
/// feels it in full, and what the fluid was not given comes one step late. That is stable only if
/// the late part is the smaller one: the share must exceed 1/2.
constexpr double k_least_implicit = 0.6;

/// Columns of a batch of grains.
struct Batch {
  std::array<double, k_batch> reynolds, void_fraction, factor, size_ratio;
};

double relaxation_time(double mass, double viscosity, double diameter) {
  return mass / (3.0 * std::numbers::pi * viscosity * diameter);
}

/// The parts written one after another, numbers to six digits.
template <class... Part>
std::string text(const Part&... parts) {
  std::ostringstream stream;
  (stream << ... << parts);
  return stream.str();
}

}  // namespace

struct Coupling::Impl {
  Impl(const scenario::FluidSpec& fluid, const scenario::TimeSpec& time, sdk::Vec3 gravity_vector,
       const fluid::Grid& grid, const fluid::CellField& open_fraction, const sdk::VoidageRule& rule,
       const sdk::DragLaw& law)
      : lattice(grid, open_fraction),
        drag(law),
        voidage(rule),
        void_fraction(lattice, rule),
        faces(lattice, rule, fluid.momentum_set == "III"),
        is_own_taken_off(fluid.corrects_own_disturbance && !fluid.is_one_way),
        properties(fluid),
        gravity(gravity_vector),
        is_set_three(fluid.momentum_set == "III"),
        initial_velocity{fluid.initial_velocity.x, fluid.initial_velocity.y,
                         fluid.initial_velocity.z},
        is_one_way(fluid.is_one_way),
        needs_size_ratio(law.needs_size_ratio()),
        step(time.fluid_step) {
    least_spacing = std::min({grid.spacing.x, grid.spacing.y, grid.spacing.z});
    refreshes = refreshes_for(step, std::numeric_limits<double>::infinity());
  }

  [[nodiscard]] double refreshes_for(double fluid_step, double shortest_relaxation) const {
    const double relaxing = k_steps_per_relaxation * fluid_step / shortest_relaxation;
    const double crossing = k_refreshes_per_cell * k_crossing_speed * fluid_step / least_spacing;
    // The allowance keeps rounding of a whole number from costing one more refresh.
    constexpr double k_allowance = 1e-9;
    const double wanted = std::ceil(std::max(relaxing, crossing) * (1.0 - k_allowance));
    return std::clamp(wanted, 1.0, k_most_refreshes);
  }

  /// Runs `work(first, last)` over fixed batches of rows.
  template <class Work>
  static void for_batches(std::size_t count, const Work& work) {
    const std::size_t batches = (count + k_batch - 1) / k_batch;
    tbb::parallel_for(std::size_t{0}, batches, [&](std::size_t b) {
      work(b * k_batch, std::min(count, (b + 1) * k_batch));
    });
  }

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
  static double reynolds(const Fluid& fluid, double eps, double slip, double diameter) {
    return eps * fluid.density * slip * diameter / fluid.viscosity;
  }
  /// K = 3 pi mu D F [kg/s].
  static double coefficient(const Fluid& fluid, double diameter, double factor) {
    return 3.0 * std::numbers::pi * fluid.viscosity * diameter * factor;
  }
  /// What the drag on a grain is made of K by: set III puts the pressure's part into it.
  [[nodiscard]] double share_of_set(double eps) const { return is_set_three ? 1.0 / eps : 1.0; }

  void map(const particles::GrainRows& grains, double fluid_step);
  void remember(const particles::GrainRows& grains, std::size_t first, std::size_t last);
  /// Void fraction that a grain has around it; sets `wide` for a grain larger than a cell.
  [[nodiscard]] double void_fraction_at(const double* position, WideKernel& wide) const;
  void find_own_solids(const particles::GrainRows& grains, std::size_t first, std::size_t last);
  void find_own_flow(const particles::GrainRows& grains, std::size_t row, double eps, double slip);
  void settle(const particles::GrainRows& grains, const fluid::FaceField& velocity);
  void refresh(const particles::GrainRows& grains, std::size_t first, std::size_t last,
               const FluidState& fluid);
  void act(const particles::GrainRows& grains, std::size_t row, std::size_t n,
           double drag_coefficient, const Triple& relative, double held,
           const ForceTerms::Sums& sums);
  [[nodiscard]] double held(const FluidState& fluid) const {
    return fluid.held > 0.0 ? fluid.held : step / refreshes;
  }
  void collect(const particles::GrainRows& grains, double fluid_step);
  void find_size_ratios(const particles::GrainRows& grains);

  Lattice lattice;
  const sdk::DragLaw& drag;
  const sdk::VoidageRule& voidage;
  VoidFraction void_fraction;
  GrainMemory memory;
  FaceExchange faces;
  bool is_own_taken_off;               ///< what a grain does to the fluid by itself
  std::unique_ptr<ForceTerms> forces;  ///< null without forces besides drag
  CouplingReport report;
  fluid::Properties properties;
  sdk::Vec3 gravity;
  bool is_set_three;
  Triple initial_velocity;
  bool is_one_way;
  bool needs_size_ratio;
  std::vector<std::array<double, 2>> size_sums;  ///< per cell W D^3 and W D^2, if needed
  double step;
  double least_spacing = 0.0;
  double refreshes = 1.0;           ///< per fluid step
  std::int64_t done_refreshes = 0;  ///< since map()
  bool is_settled = true;           ///< Remembered::given belongs to the last map()
};

/// Place, velocity and the implicit drag coefficient of each grain. The slip is that with the fluid
/// last seen at the grain (the initial velocity for a new one); collect() makes up for the lag.
void Coupling::Impl::remember(const particles::GrainRows& grains, std::size_t first,
                              std::size_t last) {
  Batch batch;
  WideKernel wide(lattice, voidage);
  if (is_own_taken_off) find_own_solids(grains, first, last);
  for (std::size_t row = first; row < last; ++row) {
    const double* position = grains.position + 4 * row;
    const double* velocity = grains.velocity + 4 * row;
    Remembered& r = memory[row];
    r.place = {position[0], position[1], position[2]};
    r.velocity = {velocity[0], velocity[1], velocity[2]};
    if (!r.has_velocity) r.fluid_velocity = initial_velocity;
    const double slip =
        std::hypot(r.fluid_velocity[0] - velocity[0], r.fluid_velocity[1] - velocity[1],
                   r.fluid_velocity[2] - velocity[2]);
    const double eps = void_fraction_at(position, wide) + r.own_solids;
    if (is_own_taken_off) find_own_flow(grains, row, eps, slip);
    batch.void_fraction[row - first] = eps;
    batch.reynolds[row - first] = reynolds(fluid_at(position), eps, slip, 2.0 * position[3]);
    batch.size_ratio[row - first] = r.size_ratio;
  }
  evaluate(batch, last - first);
  for (std::size_t row = first; row < last; ++row) {
    const double diameter = 2.0 * grains.position[4 * row + 3];
    const double inverse_mass = grains.velocity[4 * row + 3];
    const Fluid fluid = fluid_at(grains.position + 4 * row);
    const double drag_coefficient = coefficient(fluid, diameter, batch.factor[row - first]) *
                                    share_of_set(batch.void_fraction[row - first]) /
                                    (1.0 + memory[row].self_stress);
    // A free grain relaxes within the step: mean drag = (m / step) (1 - exp(-K step / m)) (u - v).
    const double relaxations = drag_coefficient * inverse_mass * step;
    const double mean = -std::expm1(-relaxations) / relaxations;
    // The faces' coefficients hold the set's share already.
    memory[row].coefficient = drag_coefficient * std::max(mean, k_least_implicit) /
                              share_of_set(batch.void_fraction[row - first]);
    memory[row].stress_impulse = {};
    memory[row].given = {};
  }
}

double Coupling::Impl::void_fraction_at(const double* position, WideKernel& wide) const {
  const fluid::CellField& eps = void_fraction.after();
  if (!wide.takes(position[3])) return eps[lattice.host_cell(lattice.place(position), position)];
  wide.set(position, position[3]);
  return wide.mean(eps);
}

/// Solids that a grain brings to its own cell and faces, less those that would be there without it.
void Coupling::Impl::find_own_solids(const particles::GrainRows& grains, std::size_t first,
                                     std::size_t last) {
  // Solids of one grain as a field; zero between grains.
  static thread_local fluid::CellField own;
  own.resize(lattice.grid().size, 0.0);
  WideKernel kernel(lattice, voidage);
  Stencil s;
  WideStencil many;
  const auto face_mean = [](const auto& near) {
    double sum = 0.0;
    double open = 0.0;
    for (std::size_t n = 0; n < near.size(); ++n) {
      const double part = near.weight[n] * near.open[n];
      sum += part * near.void_fraction[n];
      open += part;
    }
    return open > 0.0 ? sum / open : 0.0;
  };
  for (std::size_t row = first; row < last; ++row) {
    const double* position = grains.position + 4 * row;
    Remembered& r = memory[row];
    kernel.set(position, position[3]);
    const double volume = grains.weight[row] * sdk::sphere_volume(2.0 * position[3]);
    for (const WideKernel::Share& share : kernel.shares()) {
      own[share.cell] +=
          volume * share.weight / (lattice.open_fraction(share.cell) * lattice.cell_volume());
    }
    const bool is_wide = kernel.takes(position[3]);
    const Place p = lattice.place(position);
    const std::ptrdiff_t host = lattice.host_cell(p, position);
    const double here = is_wide ? kernel.mean(own) : own[host];
    const double eps = is_wide ? kernel.mean(void_fraction.after()) : void_fraction.after()[host];
    const double excess = own_disturbance::excess_of_one(1.0 - eps - here);
    r.own_solids = std::min(excess * here, 1.0 - eps);
    for (int d = 0; d < 3; ++d) {
      if (is_wide) {
        kernel.stencil(d, own, many);
        r.own_face_solids[d] = excess * face_mean(many);
      } else {
        lattice.stencil(d, p, own, s);
        r.own_face_solids[d] = excess * face_mean(s);
      }
    }
    for (const WideKernel::Share& share : kernel.shares()) own[share.cell] = 0.0;
  }
}

/// Flow around a grain by its own drag: how far it goes, and how much of it pushes the grain. `eps`
/// of the others around, `slip` [m/s] through it.
void Coupling::Impl::find_own_flow(const particles::GrainRows& grains, std::size_t row, double eps,
                                   double slip) {
  namespace own = own_disturbance;
  const double* position = grains.position + 4 * row;
  Remembered& r = memory[row];
  WideKernel kernel(lattice, voidage);
  const bool is_wide = kernel.takes(position[3]);
  const double edge = std::cbrt(lattice.cell_volume());
  double radius = own::k_trilinear_radius * edge;
  double density = own::k_trilinear_density / lattice.cell_volume();
  if (is_wide) {
    kernel.set(position, position[3]);
    radius = kernel.ball_radius();
    density = 1.0 / sdk::sphere_volume(2.0 * radius);
  }
  const Fluid fluid = fluid_at(position);
  const double reynolds = fluid.density * slip * radius / fluid.viscosity;
  const double mobility = own::mobility(radius, fluid.viscosity, reynolds);
  const double weighted = own::excess_of_one(1.0 - eps) * grains.weight[row];
  const double local = std::max(eps - r.own_solids, k_smallest_void_fraction);
  r.mobility = weighted * mobility;
  r.growth = -std::expm1(-step / own::build_up_time(radius, fluid.density, mobility));
  r.self_stress = is_set_three ? 0.0
                               : weighted * own::stress_share(reynolds) * density *
                                     sdk::sphere_volume(2.0 * position[3]) / local;
}

void Coupling::Impl::map(const particles::GrainRows& grains, double fluid_step) {
  step = fluid_step;
  memory.align(grains);
  double shortest = std::numeric_limits<double>::infinity();
  for (std::size_t row = 0; row < grains.count; ++row) {
    shortest = std::min(shortest, relaxation_time(1.0 / grains.velocity[4 * row + 3],
                                                  fluid_at(grains.position + 4 * row).viscosity,
                                                  2.0 * grains.position[4 * row + 3]));
  }
  refreshes = refreshes_for(step, shortest);
  done_refreshes = 0;
  if (needs_size_ratio) find_size_ratios(grains);
  if (is_one_way) return;

  const VoidFraction::Counts counts = void_fraction.map(grains);
  const double limit = voidage.largest_diameter_over_spacing();
  if (counts.largest_ratio > limit * (1.0 + k_ratio_rounding)) {
    const std::size_t row = counts.largest_row;
    throw sdk::ModelError(text("grain ", grains.id[row], " of diameter ",
                               2.0 * grains.position[4 * row + 3], " m is too large for cells of ",
                               least_spacing, " m: the voidage rule is valid for D/dx up to ",
                               limit, "; use fewer cells"));
  }
  report.moved_shares += counts.moved_shares;
  report.relieved_cells += counts.relieved_cells;
  report.unplaced_grains += counts.unplaced_grains;
  report.smallest_void_fraction = std::min(report.smallest_void_fraction, counts.smallest);
  report.largest_diameter_over_spacing =
      std::max(report.largest_diameter_over_spacing, counts.largest_ratio);
  if (counts.smallest <= 0.0) {
    throw sdk::ModelError(
        text("the grains in one cell fill ", 1.0 - counts.smallest,
             " of its open volume and no cell around has room; use fewer cells, or look for grains "
             "that overlap or lie inside bodies"));
  }
  for_batches(grains.count,
              [&](std::size_t first, std::size_t last) { remember(grains, first, last); });
  report.unpaired_forces += faces.spread(grains, memory, void_fraction.after(), step);
  is_settled = false;
}

/// Diameter of each grain over the Sauter mean of those in its cell, summed in row order.
void Coupling::Impl::find_size_ratios(const particles::GrainRows& grains) {
  size_sums.assign(lattice.grid().size, {0.0, 0.0});
  const auto cell_of = [&](std::size_t row) {
    const double* position = grains.position + 4 * row;
    return static_cast<std::size_t>(lattice.host_cell(lattice.place(position), position));
  };
  for (std::size_t row = 0; row < grains.count; ++row) {
    const double diameter = 2.0 * grains.position[4 * row + 3];
    std::array<double, 2>& sums = size_sums[cell_of(row)];
    sums[0] += grains.weight[row] * diameter * diameter * diameter;
    sums[1] += grains.weight[row] * diameter * diameter;
  }
  for (std::size_t row = 0; row < grains.count; ++row) {
    const std::array<double, 2>& sums = size_sums[cell_of(row)];
    memory[row].size_ratio = 2.0 * grains.position[4 * row + 3] * sums[1] / sums[0];
  }
}

void Coupling::Impl::settle(const particles::GrainRows& grains, const fluid::FaceField& velocity) {
  const double imbalance = faces.settle(grains, memory, void_fraction.after(), velocity, step);
  report.largest_imbalance = std::max(report.largest_imbalance, imbalance);
  is_settled = true;
}

void Coupling::Impl::refresh(const particles::GrainRows& grains, std::size_t first,
                             std::size_t last, const FluidState& state) {
  Batch batch;
  std::array<Triple, k_batch> slip;  // interstitial [m/s]
  std::array<Triple, k_batch> ratio;
  std::array<Triple, k_batch> stress;
  const fluid::CellField& eps = void_fraction.after();
  Stencil s;
  WideKernel wide(lattice, voidage);
  WideStencil many;
  for (std::size_t row = first; row < last; ++row) {
    const double* position = grains.position + 4 * row;
    const double* v = grains.velocity + 4 * row;
    Remembered& r = memory[row];
    const Place p = lattice.place(position);
    const bool is_wide = wide.takes(position[3]);
    const double own = std::min(1.0, void_fraction_at(position, wide) + r.own_solids);
    for (int d = 0; d < 3; ++d) {
      const double* u = state.velocity.component[d].data();
      const double* push = state.stress_divergence.component[d].data();
      const auto look = [&](const auto& near) {
        double flux = 0.0;  // relative to the grain: it does not jump with eps in plug flow
        double open = 0.0;
        double fluid = 0.0;
        double pushed = 0.0;
        for (std::size_t n = 0; n < near.size(); ++n) {
          flux += near.weight[n] * near.void_fraction[n] * (u[near.face[n]] - v[d]);
          const double part = near.weight[n] * near.open[n];
          open += part;
          fluid += part * near.void_fraction[n];
          if (is_wide) pushed += part * push[near.home[n]];
        }
        slip[row - first][d] = flux / own + r.disturbance[d];
        r.fluid_velocity[d] = v[d] + slip[row - first][d];
        ratio[row - first][d] =
            open > 0.0 && !is_set_three ? (fluid / open + r.own_face_solids[d]) / own : 1.0;
        stress[row - first][d] = open > 0.0 ? pushed / open : 0.0;
      };
      if (is_wide) {
        wide.stencil(d, eps, many);
        look(many);
      } else {
        lattice.stencil(d, p, eps, s);
        look(s);
        stress[row - first][d] = lattice.cell_mean(d, p, state.stress_divergence.component[d]);
      }
      if (is_set_three && !forces) stress[row - first][d] = 0.0;
    }
    r.has_velocity = true;
    batch.void_fraction[row - first] = own;
    const Triple& w = slip[row - first];
    const double speed = std::sqrt(w[0] * w[0] + w[1] * w[1] + w[2] * w[2]);
    batch.reynolds[row - first] = reynolds(fluid_at(position), own, speed, 2.0 * position[3]);
    batch.size_ratio[row - first] = r.size_ratio;
  }
  evaluate(batch, last - first);
  if (forces) {
    ForceTerms::Sums sums;
    const ForceTerms::Batch seen{first, last - first, batch.void_fraction.data(), slip.data(),
                                 stress.data()};
    forces->evaluate(grains, seen, state, held(state), eps, memory, sums);
    for (std::size_t row = first; row < last; ++row) {
      const std::size_t n = row - first;
      const double drag_coefficient =
          coefficient(fluid_at(grains.position + 4 * row), 2.0 * grains.position[4 * row + 3],
                      batch.factor[n]) *
          share_of_set(batch.void_fraction[n]) / (1.0 + memory[row].self_stress);
      Triple relative;
      for (std::size_t d = 0; d < 3; ++d) relative[d] = ratio[n][d] * slip[n][d];
      act(grains, row, n, drag_coefficient, relative, held(state), sums);
    }
    return;
  }
  for (std::size_t row = first; row < last; ++row) {
    const double diameter = 2.0 * grains.position[4 * row + 3];
    const double* v = grains.velocity + 4 * row;
    double* action = grains.fluid_action + 4 * row;
    Remembered& r = memory[row];
    const Fluid fluid = fluid_at(grains.position + 4 * row);
    const double drag_coefficient = coefficient(fluid, diameter, batch.factor[row - first]) *
                                    share_of_set(batch.void_fraction[row - first]) /
                                    (1.0 + r.self_stress);
    const double volume = sdk::sphere_volume(diameter);
    // The grains' reduced gravity is that of the fluid's own density.
    const double lift = volume * (properties.own().density - fluid.density);
    for (int d = 0; d < 3; ++d) {
      // The ratio differs from 1 only where the void fraction changes; it is applied to the slip of
      // this instant, because the grain has one rate for all directions.
      const double relative = ratio[row - first][d] * slip[row - first][d];
      const double force =
          volume * stress[row - first][d] + (lift == 0.0 ? 0.0 : lift * gravity[d]);
      action[d] = v[d] + relative + force / drag_coefficient;
      r.stress_impulse[d] += force;
    }
    action[3] = drag_coefficient * v[3];
  }
}

/// The action on a grain with forces besides drag. The grain obeys
///   (m + m_a) dv/dt = K (relative slip) + sum of forces + m g' + contacts ,
/// while the DEM integrates dv/dt = rate (target - v) + g' + contacts / m: the target makes up for
/// the difference, for the contacts with those of the last interval.
void Coupling::Impl::act(const particles::GrainRows& grains, std::size_t row, std::size_t n,
                         double drag_coefficient, const Triple& relative, double held,
                         const ForceTerms::Sums& sums) {
  const double* v = grains.velocity + 4 * row;
  double* action = grains.fluid_action + 4 * row;
  Remembered& r = memory[row];
  const double mass = 1.0 / v[3];
  const double moved = mass + sums.added_mass[n];
  const double volume = sdk::sphere_volume(2.0 * grains.position[4 * row + 3]);
  const double share = forces->weight_share(mass, volume);
  const bool is_buoyancy_taken = forces->taken().buoyancy;
  const double lift =
      is_buoyancy_taken
          ? 0.0
          : volume * (properties.own().density - fluid_at(grains.position + 4 * row).density);
  Triple pull;       // [N] all but m g' and contacts
  Triple contained;  // [N] of it, what the fluid does not receive
  for (std::size_t d = 0; d < 3; ++d) {
    const double g = gravity[static_cast<int>(d)];
    contained[d] = volume * sums.kept[n][d] + lift * g + sums.contained[n][d];
    pull[d] = drag_coefficient * relative[d] + contained[d] + sums.returned[n][d] -
              sums.added_mass[n] * (share * g + sums.contact[n][d]);
  }
  if (sums.resistance[n] > 0.0) {
    // Implicit along the wall's normal: it may be far stiffer than the interval.
    double approach = -sums.wall_speed[n];
    double change = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      const double towards = sums.normal[n][d];
      approach += towards * v[d];
      change += towards * (pull[d] / moved + share * gravity[static_cast<int>(d)]) * held;
    }
    const double stiffness = sums.resistance[n] * held / moved;
    const double force = -sums.resistance[n] * (approach + change) / (1.0 + stiffness);
    for (std::size_t d = 0; d < 3; ++d) {
      pull[d] += force * sums.normal[n][d];
      contained[d] += force * sums.normal[n][d];
    }
  }
  for (std::size_t d = 0; d < 3; ++d) {
    action[d] = v[d] + pull[d] / drag_coefficient;
    r.stress_impulse[d] += contained[d];
  }
  action[3] = drag_coefficient / moved;
}

void Coupling::Impl::collect(const particles::GrainRows& grains, double fluid_step) {
  if (done_refreshes == 0) {
    throw std::logic_error("Coupling::collect() without a refresh() since map()");
  }
  memory.align(grains);
  const double interval = fluid_step / static_cast<double>(done_refreshes);
  for_batches(grains.count, [&](std::size_t first, std::size_t last) {
    for (std::size_t row = first; row < last; ++row) {
      double* received = grains.fluid_impulse + 4 * row;
      Remembered& r = memory[row];
      if (forces) forces->impulse_was_read(memory, row, received);
      for (int d = 0; d < 3; ++d) {
        const double drag_impulse = received[d] - interval * r.stress_impulse[d];
        if (!is_one_way && r.is_paired[d]) {
          r.owed[d] += grains.weight[row] * (r.given[d] - drag_impulse);
        }
        if (is_own_taken_off) {
          // Per real grain; the mobility counts the weight.
          const double steady = r.mobility * drag_impulse / fluid_step;
          r.disturbance[d] += r.growth * (steady - r.disturbance[d]);
        }
        r.place[d] = grains.position[4 * row + d];
        received[d] = 0.0;
      }
    }
  });
}

Coupling::Coupling(const scenario::Setup& setup, const fluid::Grid& grid,
                   const fluid::CellField& open_fraction, const sdk::VoidageRule& voidage,
                   const sdk::DragLaw& drag) {
  if (!setup.fluid) throw std::logic_error("Coupling needs a scenario with a fluid");
  const scenario::FluidSpec& fluid = *setup.fluid;
  if (!(fluid.viscosity > 0.0)) {
    throw sdk::ModelError("drag on grains needs a fluid with a viscosity above zero");
  }
  impl_ =
      std::make_unique<Impl>(fluid, setup.time, setup.gravity, grid, open_fraction, voidage, drag);
}
Coupling::~Coupling() = default;

void Coupling::check_diameters(std::span<const double> diameters) const {
  const double limit = impl_->voidage.largest_diameter_over_spacing();
  for (const double diameter : diameters) {
    if (impl_->is_one_way || diameter <= limit * (1.0 + k_ratio_rounding) * impl_->least_spacing) {
      continue;
    }
    throw base::UserError(text(
        "error: grains of ", diameter, " m are too large for fluid cells of ", impl_->least_spacing,
        " m: the voidage rule is valid for D/dx up to ", limit, "; use fewer fluid cells"));
  }
}

void Coupling::set_open_fraction(const fluid::CellField& open_fraction) {
  impl_->lattice.set_open_fraction(open_fraction);
}

void Coupling::map(const particles::GrainRows& grains, double fluid_step) {
  impl_->map(grains, fluid_step);
}
const fluid::CellField& Coupling::void_fraction_before() const {
  return impl_->void_fraction.before();
}
const fluid::CellField& Coupling::void_fraction() const { return impl_->void_fraction.after(); }
const fluid::Exchange& Coupling::exchange() const { return impl_->faces.exchange(); }

void Coupling::settle(const particles::GrainRows& grains, const fluid::FaceField& velocity) {
  impl_->memory.align(grains);
  impl_->settle(grains, velocity);
}

void Coupling::refresh(const particles::GrainRows& grains, const fluid::FaceField& velocity,
                       const fluid::FaceField& stress_divergence) {
  refresh(grains, FluidState{velocity, stress_divergence});
}

void Coupling::refresh(const particles::GrainRows& grains, const FluidState& fluid) {
  impl_->memory.align(grains);
  if (!impl_->is_settled) impl_->settle(grains, fluid.velocity);
  ForceTerms* forces = impl_->forces.get();
  if (forces != nullptr) forces->begin(fluid, impl_->step, impl_->done_refreshes == 0);
  Impl::for_batches(grains.count, [&](std::size_t first, std::size_t last) {
    impl_->refresh(grains, first, last, fluid);
  });
  if (forces != nullptr) forces->end(fluid);
  ++impl_->done_refreshes;
}

void Coupling::use(std::span<const std::unique_ptr<sdk::FluidForce>> forces,
                   std::vector<particles::Surface> surfaces) {
  if (forces.empty()) return;
  Impl& s = *impl_;
  s.forces = std::make_unique<ForceTerms>(forces, std::move(surfaces), s.lattice, s.properties,
                                          s.gravity, s.is_set_three);
  s.memory.keep(s.forces->kept_numbers());
}

bool takes_over_buoyancy(std::span<const std::unique_ptr<sdk::FluidForce>> forces) {
  return std::any_of(forces.begin(), forces.end(),
                     [](const auto& force) { return force->takes_over().buoyancy; });
}

double Coupling::refresh_interval() const { return impl_->step / impl_->refreshes; }

void Coupling::collect(const particles::GrainRows& grains, double fluid_step) {
  impl_->collect(grains, fluid_step);
}

void Coupling::momentum_exchange(std::vector<float>& per_cell) const {
  impl_->faces.per_cell(per_cell);
}
const CouplingReport& Coupling::report() const { return impl_->report; }

void Coupling::save(sdk::ArchiveWriter& archive) const {
  const CouplingReport& r = impl_->report;
  impl_->void_fraction.save(archive);
  impl_->memory.save(archive);
  if (impl_->forces) impl_->forces->save(archive);
  archive.number("refreshes", impl_->refreshes);
  archive.number("step", impl_->step);
  archive.integers(
      "counts", std::array{r.moved_shares, r.relieved_cells, r.unplaced_grains, r.unpaired_forces});
  archive.numbers("extremes", std::array{r.smallest_void_fraction, r.largest_imbalance,
                                         r.largest_diameter_over_spacing});
}

void Coupling::load(sdk::ArchiveReader& archive) {
  CouplingReport& r = impl_->report;
  impl_->void_fraction.load(archive);
  impl_->memory.load(archive);
  if (impl_->forces) impl_->forces->load(archive);
  impl_->refreshes = archive.number("refreshes");
  impl_->step = archive.number("step");
  const std::vector<std::int64_t> counts = archive.integers("counts");
  const std::vector<double> extremes = archive.numbers("extremes");
  r.moved_shares = counts.at(0);
  r.relieved_cells = counts.at(1);
  r.unplaced_grains = counts.at(2);
  r.unpaired_forces = counts.at(3);
  r.smallest_void_fraction = extremes.at(0);
  r.largest_imbalance = extremes.at(1);
  r.largest_diameter_over_spacing = extremes.at(2);
}

}  // namespace dust::coupling
