// SPDX-License-Identifier: Apache-2.0
#include "preflight/emissions.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "dust/sdk/random.hpp"
#include "dust/sdk/sphere.hpp"
#include "preflight/journey.hpp"
#include "setup/mark.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace dust::preflight {
namespace {

/// Grains of a stream that are followed through the domain.
constexpr std::size_t k_followed = 12;
/// A filling of more grains is not placed for a look.
constexpr std::int64_t k_soon_placed = 5000;

using scenario::EmitterSpec;
using scenario::Setup;
using Requests = std::vector<sdk::InsertionRequest>;

double density_of(const Setup& setup, const EmitterSpec& spec) {
  return setup.materials[static_cast<std::size_t>(spec.material)].properties.density;
}

/// [kg] of real grains, by material.
std::vector<double> masses_of(const Setup& setup, const EmitterSpec& spec,
                              const Requests& requests) {
  std::vector<double> masses(setup.materials.size(), 0.0);
  for (const sdk::InsertionRequest& one : requests) {
    const int own = one.material < 0
                        ? spec.material
                        : spec.more_materials.at(static_cast<std::size_t>(one.material));
    const auto m = static_cast<std::size_t>(own);
    masses[m] +=
        one.weight * setup.materials[m].properties.density * sdk::sphere_volume(one.diameter);
  }
  return masses;
}

std::vector<double> shares_of(std::vector<double> masses) {
  const double all = std::accumulate(masses.begin(), masses.end(), 0.0);
  for (double& mass : masses) mass = all > 0.0 ? mass / all : 0.0;
  return masses;
}

/// [kg] of a grain on average; 0 where the emitter does not say which sizes come.
double mean_mass(const sdk::EmitterRequest& request, double density) {
  double mass = 0.0;
  double all = 0.0;
  for (const auto& share : request.shares) {
    mass += share.number_fraction * density * sdk::sphere_volume(share.diameter);
    all += share.number_fraction;
  }
  return all > 0.0 ? mass / all : 0.0;
}

/// In the domain's frame.
sdk::InsertionRequest placed(const Setup& setup, const EmitterSpec& spec,
                             sdk::InsertionRequest grain) {
  if (spec.frame < 0) return grain;
  const scenario::FrameSpec& frame = setup.frames[static_cast<std::size_t>(spec.frame)];
  const sdk::Vec3 axis = frame.axis / norm(frame.axis);
  grain.position = frame.origin + rotate(grain.position - frame.origin, axis, frame.angle);
  grain.velocity = rotate(grain.velocity, axis, frame.angle);
  return grain;
}

/// [m] Largest horizontal spread of where grains come in, square to their way; 0 for a point.
double width_of(const Setup& setup, const Requests& requests) {
  const double g = norm(setup.gravity);
  const sdk::Vec3 up = g > 0.0 ? -setup.gravity / g : sdk::Vec3{0, 0, 1};
  double width = 0.0;
  for (int d = 0; d < 3; ++d) {
    sdk::Vec3 axis;
    axis[d] = 1.0;
    if (std::abs(dot(axis, up)) > 0.7) continue;
    const sdk::Vec3 v = requests.front().velocity;
    if (std::abs(dot(axis, v)) > 0.7 * norm(v) && norm(v) > 0.0) continue;
    const auto [least, most] = std::minmax_element(
        requests.begin(), requests.end(),
        [d](const auto& a, const auto& b) { return a.position[d] < b.position[d]; });
    width = std::max(width, most->position[d] - least->position[d]);
  }
  return width;
}

void count_sizes(const Requests& requests, EmissionNumbers& numbers) {
  std::map<double, double> shares;
  for (const auto& one : requests) shares[one.diameter] += 1.0;
  for (const auto& [diameter, count] : shares) {
    numbers.sizes.push_back({diameter, count / static_cast<double>(requests.size())});
  }
}

/// How long grains stay, and how thick they lie where they are carried.
void follow_some(const Setup& setup, const bodies::BodySet& bodies, const EmitterSpec& spec,
                 const Requests& requests, EmissionNumbers& numbers) {
  double moving = 0.0;
  double carried = 0.0;
  double way = 0.0;
  numbers.on_body.assign(bodies.size(), 0.0);
  const std::size_t count = std::min(k_followed, requests.size());
  if (count > 0) numbers.first_touch = std::numeric_limits<double>::infinity();
  for (std::size_t n = 0; n < count; ++n) {
    const auto& grain = requests[n * requests.size() / count];
    const Journey j =
        follow_grain(setup, bodies, placed(setup, spec, grain), setup.time.end - numbers.begin);
    numbers.stays.push_back(j.duration);
    numbers.first_touch = std::min(numbers.first_touch, j.first_touch);
    moving += std::isfinite(j.duration) ? j.duration : j.carried;
    carried += j.carried;
    way += j.carried_way;
    for (std::size_t b = 0; b < bodies.size(); ++b) numbers.on_body[b] += j.on_body[b];
  }
  if (moving > 0.0) numbers.carried_share = carried / moving;
  for (double& share : numbers.on_body) share = moving > 0.0 ? share / moving : 0.0;
  const double width = width_of(setup, requests);
  if (!(way > 0.0 && width > 0.0)) return;
  const double speed = way / carried;
  numbers.thickness = numbers.mass_flow / density_of(setup, spec) / (speed * width);
}

/// Lets a fresh emitter propose the grains of a short time from `request.begin` on; `step` [s] at a
/// time, until these are `enough`.
double propose(const Setup& setup, const EmitterSpec& spec, double step,
               const sdk::EmitterRequest& request, sdk::Emitter& emitter, Requests& requests,
               std::size_t enough = k_many_proposals) {
  constexpr int k_max_steps = 50;
  const double end = std::min(setup.time.end, request.end);
  double time = request.begin;
  const double stop = std::min(end, time + k_max_steps * setup.time.fluid_step);
  while (time < stop && requests.size() < enough) {
    sdk::EmitterContext context;
    context.begin = time;
    context.end = time + step;
    context.grain_density = density_of(setup, spec);
    context.gravity = setup.gravity;
    context.random = sdk::Random(setup.seed, sdk::stream_of(spec.name.c_str()));
    try {
      emitter.propose(context, requests);
    } catch (const std::exception& e) {
      throw base::UserError(scenario::place(spec.model.where) + ": error: " + spec.model.path +
                            ": " + e.what());
    }
    time = context.end;
  }
  return time - request.begin;
}

/// [s] In which a stream brings no more grains than can be placed quickly, or `at_a_time`.
double step_of(const Setup& setup, const EmitterSpec& spec, const sdk::EmitterRequest& request,
               std::size_t at_a_time = k_many_proposals) {
  constexpr double k_at_a_time = 5000.0;
  const double mass = mean_mass(request, density_of(setup, spec));
  const double per_second = mass > 0.0 ? request.mass_flow / mass : 0.0;
  if (!(per_second > 0.0)) return setup.time.fluid_step;
  return std::min(setup.time.fluid_step,
                  std::min(k_at_a_time, static_cast<double>(at_a_time)) / per_second);
}

/// [kg] by material of grains at once whose sizes the emitter does not say; of very many, none.
std::vector<double> masses_seen(const Setup& setup, const EmitterSpec& spec,
                                const sdk::EmitterRequest& request, sdk::Emitter& emitter) {
  constexpr std::int64_t k_drawn_one_by_one = 5000;
  Requests requests;
  if (request.count <= k_drawn_one_by_one) {
    propose(setup, spec, step_of(setup, spec, request), request, emitter, requests);
  }
  return masses_of(setup, spec, requests);
}

void take_sizes(const sdk::EmitterRequest& request, EmissionNumbers& numbers) {
  double all = 0.0;
  for (const auto& share : request.shares) all += share.number_fraction;
  for (const auto& share : request.shares) {
    numbers.sizes.push_back({share.diameter, share.number_fraction / all});
  }
}

}  // namespace

