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
  const auto look = [&](const ContactList& list, bool is_surface) {
    for (std::size_t q = 0; q < list.size(); ++q) {
      if (list.is_touching[q] == 0) continue;
      const auto self = static_cast<std::int32_t>(row);
      if (list.a[q] != self && (is_surface || list.b[q] != self)) continue;
      const std::int32_t other = list.a[q] == self ? list.b[q] : list.a[q];
      if (is_surface || other < 0) {
        partner =
            "surface " + surfaces[static_cast<std::size_t>(is_surface ? other : -1 - other)].name;
      } else {
        partner = "grain " + std::to_string(store.id[static_cast<std::size_t>(other)]);
      }
    }
  };
  for (const Chunk& c : chunks) {
    look(c.pairs, false);
    look(c.surfaces, true);
  }
  look(fine, false);
  throw sdk::ModelError(text.str() + partner + "; likely cause: " + cause);
}

/// The lists hold as long as no grain has left the straight course they suppose by more than its
/// allowance. Looked after when a watch ends; mending is asked for early enough for the next one. A
/// fine grain of 10 um pressed between two of 600 um (soft as grains are made to be) comes off with
/// up to the speed at which its elastic energy sets it free, some 10 m/s: more than its allowance
/// in one step. The lists are made new then, at the cost of a partner that may be seen late
/// (counted when a watch begins). A coarse grain that does this is an error.
void Dem::Impl::check_course(std::size_t begin, std::size_t end, bool& wants_mending,
                             bool& wants_rebuild) const {
  bool asks = false;
  for (std::size_t n = begin; n < end; ++n) {
    const Deviation off = deviation(n);
    const double limit = trajectories.skin(n);
    asks = asks || off.asks_for_another(limit);
    if (off.now2 <= limit * limit) continue;
    if (!std::isfinite(off.now2)) fail_as_not_a_number(n);
    if (n < coarse_count) {
      fail(n, "moved farther off its course than its skin allows between two checks",
           "speeds far above the expected one: give time.expected_speed or a smaller "
           "time.dem_step");
    }
  }
  wants_mending = wants_mending || asks;
  if (is_periodic) look_for_wraps(begin, end, wants_rebuild);
}

bool Dem::Impl::is_off_course(std::size_t n) const {
  return deviation(n).asks_for_another(trajectories.skin(n));
}

/// The same for the choice of a watch and the grains it keeps awake; the next look comes after
/// `ahead` coarse steps. Who is off by more than its allowance already may have met somebody
/// unseen.
void Dem::Impl::check_awake(const Awake& awake, std::int64_t done, std::int64_t ahead,
                            bool& wants_watch) const {
  const double t = static_cast<double>(done) * steps.coarse_step;
  const double time_ahead = static_cast<double>(ahead) * steps.coarse_step;
  bool asks = false;
  for (std::size_t k = 0; k < awake.rows.size(); ++k) {
    const auto n = static_cast<std::size_t>(awake.rows[k]);
    const double* p = store.position.data() + 4 * n;
    const double* v = store.velocity(n);
    const Awake::Start& start = awake.start[k];
    double off2 = 0.0;
    double next2 = 0.0;
    for (int d = 0; d < 3; ++d) {
      const double off = p[d] - start.position[d] - t * start.velocity[d];
      const double next = off + time_ahead * (v[d] - start.velocity[d]);
      off2 += off * off;
      next2 += next * next;
    }
    const double limit2 = static_cast<double>(start.allowance) * start.allowance;
    asks = asks || std::max(off2, next2) > Deviation::k_trigger * Deviation::k_trigger * limit2;
    if (!std::isfinite(off2)) fail_as_not_a_number(n);
  }
  wants_watch = wants_watch || asks;
}

void Dem::Impl::fail_as_not_a_number(std::size_t row) const {
  fail(row, "has a position or velocity that is not a number",
       "a contact that began with a deep overlap, or a time step too long for the speeds met: "
       "give time.expected_speed or a smaller time.dem_step");
}

/// Positions are wrapped at rebuilds only: one is due when a grain is far out.
void Dem::Impl::look_for_wraps(std::size_t begin, std::size_t end, bool& wants_rebuild) const {
  for (std::size_t n = begin; n < end; ++n) {
    for (int d = 0; d < 3; ++d) {
      const double x = store.position[4 * n + static_cast<std::size_t>(d)];
      const double slack = store.position[4 * n + 3];
      if (images.length[d] > 0.0 && (x < domain_min[d] - slack || x > domain_max[d] + slack)) {
        wants_rebuild = true;
      }
    }
  }
}

}  // namespace dust::particles
