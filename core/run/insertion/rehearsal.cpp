// SPDX-License-Identifier: Apache-2.0
#include "run/insertion/rehearsal.hpp"

#include "base/error.hpp"
#include "dust/sdk/error.hpp"
#include "preflight/emissions.hpp"
#include "preflight/particle_models.hpp"
#include "preflight/places/release_check.hpp"
#include "registry/guard_report.hpp"
#include "run/insertion/insertion.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <map>
#include <vector>

namespace dust::run {
namespace {

/// Placed within a second, however tight the region is.
constexpr double k_quickly_placed = 4e4;
/// The same of grains whose places are given.
constexpr double k_quickly_looked_at = 4e5;

/// Emitters to ask, by the number of the fluid step that they are asked in.
using Asked = std::map<std::int64_t, std::vector<std::size_t>>;

bool is_quick(const preflight::EmissionNumbers& numbers, const sdk::Emitter& emitter) {
  const bool is_listed = emitter.request().shares.empty();
  return numbers.at_once <= (is_listed ? k_quickly_looked_at : k_quickly_placed);
}

Asked emitters_to_ask(const scenario::Setup& setup, const preflight::ParticleModels& models,
                      const preflight::Derived& derived, double begin) {
  constexpr double k_step_rounding = 1e-6;
  Asked asked;
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const preflight::EmissionNumbers& numbers = derived.emissions[n];
    if (!(numbers.at_once > 0.0 && numbers.begin >= begin)) continue;
    if (!is_quick(numbers, *models.emitters[n])) continue;
    const double steps = std::floor(numbers.begin / setup.time.fluid_step + k_step_rounding);
    asked[static_cast<std::int64_t>(steps)].push_back(n);
  }
  return asked;
}

/// Streams that let in grains beside those that are there before the first step, in their order.
void add_streams(const scenario::Setup& setup, const preflight::ParticleModels& models,
                 std::vector<std::size_t>& asked) {
  std::vector<std::size_t> all;
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const bool is_asked = std::find(asked.begin(), asked.end(), n) != asked.end();
    const sdk::Emitter& emitter = *models.emitters[n];
    const bool is_stream = emitter.insertion_rule().waits &&
                           !preflight::brings_too_many(setup, setup.emitters[n], emitter);
    if (is_asked || is_stream) all.push_back(n);
  }
  asked = std::move(all);
}

void remove_bodies_by(const scenario::Setup& setup, double time, bodies::BodySet& bodies) {
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    if (bodies[b].is_removed()) continue;
    if (preflight::may_be_gone(setup.bodies[b], time, setup.time.fluid_step)) {
      bodies[b].removed_at = time;
    }
  }
}

}  // namespace

void rehearse_placing(const scenario::Setup& setup, const registry::Registry& registry,
                      const preflight::Derived& derived, double begin) {
  // Models of large meshes take time to make: not for streams alone.
  const auto comes_at_once = [&](const auto& e) { return e.at_once > 0.0 && e.begin >= begin; };
  if (std::none_of(derived.emissions.begin(), derived.emissions.end(), comes_at_once)) return;
  preflight::ParticleModels models = preflight::make_particle_models(setup, registry);
  Asked asked = emitters_to_ask(setup, models, derived, begin);
  if (begin == 0.0 && asked.contains(0)) add_streams(setup, models, asked[0]);
  Insertion insertion(setup, models);
  try {
    for (const auto& [step, emitters] : asked) {
      const double time = static_cast<double>(step) * setup.time.fluid_step;
      // A run lets in the first before it takes away anything.
      if (step > 0) remove_bodies_by(setup, time, models.bodies);
      insertion.rehearse(time, emitters);
    }
  } catch (const registry::PlacedFault& e) {
    throw base::UserError(e.line());
  } catch (const sdk::ModelError& e) {
    throw base::UserError(e.what());
  }
}

}  // namespace dust::run
