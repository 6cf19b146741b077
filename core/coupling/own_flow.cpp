// SPDX-License-Identifier: Apache-2.0
#include "coupling/coupling_impl.hpp"
#include "coupling/own_disturbance.hpp"
#include "dust/sdk/sphere.hpp"

namespace dust::coupling {
namespace {

/// What a drag law makes of solids, over their share: exponents of the void fraction of 2.65 to 3.7.
constexpr double k_law_of_solids = 3.0;

/// D/dx above which a lone grain's solids are spread by its kernel, too: they would fill a good part
/// of a cell, and jump as it moves.
constexpr double k_sharp = 0.3;
/// How much of its own flow slows the stream that carries this away [-]: the mean over the kernel and
/// where it goes.
constexpr double k_slowing = 0.7;
/// Excess up to which solids are left to the voidage rule alone.
constexpr double k_crowded = 0.05;

/// Cells and shares of one grain as the voidage rule spreads it.
struct Shares {
  std::vector<int> i, j, k;
  std::vector<double> weight;
  std::size_t used = 0;

  void set(const sdk::VoidageRule& rule, const sdk::GridShape& shape, const double* position) {
    const int capacity = rule.capacity(shape, position[3]);
    const auto size = static_cast<std::size_t>(capacity);
    if (weight.size() < size) {
      for (auto* column : {&i, &j, &k}) column->resize(size);
      weight.resize(size);
    }
    int count = 0;
    rule.spread(shape, {1, position, position + 1, position + 2, position + 3, capacity, &count,
                        i.data(), j.data(), k.data(), weight.data()});
    used = static_cast<std::size_t>(count);
  }
};

}  // namespace

/// Whether some grain may be worth it by its size alone: what it makes is most in slow flow.
bool Coupling::Impl::has_candidates(const particles::GrainRows& grains) const {
  for (std::size_t row = 0; row < grains.count; ++row) {
    if (is_candidate(grains, row)) return true;
  }
  return false;
}

bool Coupling::Impl::is_candidate(const particles::GrainRows& grains, std::size_t row) const {
  const double diameter = 2.0 * grains.position[4 * row + 3];
  const double l = graining.of(grains, row);
  const double most = own_disturbance::most_of_slip(diameter, mean_spacing);
  return diameter <= own_disturbance::k_largest_ratio * least_spacing * (1.0 + k_ratio_rounding) &&
         most * grains.weight[row] * l * l > worth();
}

/// What the grain would make of a fluid with its eight faces, and its own solids of its drag, over
/// its slip or drag [-]; `eps` of its cell.
double Coupling::Impl::own_part(const particles::GrainRows& grains, std::size_t row, double eps,
                                double slip) const {
  namespace own = own_disturbance;
  const double* position = grains.position + 4 * row;
  const Fluid fluid = fluid_at(position);
  const double volume = grains.weight[row] * sdk::sphere_volume(2.0 * position[3]);
  const double solids = volume / lattice.cell_volume();
  const double excess = own::excess_of_one(1.0 - eps - solids);
  if (excess * k_law_of_solids * solids > worth()) return 1.0;
  // Schiller and Naumann's drag will do to tell whether it is worth it.
  const double factor = 1.0 + 0.15 * std::pow(reynolds(grains, row, 1.0, slip), 0.687);
  return excess * grains.weight[row] * coefficient(grains, row, factor) *
         own::mobility_of_corners(mean_spacing, fluid.viscosity, fluid.density, slip);
}

/// Decides whether what a grain does by itself is taken off until the next map(), and finds it.
/// `eps` is the void fraction of its cell, and becomes that of the others around it.
bool Coupling::Impl::take_own_off(const particles::GrainRows& grains, std::size_t row, double slip,
                                  SmoothKernel& kernel, double& eps) {
  OwnFlow& own = memory.own_flow(row);
  const double* position = grains.position + 4 * row;
  const bool is_worth = own.spread > 0.0 || (is_candidate(grains, row) &&
                                             own_part(grains, row, eps, slip) > worth());
  if (!is_worth || !kernel.set(position, 2.0 * position[3])) {
    own = {};
    return false;
  }
  own.is_smooth = true;
  own.paid = memory[row].owed;
  find_own_solids(grains, row, kernel);
  Triple of_faces;
  for (int d = 0; d < 3; ++d) {
    const double* at_faces = face_void.columns(d).void_fraction;
    double sum = 0.0;
    kernel.for_faces(d, [&](std::ptrdiff_t face, double w) { sum += w * at_faces[face]; });
    of_faces[static_cast<std::size_t>(d)] = sum;
  }
  own.excess = 1.0;
  own.excess = own_disturbance::excess_of_one(1.0 - void_of_others(own, of_faces));
  eps = void_of_others(own, of_faces);
  find_own_flow(grains, row, kernel, (of_faces[0] + of_faces[1] + of_faces[2]) / 3.0, slip);
  return true;
}

/// Void fraction [-] for the law: of its faces, `of_faces` by component, without the grain's own
/// solids as far as these are in excess.
double Coupling::Impl::void_of_others(const OwnFlow& own, const Triple& of_faces) {
  double sum = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    sum += of_faces[d] + own.excess * own.solids_at(d, of_faces[d]);
  }
  return std::min(1.0, sum / 3.0);
}

