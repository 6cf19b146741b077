// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/error.hpp"
#include "particles/impl.hpp"

#include <cmath>
#include <sstream>

namespace dust::particles {
void Dem::Impl::fail(std::size_t row, const std::string& what, const std::string& cause) const {
  const double* p = store.position.data() + 4 * row;
  const double* v = store.velocity(row);
  std::ostringstream text;
  text.precision(6);
  text << "grain " << store.id[row] << " (diameter " << 2.0 * p[3] << " m, "
       << laws.material_name(store.material[row]) << ") " << what << " at time " << time
       << " s, position (" << p[0] << ", " << p[1] << ", " << p[2] << ") m, velocity (" << v[0]
       << ", " << v[1] << ", " << v[2] << ") m/s; last known contact: ";
  std::string partner = "none";
  const auto self = static_cast<std::int32_t>(row);
  const auto look = [&](const ContactList& list) {
    const bool has_walls = list.partners() == Partners::surfaces;
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.touching()[q] == 0) continue;
      const std::int32_t a = list.a()[q];
      const std::int32_t b = list.b()[q];
      if (a != self && (has_walls || b != self)) continue;
      const std::int32_t other = a == self ? b : a;
      if (has_walls || other < 0) {
        partner =
            "surface " + surfaces[static_cast<std::size_t>(has_walls ? other : -1 - other)].name;
      } else {
        partner = "grain " + std::to_string(store.id[static_cast<std::size_t>(other)]);
      }
    }
  };
  for (std::size_t t = 0; t < inner.tiles(); ++t) {
    look(inner.contacts(t).pairs);
    look(inner.contacts(t).walls);
  }
  look(inner.fine());
  throw sdk::ModelError(text.str() + partner + "; likely cause: " + cause);
}

void Dem::Impl::fail_as_not_a_number(std::size_t row) const {
  fail(row, "has a position or velocity that is not a number",
       "a contact that began with a deep overlap, or a time step too long for the speeds met: "
       "give time.expected_speed or a smaller time.dem_step");
}

}  // namespace dust::particles
