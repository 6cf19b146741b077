// SPDX-License-Identifier: Apache-2.0
#include "preflight/body_survey.hpp"

#include "bodies/survey/gap.hpp"
#include "fluid/grid.hpp"
#include "preflight/particle_models.hpp"

#include <algorithm>

namespace dust::preflight {
namespace {

using scenario::Setup;

/// Below two cells a gap is resolved coarsely: docs/theory/fluid.md, limits.
constexpr double k_coarse_gap = 2.0;
/// Nearest points for all pairs and for one: about a microsecond each.
constexpr std::size_t k_work = 200'000;
constexpr std::size_t k_work_of_pair = 40'000;

void find_gaps(const Setup& setup, const bodies::BodySet& all, BodySurvey& survey) {
  bodies::GapSearch search{setup.domain.min, setup.domain.max, survey.limit, 0};
  std::size_t left = k_work;
  for (std::size_t j = 1; j < all.size(); ++j) {
    for (std::size_t i = 0; i < j; ++i) {
      search.work = std::min(left, k_work_of_pair);
      if (search.work == 0) {
        survey.unseen.push_back(all[i].name + " - " + all[j].name);
        continue;
      }
      const bodies::Gap gap = bodies::smallest_gap(all[i], all[j], search);
      left -= std::min(left, gap.work);
      if (gap.width == 0.0) survey.touching.push_back({all[i].name, all[j].name, gap.place});
      if (gap.width == 0.0 || gap.width > survey.limit) continue;
      survey.gaps.push_back(
          {all[i].name, all[j].name, setup.bodies[j].where, gap.width, gap.place, gap.is_whole});
    }
  }
  std::stable_sort(survey.gaps.begin(), survey.gaps.end(),
                   [](const GapNumbers& a, const GapNumbers& b) { return a.width < b.width; });
}

}  // namespace

BodySurvey survey_bodies(const Setup& setup, const registry::Registry& registry) {
  const ParticleModels models = make_particle_models(setup, registry);
  BodySurvey survey;
  if (setup.fluid) {
    const sdk::Vec3 h =
        fluid::Grid::make(setup.domain.min, setup.domain.max, setup.fluid->cells, {}).spacing;
    survey.cell = std::min({h.x, h.y, h.z});
  }
  if (!models.class_diameters.empty()) {
    survey.smallest_grain = models.class_diameters.front();
    survey.largest_grain = models.class_diameters.back();
  }
  survey.limit = std::max(k_coarse_gap * survey.cell, survey.largest_grain);
  for (std::size_t n = 0; n < models.bodies.size(); ++n) {
    const bodies::Body& body = models.bodies[n];
    const std::vector<std::string> notes = body.shape->notes();
    if (notes.empty()) continue;
    survey.meshes.push_back(
        {body.name, setup.bodies[n].shape.where, notes, body.shape->thinnest_wall()});
  }
  if (survey.limit > 0.0) find_gaps(setup, models.bodies, survey);
  return survey;
}

}  // namespace dust::preflight
