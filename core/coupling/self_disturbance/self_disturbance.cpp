// SPDX-License-Identifier: Apache-2.0
#include "coupling/self_disturbance/self_disturbance.hpp"

#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::coupling {
namespace {

/// What a drag law makes of solids, over their share: exponents of the void fraction of 2.65
/// to 3.7.
constexpr double k_law_of_solids = 3.0;

/// D/dx above which a lone grain's solids are spread by its kernel, too: they would fill a good
/// part of a cell, and jump as it moves.
constexpr double k_sharp = 0.5 - 1e-9;
/// How much of its own flow slows the stream that carries this away [-]: the mean over the kernel
/// and where it goes.
constexpr double k_slowing = 0.7;
/// Part of a cell that a grain goes on before its faces are looked at again within a fluid step:
/// the kernel is some cells wide, so that what it shows changes little over it.
constexpr double k_look_again = 0.25;
/// Cells within which a body is a wall to a grain's own flow, and over how many of them it becomes
/// one: what is left out is 3 % of the drag of a grain as large as a cell.
constexpr double k_wall_reach = 12.0;
constexpr double k_wall_fade = 4.0;
/// Share of solids of others in one of the cells around from which on a grain is one of many: it
/// keeps its eight faces, so that a bed has the ends that its cells give it.
constexpr double k_crowded = 0.1;

/// Cells and shares of one grain as the voidage rule spreads it.
struct Shares {
  std::vector<int> i, j, k;
  std::vector<double> weight;
  std::size_t used = 0;
};

/// As the deposit has them: the open cells have all of the solids, in the ratio of their shares.
/// False where none of the cells is open.
bool set_shares(const sdk::VoidageRule& rule, const Lattice& lattice, const double* position,
                Shares& shares) {
  const sdk::GridShape shape = lattice.grid().shape();
  const int capacity = rule.capacity(shape, position[3]);
  const auto size = static_cast<std::size_t>(capacity);
  if (shares.weight.size() < size) {
    for (auto* column : {&shares.i, &shares.j, &shares.k}) column->resize(size);
    shares.weight.resize(size);
  }
  int count = 0;
  rule.spread(shape, {1,
                      {position, position + 1, position + 2},
                      position + 3,
                      capacity,
                      &count,
                      shares.i.data(),
                      shares.j.data(),
                      shares.k.data(),
                      shares.weight.data()});
  shares.used = static_cast<std::size_t>(count);
  double open = 0.0;
  bool has_closed = false;
  for (std::size_t n = 0; n < shares.used; ++n) {
    const bool is_open = lattice.open_cell(shares.i[n], shares.j[n], shares.k[n]) >= 0;
    if (!is_open) shares.weight[n] = 0.0;
    has_closed = has_closed || !is_open;
    open += shares.weight[n];
  }
  if (!has_closed || !(open > 0.0)) return open > 0.0;
  for (std::size_t n = 0; n < shares.used; ++n) shares.weight[n] /= open;
  return true;
}

/// Void fraction [-] for the law: of its faces, `of_faces` by component, without the grain's own
/// solids as far as these are in excess.
double void_of_others(const SelfFlow& own, const Triple& of_faces) {
  double sum = 0.0;
  for (std::size_t d = 0; d < 3; ++d) {
    sum += of_faces[d] + own.excess * solids_at(own, d, of_faces[d]);
  }
  return std::min(1.0, sum / 3.0);
}

}  // namespace

SelfDisturbance::SelfDisturbance(scenario::DisturbanceCorrection mode, const CouplingScene& scene)
    : mode_(mode),
      lattice_(scene.lattice),
      voidage_(scene.voidage),
      drag_(scene.drag),
      face_void_(scene.face_void),
      void_fraction_(scene.void_fraction),
      states_(scene.states) {
  sides_.fill(self_disturbance::Side::wall);
  const sdk::Vec3& spacing = lattice_.grid().spacing;
  least_spacing_ = std::min({spacing.x, spacing.y, spacing.z});
  mean_spacing_ = std::cbrt(lattice_.cell_volume());
}