/// Spreads the solids of large lone grains by their kernels, in place of the voidage rule.
void Coupling::Impl::spread_smoothly(const particles::GrainRows& grains) {
  struct Move {
    std::ptrdiff_t cell;
    double volume;
  };
  static thread_local Shares shares;
  std::vector<Move> moves;
  SmoothKernel kernel(lattice);
  for (std::size_t row = 0; row < grains.count; ++row) {
    OwnFlow& own = memory.own_flow(row);
    own.spread = 0.0;
    const double* position = grains.position + 4 * row;
    if (2.0 * position[3] <= k_sharp * least_spacing || !is_candidate(grains, row)) continue;
    if (!kernel.set(position, 2.0 * position[3])) continue;
    const double volume = grains.weight[row] * sdk::sphere_volume(2.0 * position[3]);
    shares.set(voidage, lattice.grid().shape(), position);
    double others = 1.0 - kernel.mean(void_fraction.after());
    for (std::size_t n = 0; n < shares.used; ++n) {
      others -= volume / lattice.cell_volume() * shares.weight[n] *
                kernel.weight({shares.i[n], shares.j[n], shares.k[n]});
    }
    const double excess = own_disturbance::excess_of_one(others);
    if (excess <= k_crowded) continue;
    own.spread = (excess - k_crowded) / (1.0 - k_crowded);
    for (std::size_t n = 0; n < shares.used; ++n) {
      const std::ptrdiff_t cell = lattice.open_cell(shares.i[n], shares.j[n], shares.k[n]);
      if (cell >= 0) moves.push_back({cell, -own.spread * volume * shares.weight[n]});
    }
    kernel.for_cells([&](std::ptrdiff_t cell, double w) {
      if (w > 0.0) moves.push_back({cell, own.spread * volume * w});
    });
  }
  for (const Move& move : moves) void_fraction.add_after(move.cell, move.volume);
}

/// Its own solids at its faces: each cell gives its share to both faces along each axis.
void Coupling::Impl::find_own_solids(const particles::GrainRows& grains, std::size_t row,
                                     const SmoothKernel& kernel) {
  static thread_local Shares shares;
  const double* position = grains.position + 4 * row;
  shares.set(voidage, lattice.grid().shape(), position);
  OwnFlow& own = memory.own_flow(row);
  const double solids =
      grains.weight[row] * sdk::sphere_volume(2.0 * position[3]) / lattice.cell_volume();
  for (int d = 0; d < 3; ++d) {
    own.solids[static_cast<std::size_t>(d)] = own.spread * solids * kernel.overlap(d);
  }
  for (std::size_t n = 0; own.spread < 1.0 && n < shares.used; ++n) {
    const std::array<int, 3> cell{shares.i[n], shares.j[n], shares.k[n]};
    for (int d = 0; d < 3; ++d) {
      std::array<int, 3> above = cell;
      above[static_cast<std::size_t>(d)] += 1;
      own.solids[static_cast<std::size_t>(d)] +=
          (1.0 - own.spread) * solids * shares.weight[n] * 0.5 *
          (kernel.weight(d, cell) + kernel.weight(d, above));
    }
  }
}

