// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <chrono>

/// The step of the coarse particles, tile by tile: contacts, forces, integration. A tile whose
/// forces are complete goes through all three in one task, while its rows are in the cache
/// (docs/decisions/0012_forces_stay_in_the_cache.md); phase by phase, for whoever wants to look or
/// add something in between, the bits are the same.
namespace dust::particles {
namespace {

/// One step in so many has the times of its phases taken.
constexpr std::int64_t k_steps_per_timing = 16;

/// Adds the time since the last stop to one phase after the other, where the step is one of those
/// timed.
class PhaseClock {
 public:
  explicit PhaseClock(bool is_on)
      : is_on_(is_on), last_(is_on ? Clock::now() : Clock::time_point()) {}
  void stop(double& seconds) {
    if (!is_on_) return;
    const auto now = Clock::now();
    seconds += std::chrono::duration<double>(now - last_).count();
    last_ = now;
  }

 private:
  using Clock = std::chrono::steady_clock;
  bool is_on_;
  Clock::time_point last_;
};

}  // namespace

void Dem::Impl::begin_contacts(double now, bool keeps_force) {
  time = now;
  if (keeps_force) {
    contact_force.assign(4 * coarse_count, 0.0);
  } else {
    contact_force.clear();
  }
  ghosts.begin_step();
  for (Surface& s : surfaces) s.move_to(now);
}

/// All contacts of a tile: forces on its particles into the buffer, those on its ghosts published.
void Dem::Impl::evaluate(Chunk& chunk, ForceBuffer& force) {
  chunk.contacts = 0;
  chunk_pairs(chunk, force.rows());
  chunk_surfaces(chunk, force.rows());
  ghosts.publish(chunk.index, force.ghosts());
  if (!contact_force.empty()) keep_force(chunk, force.rows());
}

void Dem::Impl::keep_force(const Chunk& chunk, const double* force) {
  for (const std::int32_t row : chunk.awake.rows) {
    std::copy_n(force + k_force_row * static_cast<std::size_t>(row - chunk.begin), 3,
                contact_force.data() + 4 * static_cast<std::ptrdiff_t>(row));
  }
}

void Dem::Impl::note_contribution(std::int32_t row, const double* given) {
  if (contact_force.empty()) return;
  double* kept = contact_force.data() + 4 * static_cast<std::ptrdiff_t>(row);
  for (int d = 0; d < 3; ++d) kept[d] += given[d];
}

void Dem::Impl::add_contributions(const Chunk& chunk, ForceBuffer& force) {
  ghosts.for_each_contribution(chunk.index, [&](std::int32_t row, const double* given) {
    double* f = force.rows() + k_force_row * static_cast<std::size_t>(row - chunk.begin);
    for (std::size_t d = 0; d < k_force_row; ++d) f[d] += given[d];
    note_contribution(row, given);
  });
}

/// The same to those that wait, who stand in the order of rows.
void Dem::Impl::add_to_deferred(Chunk& chunk) {
  const auto& rows = chunk.awake.rows;
  const std::size_t moved = deferred.moved(chunk.index);
  double* const force = deferred.rows(chunk.index).data();
  std::size_t place = chunk.awake.own;
  ghosts.for_each_contribution(chunk.index, [&](std::int32_t row, const double* given) {
    while (rows[place] != row) ++place;
    double* f = force + k_force_row * (place - moved);
    for (std::size_t d = 0; d < k_force_row; ++d) f[d] += given[d];
    note_contribution(row, given);
  });
}

/// Everybody moves at once, while the rows and forces are in the cache.
void Dem::Impl::move_all(Chunk& chunk, ForceBuffer& force) {
  const std::span<const std::int32_t> rows = chunk.awake.rows;
  const auto first = static_cast<std::size_t>(chunk.begin);
  resume_course(chunk, Movers::all);
  deferred.clear(chunk.index);
  if (rows.size() == chunk.tile().size()) {
    integrate_all(first, rows.size(), force.rows());
  } else {
    integrate_awake(rows, first, force.rows(), ForceOrder::by_row);
  }
  if (is_check_due()) check(chunk, since_watch + 1);
}

/// Those nobody else looks at move at once; the others' forces are put aside.
void Dem::Impl::move_unshared(Chunk& chunk, ForceBuffer& force) {
  const std::span<const std::int32_t> rows = chunk.awake.rows;
  resume_course(chunk, Movers::unshared);
  integrate_awake(rows.first(chunk.awake.own), static_cast<std::size_t>(chunk.begin), force.rows(),
                  ForceOrder::by_row);
  deferred.keep(chunk.tile(), rows, chunk.awake.own, force);
}

void Dem::Impl::move_deferred(Chunk& chunk) {
  const std::size_t moved = deferred.moved(chunk.index);
  resume_course(chunk, moved == 0 ? Movers::all : Movers::shared);
  integrate_awake(std::span(chunk.awake.rows).subspan(moved), static_cast<std::size_t>(chunk.begin),
                  deferred.rows(chunk.index).data(), ForceOrder::by_place);
  deferred.clear(chunk.index);
  if (is_check_due()) check(chunk, since_watch + 1);
}

void Dem::Impl::contact(double now, bool keeps_force) {
  begin_contacts(now, keeps_force);
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    ForceBuffer force(chunk.tile(), ghosts.ghosts(chunk.index).size());
    evaluate(chunk, force);
    deferred.keep(chunk.tile(), chunk.awake.rows, 0, force);
  });
}

void Dem::Impl::force() {
  each_deferred([&](Chunk& chunk) { add_to_deferred(chunk); });
}

void Dem::Impl::integrate() {
  each_deferred([&](Chunk& chunk) { move_deferred(chunk); });
  end_tiles();
}

/// contact(), force() and integrate() at once: a tile goes through as many of them as it can.
void Dem::Impl::step_tiles(double now, bool keeps_force) {
  begin_contacts(now, keeps_force);
  const bool is_timed = counters.steps % k_steps_per_timing == 0;
  oneapi::tbb::parallel_for(std::size_t{0}, chunks.size(), [&](std::size_t c) {
    Chunk& chunk = chunks[c];
    ForceBuffer force(chunk.tile(), ghosts.ghosts(chunk.index).size());
    PhaseClock clock(is_timed);
    evaluate(chunk, force);
    clock.stop(chunk.times.contact);
    if (ghosts.has_all(chunk.index)) {
      add_contributions(chunk, force);
      clock.stop(chunk.times.force);
      move_all(chunk, force);
    } else {
      move_unshared(chunk, force);
    }
    clock.stop(chunk.times.integration);
  });
  each_deferred([&](Chunk& chunk) {
    PhaseClock clock(is_timed);
    add_to_deferred(chunk);
    clock.stop(chunk.times.force);
    move_deferred(chunk);
    clock.stop(chunk.times.integration);
  });
  end_tiles();
}

void Dem::Impl::end_tiles() {
  if (is_check_due()) {
    for (const Chunk& c : chunks) must_watch = must_watch || c.wants_watch;
  }
  ++since_watch;
  ++since_rebuild;
  ++counters.steps;
  counters.particle_steps += static_cast<std::int64_t>(store.size());
}

}  // namespace dust::particles