bool brings_too_many(const Setup& setup, const EmitterSpec& spec, const sdk::Emitter& emitter) {
  constexpr double k_too_many = 2e5;
  const auto request = emitter.request();
  const double mass = mean_mass(request, density_of(setup, spec));
  return mass > 0.0 && request.mass_flow / mass * setup.time.fluid_step > k_too_many;
}

void check_numbers(const Setup& setup, const ParticleModels& models,
                   scenario::Diagnostics& diagnostics) {
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const EmitterSpec& spec = setup.emitters[n];
    if (!brings_too_many(setup, spec, *models.emitters[n])) continue;
    const auto request = models.emitters[n]->request();
    const double per_second = request.mass_flow / mean_mass(request, density_of(setup, spec));
    diagnostics.warning(
        spec.model.where,
        spec.model.path + ": brings some " + base::exponent_text(per_second, 1) +
            " grains a second, and a run of millions in all takes days: give larger sizes, "
            "a coarse_graining of its material, or the fine ones as dust.field");
  }
}

std::vector<sdk::InsertionRequest> proposals(const Setup& setup, const EmitterSpec& spec,
                                             sdk::Emitter& emitter, std::size_t enough) {
  const auto request = emitter.request();
  Requests requests;
  propose(setup, spec, step_of(setup, spec, request, enough), request, emitter, requests, enough);
  for (auto& one : requests) one = placed(setup, spec, one);
  return requests;
}

