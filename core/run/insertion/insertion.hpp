// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "preflight/particle_models.hpp"
#include "run/audit/departures.hpp"
#include "run/insertion/emission_ledger.hpp"
#include "run/insertion/entry.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <span>
#include <string>
#include <vector>

namespace dust::run {

/// Particles into the domain: what emitters propose, and what finds a free place.
class Insertion {
 public:
  /// Both are kept by reference.
  Insertion(const scenario::Setup& setup, const preflight::ParticleModels& models);

  /// Lets in what is there before the first step, which then asks no emitter. Throws ModelError
  /// where that is impossible.
  void start(particles::Dem& dem);
  /// Lets in what the emitters propose for a fluid step from `time` [s] on; false: the step's are
  /// in since start().
  bool run(double time, particles::Dem& dem);

  /// Without a run: lets into an empty domain what some of the emitters propose for the fluid step
  /// from `time` [s] on, and out again. Throws ModelError where that is impossible.
  void rehearse(double time, std::span<const std::size_t> emitters);

  /// Particles that had to wait a fluid step or more because their place was taken, and those
  /// waiting.
  [[nodiscard]] std::int64_t delayed() const { return delayed_; }
  [[nodiscard]] const std::vector<InsertionCandidate>& waiting() const { return waiting_; }
  /// [kg] of those of an emitter, with their weights.
  [[nodiscard]] double waiting_mass(std::size_t emitter) const;
  [[nodiscard]] const EmissionLedger& ledger() const { return ledger_; }
  /// Those that have left through open sides.
  [[nodiscard]] const Departures& departures() const { return departures_; }

  /// Goes on from that of another scenario, whose emitters and materials are known by their names.
  /// Returns how many particles that wait for their place are given up, for theirs are not here.
  std::int64_t transfer_from(const Insertion& other);
  /// An emitter of its own passes the time up to `time` [s] as if nobody had looked: what it would
  /// have released is not.
  void pass_time(std::size_t emitter, double time);

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  void insert(double time, particles::Dem& dem);
  [[nodiscard]] sdk::EmitterContext context_of(std::size_t emitter, double begin, double end) const;
  void propose(double time, const particles::GrainRows& rows);
  void propose(std::size_t emitter, double begin, double end, const particles::GrainRows& rows);
  void add_waiting(std::size_t emitter, double begin, const sdk::InsertionRequest& request);

  const scenario::Setup& setup_;
  const preflight::ParticleModels& models_;
  EntryScene scene_;
  EmissionLedger ledger_;
  Departures departures_;
  std::vector<sdk::InsertionRequest> requests_;  ///< storage of what one emitter proposes
  std::vector<InsertionCandidate> waiting_;      ///< proposed, not yet in the domain
  std::int64_t delayed_ = 0;
  bool is_started_ = false;  ///< the first step's particles are in already
};

}  // namespace dust::run
