// SPDX-License-Identifier: Apache-2.0
// Rules of emitters: the mass asked for, within the sizes, speeds and times told, and the same
// stream through an interruption.
#include "contract/as_kind.hpp"
#include "contract/memory_archive.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/emitter.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>

namespace dust::contract {
namespace {

constexpr double k_interval = 1e-3;  ///< [s]
constexpr double k_density = 2500.0;
constexpr std::size_t k_enough = 20000;
constexpr std::size_t k_observed = 500;  ///< of them told one by one, spread over the stream

sdk::EmitterContext context_of(int n, const Units& u) {
  sdk::EmitterContext c;
  c.begin = n * k_interval * u.time;
  c.end = (n + 1) * k_interval * u.time;
  c.grain_density = k_density * u.of(sdk::dimension::density);
  c.gravity = {0.0, 0.0, -9.81 * u.of(sdk::dimension::acceleration)};
  c.random = sdk::Random(11, sdk::stream_of("emitter"));
  return c;
}

std::vector<sdk::InsertionRequest> propose(sdk::Emitter& emitter, int first, int last,
                                           const Units& u) {
  std::vector<sdk::InsertionRequest> requests;
  for (int n = first; n < last && requests.size() < k_enough; ++n) {
    emitter.propose(context_of(n, u), requests);
  }
  return requests;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto emitter = make_as<sdk::Emitter>(make, variant.units);
  Observations observations;
  const auto add = [&](const std::string& name, double value, sdk::Dimension dimension) {
    observations.push_back({name, value, dimension});
  };
  const std::vector<sdk::InsertionRequest> requests = propose(*emitter, 0, 50, variant.units);
  add("count", static_cast<double>(requests.size()), sdk::dimension::none);
  // In their sums all of them count.
  sdk::Vec3 way;
  sdk::Vec3 speed;
  double time = 0.0;
  double diameter = 0.0;
  double weight = 0.0;
  for (const sdk::InsertionRequest& s : requests) {
    time += s.time;
    diameter += s.diameter;
    weight += s.weight;
    for (int d = 0; d < 3; ++d) {
      way[d] += std::abs(s.position[d]);
      speed[d] += std::abs(s.velocity[d]);
    }
  }
  add("time of all requests", time, sdk::dimension::time);
  add("diameter of all requests", diameter, sdk::dimension::length);
  add("weight of all requests", weight, sdk::dimension::none);
  for (int d = 0; d < 3; ++d) {
    add("position of all requests", way[d], sdk::dimension::length);
    add("velocity of all requests", speed[d], sdk::dimension::velocity);
  }
  const std::size_t stride = requests.size() / k_observed + 1;
  for (std::size_t n = 0; n < requests.size(); n += stride) {
    const sdk::InsertionRequest& s = requests[n];
    const std::string request = " of request " + std::to_string(n);
    add("time" + request, s.time, sdk::dimension::time);
    for (int d = 0; d < 3; ++d) {
      add("position" + request, s.position[d], sdk::dimension::length);
      add("velocity" + request, s.velocity[d], sdk::dimension::velocity);
    }
    add("diameter" + request, s.diameter, sdk::dimension::length);
    add("weight" + request, s.weight, sdk::dimension::none);
  }
  add("requested_mass_flow", emitter->requested_mass_flow(), sdk::dimension::mass_flow);
  for (const double d : emitter->diameters()) add("diameters", d, sdk::dimension::length);
  add("largest_speed", emitter->largest_speed(), sdk::dimension::velocity);
  return observations;
}

void check_seeds(const Maker& make) {
  const auto emitter = make_as<sdk::Emitter>(make);
  const std::vector<double> sizes = emitter->diameters();
  std::string listed;
  for (const double size : sizes) listed += " " + shown(size) + " m";
  require(!sizes.empty() && std::is_sorted(sizes.begin(), sizes.end()) && sizes.front() > 0.0,
          "diameters() must be positive and ascending, answers" +
              (listed.empty() ? " none" : ":" + listed));
  const double fastest = emitter->largest_speed() * (1.0 + 1e-9);
  std::size_t count = 0;
  for (int n = 0; n < 200 && count < k_enough; ++n) {
    std::vector<sdk::InsertionRequest> requests;
    const sdk::EmitterContext context = context_of(n, {});
    emitter->propose(context, requests);
    count += requests.size();
    for (const sdk::InsertionRequest& s : requests) {
      require(s.time >= context.begin && s.time < context.end,
              "a request for " + shown(s.time) + " s comes in the interval from " +
                  shown(context.begin) + " s to " + shown(context.end) + " s");
      require(
          s.diameter >= sizes.front() * (1.0 - 1e-9) && s.diameter <= sizes.back() * (1.0 + 1e-9),
          "a grain of " + shown(s.diameter) + " m is outside diameters(), " + shown(sizes.front()) +
              " m to " + shown(sizes.back()) + " m");
      require(norm(s.velocity) <= fastest, "a grain starts with " + shown(norm(s.velocity)) +
                                               " m/s, told are " + shown(emitter->largest_speed()));
      require(s.weight > 0.0 && std::isfinite(s.weight),
              "a weight is " + shown(s.weight) + "; expected: finite, above 0");
    }
  }
  require(count > 0, "no grain comes in 0.2 s; give a flow or a beginning with --set");
}

void check_mass(const Maker& make) {
  const auto emitter = make_as<sdk::Emitter>(make);
  const double asked = emitter->requested_mass_flow();
  if (!(asked > 0.0)) throw Remark("it asks for no mass flow");
  double mass = 0.0;
  double largest = 0.0;
  std::size_t count = 0;
  double time = 0.0;
  // Long enough for the last grain not to matter, short enough for coarse and fast streams.
  for (int n = 0; n < 20000 && count < 2 * k_enough; ++n) {
    std::vector<sdk::InsertionRequest> requests;
    emitter->propose(context_of(n, {}), requests);
    count += requests.size();
    for (const sdk::InsertionRequest& s : requests) {
      const double one = s.weight * k_density * sdk::sphere_volume(s.diameter);
      mass += one;
      largest = std::max(largest, one);
    }
    time = (n + 1) * k_interval;
  }
  // Independent draws scatter with the root of their number; streams that carry remainders do
  // better.
  const double scatter = 5.0 * largest * std::sqrt(static_cast<double>(count)) + largest;
  const double tolerance = std::min(scatter, std::max(0.02 * asked * time, 2.0 * largest));
  require(std::abs(mass - asked * time) <= tolerance,
          shown(mass) + " kg came in " + shown(time) + " s, asked for are " + shown(asked * time));
}

void check_restart(const Maker& make) {
  for (const int pause : {0, 1, 17}) {
    const auto whole = make_as<sdk::Emitter>(make);
    auto part = make_as<sdk::Emitter>(make);
    (void)propose(*whole, 0, pause, {});
    (void)propose(*part, 0, pause, {});
    MemoryArchive archive;
    part->save(archive);
    part = make_as<sdk::Emitter>(make);
    part->load(archive);
    const auto a = propose(*whole, pause, pause + 30, {});
    const auto b = propose(*part, pause, pause + 30, {});
    const std::string when = "saved and loaded after " + std::to_string(pause) + " intervals ";
    require(a.size() == b.size(), when + "it gives " + std::to_string(b.size()) +
                                      " requests instead of " + std::to_string(a.size()));
    for (std::size_t n = 0; n < a.size(); ++n) {
      require(a[n].time == b[n].time && a[n].position == b[n].position &&
                  a[n].velocity == b[n].velocity && a[n].diameter == b[n].diameter &&
                  a[n].weight == b[n].weight,
              when + "request " + std::to_string(n) + " differs: a grain of " +
                  shown(b[n].diameter) + " m at " + shown(b[n].time) +
                  " s, expected: " + shown(a[n].diameter) + " m at " + shown(a[n].time) +
                  " s (save and load keep its state)");
    }
  }
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("keeps to the times, sizes and speeds it tells", [&] { check_seeds(make); });
  runner.rule("balances its mass", [&] { check_mass(make); });
  runner.rule("goes on with the same bits when saved and loaded", [&] { check_restart(make); });
}

}  // namespace

Kind emitter_kind() {
  return {.observe = observe,
          .batches = {},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = false,
          .rules = rules};
}

}  // namespace dust::contract
