// SPDX-License-Identifier: Apache-2.0
#include "preflight/stiffness/cohesion_check.hpp"

#include "base/text.hpp"
#include "preflight/stiffness/softness.hpp"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numbers>
#include <string>
#include <variant>
#include <vector>

namespace dust::preflight {
namespace {

using particles::PairLaws;
using scenario::Setup;

constexpr double k_none = std::numeric_limits<double>::infinity();

/// [m] By material; k_none of one that no grains have.
std::vector<double> smallest_diameters(const Setup& setup, const ParticleModels& models) {
  std::vector<double> smallest(setup.materials.size(), k_none);
  for (std::size_t n = 0; n < models.emitters.size(); ++n) {
    const std::vector<double> diameters = models.emitters[n]->diameters();
    if (diameters.empty()) continue;
    const double least = *std::min_element(diameters.begin(), diameters.end());
    const auto note = [&](int material) {
      double& known = smallest[static_cast<std::size_t>(material)];
      known = std::min(known, least);
    };
    note(setup.emitters[n].material);
    for (const int material : setup.emitters[n].more_materials) note(material);
  }
  return smallest;
}

/// The smallest pair that a law may act on.
struct Pair {
  double diameter = k_none;  ///< [m] of the smaller grain
  double radius = k_none;    ///< [m] R*
};

/// Of grains of both materials; where but one of them has grains the other is a wall's.
Pair smallest_pair(const PairLaws& law, const std::vector<double>& diameters) {
  const double i = diameters[static_cast<std::size_t>(law.material_i)];
  const double j = diameters[static_cast<std::size_t>(law.material_j)];
  const double smaller = std::min(i, j);
  if (std::max(i, j) < k_none) return {smaller, 0.5 * i * j / (i + j)};
  return {smaller, 0.5 * smaller};
}

/// [m] Overlap at rest under the law's own attraction, which is that of elastic spheres; where the
/// contact law is another one, that of its spring under the same force.
double overlap_at_rest(const Setup& setup, const PairLaws& law, double radius) {
  const double elastic = law.cohesion->resting_overlap(radius);
  if (law.contact->has_hertz_force()) return elastic;
  const auto& i = setup.materials[static_cast<std::size_t>(law.material_i)].properties;
  const auto& j = setup.materials[static_cast<std::size_t>(law.material_j)].properties;
  const double force = 4.0 / 3.0 * sdk::effective_young_modulus(i, j) * std::sqrt(radius) *
                       elastic * std::sqrt(elastic);
  // Half a period is pi sqrt(m* / k), of any mass.
  const double frequency = std::numbers::pi / law.contact->half_period(radius, 1.0, 0.0);
  return force / (frequency * frequency);
}

void check_rest(const Setup& setup, const PairLaws& law, const scenario::InteractionSpec& spec,
                const Pair& pair, scenario::Diagnostics& diagnostics) {
  const double ratio = overlap_at_rest(setup, law, pair.radius) / pair.radius;
  if (!(ratio > k_deep_at_rest * (1.0 + 1e-6))) return;
  // A force that does not hang on the overlap: by Hertz it goes with E*^(-2/3).
  const double excess = ratio / k_deep_at_rest;
  const std::string advice = law.contact->has_hertz_force()
                                 ? stiffer_materials(setup, spec, excess * std::sqrt(excess))
                                 : "make " + spec.contact.path + " at least " +
                                       base::plain_text(std::ceil(excess * (1.0 - 1e-9)), 3) +
                                       " times as stiff";
  const auto name = [&](int material) {
    return setup.materials[static_cast<std::size_t>(material)].name;
  };
  diagnostics.warning(spec.cohesion->where,
                      spec.cohesion->path + ": grains of " + base::length_text(pair.diameter) +
                          " pull themselves " + base::digits_text(100.0 * ratio, 2) +
                          " % of R* into each other (" + name(spec.material_i) + " on " +
                          name(spec.material_j) + "), where contact laws hold up to some " +
                          base::digits_text(100.0 * k_deep_at_rest, 2) + " %: " + advice +
                          ", or a weaker attraction");
}

/// `volume` of a law that has `relative_volume`, too: the same limit holds for both. The reading of
/// scenarios knows the two names, too (take_moisture).
void check_volume(const scenario::InteractionSpec& spec, const Pair& pair,
                  const registry::Registry& registry, scenario::Diagnostics& diagnostics) {
  const registry::Entry* entry = registry.find("cohesion", spec.cohesion->name);
  if (entry == nullptr) return;
  const auto& parameters = entry->info.parameters;
  const auto relative =
      std::ranges::find(parameters, std::string("relative_volume"), &sdk::Parameter::name);
  const auto absolute = std::ranges::find(parameters, std::string("volume"), &sdk::Parameter::name);
  if (relative == parameters.end() || absolute == parameters.end()) return;
  const auto at = static_cast<std::size_t>(absolute - parameters.begin());
  if (at >= spec.cohesion->values.size()) return;
  const double* volume = std::get_if<double>(&spec.cohesion->values[at]);
  const double unit = std::pow(2.0 * pair.radius, 3);
  const double largest = relative->range.high;
  if (volume == nullptr || !(*volume > largest * unit * (1.0 + 1e-9))) return;
  const auto cubic_millimetres = [](double v) { return base::digits_text(1e9 * v, 3) + " mm3"; };
  diagnostics.error(
      spec.cohesion->where,
      spec.cohesion->path + ".volume: " + cubic_millimetres(*volume) + " is " +
          base::plain_text(*volume / unit, 3) + " (2 R*)^3 of the smallest pair (R* " +
          base::length_text(pair.radius) + "); bridges are small and apart from each other up to " +
          base::digits_text(largest, 3) + ": give at most " + cubic_millimetres(largest * unit) +
          ", or relative_volume, which gives each pair a bridge of its size");
}

}  // namespace

void check_cohesion(const Setup& setup, const ParticleModels& models,
                    const registry::Registry& registry, scenario::Diagnostics& diagnostics) {
  const std::vector<double> diameters = smallest_diameters(setup, models);
  for (std::size_t n = 0; n < models.laws.size(); ++n) {
    const scenario::InteractionSpec& spec = setup.interactions[n];
    const Pair pair = smallest_pair(models.laws[n], diameters);
    if (!spec.cohesion || !(pair.radius < k_none)) continue;
    check_volume(spec, pair, registry, diagnostics);
    check_rest(setup, models.laws[n], spec, pair, diagnostics);
  }
}

}  // namespace dust::preflight