void SelfDisturbance::use_boundaries(
    const std::array<const sdk::BoundaryCondition*, 6>& boundaries) {
  using self_disturbance::Side;
  for (std::size_t n = 0; n < boundaries.size(); ++n) {
    if (boundaries[n] == nullptr) continue;
    const sdk::SideRules rules = boundaries[n]->rules();
    if (rules.normal_velocity != sdk::SideRule::fixed) {
      sides_[n] = Side::open;
    } else {
      const bool is_slip = rules.tangential_velocity != sdk::SideRule::fixed;
      sides_[n] = is_slip ? Side::slip : Side::wall;
    }
  }
}

void SelfDisturbance::prepare(const particles::GrainRows& grains) {
  if (mode_ == scenario::DisturbanceCorrection::felt || states_.has_self_flow()) return;
  if (has_candidates(grains)) states_.keep_self_flow();
}

/// Whether some grain may be worth it by its size alone: what it makes is most in slow flow.
bool SelfDisturbance::has_candidates(const particles::GrainRows& grains) const {
  for (std::size_t row = 0; row < grains.count; ++row) {
    if (is_candidate(grains, row)) return true;
  }
  return false;
}

/// How much of a real grain a row stands for, as far as that is itself [-]: one that stands for
/// many shows what they do together, of which each is a small part. Over the weight it is the part
/// of what the row does.
double SelfDisturbance::own_weight(const particles::GrainRows& grains, std::size_t row) const {
  const double l = drag_.graining().of(grains, row);
  return std::min(1.0, grains.weight[row]) / (l * l * l);
}

bool SelfDisturbance::is_candidate(const particles::GrainRows& grains, std::size_t row) const {
  const double diameter = grains.diameter(row);
  return self_disturbance::may_be_taken_off(diameter, mean_spacing_, least_spacing_,
                                            own_weight(grains, row), worth());
}

/// What the grain would make of a fluid with its eight faces, and its own solids of its drag, over
/// its slip or drag [-]; `eps` of its cell; docs/theory/own_disturbance.md, eq. (9).
double SelfDisturbance::own_part(const particles::GrainRows& grains, std::size_t row, double eps,
                                 double slip) const {
  namespace own = self_disturbance;
  const double* position = grains.position_of(row);
  const DragModel::Fluid fluid = drag_.fluid_at(position);
  const double volume = grains.weight[row] * sdk::sphere_volume(grains.diameter(row));
  const double solids = volume / lattice_.cell_volume();
  const double excess = own::excess_of_one(1.0 - eps - solids);
  const double weighted = excess * own_weight(grains, row);
  if (weighted * k_law_of_solids * sdk::sphere_volume(grains.diameter(row)) /
          lattice_.cell_volume() >
      worth()) {
    return 1.0;
  }
  if (weighted * own::most_of_slip(grains.diameter(row), mean_spacing_) <= worth()) return 0.0;
  // Schiller and Naumann's drag will do to tell whether it is worth it.
  const double factor = 1.0 + 0.15 * std::pow(drag_.reynolds(grains, row, 1.0, slip), 0.687);
  const double l = drag_.graining().of(grains, row);
  return weighted / (l * l) * drag_.coefficient(grains, row, factor) *
         own::mobility_of_corners(mean_spacing_, fluid.viscosity, fluid.density, slip);
}

/// Decides whether what a grain does by itself is taken off until the next begin_step(), and finds
/// it. `eps` is the void fraction of its cell, and becomes that of the others around it.
bool SelfDisturbance::begin_step(const particles::GrainRows& grains, std::size_t row, double slip,
                                 double step, SmoothKernel& kernel, double& eps) {
  SelfFlow& own = states_.self_flow(row);
  const double* position = grains.position_of(row);
  const bool is_worth =
      own.spread > 0.0 || (is_candidate(grains, row) && own_part(grains, row, eps, slip) > worth());
  const auto room = is_worth && (own.spread > 0.0 || crowding(grains, row) < k_crowded)
                        ? kernel.set(position, grains.diameter(row))
                        : SmoothKernel::Room::none;
  if (room == SmoothKernel::Room::none) {
    if (own.is_smooth) own = {};
    return false;
  }
  own.is_beside = room == SmoothKernel::Room::beside;
  own.seen.is_valid = false;
  own.is_smooth = true;
  own.released = states_[row].deferred;
  find_own_solids(grains, row, kernel);
  Triple of_faces;
  for (int d = 0; d < 3; ++d) {
    const FaceColumns columns = face_void_.columns(d);
    const SmoothKernel::Sums sums = kernel.sum_faces(d, columns);
    of_faces[static_cast<std::size_t>(d)] = sums.fluid / sums.open;
  }
  own.excess = 1.0;
  own.excess = self_disturbance::excess_of_one(1.0 - void_of_others(own, of_faces)) *
               own_weight(grains, row) / grains.weight[row];
  eps = void_of_others(own, of_faces);
  find_self_flow(grains, row, kernel, (of_faces[0] + of_faces[1] + of_faces[2]) / 3.0, slip, step);
  return true;
}

