// SPDX-License-Identifier: Apache-2.0
#include "preflight/air/side_faces.hpp"

#include "fluid/properties.hpp"

#include <iterator>
#include <variant>

namespace dust::preflight {
namespace {

constexpr std::size_t k_max_faces = 4'000'000;

/// Adds the times among the parameters of a side's model.
void add_times(const scenario::ModelChoice& air, const registry::Registry& registry,
               std::vector<double>& times) {
  const registry::Entry* entry = registry.find(air.kind, air.name);
  if (entry == nullptr) return;
  const sdk::ParameterSchema& parameters = entry->info.parameters;
  for (std::size_t n = 0; n < parameters.size() && n < air.values.size(); ++n) {
    if (!(parameters[n].dimension == sdk::dimension::time)) continue;
    if (const auto* one = std::get_if<double>(&air.values[n])) times.push_back(*one);
    if (const auto* all = std::get_if<std::vector<double>>(&air.values[n])) {
      times.insert(times.end(), all->begin(), all->end());
    }
  }
}

}  // namespace

SideModelSet::SideModelSet(const Setup& setup, const registry::Registry& registry) {
  std::array<const sdk::BoundaryCondition*, 6> models{};
  std::vector<double> corners;
  for (std::size_t n = 0; n < 6; ++n) {
    const auto& air = setup.domain.sides[n].air;
    if (air) made_[n] = registry.create_as<sdk::BoundaryCondition>(*air);
    models[n] = made_[n].get();
    if (air) add_times(*air, registry, corners);
  }
  models_ = SideModels(models, std::move(corners));
}

SideFaces::SideFaces(const scenario::Setup& setup, std::size_t side) {
  const int d = static_cast<int>(side / 2);
  const int e = d == 0 ? 1 : 0;
  const int f = d == 2 ? 1 : 2;
  const auto& cells = setup.fluid->cells;
  batch_.low = setup.domain.min;
  batch_.high = setup.domain.max;
  for (int a = 0; a < 3; ++a) {
    batch_.spacing[a] =
        (setup.domain.max[a] - setup.domain.min[a]) / cells[static_cast<std::size_t>(a)];
  }
  (side % 2 ? batch_.low : batch_.high)[d] = (side % 2 ? batch_.high : batch_.low)[d];
  batch_.normal[d] = side % 2 ? 1.0 : -1.0;
  const fluid::Properties by_place(*setup.fluid);
  for (std::vector<double>* column : {&x_, &y_, &z_, &density_}) {
    column->reserve(count_of(setup, side));
  }
  for (int b = 0; b < cells[static_cast<std::size_t>(f)]; ++b) {
    for (int a = 0; a < cells[static_cast<std::size_t>(e)]; ++a) {
      sdk::Vec3 p = batch_.low;
      p[e] += (a + 0.5) * batch_.spacing[e];
      p[f] += (b + 0.5) * batch_.spacing[f];
      x_.push_back(p.x);
      y_.push_back(p.y);
      z_.push_back(p.z);
      p[d] -= 0.5 * batch_.normal[d] * batch_.spacing[d];  // the cell inside
      density_.push_back(by_place.at(p).density);
      is_of_own_fluid_ = is_of_own_fluid_ && by_place.at(p).viscosity == by_place.own().viscosity;
    }
  }
  batch_.count = x_.size();
  clear();
  one_.assign(batch_.count, 1.0);
  area_.assign(batch_.count, batch_.spacing[e] * batch_.spacing[f]);
  batch_.position.x = x_.data();
  batch_.position.y = y_.data();
  batch_.position.z = z_.data();
  batch_.velocity.x = velocity_[0].data();
  batch_.velocity.y = velocity_[1].data();
  batch_.velocity.z = velocity_[2].data();
  batch_.pressure = pressure_.data();
  batch_.void_fraction = one_.data();
  batch_.density = density_.data();
  batch_.area = area_.data();
}

bool is_too_large(const scenario::Setup& setup, std::size_t side) {
  return SideFaces::count_of(setup, side) > k_max_faces;
}

std::string path_of_side(std::size_t side) {
  return std::string("domain.boundaries.") + scenario::k_side_names[side];
}

std::vector<double> instants(const scenario::Setup& setup, const SideModels& sides) {
  constexpr int k_steps = 16;
  std::vector<double> times;
  for (int step = 0; step <= k_steps; ++step) times.push_back(setup.time.end * step / k_steps);
  const auto add_within = [&](const std::vector<double>& corners) {
    std::copy_if(corners.begin(), corners.end(), std::back_inserter(times),
                 [&](double time) { return time > 0.0 && time < setup.time.end; });
  };
  add_within(sides.corners());
  for (const scenario::BodySpec& body : setup.bodies) {
    if (body.suction) add_within(body.suction->times);
  }
  std::sort(times.begin(), times.end());
  times.erase(std::unique(times.begin(), times.end()), times.end());
  return times;
}

}  // namespace dust::preflight
