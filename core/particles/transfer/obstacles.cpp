// SPDX-License-Identifier: Apache-2.0
#include "particles/transfer/translation.hpp"

#include <algorithm>
#include <string>

namespace dust::particles {
namespace {

/// [-] of the radius: deeper, a particle has not come to touch a surface but lies in it.
constexpr double k_touch = 0.05;

double overlap_of(const Conditions& conditions, std::size_t surface, const double* position) {
  const Surface& s = conditions.surfaces[surface];
  if (s.is_removed()) return 0.0;
  return position[3] -
         s.contact_at(conditions.time, {position[0], position[1], position[2]}).distance;
}

void note_name(std::vector<std::string>& names, const std::string& name) {
  if (std::find(names.begin(), names.end(), name) == names.end()) names.push_back(name);
}

void note_blocked(std::vector<TransferObstacles::Blocked>& blocked, const std::string& surface,
                  std::int64_t id, const double* position) {
  auto at = std::find_if(blocked.begin(), blocked.end(),
                         [&](const auto& b) { return b.surface == surface; });
  if (at == blocked.end()) {
    blocked.push_back({surface, 0, id, {position[0], position[1], position[2]}});
    at = blocked.end() - 1;
  }
  ++at->count;
}

}  // namespace

TransferObstacles find_obstacles(ContactTransfer::Side from, const Conditions& to) {
  TransferObstacles found;
  const Translation names(from.conditions, to);
  std::vector<std::int32_t> before(to.surfaces.size(), -1);
  for (std::size_t s = 0; s < names.surfaces().size(); ++s) {
    if (names.surfaces()[s] >= 0) {
      before[static_cast<std::size_t>(names.surfaces()[s])] = static_cast<std::int32_t>(s);
    }
  }
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
    for (std::size_t s = 0; s < to.surfaces.size(); ++s) {
      const double overlap = overlap_of(to, s, p);
      if (overlap <= k_touch * p[3]) continue;
      // What is pressed into a surface already, stays so.
      if (before[s] >= 0 &&
          overlap <= 2.0 * overlap_of(from.conditions, static_cast<std::size_t>(before[s]), p)) {
        continue;
      }
      note_blocked(found.blocked, to.surfaces[s].name, from.particles.id(n), p);
    }
  }
  return found;
}

}  // namespace dust::particles
