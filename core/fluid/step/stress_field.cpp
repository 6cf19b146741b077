// SPDX-License-Identifier: Apache-2.0
#include "fluid/step/stress_field.hpp"

#include "fluid/parallel.hpp"
#include "fluid/pressure/continuity.hpp"

namespace dust::fluid {
namespace {

/// stress -= grad p, at unknown faces, and the force of eddies where there are any.
void subtract_gradient(int n, std::ptrdiff_t s, double inverse_h, const FaceKind* kind,
                       const double* p, const double* eddies, double* stress) {
#pragma GCC ivdep
  for (int i = 0; i < n; ++i) {
    const double force = inverse_h * (p[i] - p[i - s]);
    const double next = stress[i] - force;
    stress[i] = is_unknown(kind[i]) ? next : stress[i];
  }
  if (eddies == nullptr) return;
  for (int i = 0; i < n; ++i) {
    if (is_unknown(kind[i])) stress[i] += eddies[i];
  }
}

}  // namespace

const FaceField& StressField::of_flow(const FaceField& u, CellField& pressure, EddyStress* eddies) {
  return stress_.get([&](FaceField& stress) {
    find(u, pressure, eddies, eddies != nullptr ? &eddies->force() : nullptr, stress);
  });
}

const FaceField& StressField::of_mean(const FaceField& mean_velocity, CellField& mean_pressure,
                                      EddyStress* eddies) {
  FaceField& stress = stress_.write();
  find(mean_velocity, mean_pressure, eddies, eddies != nullptr ? &eddies->mean_force() : nullptr,
       stress);
  return stress;
}

/// Halos filled, with the `force` of eddies (null: none).
void StressField::find(const FaceField& v, CellField& pressure, EddyStress* eddies,
                       const FaceField* force, FaceField& stress) {
  sides_.fill_pressure(pressure, false);
  momentum_.viscous_force(v, stress);
  if (eddies != nullptr) eddies->update(v);
  for (int d = 0; d < 3; ++d) {
    const auto& n = geometry_.extent[d];
    const double inverse_h = 1.0 / grid_.spacing[d];
    const std::ptrdiff_t s = grid_.stride[d];
    for_rows(n[0], n[1], n[2], [&](int j, int k) {
      const std::ptrdiff_t o = grid_.index(0, j, k);
      subtract_gradient(n[0], s, inverse_h, &geometry_.kind[d][o], &pressure[o],
                        force != nullptr ? &force->component[d][o] : nullptr,
                        &stress.component[d][o]);
    });
    if (sides_.kinds().is_periodic[d]) wrap_last_face(grid_, d, stress.component[d]);
  }
}

}  // namespace dust::fluid
