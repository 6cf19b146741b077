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

std::uint64_t histories(const InnerList& inner) {
  Digest d;
  inner.add_histories_to(d);
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
      {"contact.list", [dem] { return lists(dem->outer, dem->inner); }},
      {"contact.history", [dem] { return histories(dem->inner); }},
      {"contact.force", [dem] { return Digest().add(dem->contact_force).value(); }},
      {"contact.ghost_force", [dem] { return dem->ghosts.digest(); }},
      {"grain.force", [dem] { return dem->deferred.digest(); }},
      {"fine.force", [dem] { return Digest().add(dem->fine_level.force()).value(); }},
      {"fine.deferred_impulse", [dem] { return dem->fine_level.deferred().digest(); }},
  };
}

}  // namespace dust::particles
