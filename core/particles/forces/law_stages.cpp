// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/law_stages.hpp"

#include "contact/batch_kernels.hpp"

#include <algorithm>

namespace dust::particles {

using contact::BatchColumns;

std::int64_t in_touch(BatchColumns& columns, std::size_t count) {
  const double* overlap = columns.column(BatchColumns::overlap);
  return std::count_if(overlap, overlap + count, [](double d) { return d > 0.0; });
}

contact::BatchColumns& thread_columns() {
  thread_local contact::BatchColumns columns;
  return columns;
}

void evaluate_laws(const PairLaws& law, BatchColumns& columns, std::size_t count,
                   double time_step) {
  sdk::ContactBatch batch = columns.view(count, time_step);
  const int first_rolling = law.contact->history_size();
  if (law.cohesion) {
    const int first = first_rolling + (law.rolling ? law.rolling->history_size() : 0);
    contact::derive_normal_velocity(columns, count);
    law.cohesion->evaluate(columns.cohesion_view(count, time_step, first));
    batch.overlap = columns.column(BatchColumns::contact_overlap);
  }
  if (const int couple = law.rolling ? law.rolling->couple_column() : -1; couple >= 0) {
    double* const* history = columns.history() + first_rolling + couple;
    batch.couple.x = history[0];
    batch.couple.y = history[1];
    batch.couple.z = history[2];
  }
  law.contact->evaluate(batch);
  if (law.cohesion) contact::subtract_attraction(columns, count);
  if (law.rolling) {
    batch.overlap = columns.column(BatchColumns::overlap);
    batch.history += first_rolling;
    law.rolling->evaluate(batch);
  }
  contact::derive_torques(columns, count, law.rolling != nullptr);
}

}  // namespace dust::particles
