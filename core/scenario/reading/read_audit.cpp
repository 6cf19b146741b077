// SPDX-License-Identifier: Apache-2.0
#include "scenario/reading/block_readers.hpp"
#include "scenario/reading/reading.hpp"

namespace dust::scenario {

/// `audit: {energy: true}`. Written out where it is given: runs without it stay as they are.
void read_audit(Reading& reading, MapReader& top) {
  const Entry* entry = top.optional("audit");
  if (entry == nullptr) return;
  MapReader reader(entry->value, "audit", entry->where, reading.diagnostics);
  if (!entry->value.is_map()) return;
  std::vector<sdk::Value> values;
  const auto audit = block<AuditBlock>(reader, &values);
  reader.finish();
  reading.setup.audit = {.energy = audit.energy, .where = mark_of(entry->value, "energy")};
  add(reading.written, "audit", written_block<AuditBlock>(values));
}

/// What the account does not hold.
void check_audit(Reading& reading) {
  if (!reading.setup.audit.energy) return;
  if (reading.setup.fluid && !reading.setup.fluid->resolved.empty()) {
    reading.error(
        reading.setup.audit.where,
        "audit.energy: the account does not hold the work of the fluid on resolved spheres; "
        "leave out `coupling.resolved` or the account");
  }
}

}  // namespace dust::scenario
