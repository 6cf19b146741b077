// SPDX-License-Identifier: Apache-2.0
#include "base/digest.hpp"
#include "particles/impl.hpp"

/// What stands in the arrays that the nodes of a step name, as numbers: for the check that a node
/// changes what it says and nothing else.
namespace dust::particles {
namespace {

using base::Digest;

std::uint64_t lists(const OuterList& outer, const InnerList& inner) {
  Digest d;
  outer.add_to(d);
  inner.add_entries_to(d);
  return d.value();
}

/// Where bodies stand, and when.
std::uint64_t placements(const Conditions& conditions) {
  Digest d;
  d.add(&conditions.time, 1);
  for (const Surface& s : conditions.surfaces) {
    const bodies::Placement& place = s.place;
    for (const sdk::Vec3& v : {place.column[0], place.column[1], place.column[2], place.shift,
                               place.velocity, place.spin}) {
      d.add(&v.x, 1).add(&v.y, 1).add(&v.z, 1);
    }
  }
  return d.value();
}

std::uint64_t histories(const InnerList& inner) {
  Digest d;
  inner.add_histories_to(d);
  return d.value();
}

}  // namespace

Dem::Digests Dem::digests() const {
  const Impl* dem = impl_.get();
  return {
      {"grain.position", [dem] { return dem->store.position_digest(); }},
      {"grain.velocity", [dem] { return dem->store.motion_digest(); }},
      {"grain.drag_relaxation", [dem] { return dem->store.drag_digest(); }},
      {"grain.fluid_impulse", [dem] { return dem->store.impulse_digest(); }},
      {"contact.list", [dem] { return lists(dem->outer, dem->inner); }},
      {"contact.history", [dem] { return histories(dem->inner); }},
      {"contact.force", [dem] { return Digest().add(dem->tile_step.contact_force()).value(); }},
      {"contact.ghost_force", [dem] { return dem->tile_step.ghost_digest(); }},
      {"grain.force", [dem] { return dem->tile_step.deferred_digest(); }},
      {"body.motion", [dem] { return placements(dem->conditions); }},
      {"fine.force", [dem] { return Digest().add(dem->fine_level.force()).value(); }},
      {"fine.deferred_impulse", [dem] { return dem->fine_level.deferred().digest(); }},
  };
}

}  // namespace dust::particles