/// How its flow grows and fades in a fluid step, and what its stress does; `eps` at its faces.
void Coupling::Impl::find_own_flow(const particles::GrainRows& grains, std::size_t row,
                                   const SmoothKernel& kernel, double eps, double slip) {
  const double* position = grains.position + 4 * row;
  OwnFlow& own = memory.own_flow(row);
  const Fluid fluid = fluid_at(position);
  // The stream that carries the flow away is slowed by it.
  double own_speed = 0.0;
  for (std::size_t d = 0; d < 3; ++d) own_speed += own.disturbance(d) * own.disturbance(d);
  const double stream = std::max(0.0, slip - k_slowing * std::sqrt(own_speed));
  const own_disturbance::Response response =
      own_disturbance::response(kernel.width(), fluid.viscosity, fluid.density, stream);
  for (std::size_t n = 0; n < own_disturbance::k_groups; ++n) {
    own.kept[n] = std::exp(-response.rate[n] * step);
    own.gained[n] = -std::expm1(-response.rate[n] * step) * response.mobility[n];
  }
  const double density = kernel.concentration(0) / (eps * lattice.cell_volume());
  own.self_stress = is_set_three ? 0.0
                                 : own.excess * grains.weight[row] * response.stress * density *
                                       sdk::sphere_volume(2.0 * position[3]);
}

/// After settle(): the flow that a fluid step has left of what there was, and what it added.
void Coupling::Impl::advance_own_flow() {
  if (!memory.has_own_flow()) return;
  for (std::size_t row = 0; row < memory.size(); ++row) {
    OwnFlow& own = memory.own_flow(row);
    if (!own.is_smooth) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      const double force = (memory[row].given[d] - own.paid[d]) / step;
      for (std::size_t n = 0; n < own_disturbance::k_groups; ++n) {
        own.flow[n][d] = own.kept[n] * own.flow[n][d] + own.gained[n] * force;
      }
    }
  }
}

/// What the grains with a SmoothKernel see of the fluid, in place of what their eight faces show.
void Coupling::Impl::look_smooth(const SpotBatch& spot, Rows rows, const FluidState& state,
                                 const std::array<SpotBatch::Reals, 3>& v, Seen& seen,
                                 Batch& batch) const {
  const bool needs_stress = !is_set_three || forces;
  SmoothKernel kernel(lattice);
  for (std::size_t q = 0; q < rows.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows[q]);
    if (!memory.is_smooth(row)) continue;
    const OwnFlow& own = memory.own_flow(row);
    kernel.set(&spot.position[4 * q], 2.0 * spot.position[4 * q + 3]);
    Triple of_faces;
    for (int d = 0; d < 3; ++d) {
      const auto c = static_cast<std::size_t>(d);
      const double* at_faces = face_void.columns(d).void_fraction;
      const double* u = state.velocity.component[d].data();
      const double* push = state.stress_divergence.component[d].data();
      double eps = 0.0;
      double flux = 0.0;
      double stress = 0.0;
      kernel.for_faces(d, [&](std::ptrdiff_t face, double w) {
        const double part = w * at_faces[face];
        eps += part;
        flux += part * (u[face] - v[c][q]);
        if (needs_stress) stress += w * push[face];
      });
      of_faces[c] = eps;
      seen.slip[c][q] = flux / own.void_of_flux(c, eps) + own.disturbance(c);
      seen.ratio[c][q] = 1.0;
      seen.stress[c][q] = stress;
    }
    batch.void_fraction[q] = void_of_others(own, of_faces);
  }
}

}  // namespace dust::coupling
