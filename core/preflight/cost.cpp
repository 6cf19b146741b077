// SPDX-License-Identifier: Apache-2.0
#include "preflight/cost.hpp"

#include "coupling/self_disturbance/disturbance_formulas.hpp"
#include "dust/sdk/sphere.hpp"
#include "fluid/grid.hpp"
#include "preflight/journey.hpp"

#include <algorithm>
#include <cmath>

namespace dust::preflight {
namespace {

// What things cost on one core of a virtual machine of 2026, by `tools/validation/run estimates`
// and long runs. What this machine does differently is learnt: LearntCosts.

constexpr double k_bytes_base = 3.5e7;
constexpr double k_bytes_fluid = 1.5e7;               // more, where there is a fluid
constexpr double k_bytes_per_grain = 1500.0;          // with lists, and copies for the disk
constexpr double k_bytes_per_coupled_grain = 1500.0;  // more, in a fluid
constexpr double k_bytes_per_cell = 1150.0;
constexpr double k_bytes_per_dust_cell = 280.0;  // of each class
constexpr double k_disk_base = 1e6;              // report, series, scenario, summary
constexpr double k_disk_fluid = 1.5e6;
constexpr double k_frame_bytes_per_grain = 52.0;  // packed
constexpr double k_frame_bytes_per_cell = 14.0;
constexpr double k_frame_bytes_per_dust_cell = 3.5;  // of each class
constexpr double k_checkpoint_bytes_per_grain = 600.0;
// Arrays of a checkpoint that hold a number for each place of the fluid's grid, its halo with them;
// those that are the same all over pack to nothing and do not count.
constexpr double k_arrays_of_fluid = 7.0;     // pressure, velocity, stress
constexpr double k_arrays_of_grains = 6.0;    // what they owe its velocity, and its excess
constexpr double k_arrays_of_coupling = 3.0;  // what those that it does not resolve owe its stress
constexpr double k_arrays_of_dust = 4.0;      // volume and velocity of the gas
constexpr double k_arrays_of_dust_class = 2.0;

// [s] A step of a grain: in a bed it has contacts all the time; before a filling has settled it
// meets others now and then; in a gas it flies from one collision to the next. In a stream its
// lists are made anew often, and what it touches costs more the deeper the load is.
constexpr double k_bed_step = 7.5e-8;
/// A bed that a body shakes, over one at rest: its lists are made anew with every stroke.
constexpr double k_shaken = 2.0;
constexpr double k_settling_step = 2.2e-8;
constexpr double k_gas_step = 7.5e-9;
constexpr double k_thin_stream_step = 1.8e-8;
constexpr double k_stream_contact = 7e-8;
// A contact with cohesion costs so many without: that law comes on top, and all pairs within its
// reach are looked at. Fitted to the bridges of studies/wet_hopper.yaml, see
// docs/validation/estimates.md.
constexpr double k_cohesive_contact = 2.5;
/// A step at a finer rate, over one at the coarse rate of the same bed: clusters are found and
/// their rows are fetched for it.
constexpr double k_fine_factor = 4.5;
/// The same of a stream, however deep its load is: a fine grain touches one or two others.
constexpr double k_fine_stream_step = 8e-8;
constexpr double k_contacts_in_bed = 2.5;
/// Layers up to which a load lies side by side, for it spreads.
constexpr double k_single_layer = 1.2;
/// Share of its fine steps that a grain makes while a thin stream is carried: one at rest needs no
/// steps as fine as a blow does, and among others it lies stiller: with so many contacts more, by
/// as many times less. Fitted to the transfer point at 0.2 to 0.8 m/s with 1 and 6 g/s. One that
/// flies moves at the coarse rate, at next to no cost.
constexpr double k_fine_carried = 0.17;

constexpr double k_cell_step = 3.9e-7;
/// A cell of one class of dust, once its transport has begun; its own sub-steps keep a smaller
/// Courant number than the fluid's, for it drifts and diffuses besides.
constexpr double k_dust_cell = 7e-8;
constexpr double k_dust_cfl = 0.65;
constexpr double k_fluid_step = 9e-4;  // however few the cells

// Exchange with the fluid, in each of its steps: the void fraction, and each refresh of the drag.
constexpr double k_voidage_per_grain = 2.5e-6;    // of a stream: its cells and faces are anywhere
constexpr double k_voidage_per_bed_grain = 4e-7;  // of a bed: those of its neighbours
/// More for a lone grain whose own disturbance is taken off: the cells of its kernel, which is no
/// narrower than so many cells, and those that a large one fills.
constexpr double k_self_disturbance = 6e-6;
constexpr double k_self_power = 5.5;
/// Grains that come at once are as lone as those of a stream where they are no more than this.
constexpr double k_few = 10.0;
constexpr double k_voidage_per_cell = 2e-8;
constexpr double k_refresh_per_grain = 2.2e-7;
/// Refreshes follow the time in which a grain of 2 m/s crosses 1/8 of a cell (RefreshSchedule).
constexpr double k_refresh_way = 1.0 / 16.0;  // [s/m] times the edge of a cell
constexpr double k_max_refreshes = 64.0;

constexpr double k_frame = 0.01;
constexpr double k_frame_per_grain = 3e-6;
constexpr double k_frame_per_cell = 9e-7;
// Snapshots, checks and sensors, in each fluid step.
constexpr double k_rest = 5e-5;
constexpr double k_rest_per_grain = 2.5e-7;
constexpr double k_rest_per_cell = 1e-8;

// Solid share above which grains without gravity press on each other.
constexpr double k_dense = 0.2;

using scenario::DomainSpec;
using scenario::Setup;

double extent_along(const DomainSpec& domain, sdk::Vec3 direction) {
  const sdk::Vec3 size = domain.max - domain.min;
  return std::abs(size.x * direction.x) + std::abs(size.y * direction.y) +
         std::abs(size.z * direction.z);
}

/// [s] that grains filled in loosely fall before they lie on each other: the top of the filling
/// sinks by half its height. Nothing where they are few.
double settling_time(const Setup& setup, double volume) {
  constexpr double k_loose = 0.3;
  const double g = norm(setup.gravity);
  const double height = extent_along(setup.domain, setup.gravity / g);
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const double filled = volume / (k_loose * size.x * size.y * size.z) * height;
  return std::sqrt(std::min(filled, height) / g);
}

bool is_cohesive(const Setup& setup, std::size_t material) {
  const auto index = static_cast<int>(material);
  return std::any_of(setup.interactions.begin(), setup.interactions.end(),
                     [&](const scenario::InteractionSpec& pair) {
                       return pair.material_i == index && pair.material_j == index &&
                              pair.cohesion.has_value();
                     });
}

/// Share of an emitter's grains by mass that cohere with their own kind.
double cohesive_share(const Setup& setup, const EmissionNumbers& e) {
  double all = 0.0;
  double cohesive = 0.0;
  for (std::size_t m = 0; m < setup.materials.size(); ++m) {
    const double share = (m < e.stream_shares.size() ? e.stream_shares[m] : 0.0) +
                         (m < e.mass_at_once.size() ? e.mass_at_once[m] : 0.0);
    all += share;
    if (is_cohesive(setup, m)) cohesive += share;
  }
  return all > 0.0 ? cohesive / all : 0.0;
}

/// What its grains make of a contact's cost.
double contact_factor(const Setup& setup, const EmissionNumbers& e) {
  return 1.0 + (k_cohesive_contact - 1.0) * cohesive_share(setup, e);
}

/// Contacts of a grain of a stream, over its stay: one side of each counts. Those that cohere are
/// held in clumps, however thin the load is.
double stream_contacts(const Setup& setup, const EmissionNumbers& e, double layers) {
  const double share = cohesive_share(setup, e);
  return e.carried_share * (share * k_contacts_in_bed + (1.0 - share) * carried_contacts(layers));
}

/// [s] Mean cost of a step of grains that are there at once: with gravity they fall, then lie.
double step_at_once(const Setup& setup, const Derived& derived, const EmissionNumbers& e) {
  const double shaken = derived.bodies.is_shaking ? k_shaken : 1.0;
  const double bed_step = shaken * contact_factor(setup, e) * k_bed_step;
  if (norm(setup.gravity) > 0.0) {
    const double time = std::max(setup.time.end - e.begin, setup.time.fluid_step);
    const double share = std::min(1.0, settling_time(setup, e.volume_at_once) / time);
    return share * k_settling_step + (1.0 - share) * bed_step;
  }
  const sdk::Vec3 size = setup.domain.max - setup.domain.min;
  const double most =
      e.sizes.empty() ? 0.0 : e.at_once * sdk::sphere_volume(e.sizes.back().diameter);
  const double solids = e.volume_at_once > 0.0 ? e.volume_at_once : most;
  return solids > k_dense * size.x * size.y * size.z ? bed_step : k_gas_step;
}

/// Of an emitter's grains, those below the coarse level.
struct FineShare {
  double grains = 0.0;     ///< of all its grains
  double sub_steps = 0.0;  ///< per grain of any size and coarse step, when all are near others
};

FineShare fine_share(const particles::TimeSteps& steps, const EmissionNumbers& e) {
  FineShare fine;
  for (const EmissionNumbers::Size& size : e.sizes) {
    for (const particles::ClassStep& c : steps.classes) {
      if (c.diameter != size.diameter || steps.is_coarse(c)) continue;
      fine.grains += size.share;
      fine.sub_steps += size.share * steps.coarse_step / steps.step_of(c);
      break;
    }
  }
  return fine;
}

/// Grains of all emitters over the run.
struct GrainTotals {
  double most = 0.0;            ///< at a time
  double left = 0.0;            ///< of those that were there at once, at the end
  double seconds = 0.0;         ///< [s] integral of their number
  double stream_seconds = 0.0;  ///< [s] of that, of streams
  /// [s2] Integral of what their own disturbance costs a fluid step.
  double self_disturbance = 0.0;
  double layers = 0.0;  ///< of all that is carried, for it is carried together
};

/// [s] Mean cost of finding where a grain of a stream touches bodies, in each of its steps: of a
/// deep load only the lowest layer does.
double touch_step(const BodyWork& bodies, const EmissionNumbers& e, double layers) {
  double sum = 0.0;
  for (std::size_t b = 0; b < e.on_body.size(); ++b) sum += e.on_body[b] * bodies.touch[b];
  return sum / std::max(1.0, layers);
}

/// [s] The same of grains that are there at once: those at the surface of a compact heap touch one
/// of the bodies.
double touch_step(const BodyWork& bodies, double grains) {
  if (bodies.touch.empty() || !(grains > 0.0)) return 0.0;
  double sum = 0.0;
  for (const double touch : bodies.touch) sum += touch;
  const double outer_share = std::min(1.0, 1.5 / std::cbrt(grains));
  return outer_share * sum / static_cast<double>(bodies.touch.size());
}

/// [s] More in each fluid step for a lone grain of this emitter, on average, where its own
/// disturbance is taken off.
double self_disturbance_cost(const Setup& setup, const Derived& derived, const EmissionNumbers& e) {
  const auto cost = [&](double diameter) {
    if (!is_self_disturbance_corrected(setup, derived, diameter)) return 0.0;
    const double cells = diameter / derived.mean_spacing;
    const double wider = std::max(1.0, cells / coupling::self_disturbance::k_min_knots);
    return k_self_disturbance * std::pow(wider, k_self_power);
  };
  if (e.sizes.empty()) {
    return derived.steps.classes.empty() ? 0.0 : cost(derived.steps.classes.back().diameter);
  }
  double sum = 0.0;
  for (const EmissionNumbers::Size& size : e.sizes) sum += size.share * cost(size.diameter);
  return sum;
}

/// What a step of a grain at the coarse rate costs, with those at finer rates that come with it.
struct StepWork {
  double step = 0.0;            ///< [s]
  double isolated_steps = 0.0;  ///< of fine grains that fly: counted, at next to no cost
  double fine_steps = 0.0;      ///< of fine grains near others
  double fine_step_cost = 0.0;  ///< [s] of each
};

void add_steps(double count, const StepWork& work, Derived& derived) {
  Spent& grains = derived.cost.terms[CostTerm::grains];
  grains.amount += count;
  grains.seconds += count * (work.step + derived.bodies.search);
  Spent& fine = derived.cost.terms[CostTerm::fine_grains];
  fine.amount += count * (work.isolated_steps + work.fine_steps);
  fine.seconds += count * work.fine_steps * work.fine_step_cost;
}

/// Adds the work of an emitter's grains.
void add_grains(const Setup& setup, const EmissionNumbers& e, Derived& derived,
                GrainTotals& totals) {
  const double end = setup.time.end;
  double stream_seconds = 0.0;
  for (const double stay : e.stays) {
    const double each = e.computed_per_second / static_cast<double>(e.stays.size());
    stream_seconds += each * grain_seconds(e.begin, e.end, stay, end);
    totals.most += each * most_grains(e.begin, e.end, stay, end);
  }
  SlopeDrain drain = derived.drain;
  drain.begin = std::max(drain.begin, e.begin);
  const double filled_seconds = e.at_once * (std::max(0.0, end - e.begin) - drain.absent(end));
  totals.most += e.at_once;
  totals.left += e.at_once * drain.left(end);
  totals.seconds += stream_seconds + filled_seconds;
  totals.stream_seconds += stream_seconds;
  const double isolated_seconds = stream_seconds + (e.at_once <= k_few ? filled_seconds : 0.0);
  totals.self_disturbance += isolated_seconds * self_disturbance_cost(setup, derived, e);
  const particles::TimeSteps& steps = derived.steps;
  if (steps.classes.empty() || !(steps.coarse_step > 0.0)) return;
  const FineShare fine = fine_share(steps, e);
  const double bed_step = step_at_once(setup, derived, e) + touch_step(derived.bodies, e.at_once);
  add_steps(
      filled_seconds / steps.coarse_step,
      {.step = bed_step, .fine_steps = fine.sub_steps, .fine_step_cost = k_fine_factor * bed_step},
      derived);
  const double contacts = stream_contacts(setup, e, totals.layers);
  add_steps(stream_seconds / steps.coarse_step,
            {.step = k_thin_stream_step + contact_factor(setup, e) * k_stream_contact * contacts +
                     touch_step(derived.bodies, e, totals.layers),
             .isolated_steps = (1.0 - e.carried_share) * fine.grains,
             .fine_steps = k_fine_carried * e.carried_share / (1.0 + contacts) * fine.sub_steps,
             .fine_step_cost = contact_factor(setup, e) * k_fine_stream_step},
            derived);
}

/// Streams that are carried lie on each other: their thickness over the mean size of all.
double all_layers(const Derived& derived) {
  double thickness = 0.0;
  double cubes = 0.0;
  double grains = 0.0;
  for (const EmissionNumbers& e : derived.emissions) {
    if (!(e.thickness > 0.0)) continue;
    thickness += e.thickness;
    for (const EmissionNumbers::Size& size : e.sizes) {
      // That of the mean volume: rare dust among sand makes no layers.
      cubes += e.computed_per_second * size.share * std::pow(size.diameter, 3);
      grains += e.computed_per_second * size.share;
    }
  }
  return cubes > 0.0 ? thickness / std::cbrt(cubes / grains) : 0.0;
}

/// [s] that grains of streams stay, on average over those that leave in time.
double mean_stay(const Setup& setup, const Derived& derived) {
  double sum = 0.0;
  double count = 0.0;
  for (const EmissionNumbers& e : derived.emissions) {
    for (const double stay : e.stays) {
      const double each = e.computed_per_second / static_cast<double>(e.stays.size());
      sum += each * std::min(stay, setup.time.end);
      count += each;
    }
  }
  return count > 0.0 ? sum / count : setup.time.end;
}

double cell_count(const Setup& setup) {
  if (!setup.fluid) return 0.0;
  const auto& n = setup.fluid->cells;
  return static_cast<double>(n[0]) * n[1] * n[2];
}

void add_fluid(const Setup& setup, const GrainTotals& totals, Derived& derived) {
  const double cells = cell_count(setup);
  if (!(cells > 0.0)) return;
  const double step = setup.time.fluid_step;
  const double courant = derived.air_speed * step / derived.smallest_spacing;
  const double sub_steps =
      setup.time.end / step * std::max(1.0, courant / setup.fluid->largest_cfl);
  const double steps = setup.time.end / step;
  derived.cost.terms[CostTerm::fluid] = {
      sub_steps * cells,
      sub_steps * (k_fluid_step + cells * k_cell_step) + steps * derived.bodies.cut};
  const double dusty = std::clamp(1.0 - derived.dust_begin / setup.time.end, 0.0, 1.0);
  const double dust_cells =
      dusty * derived.dust_classes * steps * std::max(1.0, courant / k_dust_cfl) * cells;
  derived.cost.terms[CostTerm::dust] = {dust_cells, dust_cells * k_dust_cell};
  if (derived.emissions.empty()) return;
  const double refreshes = std::clamp(std::ceil(step / (k_refresh_way * derived.smallest_spacing)),
                                      1.0, k_max_refreshes);
  const double bed_seconds = totals.seconds - totals.stream_seconds;
  derived.cost.terms[CostTerm::exchange] = {
      totals.seconds / step + steps * cells,
      (totals.stream_seconds * k_voidage_per_grain + totals.self_disturbance +
       bed_seconds * k_voidage_per_bed_grain + totals.seconds * refreshes * k_refresh_per_grain) /
              step +
          steps * (cells * k_voidage_per_cell + derived.bodies.predict)};
}

/// Whether the fluid has fields for grains that it does not resolve.
bool is_coupled(const Setup& setup, const Derived& derived) {
  return setup.fluid && derived.emissions.size() > derived.resolved.size();
}

/// [B] What a checkpoint keeps of the fluid, and of what acts on it.
double grid_checkpoint_bytes(const Setup& setup, const Derived& derived) {
  const std::size_t places = fluid::Grid::make({}, {1.0, 1.0, 1.0}, setup.fluid->cells, {}).size;
  double arrays = k_arrays_of_fluid;
  if (!derived.emissions.empty()) arrays += k_arrays_of_grains;
  if (is_coupled(setup, derived)) arrays += k_arrays_of_coupling;
  if (derived.dust_classes > 0) {
    arrays += k_arrays_of_dust + k_arrays_of_dust_class * derived.dust_classes;
  }
  return sizeof(double) * static_cast<double>(places) * arrays;
}

/// Returns the size of its frames [B].
double add_records(const Setup& setup, const GrainTotals& totals, Derived& derived) {
  const double cells = cell_count(setup);
  const double mean = totals.seconds / setup.time.end;
  const double frames = std::floor(setup.time.end / setup.time.output_every + 1e-9) + 1.0;
  derived.cost.terms[CostTerm::output] = {
      frames, frames * (k_frame + mean * k_frame_per_grain + cells * k_frame_per_cell)};
  const double steps = setup.time.end / setup.time.fluid_step;
  derived.cost.terms[CostTerm::rest] = {
      steps, steps * (k_rest + mean * k_rest_per_grain + cells * k_rest_per_cell)};
  derived.cost.memory_bytes =
      k_bytes_base + k_bytes_per_grain * totals.most + k_bytes_per_cell * cells;
  const double dust_cells = derived.dust_classes * cells;
  const double frame_bytes =
      frames * (k_frame_bytes_per_grain * mean + k_frame_bytes_per_cell * cells +
                k_frame_bytes_per_dust_cell * dust_cells + derived.bodies.frame_bytes);
  derived.cost.disk_bytes =
      k_disk_base + frame_bytes + k_checkpoint_bytes_per_grain * (totals.most - totals.left);
  if (!(cells > 0.0)) return frame_bytes;
  derived.cost.memory_bytes +=
      k_bytes_fluid + k_bytes_per_coupled_grain * totals.most + k_bytes_per_dust_cell * dust_cells;
  derived.cost.disk_bytes += k_disk_fluid + grid_checkpoint_bytes(setup, derived);
  return frame_bytes;
}

/// The cost of a run from 0 s to its end; returns the size of its frames [B].
double estimate_whole(const Setup& setup, Derived& derived) {
  GrainTotals totals;
  totals.layers = all_layers(derived);
  for (const EmissionNumbers& e : derived.emissions) add_grains(setup, e, derived, totals);
  derived.residence_time = mean_stay(setup, derived);
  derived.grains_in_domain = totals.most;
  add_fluid(setup, totals, derived);
  return add_records(setup, totals, derived);
}

}  // namespace

double fall_height(const scenario::Setup& setup) {
  const double g = norm(setup.gravity);
  return g > 0.0 ? extent_along(setup.domain, setup.gravity / g) : 0.0;
}

double carried_contacts(double layers) {
  return layers > k_single_layer ? k_contacts_in_bed * (1.0 - k_single_layer / layers) : 0.0;
}

void estimate_cost(const Setup& setup, Derived& derived, double begin) {
  estimate_whole(setup, derived);
  if (!(begin > 0.0)) return;
  Setup before = setup;
  before.time.end = std::min(begin, setup.time.end);
  Derived done = derived;
  done.cost = {};
  derived.cost.disk_bytes -= estimate_whole(before, done);
  for (std::size_t n = 0; n < k_cost_terms; ++n) {
    Spent& term = derived.cost.terms[n];
    term.amount = std::max(0.0, term.amount - done.cost.terms[n].amount);
    term.seconds = std::max(0.0, term.seconds - done.cost.terms[n].seconds);
  }
}

}  // namespace dust::preflight
