// SPDX-License-Identifier: Apache-2.0
#include "particles/forces/weight_ratios.hpp"

namespace dust::particles {

using contact::BatchColumns;

bool find_weight_ratios(const ParticleStore& particles, const PairBatch& batch) {
  const contact::PairView& pairs = batch.pairs;
  BatchColumns& columns = batch.columns;
  bool has_scales = false;
  double* scale_i = columns.column(BatchColumns::scale_i);
  double* scale_j = columns.column(BatchColumns::scale_j);
  for (std::size_t q = 0; q < batch.count; ++q) {
    const std::size_t entry = batch.entry(q);
    const double wi = particles.weight(static_cast<std::size_t>(pairs.a[entry]));
    const double wj = particles.weight(static_cast<std::size_t>(pairs.b[entry]));
    scale_i[q] = felt_share(wi, wj);
    scale_j[q] = felt_share(wj, wi);
    if (wi == wj) continue;
    has_scales = true;
    const auto inverse_mass = [&](std::int32_t row) {
      return particles.inverse_mass(static_cast<std::size_t>(row));
    };
    columns.column(BatchColumns::inverse_mass_i)[q] = scale_i[q] * inverse_mass(pairs.a[entry]);
    columns.column(BatchColumns::inverse_mass_j)[q] = scale_j[q] * inverse_mass(pairs.b[entry]);
  }
  return has_scales;
}

}  // namespace dust::particles
