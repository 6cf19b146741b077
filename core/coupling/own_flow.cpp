// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_impl.hpp"
#include "coupling/own_disturbance.hpp"
#include "dust/sdk/sphere.hpp"

namespace dust::coupling {

/// Solids that a grain brings to its own cell and faces, less those that would be there without it.
void Coupling::Impl::find_own_solids(const particles::GrainRows& grains, Rows rows) {
  // Solids of one grain as a field; zero between grains.
  static thread_local fluid::CellField own;
  own.resize(lattice.grid().size, 0.0);
  WideKernel kernel(lattice, voidage);
  Stencil s;
  WideStencil many;
  const auto face_mean = [](const auto& near) {
    double sum = 0.0;
    double open = 0.0;
    for (std::size_t n = 0; n < near.size(); ++n) {
      const double part = near.weight[n] * near.open[n];
      sum += part * near.void_fraction[n];
      open += part;
    }
    return open > 0.0 ? sum / open : 0.0;
  };
  for (const std::int32_t number : rows) {
    const auto row = static_cast<std::size_t>(number);
    const double* position = grains.position + 4 * row;
    OwnFlow& of_grain = memory.own_flow(row);
    kernel.set(position, position[3]);
    const double volume = grains.weight[row] * sdk::sphere_volume(2.0 * position[3]);
    for (const WideKernel::Share& share : kernel.shares()) {
      own[share.cell] +=
          volume * share.weight / (lattice.open_fraction(share.cell) * lattice.cell_volume());
    }
    const bool is_wide = kernel.takes(position[3]);
    const Place p = lattice.place(position);
    const std::ptrdiff_t host = lattice.host_cell(lattice.cell(p), position);
    const double here = is_wide ? kernel.mean(own) : own[host];
    const double eps = is_wide ? kernel.mean(void_fraction.after()) : void_fraction.after()[host];
    const double excess = own_disturbance::excess_of_one(1.0 - eps - here);
    of_grain.solids = std::min(excess * here, 1.0 - eps);
    for (int d = 0; d < 3; ++d) {
      if (is_wide) {
        kernel.stencil(d, own, many);
        of_grain.face_solids[d] = excess * face_mean(many);
      } else {
        lattice.stencil(d, p, own, s);
        of_grain.face_solids[d] = excess * face_mean(s);
      }
    }
    for (const WideKernel::Share& share : kernel.shares()) own[share.cell] = 0.0;
  }
}

/// Flow around a grain by its own drag: how far it goes, and how much of it pushes the grain. `eps`
/// of the others around, `slip` [m/s] through it.
void Coupling::Impl::find_own_flow(const particles::GrainRows& grains, std::size_t row, double eps,
                                   double slip) {
  namespace own = own_disturbance;
  const double* position = grains.position + 4 * row;
  OwnFlow& of_grain = memory.own_flow(row);
  WideKernel kernel(lattice, voidage);
  const bool is_wide = kernel.takes(position[3]);
  const double edge = std::cbrt(lattice.cell_volume());
  double radius = own::k_trilinear_radius * edge;
  double density = own::k_trilinear_density / lattice.cell_volume();
  if (is_wide) {
    kernel.set(position, position[3]);
    radius = kernel.ball_radius();
    density = 1.0 / sdk::sphere_volume(2.0 * radius);
  }
  const Fluid fluid = fluid_at(position);
  const double reynolds = fluid.density * slip * radius / fluid.viscosity;
  const double mobility = own::mobility(radius, fluid.viscosity, reynolds);
  const double weighted = own::excess_of_one(1.0 - eps) * grains.weight[row];
  const double local = std::max(eps - of_grain.solids, k_smallest_void_fraction);
  of_grain.mobility = weighted * mobility;
  of_grain.growth = -std::expm1(-step / own::build_up_time(radius, fluid.density, mobility));
  of_grain.self_stress = is_set_three ? 0.0
                                      : weighted * own::stress_share(reynolds) * density *
                                            sdk::sphere_volume(2.0 * position[3]) / local;
}

}  // namespace dust::coupling
