// SPDX-License-Identifier: Apache-2.0
#include "preflight/body_survey.hpp"

#include "base/text.hpp"
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

/// Instants of the run at which a belt's speed is asked for: it may start late or stop.
constexpr int k_times = 16;

/// Whether its surface runs while it stays where it is.
bool is_belt(const bodies::Body& body) { return !body.motions.empty() && !body.is_carried(); }

/// [m/s] The largest speed of a belt's surface where it is nearest to a place.
double belt_speed(const Setup& setup, const bodies::Body& belt, sdk::Vec3 place) {
  const bodies::SurfacePoint near = belt.nearest(place);
  const sdk::Vec3 foot = place - near.distance * near.normal;
  double largest = 0.0;
  for (int n = 0; n <= k_times; ++n) {
    const double time = setup.time.end * n / k_times;
    largest = std::max(largest, norm(belt.surface_velocity(foot, near.normal, time)));
  }
  return largest;
}

TouchNumbers touch_of(const Setup& setup, const bodies::BodySet& all, std::size_t i, std::size_t j,
                      sdk::Vec3 place) {
  TouchNumbers touch{all[i].name, all[j].name, place};
  if (is_belt(all[i]) == is_belt(all[j])) return touch;
  const std::size_t belt = is_belt(all[i]) ? i : j;
  const std::size_t other = belt == i ? j : i;
  const double speed = belt_speed(setup, all[belt], place);
  if (speed > 0.0 && !all[other].displaces()) {
    touch.crossing = {all[belt].name, all[other].name, speed, setup.bodies[other].where};
  }
  return touch;
}

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
      if (gap.width == 0.0) survey.touching.push_back(touch_of(setup, all, i, j, gap.place));
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

void check_crossings(const BodySurvey& survey, scenario::Diagnostics& diagnostics) {
  for (const TouchNumbers& t : survey.touching) {
    if (!t.crossing) continue;
    const auto& c = *t.crossing;
    diagnostics.warning(c.where,
                        "bodies." + c.other + ": touches or crosses '" + c.belt + "' at " +
                            base::place_text(t.place, 3) + ", where that runs at " +
                            base::digits_text(c.speed, 3) +
                            " m/s: grains are drawn into the corner between them and squeezed; end "
                            "it above the belt" +
                            (survey.smallest_grain > 0.0
                                 ? ": a gap below " + base::length_text(survey.smallest_grain, 3) +
                                       " lets no grain through"
                                 : ""));
  }
}

}  // namespace dust::preflight
