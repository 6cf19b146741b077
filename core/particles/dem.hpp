// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/sensor.hpp"
#include "particles/energy/energy_balance.hpp"
#include "particles/grain_rows.hpp"
#include "particles/openings/opening.hpp"
#include "particles/pair_law_table.hpp"
#include "particles/transfer/transfer.hpp"
#include "particles/work/contact_work.hpp"
#include "particles/work/dust_loads.hpp"
#include "setup/setup.hpp"

#include <algorithm>
#include <array>
#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dust::particles {

class BalanceLedger;
struct TimeSteps;

/// A grain to insert; the DEM gives the id.
struct NewGrain {
  sdk::Vec3 position;
  sdk::Vec3 velocity;
  sdk::Vec3 rotation;
  double diameter = 0.0;
  double weight = 1.0;
  std::int32_t material = 0;
};

/// Counts and masses; `real_*` and masses count each computed grain with its weight.
struct Balance {
  std::int64_t emitted = 0, in_domain = 0, left = 0, removed = 0, max = 0;
  double real_emitted = 0, real_in_domain = 0, real_left = 0, real_removed = 0, real_max = 0;
  double mass_emitted = 0, mass_in_domain = 0, mass_left = 0, mass_removed = 0;  ///< [kg]
};

/// Time step of one size class, and what sets it.
struct ClassStep {
  double diameter = 0.0;       ///< [m]
  double rayleigh_time = 0.0;  ///< [s]
  double hertz_time = 0.0;     ///< [s] at the expected speed
  double stable_step = 0.0;    ///< [s] docs/theory/grains.md, eq. (10)
  int level = 0;               ///< steps are coarse_step / 2^level at the finest
  int material = -1;           ///< of the grain that has the shortest collision
  int partner = -1;            ///< material of what it meets in it
};

/// Counters of the DEM, for the summary and the audit.
struct DemReport {
  std::int64_t steps = 0;           ///< coarse steps
  std::int64_t particle_steps = 0;  ///< sum over coarse steps of grains integrated
  std::int64_t fine_steps = 0;      ///< sub-steps of fine grains, summed over grains
  std::int64_t rebuilds = 0;
  std::int64_t list_repairs = 0;  ///< for single grains that left their predicted trajectory
  std::int64_t free_flight_steps =
      0;                         ///< of particle_steps, those made many at once in free flight
  double largest_overlap = 0.0;  ///< [-] overlap / smaller radius, since the start
  double largest_coarse_overlap = 0.0;  ///< [-] of that, between grains on coarse steps and walls
  double largest_fine_overlap = 0.0;    ///< [-] of that, where a sub-stepped grain takes part
  std::int64_t contacts = 0;            ///< in touch at the last step
  std::int64_t missed_contact_onsets =
      0;  ///< between grains, begun while the inner list had not got them
};

/// A contact as sensors see it.
struct ContactRecord {
  std::int32_t row_i = 0;
  std::int32_t row_j = 0;   ///< < 0: surface -1 - row_j
  sdk::Vec3 force;          ///< [N] on i, contact stage
  sdk::Vec3 branch;         ///< [m] from the centre of i to that of j, or to the contact point
  double overlap = 0.0;     ///< [m] < 0 within a law's range
  sdk::Vec3 wall_velocity;  ///< [m/s] of the surface at the contact point; 0 between grains
};

/// What a solver is asked for beyond its scenario.
struct DemOptions {
  double fluid_density = 0.0;  ///< [kg/m3] > 0: of the hydrostatic pressure that reduces gravity
  /// kg of dust per kg of grain, by material and class; empty: none carries any.
  std::vector<std::vector<double>> dust_shares;
  double release_speed = 0.0;  ///< [m/s] of the fastest particle as it is inserted
  bool catches_dust = false;   ///< take_up_dust() is called
  bool keeps_wind = false;     ///< GrainRows::wind is asked for; with a fluid only
  /// Particles that touch these are drawn out.
  std::vector<Opening> openings;
  bool records_wall_loads = false;    ///< close_wall_loads() is called
  bool records_wall_sliding = false;  ///< with slidings
  /// None flies freely: add_force() acts on all coarse particles.
  bool all_step = false;
};

/// Discrete elements: rows in Morton order in fixed tiles, Verlet lists from a hierarchical grid,
/// contact laws in batches, several rates. Deterministic for any number of threads.
///
/// One coarse step is: neighbours() (does something only when lists no longer hold or grains came
/// or went), contact(), force(), integrate(), advance_fine(). Each is parallel inside.
class Dem {
 public:
  /// `class_diameters`: all diameters that may come, ascending.
  Dem(const scenario::Setup& setup, const bodies::BodySet& bodies, std::vector<PairLaws> laws,
      const std::vector<double>& class_diameters, DemOptions options);
  ~Dem();
  Dem(const Dem&) = delete;
  Dem& operator=(const Dem&) = delete;

