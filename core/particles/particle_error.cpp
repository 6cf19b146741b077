// SPDX-License-Identifier: Apache-2.0
#include "particles/particle_error.hpp"

#include "dust/sdk/error.hpp"
#include "particles/surface_search.hpp"

#include <cmath>
#include <limits>
#include <sstream>

namespace dust::particles {
namespace {

/// The last contact of a particle that is known, as text.
std::string last_contact(const ContactScene& scene, const InnerList& lists, std::int32_t self) {
  std::string partner = "none";
  const auto look = [&](const ContactList& list) {
    const bool has_walls = list.partners() == PartnerKind::surfaces;
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.touching()[q] == 0) continue;
      const std::int32_t a = list.a()[q];
      const std::int32_t b = list.b()[q];
      if (a != self && (has_walls || b != self)) continue;
      const std::int32_t other = a == self ? b : a;
      if (has_walls || other < 0) {
        const auto number = static_cast<std::size_t>(has_walls ? other : -1 - other);
        partner = "surface " + scene.surfaces[number].name;
      } else {
        const auto id = scene.particles.id(static_cast<std::size_t>(other));
        partner = "grain " + std::to_string(id);
      }
    }
  };
  for (std::size_t t = 0; t < lists.tiles(); ++t) {
    look(lists.contacts(t).pairs);
    look(lists.contacts(t).walls);
  }
  look(lists.fine());
  return partner;
}

/// The surface nearest to a particle, as text that goes on with the sentence; nothing where there
/// is none.
std::string nearest_text(const ContactScene& scene, sdk::Vec3 centre) {
  const auto [surface, point] =
      nearest_surface(scene.surfaces, centre, std::numeric_limits<double>::infinity());
  if (surface == nullptr) return {};
  std::ostringstream text;
  text.precision(3);
  text << "; nearest surface: " << surface->name << ", its centre is " << std::abs(point.distance)
       << (point.distance < 0.0 ? " m inside" : " m away");
  return text.str();
}

/// Why a particle flew apart that is in a nip; empty where it is in none.
std::string nip_text(const ContactScene& scene, sdk::Vec3 centre, double radius) {
  for (const Surface& s : scene.surfaces) {
    if (s.body == nullptr || s.is_removed()) continue;
    const std::string nip = s.body->nip_at(centre, radius, s.place);
    if (nip.empty()) continue;
    return "it was drawn into " + nip + " of '" + s.name +
           "', which has no room for it: keep grains out of there, by a plough for example "
           "(docs/how_to/walls.md, Conveyors)";
  }
  return {};
}

}  // namespace

void throw_particle_error(const ContactScene& scene, const InnerList& lists, std::size_t row,
                          const std::string& what, const std::string& cause) {
  const ParticleStore& store = scene.particles;
  const double* p = store.position(row);
  const double* v = store.velocity(row);
  std::ostringstream text;
  text.precision(6);
  text << "grain " << store.id(row) << " (diameter " << 2.0 * p[3] << " m, "
       << scene.laws.material_name(store.material(row)) << ") " << what << " at time " << scene.time
       << " s, position (" << p[0] << ", " << p[1] << ", " << p[2] << ") m, velocity (" << v[0]
       << ", " << v[1] << ", " << v[2] << ") m/s; last known contact: ";
  text << last_contact(scene, lists, static_cast<std::int32_t>(row));
  const sdk::Vec3 centre{p[0], p[1], p[2]};
  std::string nip;
  if (std::isfinite(norm(centre))) {
    text << nearest_text(scene, centre);
    nip = nip_text(scene, centre, p[3]);
  }
  throw sdk::ModelError(text.str() + "; likely cause: " + (nip.empty() ? cause : nip));
}

void throw_not_a_number(const ContactScene& scene, const InnerList& lists, std::size_t row) {
  throw_particle_error(
      scene, lists, row, "has a position or velocity that is not a number",
      "a contact that began with a deep overlap, or a time step too long for the speeds met: "
      "give time.expected_speed or a smaller time.dem_step");
}

}  // namespace dust::particles
