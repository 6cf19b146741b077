// SPDX-License-Identifier: Apache-2.0
#include "preflight/stiffness/softness.hpp"

#include "base/text.hpp"
#include "dust/sdk/sphere.hpp"
#include "particles/time_steps.hpp"

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>
#include <string>

namespace dust::preflight {
namespace {

using particles::PairLaws;
using scenario::Setup;
using sdk::MaterialProperties;

/// \f$ v t_c / \delta \f$ of an elastic impact by Hertz.
constexpr double k_hertz_duration = 2.9432;
/// [kg/m3] Grains heavier than any material are meant to stay where they are: a bed that air goes
/// through, for its drag.
constexpr double k_fixed = 1e5;
/// Below this modulus [Pa] the unit is asked for: no grain is as soft as 10 kPa.
constexpr double k_hardly_meant = 1e4;

const MaterialProperties& properties_of(const Setup& setup, int material) {
  return setup.materials[static_cast<std::size_t>(material)].properties;
}

const std::string& name_of(const Setup& setup, int material) {
  return setup.materials[static_cast<std::size_t>(material)].name;
}

/// Materials that grains have, and those of bodies and walls.
struct Kinds {
  std::set<int> of_grains, of_walls;

  explicit Kinds(const Setup& setup) : of_grains(particles::grain_materials(setup)) {
    for (const auto& body : setup.bodies) of_walls.insert(body.material);
    for (const auto& side : setup.domain.sides) {
      if (side.grains == scenario::GrainSide::wall) of_walls.insert(side.material);
    }
  }
};

double overlap_of(const PairLaws& law, double radius, double mass, double speed) {
  const double scale = law.contact->has_hertz_force() ? k_hertz_duration : std::numbers::pi;
  return speed * law.contact->collision_time(radius, mass, speed) / scale;
}

/// [m] The largest overlap of grains of `diameter` and material `m` with what has `other`.
double largest_overlap(const Setup& setup, const ParticleModels& models, const Kinds& kinds,
                       const PairLaws& law, const ImpactOverlap& grain, int m, int other) {
  const double d = grain.diameter;
  const double mass = properties_of(setup, m).density * sdk::sphere_volume(d);
  double overlap = 0.0;
  if (kinds.of_walls.contains(other)) overlap = overlap_of(law, 0.5 * d, mass, grain.speed);
  if (!kinds.of_grains.contains(other)) return overlap;
  for (const double partner : {d, models.class_diameters.back()}) {
    const double partner_mass = properties_of(setup, other).density * sdk::sphere_volume(partner);
    overlap =
        std::max(overlap, overlap_of(law, 0.5 * d * partner / (d + partner),
                                     mass * partner_mass / (mass + partner_mass), grain.speed));
  }
  return overlap;
}

/// Steps that an impact lasts, ImpactOverlap::steps: they are made for the expected speed, and a
/// collision by Hertz lasts as long as v^(-1/5).
double steps_of(const ImpactOverlap& impact, const particles::TimeSteps& steps) {
  if (!impact.is_hertz) return 0.0;
  const auto size =
      std::find_if(steps.classes.begin(), steps.classes.end(),
                   [&](const particles::ClassStep& c) { return c.diameter == impact.diameter; });
  if (size == steps.classes.end()) return 0.0;
  return size->hertz_time * std::pow(impact.speed / steps.expected_speed, -0.2) /
         steps.step_of(*size);
}

/// "at least 12 MPa": rounded up to two digits.
std::string modulus_text(double pascal) {
  const double step = std::pow(10.0, std::floor(std::log10(pascal)) - 1.0);
  const double rounded = step * std::ceil(pascal / step * (1.0 - 1e-9));
  if (rounded >= 1e9) return base::plain_text(rounded / 1e9, 2) + " GPa";
  if (rounded >= 1e6) return base::digits_text(rounded / 1e6, 3) + " MPa";
  if (rounded >= 1e3) return base::digits_text(rounded / 1e3, 3) + " kPa";
  return base::digits_text(rounded, 3) + " Pa";
}

/// "12 % of their radius", "83 times their radius".
std::string overlap_text(double ratio) {
  if (ratio < 1.0) return base::digits_text(100.0 * ratio, 2) + " % of their radius";
  return base::plain_text(ratio, 2) + " times their radius";
}

}  // namespace

ImpactOverlap softest_impact(const Setup& setup, const ParticleModels& models, double speed) {
  ImpactOverlap softest{.speed = speed};
  const Kinds kinds(setup);
  for (const double diameter : models.class_diameters) {
    const ImpactOverlap grain{.diameter = diameter, .speed = speed};
    for (std::size_t n = 0; n < models.laws.size(); ++n) {
      const PairLaws& law = models.laws[n];
      const auto look = [&](int m, int other) {
        if (!kinds.of_grains.contains(m) || properties_of(setup, m).density > k_fixed) return;
        const double ratio =
            2.0 * largest_overlap(setup, models, kinds, law, grain, m, other) / diameter;
        if (ratio > softest.ratio * (1.0 + 1e-9)) {
          softest = {.ratio = ratio,
                     .diameter = diameter,
                     .speed = speed,
                     .interaction = n,
                     .is_hertz = law.contact->has_hertz_force()};
        }
      };
      look(law.material_i, law.material_j);
      look(law.material_j, law.material_i);
    }
  }
  return softest;
}

std::string stiffer_materials(const Setup& setup, const scenario::InteractionSpec& pair,
                              double factor) {
  const bool is_first_softer = properties_of(setup, pair.material_i).young_modulus <=
                               properties_of(setup, pair.material_j).young_modulus;
  const int soft = is_first_softer ? pair.material_i : pair.material_j;
  const int hard = is_first_softer ? pair.material_j : pair.material_i;
  const MaterialProperties& a = properties_of(setup, soft);
  const MaterialProperties& b = properties_of(setup, hard);
  const auto share = [](const MaterialProperties& p) {
    return 1.0 - p.poisson_ratio * p.poisson_ratio;
  };
  const double wanted = factor * sdk::effective_young_modulus(a, b);
  const double alone = share(a) / (1.0 / wanted - share(b) / b.young_modulus);
  const bool is_enough = soft != hard && alone > 0.0 && alone <= b.young_modulus;
  std::string text = "give materials." + name_of(setup, soft) + ".young_modulus";
  if (soft != hard && !is_enough) text += " and that of " + name_of(setup, hard);
  text += " at least " + modulus_text(is_enough ? alone : wanted * (share(a) + share(b)));
  if (a.young_modulus < k_hardly_meant) {
    text += " (it is " + modulus_text(a.young_modulus) + ": was MPa meant?)";
  }
  return text;
}

std::string stiffness_advice(const Setup& setup, const ImpactOverlap& impact) {
  // The overlap goes with E*^(-2/5) by Hertz, with k^(-1/2) of a linear spring.
  const double excess = impact.ratio / k_soft_overlap;
  const double factor = std::pow(excess, impact.is_hertz ? 2.5 : 2.0);
  const scenario::InteractionSpec& pair = setup.interactions[impact.interaction];
  if (impact.is_hertz) return stiffer_materials(setup, pair, factor);
  return "make " + pair.contact.path + " at least " + base::plain_text(std::ceil(factor), 3) +
         " times as stiff";
}

ImpactOverlap expected_impact(const Setup& setup, const ParticleModels& models,
                              const registry::Registry& registry) {
  if (models.class_diameters.empty()) return {};
  const particles::TimeSteps steps = particles::time_steps(
      setup, models.bodies, models.laws, models.class_diameters, models.release_speed);
  const double of_steps = steps.expected_speed;
  const Fall fall = largest_fall(setup, models.bodies, registry);
  // What the scenario says of its grains holds.
  const bool is_of_fall = !(setup.time.expected_speed > 0.0) && fall.speed > of_steps;
  ImpactOverlap impact = softest_impact(setup, models, of_steps);
  const double ratio_in_stream = impact.ratio;
  if (is_of_fall) impact = softest_impact(setup, models, fall.speed);
  impact.ratio_in_stream = ratio_in_stream;
  impact.fall = fall;
  impact.is_of_fall = is_of_fall;
  impact.steps = steps_of(impact, steps);
  return impact;
}

std::string impact_speed_text(const ImpactOverlap& impact) {
  return base::digits_text(impact.speed, 3) + " m/s" +
         (impact.is_of_fall ? ", after a fall of " + base::length_text(impact.fall.height, 3) : "");
}

void check_softness(const Setup& setup, const ParticleModels& models,
                    const registry::Registry& registry, scenario::Diagnostics& diagnostics) {
  const ImpactOverlap impact = expected_impact(setup, models, registry);
  if (!(std::max(impact.ratio, impact.ratio_in_stream) > k_warned_overlap)) return;
  const scenario::InteractionSpec& pair = setup.interactions[impact.interaction];
  diagnostics.warning(
      pair.contact.where,
      pair.contact.path + ": grains of " + base::length_text(impact.diameter) + " overlap by " +
          overlap_text(impact.ratio) + " in an impact at " + impact_speed_text(impact) + " (" +
          name_of(setup, pair.material_i) + " on " + name_of(setup, pair.material_j) +
          "), which is too soft: " +
          (impact.ratio < 1.0 ? "contacts last long, and loads press grains deep into each other"
                              : "they go through each other and through walls") +
          "; for " + base::digits_text(100.0 * k_soft_overlap, 2) + " % " +
          stiffness_advice(setup, impact) +
          (impact.is_of_fall ? ", or say by time.expected_speed how fast they meet if something "
                               "breaks their fall"
                             : ", or a lower time.expected_speed if they meet more slowly"));
}

}  // namespace dust::preflight