  [[nodiscard]] double coarse_step() const;  ///< [s] divides the fluid step
  [[nodiscard]] std::span<const ClassStep> class_steps() const;
  [[nodiscard]] const TimeSteps& time_steps() const;

  void insert(std::span<const NewGrain> grains);
  [[nodiscard]] std::span<const Opening> openings() const;
  /// Counts and drops grains beyond open sides and those drawn out. Call between coarse steps.
  void remove_escaped();

  void neighbours();
  /// The phases of a step at `time` [s], each over all tiles. `keeps_force`: last_force() is asked
  /// for after this step. Between force() and integrate() the forces of the particles that are
  /// about to move are complete: see add_force().
  void contact(double time, bool keeps_force = true);
  void force();
  void integrate();
  /// The three phases at once, with the same bits: each tile goes through them in one task where
  /// its forces are complete.
  void step_tiles(double time, bool keeps_force = true);
  /// How the time in step_tiles() was shared by contact, force and integration; sums to one, or
  /// zeros before the first step.
  [[nodiscard]] std::array<double, 3> phase_shares() const;
  /// Sub-steps of the particles of the finer rates; ends the step.
  void advance_fine();
  /// Adds `force`(row) [N], asked by several threads, to each coarse particle that makes this step:
  /// for stages of one's own between force() and integrate(). Those that fly without a partner make
  /// no steps, unless DemOptions::all_step is set.
  void add_force(const std::function<sdk::Vec3(std::size_t)>& force);

  /// Ends the inner pair list and brings all grains to the present time: those in free flight make
  /// many steps at once. Whatever looks at the grains below does it first; end a run of steps with
  /// it, so that several may look at the same time.
  void synchronise();
  [[nodiscard]] GrainRows rows();
  /// Changes the angular velocity [rad/s] of a particle at once, as a torque that acted before
  /// would have. Call between coarse steps.
  void turn(std::size_t row, sdk::Vec3 change);
  /// Force [N] (contact + fluid + weight) of the last step, 4 per grain in row order; without the
  /// contacts of coarse grains where contact() did not keep them.
  [[nodiscard]] std::span<const double> last_force();
  /// The contacts of this moment, which is `time` [s]; costs a pass over all of them, so only for
  /// those who ask.
  [[nodiscard]] std::vector<ContactRecord> contacts(double time);
  [[nodiscard]] const Balance& balance() const;
  [[nodiscard]] const BalanceLedger& ledger() const;
  /// Zeros unless the scenario asks for it (Setup::audit).
  [[nodiscard]] EnergyBalance energy() const;
  [[nodiscard]] DemReport report() const;
  /// Tells that drag_relaxation was rewritten (the DEM derives its decay factors from it).
  void drag_relaxation_changed();
  /// What contacts have dissipated since clear_contact_work(); kept where grains carry dust.
  [[nodiscard]] const ContactWork& contact_work() const;
  /// Names of its walls.
  [[nodiscard]] std::vector<std::string> wall_names() const;
  void clear_contact_work();
  /// [kg] by class on a real particle.
  [[nodiscard]] std::span<const double> dust_load(std::size_t row) const;
  /// `mass` [kg] of a class comes off a real particle. Call between coarse steps.
  void set_dust_free(std::size_t row, std::size_t n, double mass);
  /// A real particle catches `mass` [kg] of a class, see DustLoads. Call between coarse steps.
  void take_up_dust(std::size_t row, std::size_t n, double mass);
  [[nodiscard]] DustLoads::Balance dust_balance(std::size_t n) const;
  /// Ends the interval [s] of the wall loads, at `time` [s]; nothing unless they are recorded. Call
  /// between coarse steps.
  sdk::WallColumns close_wall_loads(double interval, double time);
  /// As of the last close.
  [[nodiscard]] sdk::WallColumns wall_loads() const;
  /// Tells that a body was taken away.
  void bodies_changed();

  /// Pairs in the Verlet list as ids (i < j), sorted: for tests against brute force.
  [[nodiscard]] std::vector<std::pair<std::int64_t, std::int64_t>> listed_pairs() const;

  /// The arrays that the phases of a step read and write, by name, as numbers (graph::TaskGraph).
  using Digests = std::map<std::string, std::function<std::uint64_t()>>;
  [[nodiscard]] Digests digests() const;

  /// After synchronise(): no inner pair list is part of it.
  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

  /// What stands in the way of another solver's particles at `time` [s].
  [[nodiscard]] TransferObstacles obstacles_to(const Dem& other, double time);
  /// Takes the particles of another solver, under whatever laws, materials and bodies it has, with
  /// the histories of their contacts; materials, bodies and openings are known by their names.
  /// `laws` by its number of a law. `keeps_dust`: its classes of dust are those here; else each
  /// particle carries what its material brings here. Call before the first step, where nothing
  /// stands in the way, and after the other's synchronise().
  TransferReport transfer_from(const Dem& other, double time, std::span<const LawTransfer> laws,
                               bool keeps_dust = true);

 private:
  class Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dust::particles