/// Most solids of others in one of the 27 cells around, while its own are spread by the rule.
double SelfDisturbance::crowding(const particles::GrainRows& grains, std::size_t row) const {
  static thread_local Shares shares;
  const double* position = grains.position_of(row);
  const double solids =
      grains.weight[row] * sdk::sphere_volume(grains.diameter(row)) / lattice_.cell_volume();
  const Place p = lattice_.place(position);
  const std::ptrdiff_t here = lattice_.cell(p);
  const double at_least = 1.0 - void_fraction_.after()[here] -
                          solids / std::max(k_min_open, lattice_.open_fraction(here));
  if (at_least >= k_crowded) return at_least;  // as in most of a packing
  set_shares(voidage_, lattice_, position, shares);
  double most = 0.0;
  for (int k = -1; k <= 1; ++k) {
    for (int j = -1; j <= 1; ++j) {
      for (int i = -1; i <= 1; ++i) {
        const std::ptrdiff_t cell = lattice_.cell(p[0].cell + i, p[1].cell + j, p[2].cell + k);
        double others = 1.0 - void_fraction_.after()[cell];
        if (others < k_crowded) continue;
        for (std::size_t n = 0; n < shares.used; ++n) {
          const bool is_it = lattice_.open_cell(shares.i[n], shares.j[n], shares.k[n]) == cell;
          if (is_it) others -= solids * shares.weight[n] / lattice_.open_fraction(cell);
        }
        most = std::max(most, others);
      }
    }
  }
  return most;
}

/// Spreads the solids of large lone grains by their kernels, in place of the voidage rule.
void SelfDisturbance::spread_solids(const particles::GrainRows& grains) {
  struct Move {
    std::ptrdiff_t cell;
    double volume;
  };
  static thread_local Shares shares;
  std::vector<Move> moves;
  SmoothKernel kernel(lattice_);
  for (std::size_t row = 0; row < grains.count; ++row) {
    const double* position = grains.position_of(row);
    if (grains.diameter(row) <= k_sharp * least_spacing_ || !is_candidate(grains, row)) continue;
    SelfFlow& own = states_.self_flow(row);
    own.spread = 0.0;
    const double volume = grains.weight[row] * sdk::sphere_volume(grains.diameter(row));
    const double others = crowding(grains, row);
    if (others >= k_crowded) continue;
    if (kernel.set(position, grains.diameter(row)) == SmoothKernel::Room::none) continue;
    if (!set_shares(voidage_, lattice_, position, shares)) continue;
    // Nothing jumps when others come near.
    own.spread = 1.0 - std::max(0.0, others) / k_crowded;
    for (std::size_t n = 0; n < shares.used; ++n) {
      const std::ptrdiff_t from = lattice_.open_cell(shares.i[n], shares.j[n], shares.k[n]);
      if (from >= 0) moves.push_back({from, -own.spread * volume * shares.weight[n]});
    }
    const double put = own.spread * volume / kernel.inside();
    kernel.for_cells([&](std::ptrdiff_t to, double w) {
      if (!(w > 0.0) || !lattice_.is_in_domain(to)) return;
      const double room = kernel.room_in(to);
      if (room > 0.0) moves.push_back({to, put * w * room});
    });
  }
  for (const Move& move : moves) void_fraction_.add_after(move.cell, move.volume);
}

