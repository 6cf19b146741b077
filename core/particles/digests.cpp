// SPDX-License-Identifier: Apache-2.0
#include "base/digest.hpp"
#include "particles/impl.hpp"

/// What stands in the arrays that the nodes of a step name, as numbers: for the check that a node
/// changes what it says and nothing else.
namespace dust::particles {
namespace {

using base::Digest;

template <class List>
void add_entries(const List& list, Digest& digest) {
  digest.add(list.a).add(list.b);
  for (const Segment& s : list.segments) {
    const std::int32_t numbers[] = {s.law, s.surface, s.begin, s.end, s.standing};
    digest.add(numbers, 5);
  }
}

void add_contacts(const ContactList& list, Digest& digest) {
  digest.add(list.is_touching).add(list.history);
}

std::uint64_t lists(const Dem::Impl& dem) {
  Digest d;
  for (const Chunk& c : dem.chunks) {
    add_entries(c.near_pairs, d);
    add_entries(c.near_surfaces, d);
    add_entries(c.pairs, d);
    add_entries(c.surfaces, d);
    d.add(c.awake.rows);
  }
  add_entries(dem.near_fine, d);
  add_entries(dem.fine, d);
  d.add(dem.fine_awake.rows);
  return d.value();
}

std::uint64_t histories(const Dem::Impl& dem) {
  Digest d;
  for (const Chunk& c : dem.chunks) {
    add_contacts(c.pairs, d);
    add_contacts(c.surfaces, d);
  }
  add_contacts(dem.fine, d);
  return d.value();
}

}  // namespace

std::map<std::string, std::function<std::uint64_t()>> Dem::digests() const {
  const Impl* dem = impl_.get();
  const auto of = [dem](auto... columns) {
    return [dem, columns...] {
      Digest d;
      (d.add(dem->store.*columns), ...);
      return d.value();
    };
  };
  return {
      {"grain.position", of(&GrainStore::position)},
      {"grain.velocity", of(&GrainStore::motion, &GrainStore::spin)},
      {"grain.fluid_action", of(&GrainStore::action, &GrainStore::decay)},
      {"grain.fluid_impulse", of(&GrainStore::impulse)},
      {"contact.list", [dem] { return lists(*dem); }},
      {"contact.history", [dem] { return histories(*dem); }},
      {"contact.force", [dem] { return Digest().add(dem->contact_force).value(); }},
      {"contact.ghost_force", [dem] { return dem->ghosts.digest(); }},
      {"grain.force", [dem] { return dem->deferred.digest(); }},
      {"fine.force", [dem] { return Digest().add(dem->fine_level.force()).value(); }},
      {"fine.deferred_impulse", [dem] { return dem->fine_level.deferred().digest(); }},
  };
}

}  // namespace dust::particles
