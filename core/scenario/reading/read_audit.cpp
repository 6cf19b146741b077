// SPDX-License-Identifier: Apache-2.0
#include "scenario/reading/setup_reader.hpp"

#include <utility>

namespace dust::scenario {

/// `audit: {energy: true}`. Written out where it is given: runs without it stay as they are.
void SetupReader::read_audit(MapReader& top) {
  const Entry* entry = top.optional("audit");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "audit", entry->where, diagnostics_);
  if (!entry->value.is_map()) return;
  std::vector<sdk::Value> values;
  const auto audit = block<AuditBlock>(reader, &values);
  reader.finish();
  setup_.audit = {.energy = audit.energy, .where = mark_of(entry->value, "energy")};
  out_.add("audit", written_block<AuditBlock>(values));
}

/// What the account does not hold.
void SetupReader::check_audit() {
  if (!setup_.audit.energy) return;
  if (!setup_.time.rates_single) {
    error(setup_.audit.where,
          "audit.energy: grains on finer time steps exchange impulses that the account of a step "
          "does not hold; give `time: {rates: single}` or leave the account out");
  }
  if (setup_.fluid && !setup_.fluid->resolved.empty()) {
    error(setup_.audit.where,
          "audit.energy: the account does not hold the work of the fluid on resolved spheres; "
          "leave out `coupling.resolved` or the account");
  }
}

}  // namespace dust::scenario
