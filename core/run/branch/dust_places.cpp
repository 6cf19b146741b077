// SPDX-License-Identifier: Apache-2.0
#include "run/branch/dust_places.hpp"

#include "airborne/dust_field.hpp"
#include "base/named.hpp"
#include "run/dust/dust_stage.hpp"
#include "run/dust/hoods.hpp"

#include <algorithm>
#include <numeric>
#include <string>

namespace dust::run {
namespace {

namespace saved = airborne::saved;

constexpr std::size_t k_sides = 6;

double sum_of_gone(const std::vector<std::int64_t>& here, const std::vector<double>& values) {
  double sum = 0.0;
  for (std::size_t n = 0; n < std::min(here.size(), values.size()); ++n) {
    if (here[n] < 0) sum += values[n];
  }
  return sum;
}

}  // namespace

DustPlaces::DustPlaces(const scenario::ReadResult& then, const scenario::ReadResult& now)
    : surfaces_(k_sides + now.setup.bodies.size()),
      dropped_(then.dust.field->diameters.size(), 0.0),
      do_surfaces_run_(has_running_surfaces(then.setup)) {
  for (int d = 0; d < 3; ++d) {
    const auto& domain = then.setup.domain;
    cell_volume_ *=
        (domain.max[d] - domain.min[d]) / then.setup.fluid->cells.at(static_cast<std::size_t>(d));
  }
  for (std::size_t side = 0; side < k_sides; ++side) {
    surface_.push_back(static_cast<std::int64_t>(side));
  }
  for (const auto& body : then.setup.bodies) {
    const std::int64_t here = base::number_of(now.setup.bodies, body.name);
    surface_.push_back(here < 0 ? -1 : static_cast<std::int64_t>(k_sides) + here);
  }
  const auto openings = openings_of(now.setup, now.dust);
  openings_ = openings.size();
  for (const auto& opening : openings_of(then.setup, then.dust)) {
    opening_.push_back(base::number_of(openings, opening.name));
  }
}

void DustPlaces::find_dropped(sdk::ArchiveReader& field) {
  for (std::size_t n = 0; n < dropped_.size(); ++n) {
    dropped_[n] =
        sum_of_gone(surface_, field.numbers(saved::of_class(n, saved::k_surfaces))) +
        cell_volume_ * sum_of_gone(opening_, field.numbers(saved::of_class(n, saved::k_outlets)));
    if (do_surfaces_run_) {
      dropped_[n] += sum_of_gone(surface_, field.numbers(saved::of_class(n, saved::k_carried_out)));
    }
  }
}

double DustPlaces::dropped() const {
  return std::accumulate(dropped_.begin(), dropped_.end(), 0.0);
}

const std::vector<std::int64_t>* DustPlaces::numbers_of(std::string_view name) const {
  for (std::size_t n = 0; n < dropped_.size(); ++n) {
    if (name == saved::of_class(n, saved::k_surfaces)) return &surface_;
    if (name == saved::of_class(n, saved::k_carried_out)) return &surface_;
    if (name == saved::of_class(n, saved::k_outlets)) return &opening_;
  }
  return nullptr;
}

void DustPlaces::change(std::string_view name, std::vector<double>& values) const {
  for (std::size_t n = 0; n < dropped_.size(); ++n) {
    if (name == saved::of_class(n, saved::k_released)) values.at(0) -= dropped_[n];
  }
  const auto* const here = numbers_of(name);
  if (here == nullptr) return;
  std::vector<double> mine(here == &surface_ ? surfaces_ : openings_, 0.0);
  for (std::size_t n = 0; n < std::min(here->size(), values.size()); ++n) {
    if ((*here)[n] >= 0) mine[static_cast<std::size_t>((*here)[n])] = values[n];
  }
  values = std::move(mine);
}

/// The surfaces that layers lie on: every second number.
void DustPlaces::change(std::string_view name, std::vector<std::int64_t>& values) const {
  if (name != airborne::k_saved_layer_places) return;
  for (std::size_t n = 1; n < values.size(); n += 2) {
    values[n] = surface_.at(static_cast<std::size_t>(values[n]));
  }
}

}  // namespace dust::run
