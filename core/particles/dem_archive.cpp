// SPDX-License-Identifier: Apache-2.0
#include "particles/impl.hpp"

#include <algorithm>
#include <utility>

namespace dust::particles {
namespace {

template <class T>
std::vector<std::int64_t> widened(const std::vector<T>& v) {
  return {v.begin(), v.end()};
}

/// Lists of one kind, one after another, with their sizes.
struct FlatLists {
  std::vector<std::int64_t> sizes, a, b;
  std::vector<std::int64_t> touching;  ///< of a outer list: number in the contact list
  std::vector<std::int64_t> segments;
  std::vector<double> history;

  void add(const ContactList& list) {
    sizes.insert(sizes.end(), {static_cast<std::int64_t>(list.size()),
                               static_cast<std::int64_t>(list.segments.size())});
    a.insert(a.end(), list.a.begin(), list.a.end());
    b.insert(b.end(), list.b.begin(), list.b.end());
    touching.insert(touching.end(), list.is_touching.begin(), list.is_touching.end());
    history.insert(history.end(), list.history.begin(), list.history.end());
    for (const Segment& s : list.segments) {
      segments.insert(segments.end(), {s.law, s.surface, s.begin, s.end, s.standing});
    }
  }
  void add(const OuterList& list) {
    sizes.insert(sizes.end(), {static_cast<std::int64_t>(list.size()),
                               static_cast<std::int64_t>(list.segments.size())});
    a.insert(a.end(), list.a.begin(), list.a.end());
    b.insert(b.end(), list.b.begin(), list.b.end());
    for (const Segment& s : list.segments) {
      segments.insert(segments.end(), {s.law, s.surface, s.begin, s.end, s.standing});
    }
  }
  void save(sdk::ArchiveWriter& archive, const std::string& name) const {
    archive.integers(name + "_sizes", sizes);
    archive.integers(name + "_a", a);
    archive.integers(name + "_b", b);
    archive.integers(name + "_touching", touching);
    archive.integers(name + "_segments", segments);
    archive.numbers(name + "_history", history);
  }
  void load(sdk::ArchiveReader& archive, const std::string& name) {
    sizes = archive.integers(name + "_sizes");
    a = archive.integers(name + "_a");
    b = archive.integers(name + "_b");
    touching = archive.integers(name + "_touching");
    segments = archive.integers(name + "_segments");
    history = archive.numbers(name + "_history");
  }
  void take(ContactList& list, std::size_t stride) {
    const auto [n, m] = next_sizes();
    list.clear();
    for (std::size_t q = at_; q < at_ + n; ++q) {
      const bool is_touching = touching.at(q) != 0;
      list.push(static_cast<std::int32_t>(a.at(q)), static_cast<std::int32_t>(b.at(q)),
                is_touching ? history.data() + q * stride : nullptr, stride);
      list.is_touching.back() = static_cast<std::uint8_t>(touching.at(q));
    }
    take_segments(list.segments, m);
    at_ += n;
  }
  void take(OuterList& list) {
    const auto [n, m] = next_sizes();
    list.clear();
    for (std::size_t q = at_; q < at_ + n; ++q) {
      list.push(static_cast<std::int32_t>(a.at(q)), static_cast<std::int32_t>(b.at(q)));
    }
    take_segments(list.segments, m);
    at_ += n;
  }

