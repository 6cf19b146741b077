// SPDX-License-Identifier: Apache-2.0
#include "particles/transfer/translation.hpp"

#include <algorithm>
#include <string>

namespace dust::particles {
namespace {

/// [-] of the radius: deeper, a particle has not come to touch a surface but lies in it.
constexpr double k_touch = 0.05;

/// [m] Of the whole body, or side, that a surface is the first part of.
double overlap_of(const Conditions& conditions, std::size_t surface, const double* position) {
  const Surface& s = conditions.surfaces[surface];
  if (s.is_removed()) return 0.0;
  return position[3] -
         s.nearest_at(conditions.time, {position[0], position[1], position[2]}).distance;
}

/// Which particles of another solver lie in a wall that was not there before, or deeper.
class NewOverlaps {
 public:
  NewOverlaps(const Conditions& from, const Conditions& to, const Translation& names)
      : from_(from), to_(to), before_(to.surfaces.size(), -1) {
    for (std::size_t s = 0; s < to.surfaces.size(); ++s) {
      if (to.surfaces[s].is_first_part()) walls_.push_back(s);
    }
    for (std::size_t s = 0; s < names.walls().size(); ++s) {
      const std::int32_t here = names.walls()[s];
      if (here < 0 || !from.surfaces[s].is_first_part()) continue;
      before_[static_cast<std::size_t>(here)] = static_cast<std::int32_t>(s);
    }
  }
  /// Numbers of the surfaces that stand for the walls.
  [[nodiscard]] const std::vector<std::size_t>& walls() const { return walls_; }
  /// `position`: x, y, z, radius [m].
  [[nodiscard]] bool lies_in(const double* position, std::size_t wall) const {
    const double overlap = overlap_of(to_, wall, position);
    if (overlap <= k_touch * position[3]) return false;
    // What is pressed into a wall already, stays so.
    const std::int32_t before = before_[wall];
    const double then =
        before < 0 ? 0.0 : overlap_of(from_, static_cast<std::size_t>(before), position);
    return overlap > 2.0 * std::max(then, 0.0);
  }

 private:
  const Conditions& from_;
  const Conditions& to_;
  std::vector<std::size_t> walls_;
  std::vector<std::int32_t> before_;  ///< the other's number of each wall; -1: it had none
};

void note_name(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void note_blocked(std::vector<TransferObstacles::Blocked>& blocked, const Surface& surface,
                  std::int64_t id, const double* position) {
  auto at = std::find_if(blocked.begin(), blocked.end(),
                         [&](const auto& b) { return b.surface == surface.name; });
  if (at == blocked.end()) {
    blocked.push_back({.surface = surface.name,
                       .first_id = id,
                       .first_place = {position[0], position[1], position[2]},
                       .is_hood = surface.opening >= 0 && surface.body != nullptr});
    at = blocked.end() - 1;
  }
  ++at->count;
  at->largest_diameter = std::max(at->largest_diameter, 2.0 * position[3]);
}

}  // namespace

TransferObstacles find_obstacles(ContactTransfer::Side from, const Conditions& to) {
  TransferObstacles found;
  const Translation names(from.conditions, to);
  const NewOverlaps overlaps(from.conditions, to, names);
  for (std::size_t n = 0; n < from.particles.size(); ++n) {
    const double* p = from.particles.position(n);
    const std::int32_t material = from.particles.material(n);
    const std::string& name = from.conditions.laws.material_name(material);
    note_name(found.materials, name);
    if (names.materials()[static_cast<std::size_t>(material)] < 0) {
      note_name(found.missing_materials, name);
    }
    if (to.domain.place_of(p).where == ParticleDomain::Where::lost) {
      if (found.outside++ == 0) found.first_outside = {p[0], p[1], p[2]};
      continue;
    }
    for (const std::size_t s : overlaps.walls()) {
      if (overlaps.lies_in(p, s))
        note_blocked(found.blocked, to.surfaces[s], from.particles.id(n), p);
    }
  }
  return found;
}

std::vector<std::pair<std::size_t, int>> find_inside_hoods(ContactTransfer::Side from,
                                                           const Conditions& to,
                                                           const Translation& names) {
  std::vector<std::pair<std::size_t, int>> found;
  const NewOverlaps overlaps(from.conditions, to, names);
  for (const std::size_t s : overlaps.walls()) {
    const Surface& surface = to.surfaces[s];
    if (surface.opening < 0 || surface.body == nullptr) continue;
    for (std::size_t n = 0; n < from.particles.size(); ++n) {
      if (overlaps.lies_in(from.particles.position(n), s)) found.emplace_back(n, surface.opening);
    }
  }
  return found;
}

}  // namespace dust::particles