/// Its own solids at its faces: each cell gives its share to both faces along each axis.
void SelfDisturbance::find_own_solids(const particles::GrainRows& grains, std::size_t row,
                                      const SmoothKernel& kernel) {
  static thread_local Shares shares;
  const double* position = grains.position_of(row);
  set_shares(voidage_, lattice_, position, shares);
  SelfFlow& own = states_.self_flow(row);
  const double solids =
      grains.weight[row] * sdk::sphere_volume(grains.diameter(row)) / lattice_.cell_volume();
  for (int d = 0; d < 3; ++d) {
    own.solids[static_cast<std::size_t>(d)] = own.spread * solids * kernel.overlap(d);
  }
  if (!(own.spread < 1.0)) return;
  const Triple inside{kernel.inside(0), kernel.inside(1), kernel.inside(2)};
  for (std::size_t n = 0; n < shares.used; ++n) {
    const std::array<int, 3> cell{shares.i[n], shares.j[n], shares.k[n]};
    for (int d = 0; d < 3; ++d) {
      std::array<int, 3> above = cell;
      above[static_cast<std::size_t>(d)] += 1;
      own.solids[static_cast<std::size_t>(d)] +=
          (1.0 - own.spread) * solids * shares.weight[n] * 0.5 *
          (kernel.weight(d, cell) + kernel.weight(d, above)) / inside[static_cast<std::size_t>(d)];
    }
  }
}

/// How its flow grows and fades in a fluid step, and what its stress does; `eps` at its faces.
void SelfDisturbance::find_self_flow(const particles::GrainRows& grains, std::size_t row,
                                     const SmoothKernel& kernel, double eps, double slip,
                                     double step) {
  SelfFlow& own = states_.self_flow(row);
  const DragModel::Fluid fluid = drag_.fluid_at(grains.position_of(row));
  // The stream that carries the flow away is slowed by it.
  double own_speed = 0.0;
  for (std::size_t d = 0; d < 3; ++d) own_speed += disturbance(own, d) * disturbance(own, d);
  const double stream = std::max(0.0, slip - k_slowing * std::sqrt(own_speed));
  const self_disturbance::Response response =
      self_disturbance::response(kernel.width(), fluid.viscosity, fluid.density, stream);
  const auto wall = lattice_.walls().nearest(grains.centre(row), k_wall_reach * mean_spacing_);
  for (std::size_t n = 0; n < self_disturbance::k_groups; ++n) {
    own.kept[n] = std::exp(-response.rate[n] * step);
    const double gained = -std::expm1(-response.rate[n] * step) * response.mobility[n];
    const double k = self_disturbance::k_waves[n] / kernel.width();
    for (int d = 0; d < 3; ++d) {
      own.gained[n][static_cast<std::size_t>(d)] =
          gained * beside_walls(grains, row, wall ? &*wall : nullptr, d, k);
    }
  }
  const double density =
      concentration_seen(grains, row, own, kernel) / (eps * lattice_.cell_volume());
  own.self_stress = drag_.is_set_three() ? 0.0
                                         : own.excess * grains.weight[row] * response.stress *
                                               density * sdk::sphere_volume(grains.diameter(row));
}

/// Share of its force per cell that a grain sees of the stress that balances it [-]: through its
/// kernel, or beside a wall as all others do, at the faces of its cell. One larger than a cell sees
/// it over its cells, about as wide as its kernel.
double SelfDisturbance::concentration_seen(const particles::GrainRows& grains, std::size_t row,
                                           const SelfFlow& own, const SmoothKernel& kernel) const {
  if (!own.is_beside || grains.diameter(row) > least_spacing_) return kernel.concentration(0);
  const Place here = lattice_.place(grains.position_of(row));
  double sum = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double inside = kernel.inside(d);
    for (const int side : {0, 1}) {
      const Lattice::Face face = lattice_.face(d, here[0].cell, here[1].cell, here[2].cell, side);
      sum += 0.5 * kernel.weight_at_storage(d, face.storage) / inside;
    }
  }
  return sum / 3.0;
}

/// What sides and bodies make of a group of waves of a force along d.
double SelfDisturbance::beside_walls(const particles::GrainRows& grains, std::size_t row,
                                     const NearWalls::Wall* wall, int d, double k) const {
  namespace own = self_disturbance;
  const fluid::Grid& grid = lattice_.grid();
  const auto knots_in = [&](double cell) {
    return std::max(grains.diameter(row), own::k_min_knots * cell);
  };
  double factor = 1.0;
  for (int axis = 0; axis < 3; ++axis) {
    const auto a = static_cast<std::size_t>(axis);
    if (grid.is_periodic[a]) continue;
    const double cell = grid.spacing[axis];
    const double above = grains.position_of(row)[axis] - grid.origin[axis];
    const double below = grid.count[a] * cell - above;
    for (const int high : {0, 1}) {
      const double distance = std::max(high == 0 ? above : below, 0.0);
      factor *= own::beside_side(sides_[2 * a + static_cast<std::size_t>(high)], axis == d, k,
                                 {distance, knots_in(cell), cell});
    }
  }
  if (wall == nullptr) return factor;
  const own::Beside at{std::max(wall->distance, 0.0), knots_in(mean_spacing_), mean_spacing_};
  // A force askew to the wall is one along it and one across it.
  const double across = wall->normal[d] * wall->normal[d];
  const double left = (1.0 - across) * own::beside_side(own::Side::wall, false, k, at) +
                      across * own::beside_side(own::Side::wall, true, k, at);
  // Nothing jumps where a wall comes into reach.
  const double near =
      std::clamp((k_wall_reach - at.distance / mean_spacing_) / k_wall_fade, 0.0, 1.0);
  return factor * (1.0 - near * (1.0 - left));
}

