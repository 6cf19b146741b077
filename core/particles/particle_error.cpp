// SPDX-License-Identifier: Apache-2.0
#include "particles/particle_error.hpp"

#include "dust/sdk/error.hpp"

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
  throw sdk::ModelError(text.str() + last_contact(scene, lists, static_cast<std::int32_t>(row)) +
                        "; likely cause: " + cause);
}

void throw_not_a_number(const ContactScene& scene, const InnerList& lists, std::size_t row) {
  throw_particle_error(
      scene, lists, row, "has a position or velocity that is not a number",
      "a contact that began with a deep overlap, or a time step too long for the speeds met: "
      "give time.expected_speed or a smaller time.dem_step");
}

}  // namespace dust::particles
