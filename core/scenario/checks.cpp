// SPDX-License-Identifier: Apache-2.0
#include "scenario/checks.hpp"

#include "scenario/text/units.hpp"

#include <algorithm>
#include <cmath>
#include <map>
#include <utility>

namespace dust::scenario {
namespace {

/// Steps written in decimal divide each other to a few roundings.
constexpr double k_rounding = 1e-9;

bool is_multiple(double value, double step) {
  const double ratio = value / step;
  const double whole = std::round(ratio);
  return whole >= 1.0 && std::abs(ratio - whole) <= k_rounding * whole;
}

std::string seconds(double value) { return number_text(value) + " s"; }

/// No run comes to its end, and its steps could not be counted.
bool check_step_count(const char* path, double time, const char* of_step, double step,
                      const Mark& where, Diagnostics& diagnostics) {
  constexpr double k_max_steps = 1e15;
  if (!(time > k_max_steps * step)) return true;
  diagnostics.error(where, std::string(path) + ": " + seconds(time) + " is more than 1e15 times " +
                               of_step + ", " + seconds(step) +
                               ", which no run reaches: give a shorter time or a longer step");
  return false;
}

}  // namespace

void check_sides(const DomainSpec& domain, const std::array<bool, 6>& is_read,
                 const std::array<bool, 6>& has_air, const std::array<bool, 6>& is_air_periodic,
                 Diagnostics& diagnostics) {
  for (std::size_t n = 0; n < 6; ++n) {
    const std::size_t opposite = n ^ 1u;
    const SideSpec& side = domain.sides[n];
    const std::string path = std::string("domain.boundaries.") + k_side_names[n];
    const bool is_periodic = side.grains == GrainSide::periodic;
    if (is_read[n] && is_read[opposite] && is_periodic &&
        domain.sides[opposite].grains != GrainSide::periodic) {
      diagnostics.error(side.where, path + ": periodic sides come in pairs: make " +
                                        k_side_names[opposite] + " periodic too");
    }
    if (!is_read[n]) continue;
    if (is_air_periodic[n] && !is_periodic) {
      diagnostics.error(side.where, path + ": air: periodic needs grains: periodic");
    }
    if (is_periodic && has_air[n] && !is_air_periodic[n]) {
      diagnostics.error(side.where, path + ": grains: periodic needs air: periodic");
    }
  }
}

void check_multiple(const char* path, double every, double fluid_step, const Mark& where,
                    Diagnostics& diagnostics) {
  if (!(every > 0.0) || !(fluid_step > 0.0)) return;
  if (!check_step_count(path, every, "fluid_step", fluid_step, where, diagnostics)) return;
  if (is_multiple(every, fluid_step)) return;
  diagnostics.error(where, std::string(path) + ": " + seconds(every) +
                               " is not a multiple of fluid_step, " + seconds(fluid_step));
}

void check_begin_of_means(const std::string& path, double begin, double end, const Mark& where,
                          Diagnostics& diagnostics) {
  if (!(end > 0.0) || begin < end * (1.0 - k_rounding)) return;
  diagnostics.warning(
      where, path + ": " + seconds(begin) + " is not before time.end, " + seconds(end) +
                 ": no time is left to average over, so its means tell nothing; give an earlier "
                 "time or a later end");
}

void check_time(const TimeSpec& time, const TimeMarks& where, Diagnostics& diagnostics) {
  if (!(time.fluid_step > 0.0)) return;
  const std::string step = seconds(time.fluid_step);
  check_step_count("time.end", time.end, "fluid_step", time.fluid_step, where.end, diagnostics);
  if (time.dem_step > 0.0) {
    check_step_count("time.end", time.end, "dem_step", time.dem_step, where.end, diagnostics);
  }
  check_multiple("time.output_every", time.output_every, time.fluid_step, where.output_every,
                 diagnostics);
  check_multiple("time.checkpoint_every", time.checkpoint_every, time.fluid_step,
                 where.checkpoint_every, diagnostics);
  if (time.dem_step > time.fluid_step * (1.0 + k_rounding)) {
    diagnostics.error(where.dem_step, "time.dem_step: " + seconds(time.dem_step) +
                                          " is longer than fluid_step, " + step);
  }
  if (time.end > 0.0 && time.end < time.fluid_step * (1.0 - k_rounding)) {
    diagnostics.error(
        where.end, "time.end: " + seconds(time.end) + " is shorter than one fluid_step, " + step);
  } else if (time.end > 0.0 && !is_multiple(time.end, time.fluid_step)) {
    diagnostics.warning(
        where.end, "time.end: " + seconds(time.end) + " is not a multiple of fluid_step, " + step);
  }
}

void check_pairs(const Setup& setup, const Mark& where, Diagnostics& diagnostics) {
  const auto ordered = [](int a, int b) { return std::pair(std::min(a, b), std::max(a, b)); };
  // Each pair with what it is that meets.
  std::vector<std::pair<std::pair<int, int>, std::string>> needed;
  const auto need = [&](int grain, int other, const std::string& what) {
    needed.emplace_back(ordered(grain, other), what);
  };
  const auto materials_of = [](const EmitterSpec& emitter) {
    std::vector<int> all{emitter.material};
    all.insert(all.end(), emitter.more_materials.begin(), emitter.more_materials.end());
    std::erase_if(all, [](int m) { return m < 0; });
    return all;
  };
  for (const EmitterSpec& emitter : setup.emitters) {
    const std::string grains = "grains of emitter '" + emitter.name + "' meet ";
    for (const int material : materials_of(emitter)) {
      for (const EmitterSpec& other : setup.emitters) {
        for (const int met : materials_of(other)) {
          need(material, met,
               grains + (&other == &emitter ? "each other" : "those of '" + other.name + "'"));
        }
      }
      for (const BodySpec& body : setup.bodies) {
        if (body.material >= 0) {
          need(material, body.material, grains + "the body '" + body.name + "'");
        }
      }
      for (std::size_t n = 0; n < 6; ++n) {
        const SideSpec& side = setup.domain.sides[n];
        if (side.grains == GrainSide::wall && side.material >= 0) {
          need(material, side.material, grains + "the wall '" + k_side_names[n] + "'");
        }
      }
    }
  }
  std::map<std::pair<int, int>, bool> given;
  for (const InteractionSpec& i : setup.interactions) {
    given[ordered(i.material_i, i.material_j)] = true;
  }
  for (const auto& [pair, what] : needed) {
    if (given[pair]) continue;
    given[pair] = true;
    const auto name = [&](int material) {
      return setup.materials[static_cast<std::size_t>(material)].name;
    };
    diagnostics.error(where, "interactions: missing pair [" + name(pair.first) + ", " +
                                 name(pair.second) + "]: " + what);
  }
}

}  // namespace dust::scenario
