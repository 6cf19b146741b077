// SPDX-License-Identifier: Apache-2.0
#include "preflight/places/reach_check.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <string>

namespace dust::preflight {
namespace {

void check_period(const scenario::Setup& setup, const ParticleModels& models, int d,
                  scenario::Diagnostics& diagnostics) {
  const auto side = static_cast<std::size_t>(2 * d);
  if (setup.domain.sides[side].grains != scenario::GrainSide::periodic) return;
  const double diameter = models.class_diameters.back();
  const double period = setup.domain.max[d] - setup.domain.min[d];
  double reach = 0.0;
  for (const particles::PairLaws& law : models.laws) {
    reach = std::max(reach, law.range_of(0.25 * diameter));  // R* of two of the largest
  }
  // Without a reach scenario/reader.cpp asks for more.
  const double wanted = 2.0 * (diameter + reach);
  if (period > wanted || reach == 0.0) return;
  diagnostics.error(setup.domain.sides[side].where,
                    "domain: " + base::length_text(period) + " between the periodic sides " +
                        scenario::k_side_names[side] + " and " + scenario::k_side_names[side + 1] +
                        " are too little for laws that reach " + base::length_text(reach) +
                        " beyond touch: two grains would act on each other on both sides at once; "
                        "make it more than " +
                        base::length_text(wanted) +
                        ", twice the largest grain's diameter and that reach");
}

}  // namespace

void check_reach(const scenario::Setup& setup, const ParticleModels& models,
                 scenario::Diagnostics& diagnostics) {
  if (models.class_diameters.empty()) return;
  for (int d = 0; d < 3; ++d) check_period(setup, models, d, diagnostics);
  const double smallest = models.class_diameters.front();
  for (std::size_t n = 0; n < models.laws.size(); ++n) {
    const auto warn = [&](const scenario::ModelChoice& law, double reach) {
      if (!(reach > smallest)) return;
      diagnostics.warning(law.where, law.path + ": reaches " + base::length_text(reach) +
                                         " beyond touch, farther than the smallest grains are "
                                         "thick (" +
                                         base::length_text(smallest) +
                                         "); is the unit of what sets its reach right?");
    };
    const particles::PairLaws& laws = models.laws[n];
    warn(setup.interactions[n].contact, laws.contact->range());
    if (laws.cohesion) {
      warn(*setup.interactions[n].cohesion, laws.cohesion->range(0.25 * smallest));
    }
  }
}

}  // namespace dust::preflight
