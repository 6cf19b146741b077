// SPDX-License-Identifier: Apache-2.0
#include "run/branch/comparison.hpp"

#include "base/named.hpp"

#include <algorithm>
#include <array>

namespace dust::run {
namespace {

/// Settings that what is there does not depend on; the last two are what lets things in and what
/// looks at them, and whole states do depend on those.
constexpr std::array<std::string_view, 10> k_outside_world = {"start_from",
                                                              "name",
                                                              "time.end",
                                                              "time.output_every",
                                                              "time.checkpoint_every",
                                                              "references",
                                                              "time.keep_every",
                                                              "reference_curves",
                                                              "sensors",
                                                              "emitters"};
constexpr std::span k_free = std::span(k_outside_world).first<8>();
constexpr std::span k_free_and_sensors = std::span(k_outside_world).first<9>();

}  // namespace

Comparison::Comparison(const scenario::ReadResult& now, const std::vector<io::InputFile>& inputs,
                       const registry::Registry& registry)
    : now_(now),
      origin_(*now.start.from, registry),
      leaves_(now.resolved_yaml, inputs),
      changed_models_(changed_models(origin_.state(), used_models(now, registry))),
      is_same_(changed_models_.empty() &&
               origin_.leaves().first_difference(leaves_, k_free).empty()),
      is_same_but_sensors_(changed_models_.empty() &&
                           origin_.leaves().first_difference(leaves_, k_free_and_sensors).empty()),
      is_same_world_(changed_models_.empty() &&
                     origin_.leaves().first_difference(leaves_, k_outside_world).empty()) {}

bool Comparison::is_changed(std::string_view kind, std::string_view name) const {
  return std::any_of(changed_models_.begin(), changed_models_.end(), [&](const ChangedModel& c) {
    return c.now.kind == kind && c.now.name == name;
  });
}

bool Comparison::has_other_histories() const {
  return std::any_of(changed_models_.begin(), changed_models_.end(),
                     [](const ChangedModel& c) { return c.keeps_other_numbers(); });
}

bool Comparison::same(std::string_view path, std::span<const std::string_view> ignored) const {
  return leaves_.is_same_below(std::string(path), origin_.leaves(), ignored);
}

bool Comparison::is_same_grid() const {
  const auto& here = now_.setup;
  const auto& there = origin_.scenario().setup;
  if (!here.fluid || !there.fluid || here.fluid->cells != there.fluid->cells) return false;
  for (std::size_t d = 0; d < 3; ++d) {
    const auto is_periodic = [d](const scenario::Setup& s) {
      return s.domain.sides[2 * d].grains == scenario::GrainSide::periodic;
    };
    if (is_periodic(here) != is_periodic(there)) return false;
  }
  return true;
}

bool Comparison::keeps_loads() const {
  if (!same("dust.field.classes")) return false;
  const auto share_of = [](const scenario::ReadResult& read, std::size_t material) {
    const auto& loads = read.dust.loads;
    return material < loads.size() ? loads[material].share : std::vector<double>{};
  };
  const auto& there = origin_.scenario();
  for (std::size_t n = 0; n < there.setup.materials.size(); ++n) {
    const int here = base::number_of(now_.setup.materials, there.setup.materials[n].name);
    if (here < 0) continue;
    if (share_of(now_, static_cast<std::size_t>(here)) != share_of(there, n)) return false;
  }
  return true;
}

bool Comparison::has_same_densities(const scenario::EmitterSpec& ours,
                                    const scenario::EmitterSpec& theirs) const {
  const auto density = [](const scenario::Setup& setup, int material) {
    return setup.materials[static_cast<std::size_t>(material)].properties.density;
  };
  const auto is_same_density = [&](int here, int there) {
    return density(now_.setup, here) == density(origin_.scenario().setup, there);
  };
  return is_same_density(ours.material, theirs.material) &&
         std::equal(ours.more_materials.begin(), ours.more_materials.end(),
                    theirs.more_materials.begin(), theirs.more_materials.end(), is_same_density);
}

bool Comparison::is_same_plant(const std::vector<double>& class_diameters) const {
  return is_same_but_sensors_ && class_diameters == origin_.class_diameters();
}

bool Comparison::keeps_statistics(const std::string& name,
                                  const std::vector<double>& class_diameters) const {
  return is_same_plant(class_diameters) &&
         base::find_named(origin_.scenario().setup.sensors, name) != nullptr &&
         same("sensors." + name);
}

}  // namespace dust::run