/// The flow that a fluid step has left of what there was, and what it added.
void SelfDisturbance::end_step(double step) {
  if (!states_.has_self_flow()) return;
  for (std::size_t row = 0; row < states_.size(); ++row) {
    SelfFlow& own = states_.self_flow(row);
    if (!own.is_smooth) continue;
    for (std::size_t d = 0; d < 3; ++d) {
      const double force = (states_[row].given[d] - own.released[d]) / step;
      for (std::size_t n = 0; n < self_disturbance::k_groups; ++n) {
        own.flow[n][d] = own.kept[n] * own.flow[n][d] + own.gained[n][d] * force;
      }
    }
  }
}

/// Looks at the faces of a grain with a SmoothKernel.
void SelfDisturbance::look_at_kernel(const double* position, const SmoothKernel& kernel,
                                     const FluidState& state, bool needs_stress,
                                     SelfFlow::Seen& seen) const {
  for (int d = 0; d < 3; ++d) {
    const FaceColumns columns = face_void_.columns(d);
    const double* u = state.velocity.component[d].data();
    const double* push = state.stress_divergence.component[d].data();
    double all = 0.0;
    double flux = 0.0;
    double open = 0.0;
    double fluid = 0.0;
    double stress = 0.0;
    kernel.for_faces(d, [&](std::ptrdiff_t face, double w) {
      const double eps = columns.void_fraction[face];
      const double part = w * columns.open[face];
      all += w * eps;
      flux += w * eps * u[face];
      open += part;
      fluid += part * eps;
      if (needs_stress && part > 0.0) stress += w * push[face];
    });
    const auto c = static_cast<std::size_t>(d);
    seen.place[c] = position[d];
    seen.flux[c] = flux;
    seen.all[c] = all;
    seen.eps[c] = open > 0.0 ? fluid / open : all;
    seen.stress[c] = stress;
  }
  seen.is_valid = true;
}

/// What the grains with a SmoothKernel see of the fluid, in place of what their eight faces show.
void SelfDisturbance::sample(const ParticleBatch& batch, const FluidState& state, bool needs_stress,
                             const std::array<StencilBatch::Reals, 3>& v, SampledFlow& seen,
                             DragColumns& columns) {
  SmoothKernel kernel(lattice_);
  const double far = k_look_again * least_spacing_;
  for (std::size_t q = 0; q < batch.size(); ++q) {
    const std::size_t row = batch.row(q);
    if (!states_.is_smooth(row)) continue;
    SelfFlow& own = states_.self_flow(row);
    const double* position = batch.here.position_of(q);
    double way = 0.0;
    for (std::size_t d = 0; d < 3; ++d) {
      way = std::max(way, std::abs(position[d] - own.seen.place[d]));
    }
    if (!own.seen.is_valid || way > far) {
      kernel.set(position, 2.0 * batch.here.radius(q));
      look_at_kernel(position, kernel, state, needs_stress, own.seen);
    }
    for (std::size_t d = 0; d < 3; ++d) {
      const double flux = own.seen.flux[d] - own.seen.all[d] * v[d][q];
      seen.slip[d][q] = flux / void_of_flux(own, d, own.seen.eps[d]) + disturbance(own, d);
      seen.ratio[d][q] = 1.0;
      // Beside a side the pressure acts as on all others, so that a layer on it has its weight.
      if (!own.is_beside) seen.stress[d][q] = own.seen.stress[d];
    }
    columns.void_fraction[q] = void_of_others(own, own.seen.eps);
  }
}

}  // namespace dust::coupling
