// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/emitter.hpp"
#include "preflight/particle_models.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <cstddef>
#include <limits>
#include <string>
#include <vector>

namespace dust::preflight {

/// What an emitter sends.
struct EmissionNumbers {
  /// Computed grains of one size.
  struct Size {
    double diameter = 0.0;  ///< [m]
    double share = 0.0;     ///< of their number
  };
  std::string emitter;
  double mass_flow = 0.0;            ///< [kg/s] as asked for
  double computed_per_second = 0.0;  ///< grains the engine follows
  double real_per_second = 0.0;      ///< the same, counted with their weights
  double at_once = 0.0;              ///< computed grains that come at one moment
  double volume_at_once = 0.0;       ///< [m3] of them; 0 where their sizes are not known
  /// [kg] of them, and of the stream its share by mass [-]: by index into Setup::materials.
  std::vector<double> mass_at_once, stream_shares;
  std::vector<Size> sizes;  ///< ascending; empty where they are not known
  double begin = 0.0;       ///< [s] of a stream, or when those at once come
  double end = std::numeric_limits<double>::infinity();
  /// [s] that grains of a stream stay, of a sample of them; infinite for those that never leave.
  std::vector<double> stays;
  /// [s] after its begin, when the first of them meets something; 0 where none is followed.
  double first_touch = 0.0;
  double carried_share = 0.0;   ///< of the time they move, on bodies and walls
  std::vector<double> on_body;  ///< share of that time on each body
  double thickness = 0.0;       ///< [m] of the solids where they are carried, without pores
};

/// Whether a stream brings more grains per fluid step than any run can follow: placing them for a
/// look takes long.
bool brings_too_many(const scenario::Setup& setup, const scenario::EmitterSpec& spec,
                     const sdk::Emitter& emitter);

/// Warns of such streams.
void check_numbers(const scenario::Setup& setup, const ParticleModels& models,
                   scenario::Diagnostics& diagnostics);

/// As many tell what a stream is like.
inline constexpr std::size_t k_many_proposals = 20000;

/// Grains that a fresh emitter proposes in the first steps of its stream, or at once, where they
/// come in, in the domain's frame: no more steps once these are `enough`.
std::vector<sdk::InsertionRequest> proposals(const scenario::Setup& setup,
                                             const scenario::EmitterSpec& spec,
                                             sdk::Emitter& emitter,
                                             std::size_t enough = k_many_proposals);

/// The grains that each emitter proposes first: of streams, and where `has_fillings` of those that
/// come at once, unless they are so many that placing them takes time. The emitters have proposed
/// them then.
std::vector<std::vector<sdk::InsertionRequest>> first_grains(const scenario::Setup& setup,
                                                             ParticleModels& models,
                                                             bool has_fillings);

/// Counts what an emitter sends: from what it says of itself, where that is enough, else from what
/// it proposes. `bodies` carry the grains.
EmissionNumbers count_grains(const scenario::Setup& setup, const bodies::BodySet& bodies,
                             const scenario::EmitterSpec& spec, sdk::Emitter& emitter);

}  // namespace dust::preflight