 private:
  std::pair<std::size_t, std::size_t> next_sizes() {
    const auto n = static_cast<std::size_t>(sizes.at(next_++));
    const auto m = static_cast<std::size_t>(sizes.at(next_++));
    return {n, m};
  }
  void take_segments(std::vector<Segment>& into, std::size_t count) {
    for (std::size_t s = segment_; s < segment_ + count; ++s) {
      const auto get = [&](std::size_t k) {
        return static_cast<std::int32_t>(segments.at(5 * s + k));
      };
      into.push_back({get(0), get(1), get(2), get(3), get(4)});
    }
    segment_ += count;
  }
  std::size_t next_ = 0, at_ = 0, segment_ = 0;
};

}  // namespace

void Dem::Impl::save(sdk::ArchiveWriter& archive) const {
  const auto rows = [&](const char* name, const contact::AlignedVector<double>& v) {
    archive.numbers(name, {v.data(), v.size()});
  };
  rows("position", store.position);
  rows("motion", store.motion);
  rows("spin", store.spin);
  trajectories.save(archive);
  if (store.has_fluid) {
    rows("action", store.action);
    rows("impulse", store.impulse);
    rows("decay", store.decay);
  }
  archive.integers("id", store.id);
  archive.integers("material", widened(store.material));
  archive.integers("population", widened(store.population));
  archive.numbers("weight", store.weight);

  FlatLists pairs;
  FlatLists walls;
  FlatLists near_pairs;
  FlatLists near_walls;
  for (const Chunk& c : chunks) {
    near_pairs.add(c.near_pairs);
    near_walls.add(c.near_surfaces);
    pairs.add(c.pairs);
    walls.add(c.surfaces);
  }
  FlatLists fines;
  FlatLists near_fines;
  fines.add(fine);
  near_fines.add(near_fine);
  near_pairs.save(archive, "near_pairs");
  near_walls.save(archive, "near_surfaces");
  near_fines.save(archive, "near_fine");
  pairs.save(archive, "pairs");
  walls.save(archive, "surfaces");
  fines.save(archive, "fine");
  archive.numbers("contact_force", contact_force);

  std::vector<std::int64_t> bounds;
  for (const Chunk& c : chunks) bounds.insert(bounds.end(), {c.begin, c.end, c.contacts});
  archive.integers("chunks", bounds);
  fine_level.save(archive);
  const ListTuner::State lists = tuner.state();
  const std::int64_t state[] = {static_cast<std::int64_t>(coarse_count),
                                next_id,
                                since_rebuild,
                                lists.outer_lifetime,
                                lists.next_outer_lifetime,
                                must_rebuild,
                                must_sort,
                                has_fluid,
                                counters.steps,
                                counters.particle_steps,
                                fine_level.sub_steps(),
                                counters.rebuilds,
                                counters.contacts_seen_late,
                                counters.flown_steps,
                                lists.skin_level,
                                lists.inner_lifetime,
                                must_mend,
                                mended,
                                counters.mends};
  archive.integers("state", state);
  archive.number("time", time);
  double largest = counters.largest_coarse_overlap;
  for (const Chunk& c : chunks) largest = std::max(largest, c.largest_overlap);
  archive.number("largest_coarse_overlap", largest);
  book.save(archive);
}

void Dem::Impl::load(sdk::ArchiveReader& archive) {
  const auto rows = [&](const char* name, contact::AlignedVector<double>& v) {
    const auto values = archive.numbers(name);
    v.assign(values.begin(), values.end());
  };
  rows("position", store.position);
  rows("motion", store.motion);
  rows("spin", store.spin);
  trajectories.load(archive);
  if (store.has_fluid) {
    rows("action", store.action);
    rows("impulse", store.impulse);
    rows("decay", store.decay);
  }
  store.id = archive.integers("id");
  const auto material = archive.integers("material");
  const auto population = archive.integers("population");
  store.material.assign(material.begin(), material.end());
  store.population.assign(population.begin(), population.end());
  store.weight = archive.numbers("weight");

  FlatLists pairs;
  FlatLists walls;
  FlatLists fines;
  FlatLists near_pairs;
  FlatLists near_walls;
  FlatLists near_fines;
  near_pairs.load(archive, "near_pairs");
  near_walls.load(archive, "near_surfaces");
  near_fines.load(archive, "near_fine");
  pairs.load(archive, "pairs");
  walls.load(archive, "surfaces");
  fines.load(archive, "fine");
  const auto forces = archive.numbers("contact_force");
  contact_force.assign(forces.begin(), forces.end());
  const auto bounds = archive.integers("chunks");
  chunks.clear();
  chunks.resize(bounds.size() / 3);
  for (std::size_t c = 0; c < chunks.size(); ++c) {
    chunks[c].index = static_cast<std::int32_t>(c);
    chunks[c].begin = static_cast<std::int32_t>(bounds[3 * c]);
    chunks[c].end = static_cast<std::int32_t>(bounds[3 * c + 1]);
    chunks[c].contacts = bounds[3 * c + 2];
    near_pairs.take(chunks[c].near_pairs);
    near_walls.take(chunks[c].near_surfaces);
    chunks[c].wall_sums.assign(WallLoads::k_sums * wall_loads.walls(), 0.0);
    pairs.take(chunks[c].pairs, history_stride);
    walls.take(chunks[c].surfaces, history_stride);
  }
  near_fines.take(near_fine);
  fines.take(fine, history_stride);
  const auto state = archive.integers("state");
  coarse_count = static_cast<std::size_t>(state.at(0));
  next_id = state.at(1);
  since_rebuild = state.at(2);
  must_rebuild = state.at(5) != 0;
  must_sort = state.at(6) != 0;
  has_fluid = state.at(7) != 0;
  counters.steps = state.at(8);
  counters.particle_steps = state.at(9);
  counters.rebuilds = state.at(11);
  counters.contacts_seen_late = state.at(12);
  counters.flown_steps = state.at(13);
  tuner.restore({state.at(3), state.at(4), state.at(14), state.at(15)});
  must_mend = state.at(16) != 0;
  mended = state.at(17);
  counters.mends = state.at(18);
  time = archive.number("time");
  counters.largest_coarse_overlap = archive.number("largest_coarse_overlap");
  fine_level.load(archive, state.at(10));
  for (Surface& s : surfaces) s.move_to(time);
  book.load(archive);
  look_at_weights();
}

}  // namespace dust::particles