std::vector<std::vector<sdk::InsertionRequest>> first_grains(const Setup& setup,
                                                             ParticleModels& models,
                                                             bool has_fillings) {
  std::vector<std::vector<sdk::InsertionRequest>> all(models.emitters.size());
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    sdk::Emitter& emitter = *models.emitters[n];
    const sdk::EmitterRequest request = emitter.request();
    const bool is_soon_placed =
        has_fillings && request.mass == 0.0 && request.count <= k_soon_placed;
    if (!emitter.insertion_rule().waits && !is_soon_placed) continue;
    // Nobody could let so many in, and to look at the first of them takes as long as that.
    if (brings_too_many(setup, setup.emitters[n], emitter)) continue;
    all[n] = proposals(setup, setup.emitters[n], emitter);
  }
  return all;
}

EmissionNumbers count_grains(const Setup& setup, const bodies::BodySet& bodies,
                             const EmitterSpec& spec, sdk::Emitter& emitter) {
  EmissionNumbers numbers;
  numbers.emitter = spec.name;
  numbers.mass_flow = emitter.requested_mass_flow();
  const auto request = emitter.request();
  numbers.begin = request.begin;
  numbers.end = request.end;
  const double mass = mean_mass(request, density_of(setup, spec));
  const auto own = static_cast<std::size_t>(spec.material);
  numbers.mass_at_once.assign(setup.materials.size(), 0.0);
  numbers.stream_shares.assign(setup.materials.size(), 0.0);
  numbers.stream_shares[own] = 1.0;
  // Grains of several materials have to be seen one by one.
  if (!emitter.insertion_rule().waits && spec.more_materials.empty() &&
      (request.count > 0 || (request.mass > 0.0 && mass > 0.0))) {
    numbers.at_once =
        request.count > 0 ? static_cast<double>(request.count) : std::round(request.mass / mass);
    numbers.volume_at_once = numbers.at_once * mass / density_of(setup, spec);
    numbers.mass_at_once[own] = numbers.at_once * mass;
    if (!(mass > 0.0)) numbers.mass_at_once = masses_seen(setup, spec, request, emitter);
    take_sizes(request, numbers);
    return numbers;
  }
  if (brings_too_many(setup, spec, emitter)) {  // counted by shares alone
    const double per_second = request.mass_flow / mass;
    numbers.real_per_second = per_second;
    numbers.computed_per_second = per_second;
    take_sizes(request, numbers);
    numbers.stays = {std::numeric_limits<double>::infinity()};
    return numbers;
  }
  Requests requests;
  const double duration =
      propose(setup, spec, step_of(setup, spec, request), request, emitter, requests);
  if (!(duration > 0.0) || requests.empty()) return numbers;
  count_sizes(requests, numbers);
  std::vector<double> masses = masses_of(setup, spec, requests);
  if (!emitter.insertion_rule().waits) {
    numbers.at_once = static_cast<double>(requests.size());
    for (std::size_t m = 0; m < masses.size() && !spec.more_materials.empty(); ++m) {
      numbers.volume_at_once += masses[m] / setup.materials[m].properties.density;
    }
    numbers.mass_at_once = std::move(masses);
    return numbers;
  }
  numbers.stream_shares = shares_of(std::move(masses));
  for (const sdk::InsertionRequest& one : requests) numbers.real_per_second += one.weight;
  numbers.real_per_second /= duration;
  numbers.computed_per_second = static_cast<double>(requests.size()) / duration;
  follow_some(setup, bodies, spec, requests, numbers);
  return numbers;
}

}  // namespace dust::preflight
