// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/transfer/transfer.hpp"
#include "registry/registry.hpp"
#include "run/branch/comparison.hpp"
#include "run/models.hpp"
#include "run/simulation.hpp"
#include "run/summary/summary.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/reader.hpp"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// A scenario that starts from the state of another run (docs/how_to/branch_a_run.md).
///
/// Where both scenarios say the same, all of the state is loaded, and the run goes on with the same
/// bits as if it had not been cut. Where they differ, each owner takes what still means something
/// to it: particles with the histories of their contacts, the fluid on the same grid, statistics of
/// sensors that are the same. The rest is told.
class Branch {
 public:
  /// Reads the other run's scenario; `now` and `registry` are kept by reference, `inputs` is what
  /// stands in the files of `now`. What cannot be goes to `diagnostics`.
  Branch(const scenario::ReadResult& now, const std::vector<io::InputFile>& inputs,
         const registry::Registry& registry, scenario::Diagnostics& diagnostics);

  [[nodiscard]] const Origin& origin() const { return both_.origin(); }
  /// Whether the scenarios differ in nothing that the state depends on.
  [[nodiscard]] bool is_same() const { return both_.is_same(); }
  /// How many particles the other run's state holds.
  [[nodiscard]] std::int64_t particles_there() const;
  /// Names of the sensors that go on with what they have seen of the other run.
  [[nodiscard]] const std::vector<std::string>& sensors_going_on() const {
    return sensors_going_on_;
  }
  /// What began with this run or with one that it comes from: hoods, emitters, dust.
  [[nodiscard]] const CountsBefore& before() const { return before_; }
  /// Adds the sizes of the particles that come along.
  void add_diameters(Models& models) const;
  /// Takes away the bodies that the other run had taken away, looks for what is in the way of its
  /// particles, and tells what will begin anew.
  void check(Models& models, particles::Dem& particles);
  /// Gives the state to a simulation that has not started. Throws base::UserError with what is in
  /// the way, before anything is given.
  void give_to(Simulation& simulation);

  /// What came along; after give_to().
  [[nodiscard]] const particles::TransferReport& report() const { return report_; }

 private:
  void check_time();
  void check_domain();
  void report_models();
  void check_emitters(const Models& models);
  /// Those whose settings are not, or had not been, the same since the very beginning: what they
  /// had brought by now was not asked for by these.
  void note_changed_emitters(const CountsBefore& then, const Insertion& insertion);
  /// Both that and since when the plant is as it is, after all has been given.
  void note_counts(const Simulation& simulation);
  void report_obstacles(const particles::TransferObstacles& obstacles);
  void error(const std::string& text) { diagnostics_.error(start().where, "start_from: " + text); }
  void warn(const std::string& text) { diagnostics_.warning(start().where, "start_from: " + text); }
  [[nodiscard]] const scenario::StartSpec& start() const { return *now_.start.from; }
  [[nodiscard]] std::vector<particles::LawTransfer> laws() const;
  void check_pairs(const std::vector<std::string>& materials);
  Models& their_models();
  particles::Dem& their_particles();

  void transfer(const Simulation::Owners& to);
  void transfer_bodies(Models& models);
  void transfer_particles(const Simulation::Owners& to);
  void transfer_insertion(const Simulation::Owners& to);
  void transfer_liberation(const Simulation::Owners& to);
  void transfer_sensors(Models& models);
  void report_sensors_anew(const Models& models);
  void report_grains_anew();
  [[nodiscard]] bool keeps_emitter(const scenario::EmitterSpec& emitter) const;
  [[nodiscard]] bool keeps_dust_on_grains() const;

  Comparison both_;
  const scenario::ReadResult& now_;
  const registry::Registry& registry_;
  scenario::Diagnostics& diagnostics_;
  bool is_same_world_ = false;  ///< but for what lets things in and what looks at them
  std::optional<Models> their_models_;
  std::unique_ptr<particles::Dem> their_particles_;
  particles::TransferReport report_;
  std::vector<std::string> sensors_going_on_;
  CountsBefore before_;
};

}  // namespace dust::run
