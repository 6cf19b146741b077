// SPDX-License-Identifier: Apache-2.0
#include "run/audit/force_shares.hpp"

#include "dust/sdk/fluid_cells.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <vector>

namespace dust::run {
namespace {

using sdk::Vec3;

std::size_t index(ForceKind kind) { return static_cast<std::size_t>(kind); }

/// Sums of the contacts on each grain.
struct ContactSums {
  std::vector<Vec3> pressing, tangential, pulling;

  explicit ContactSums(std::size_t grains)
      : pressing(grains), tangential(grains), pulling(grains) {}

  void add(const particles::ContactRecord& c) {
    const double length = norm(c.branch);
    if (!(length > 0.0)) return;
    const Vec3 towards = c.branch / length;
    const double pull = dot(c.force, towards);
    const Vec3 normal = pull * towards;
    put(c.row_i, pull > 0.0, normal, c.force - normal);
    if (c.row_j >= 0) put(c.row_j, pull > 0.0, -normal, normal - c.force);
  }
  void put(std::int32_t row, bool is_pull, Vec3 normal, Vec3 along) {
    const auto n = static_cast<std::size_t>(row);
    (is_pull ? pulling : pressing)[n] += normal;
    tangential[n] += along;
  }
};

/// Pressure gradient [Pa/m] in the cell that holds `point`, from the two cells beside it, one at
/// the ends; cells with less than half their volume open do not count.
class PressureGradient {
 public:
  explicit PressureGradient(const sdk::FluidColumns& fluid) : fluid_(fluid), cells_(fluid) {}

  [[nodiscard]] bool is_there() const { return !cells_.is_empty(); }
  [[nodiscard]] Vec3 at(Vec3 point) const {
    int cell[3];
    for (int d = 0; d < 3; ++d) cell[d] = cells_.cell_at(d, point[d]);
    Vec3 gradient;
    for (int d = 0; d < 3; ++d) gradient[d] = along(d, cell);
    return gradient;
  }

 private:
  [[nodiscard]] double along(int d, const int* cell) const {
    const int own = cell[d];
    int ends[2] = {own, own};
    for (const int step : {-1, 1}) {
      const int next = own + step;
      if (next < 0 || next >= fluid_.count[d]) continue;
      if (cells_.is_open(row(d, next, cell))) ends[step < 0 ? 0 : 1] = next;
    }
    if (ends[0] == ends[1]) return 0.0;
    const double change = static_cast<double>(fluid_.pressure[row(d, ends[1], cell)]) -
                          static_cast<double>(fluid_.pressure[row(d, ends[0], cell)]);
    return change / (fluid_.spacing[d] * (ends[1] - ends[0]));
  }
  [[nodiscard]] std::size_t row(int d, int at, const int* cell) const {
    int c[3] = {cell[0], cell[1], cell[2]};
    c[d] = at;
    return cells_.index(c[0], c[1], c[2]);
  }

  const sdk::FluidColumns& fluid_;
  sdk::FluidCells cells_;
};

}  // namespace

void ForceShares::sample(const particles::GrainRows& grains,
                         std::span<const particles::ContactRecord> contacts,
                         const Surroundings& in) {
  ++samples_;
  ContactSums sums(grains.count);
  for (const auto& contact : contacts) sums.add(contact);
  const PressureGradient gradient(in.fluid);
  const double g = norm(in.gravity);
  for (std::size_t n = 0; n < grains.count; ++n) {
    const double weight = grains.weight[n];
    const double* v = grains.velocity_of(n);
    const double mass = grains.mass(n);
    const double volume = sdk::sphere_volume(grains.diameter(n));
    const auto add = [&](ForceKind kind, double force) { sums_[index(kind)] += weight * force; };
    add(ForceKind::gravity, mass * g);
    add(ForceKind::buoyancy, in.fluid_density * volume * g);
    add(ForceKind::contact_normal, norm(sums.pressing[n]));
    add(ForceKind::contact_tangential, norm(sums.tangential[n]));
    add(ForceKind::attraction, norm(sums.pulling[n]));
    if (grains.drag_relaxation == nullptr) continue;
    const double* action = grains.drag_relaxation + 4 * n;
    Vec3 fluid;
    for (int d = 0; d < 3; ++d) fluid[d] = mass * action[3] * (action[d] - v[d]);
    if (gradient.is_there()) {
      const Vec3 pressure = -volume * gradient.at(grains.centre(n));
      add(ForceKind::pressure_gradient, norm(pressure));
      fluid -= pressure;
    }
    add(ForceKind::drag, norm(fluid));
  }
}

double ForceShares::share(ForceKind kind) const {
  double all = 0.0;
  for (const double sum : sums_) all += sum;
  return all > 0.0 ? sums_[index(kind)] / all : 0.0;
}

double ForceShares::over_weight(ForceKind kind) const {
  const double weight = sums_[index(ForceKind::gravity)];
  return weight > 0.0 ? sums_[index(kind)] / weight : 0.0;
}

void ForceShares::save(sdk::ArchiveWriter& archive) const {
  archive.numbers("force_sums", sums_);
  archive.integer("force_samples", samples_);
}

void ForceShares::load(sdk::ArchiveReader& archive) {
  const auto sums = archive.numbers("force_sums");
  for (std::size_t k = 0; k < k_force_kinds; ++k) sums_[k] = sums.at(k);
  samples_ = archive.integer("force_samples");
}

}  // namespace dust::run
