// SPDX-License-Identifier: Apache-2.0
#include "study/measures.hpp"

#include "scenario/text/suggest.hpp"

namespace dust::study {

using scenario::printable;

void MeasureCheck::see(const std::vector<Quantity>& known) {
  if (first_.empty()) first_ = known;
  for (const Measure& m : spec_.measures) {
    check(m, m.quantity, known);
    if (!m.minus.empty()) check(m, m.minus, known);
  }
}

void MeasureCheck::check(const Measure& measure, const std::string& quantity,
                         const std::vector<Quantity>& known) {
  if (find_quantity(known, quantity) != nullptr || !reported_.insert(measure.name).second) return;
  const bool is_sometimes = find_quantity(first_, quantity) != nullptr;
  diagnostics_.error(measure.where, printable(measure.name) + ": '" + printable(quantity) +
                                        (is_sometimes ? "' is no quantity of every point"
                                                      : "' is no quantity of a run") +
                                        quantity_hint(known, quantity));
}

std::vector<OutputColumn> MeasureCheck::columns() {
  std::vector<OutputColumn> columns;
  for (const Measure& m : spec_.measures) {
    const Quantity* q = find_quantity(first_, m.quantity);
    const Quantity* minus = find_quantity(first_, m.minus);
    if (q == nullptr || (minus == nullptr && !m.minus.empty())) continue;
    const auto factor = unit_factor(q->unit, m.unit);
    if (!factor) {
      diagnostics_.error(m.where, printable(m.name) + ": '" + printable(m.unit) +
                                      "' is no unit of " + q->path + ", which is told in " +
                                      q->unit);
    } else if (minus != nullptr && minus->unit != q->unit) {
      diagnostics_.error(m.where, printable(m.name) + ": " + minus->path + " is told in " +
                                      minus->unit + " and cannot be taken off one in " + q->unit);
    } else {
      columns.push_back({m.name, q->path, minus != nullptr ? minus->path : std::string(),
                         m.unit.empty() ? q->unit : m.unit, *factor, q->has_error, q->zero_beside,
                         minus != nullptr ? minus->zero_beside : std::string()});
    }
  }
  return columns;
}

}  // namespace dust::study
