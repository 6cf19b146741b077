// SPDX-License-Identifier: Apache-2.0
#include "airborne/dust_field.hpp"

#include "airborne/cells/covered_cells.hpp"
#include "dust/sdk/error.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <string>

namespace dust::airborne {
namespace {

/// Sum over the cells, row by row: less rounding than one long sum.
double sum_of(const fluid::Grid& grid, const fluid::CellField& values) {
  double sum = 0.0;
  for (int k = 0; k < grid.count[2]; ++k) {
    for (int j = 0; j < grid.count[1]; ++j) {
      const std::ptrdiff_t o = grid.index(0, j, k);
      sum += std::accumulate(values.begin() + o, values.begin() + o + grid.count[0], 0.0);
    }
  }
  return sum;
}

[[noreturn]] void fail_as_empty(const std::string& what) {
  throw sdk::ModelError("dust.field." + what +
                        ": there is no fluid between min and max; give a box of the domain that "
                        "is not all in bodies");
}

/// Length of what two stretches have in common.
double overlap(double low, double high, double other_low, double other_high) {
  return std::max(0.0, std::min(high, other_high) - std::max(low, other_low));
}

}  // namespace

double DustBalance::error() const {
  if (!(released > 0.0)) return 0.0;
  const double gone = std::accumulate(left.begin(), left.end(), 0.0) +
                      std::accumulate(outlets.begin(), outlets.end(), 0.0) +
                      std::accumulate(surfaces.begin(), surfaces.end(), 0.0) +
                      std::accumulate(carried_out.begin(), carried_out.end(), 0.0);
  return (released - airborne - gone - caught) / released;
}

DustField::DustField(const fluid::Grid& grid, const scenario::DustFieldSpec& spec, const Gas& gas,
                     sdk::Vec3 gravity, Ends ends)
    : grid_(grid),
      spec_(spec),
      transport_(grid),
      source_(grid.size, 0.0),
      layers_(spec.diameters.size()),
      do_surfaces_run_(ends.run) {
  if (spec.resuspension) resuspension_.emplace(spec, gas, norm(gravity));
  for (const double diameter : spec.diameters) {
    Class c;
    c.dust = make_class(diameter, spec.density, gravity, gas);
    if (spec.inertia) {
      const double g = norm(gravity);
      // Dust lighter than the fluid goes where the fluid is speeded up to.
      const double sign = spec.density < gas.density ? -1.0 : 1.0;
      c.dust.inertia_time = g > 0.0 ? sign * norm(c.dust.drift) / g
                                    : c.dust.response_time * (1.0 - gas.density / spec.density);
    }
    c.mass.assign(grid.size, 0.0);
    if (!keeps_layers()) c.deposit.assign(grid.size, 0.0);
    c.losses.outlets.assign(ends.outlets, 0.0);
    c.surfaces.assign(ends.surfaces, 0.0);
    if (do_surfaces_run_) c.carried_out.assign(ends.surfaces, 0.0);
    classes_.push_back(std::move(c));
  }
  // Classes ascend: the last one takes longest to follow.
  const double memory = std::abs(classes_.back().dust.inertia_time);
  if (spec.inertia && memory > 0.0) acceleration_.emplace(grid, memory);
}

int DustField::layer_of(int d, double x) const {
  constexpr double k_rounding = 1e-9;  // cells
  const double place = (x - grid_.origin[d]) / grid_.spacing[d];
  const int count = grid_.count[static_cast<std::size_t>(d)];
  if (place < -k_rounding || place > count + k_rounding) return -1;
  // Upper sides belong to the last layer.
  return std::clamp(static_cast<int>(std::floor(place)), 0, count - 1);
}

std::vector<DustField::Part> DustField::parts_of(sdk::Vec3 min, sdk::Vec3 max,
                                                 const fluid::CellField& volume) const {
  std::array<int, 3> first{};
  std::array<int, 3> end{};
  for (int d = 0; d < 3; ++d) {
    const auto n = static_cast<std::size_t>(d);
    first[n] = std::clamp(grid_.layer_of(d, min[d]) - 1, 0, grid_.count[n]);
    end[n] = std::clamp(grid_.layer_of(d, max[d]) + 2, 0, grid_.count[n]);
  }
  std::vector<Part> parts;
  for (int k = first[2]; k < end[2]; ++k) {
    for (int j = first[1]; j < end[1]; ++j) {
      for (int i = first[0]; i < end[0]; ++i) {
        const auto cell = static_cast<std::size_t>(grid_.index(i, j, k));
        const sdk::Vec3 centre = grid_.centre(i, j, k);
        double gas = volume[cell];
        const std::array<int, 3> at{i, j, k};
        for (int d = 0; d < 3; ++d) {
          const double h = grid_.spacing[d];
          const double low = centre[d] - 0.5 * h;
          // A flat box lies in one layer of cells.
          const bool is_flat = max[d] <= min[d];
          const int layer = at[static_cast<std::size_t>(d)];
          gas *= is_flat ? (layer_of(d, min[d]) == layer ? 1.0 : 0.0)
                         : overlap(low, low + h, min[d], max[d]) / h;
        }
        if (gas > 0.0) parts.push_back({cell, gas});
      }
    }
  }
  return parts;
}

void DustField::start(const fluid::CellField& volume) {
  for (const scenario::DustCloudSpec& cloud : spec_.clouds) {
    const std::vector<Part> parts = parts_of(cloud.min, cloud.max, volume);
    if (parts.empty()) fail_as_empty("clouds." + cloud.name);
    for (std::size_t n = 0; n < classes_.size(); ++n) {
      for (const Part& part : parts) {
        classes_[n].mass[part.cell] += cloud.concentration[n] * part.gas;
      }
    }
  }
  for (Class& c : classes_) c.released = {sum_of(grid_, c.mass) * grid_.cell_volume(), 0.0};
}

void DustField::leave_covered_cells(const fluid::CellField& volume) {
  const std::vector<std::int32_t> nearest = nearest_gas_cells(grid_, volume);
  for (Class& c : classes_) {
    for (std::size_t o = 0; o < nearest.size(); ++o) {
      if (nearest[o] < 0 || static_cast<std::size_t>(nearest[o]) == o || c.mass[o] == 0.0) continue;
      c.mass[static_cast<std::size_t>(nearest[o])] += c.mass[o];
      c.mass[o] = 0.0;
    }
  }
}

void DustField::find_sources(const fluid::CellField& volume, double time, double step) {
  sources_.clear();
  for (const scenario::DustSourceSpec& source : spec_.sources) {
    std::vector<Part>& parts = sources_.emplace_back();
    // Before it begins and once it has ended, bodies may be where it is.
    if (!(overlap(time, time + step, source.begin, source.end) > 0.0)) continue;
    parts = parts_of(source.min, source.max, volume);
    if (parts.empty()) fail_as_empty("sources." + source.name);
    double sum = 0.0;
    for (const Part& part : parts) sum += part.gas;
    for (Part& part : parts) part.gas /= sum;
  }
}

double DustField::given_by_sources(std::size_t n, double time) const {
  double given = 0.0;
  for (const scenario::DustSourceSpec& source : spec_.sources) {
    given += source.mass_flow[n] * std::max(0.0, overlap(0.0, time, source.begin, source.end));
  }
  return given;
}

/// Fills source_ with the mean over the step; false where no source is active.
bool DustField::add_sources(std::size_t n, double time, double step) {
  bool is_active = false;
  for (std::size_t s = 0; s < sources_.size(); ++s) {
    const scenario::DustSourceSpec& spec = spec_.sources[s];
    const double duration = overlap(time, time + step, spec.begin, spec.end);
    const double flow = spec.mass_flow[n] * duration / step;
    if (!(flow > 0.0)) continue;
    if (!is_active) std::fill(source_.begin(), source_.end(), 0.0);
    is_active = true;
    for (const Part& part : sources_[s]) {
      source_[part.cell] += flow * part.gas / grid_.cell_volume();
    }
    classes_[n].released += flow * step;
  }
  return is_active;
}

/// What has settled in this step goes to its surface and cell.
void DustField::add_deposits(std::size_t of_class, const Flow& flow) {
  Class& c = classes_[of_class];
  // The step's sums by themselves: totals that grow piece by piece round far more often.
  std::vector<double> settled(c.surfaces.size(), 0.0);
  for (std::size_t n = 0; n < flow.walls.size(); ++n) {
    const double mass = c.losses.walls[n] * grid_.cell_volume();
    settled[static_cast<std::size_t>(flow.walls[n].surface)] += mass;
    if (keeps_layers()) {
      layers_.add(n, of_class, mass);
    } else {
      c.deposit[static_cast<std::size_t>(flow.walls[n].cell)] += mass;
    }
  }
  for (std::size_t n = 0; n < settled.size(); ++n) c.surfaces[n] += settled[n];
  c.losses.walls.clear();
}

void DustField::resuspend(const Flow& flow, double step) {
  // The step's sums by themselves, as of deposits.
  std::vector<std::vector<double>> gone(classes_.size());
  for (std::size_t n = 0; n < classes_.size(); ++n) gone[n].resize(classes_[n].surfaces.size());
  std::vector<double> before(classes_.size());
  for (std::size_t w = 0; w < flow.walls.size(); ++w) {
    const WallPiece& piece = flow.walls[w];
    const auto cell = static_cast<std::size_t>(piece.cell);
    const std::span<double> layer = layers_.on(w);
    const bool is_bare = std::all_of(layer.begin(), layer.end(), [](double m) { return m == 0.0; });
    if (is_bare || !(flow.volume_before[cell] > 0.0)) continue;
    const double area = norm(piece.area) * grid_.cell_volume();
    before.assign(layer.begin(), layer.end());
    for (std::size_t n = 0; n < classes_.size(); ++n) {
      const double taken = resuspension_->taken(before, n, flow.friction_velocity[w], area, step);
      if (!(taken > 0.0)) continue;
      Class& c = classes_[n];
      layer[n] -= taken;
      c.mass[cell] += taken / grid_.cell_volume();
      c.resuspended += taken;
      gone[n][static_cast<std::size_t>(piece.surface)] += taken;
    }
  }
  for (std::size_t n = 0; n < classes_.size(); ++n) {
    std::vector<double>& surfaces = classes_[n].surfaces;
    for (std::size_t s = 0; s < surfaces.size(); ++s) surfaces[s] -= gone[n][s];
  }
}

void DustField::advance(const Flow& flow, double time, double step) {
  static const std::vector<double> k_no_source;
  find_sources(flow.volume_after, time, step);
  if (acceleration_) acceleration_->find(flow, step);
  transport_.prepare(flow, acceleration_ ? &*acceleration_ : nullptr);
  if (keeps_layers() && walls_found_ != flow.walls_found) {
    surface_transport_.prepare(grid_, flow, layers_);
    walls_found_ = flow.walls_found;
  }
  if (resuspension_) resuspend(flow, step);
  for (std::size_t n = 0; n < classes_.size(); ++n) {
    Class& c = classes_[n];
    const bool has_source = add_sources(n, time, step);
    if (!(c.released.value() > 0.0)) continue;  // there is none yet
    sub_steps_ += transport_.advance(flow, c.dust, 1.0 / spec_.schmidt_number,
                                     has_source ? source_ : k_no_source, step, c.mass, c.losses);
    add_deposits(n, flow);
    if (acceleration_) count_limited(c, step);
  }
  if (do_surfaces_run_) carry(flow, step);
}

void DustField::carry(const Flow& flow, double step) {
  if (is_empty()) return;
  // The step's sums by themselves, as of deposits.
  std::vector<std::vector<double>> out(classes_.size());
  for (std::size_t n = 0; n < classes_.size(); ++n) out[n].resize(classes_[n].surfaces.size());
  surface_transport_.advance(flow, step, layers_, out);
  for (std::size_t n = 0; n < classes_.size(); ++n) {
    Class& c = classes_[n];
    for (std::size_t s = 0; s < c.surfaces.size(); ++s) {
      c.surfaces[s] -= out[n][s];
      c.carried_out[s] += out[n][s];
    }
  }
}

fluid::CellField DustField::deposit(std::size_t n) const {
  if (!keeps_layers()) return classes_[n].deposit;
  fluid::CellField deposit(grid_.size, 0.0);
  layers_.add_to(n, deposit);
  return deposit;
}

void DustField::count_limited(Class& c, double step) const {
  const std::vector<float>& limited = transport_.limited();
  double airborne = 0.0;
  double there = 0.0;
  for (int k = 0; k < grid_.count[2]; ++k) {
    for (int j = 0; j < grid_.count[1]; ++j) {
      const auto o = static_cast<std::size_t>(grid_.index(0, j, k));
      double row = 0.0;
      double limited_row = 0.0;
      for (std::size_t i = 0; i < static_cast<std::size_t>(grid_.count[0]); ++i) {
        row += c.mass[o + i];
        limited_row += static_cast<double>(limited[o + i]) * c.mass[o + i];
      }
      airborne += row;
      there += limited_row;
    }
  }
  c.airborne_time += airborne * step * grid_.cell_volume();
  c.limited_time += there * step * grid_.cell_volume();
}

double DustField::limited_share(std::size_t n) const {
  const Class& c = classes_[n];
  return c.airborne_time > 0.0 ? c.limited_time / c.airborne_time : 0.0;
}

void DustField::release(std::size_t n, std::int32_t cell, double mass) {
  classes_[n].mass[static_cast<std::size_t>(cell)] += mass / grid_.cell_volume();
  classes_[n].released += mass;
}

double DustField::catch_in(std::size_t n, std::int32_t cell, double share) {
  double& mass = classes_[n].mass[static_cast<std::size_t>(cell)];
  const double rest = mass * (1.0 - share);
  const double caught = (mass - rest) * grid_.cell_volume();
  mass = rest;
  classes_[n].caught += caught;
  return caught;
}

bool DustField::is_empty() const {
  return std::none_of(classes_.begin(), classes_.end(),
                      [](const Class& c) { return c.released.value() > 0.0; });
}

void DustField::concentration(std::size_t n, const fluid::CellField& volume,
                              fluid::CellField& c) const {
  Transport::concentration(grid_, classes_[n].mass, volume, c);
}

DustBalance DustField::balance(std::size_t n) const {
  DustBalance balance = gone(n);
  balance.airborne = sum_of(grid_, classes_[n].mass) * grid_.cell_volume();
  return balance;
}

DustBalance DustField::gone(std::size_t n) const {
  const Class& c = classes_[n];
  const double volume = grid_.cell_volume();
  DustBalance balance;
  balance.released = c.released.value();
  for (std::size_t side = 0; side < 6; ++side) balance.left[side] = c.losses.sides[side] * volume;
  for (const double drawn : c.losses.outlets) balance.outlets.push_back(drawn * volume);
  balance.surfaces = c.surfaces;
  balance.carried_out = c.carried_out;
  balance.caught = c.caught.value();
  balance.resuspended = c.resuspended.value();
  return balance;
}

void DustField::save(sdk::ArchiveWriter& archive) const {
  archive.integer("sub_steps", sub_steps_);
  if (keeps_layers()) layers_.save(archive);
  if (acceleration_) acceleration_->save(archive);
  for (std::size_t n = 0; n < classes_.size(); ++n) {
    const Class& c = classes_[n];
    const auto name = [n](const char* what) { return saved::of_class(n, what); };
    archive.numbers(name("mass"), c.mass);
    if (!keeps_layers()) archive.numbers(name("deposit"), c.deposit);
    archive.number(name(saved::k_released), c.released.sum());
    archive.number(name("released_lost"), c.released.lost());
    archive.numbers(name("sides"), c.losses.sides);
    archive.numbers(name(saved::k_outlets), c.losses.outlets);
    archive.numbers(name(saved::k_surfaces), c.surfaces);
    if (spec_.scavenging) {
      archive.numbers(name("caught"), std::array{c.caught.sum(), c.caught.lost()});
    }
    if (resuspension_) {
      archive.numbers(name("resuspended"), std::array{c.resuspended.sum(), c.resuspended.lost()});
    }
    if (do_surfaces_run_) archive.numbers(name(saved::k_carried_out), c.carried_out);
    if (acceleration_) {
      archive.numbers(name("limited"), std::array{c.airborne_time, c.limited_time});
    }
  }
}

void DustField::load(sdk::ArchiveReader& archive) {
  sub_steps_ = archive.integer("sub_steps");
  if (keeps_layers()) layers_.load(archive);
  walls_found_ = -1;
  if (acceleration_) acceleration_->load(archive);
  for (std::size_t n = 0; n < classes_.size(); ++n) {
    Class& c = classes_[n];
    const auto name = [n](const char* what) { return saved::of_class(n, what); };
    c.mass = archive.numbers(name("mass"));
    if (!keeps_layers()) c.deposit = archive.numbers(name("deposit"));
    const double released = archive.number(name(saved::k_released));
    c.released = {released, archive.number(name("released_lost"))};
    const std::vector<double> sides = archive.numbers(name("sides"));
    if (c.mass.size() != grid_.size || sides.size() != c.losses.sides.size()) {
      throw sdk::ModelError("the checkpoint's dust belongs to another grid");
    }
    std::copy(sides.begin(), sides.end(), c.losses.sides.begin());
    c.losses.outlets = archive.numbers(name(saved::k_outlets));
    c.surfaces = archive.numbers(name(saved::k_surfaces));
    if (spec_.scavenging) {
      const std::vector<double> caught = archive.numbers(name("caught"));
      c.caught = {caught.at(0), caught.at(1)};
    }
    if (resuspension_) {
      const std::vector<double> resuspended = archive.numbers(name("resuspended"));
      c.resuspended = {resuspended.at(0), resuspended.at(1)};
    }
    if (do_surfaces_run_) c.carried_out = archive.numbers(name(saved::k_carried_out));
    if (acceleration_) {
      const std::vector<double> limited = archive.numbers(name("limited"));
      c.airborne_time = limited.at(0);
      c.limited_time = limited.at(1);
    }
  }
}

}  // namespace dust::airborne
