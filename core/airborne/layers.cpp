// SPDX-License-Identifier: Apache-2.0
#include "airborne/layers.hpp"

#include <algorithm>
#include <functional>

namespace dust::airborne {

std::map<Layers::Place, std::vector<double>> Layers::by_place() const {
  std::map<Place, std::vector<double>> all = left_behind_;
  for (std::size_t row = 0; row < places_.size(); ++row) {
    const auto first = mass_.begin() + static_cast<std::ptrdiff_t>(classes_ * row);
    const auto end = first + static_cast<std::ptrdiff_t>(classes_);
    if (std::all_of(first, end, [](double mass) { return mass == 0.0; })) continue;
    std::vector<double>& layer = all[places_[row]];
    layer.resize(classes_, 0.0);
    std::transform(first, end, layer.begin(), layer.begin(), std::plus<>());
  }
  return all;
}

void Layers::match(std::span<const WallPiece> walls) {
  left_behind_ = by_place();
  places_.clear();
  mass_.assign(classes_ * walls.size(), 0.0);
  for (const WallPiece& piece : walls) {
    const Place place{piece.cell, piece.surface};
    places_.push_back(place);
    if (left_behind_.count(place) != 0) bring(place, places_.size() - 1);
  }
}

void Layers::bring(Place place, std::size_t piece) {
  const auto found = left_behind_.find(place);
  for (std::size_t n = 0; n < classes_; ++n) add(piece, n, found->second[n]);
  left_behind_.erase(found);
}

void Layers::add_to(std::size_t n, fluid::CellField& deposit) const {
  for (std::size_t row = 0; row < places_.size(); ++row) {
    deposit[static_cast<std::size_t>(places_[row].first)] += mass_[classes_ * row + n];
  }
  for (const auto& [place, layer] : left_behind_) {
    deposit[static_cast<std::size_t>(place.first)] += layer[n];
  }
}

void Layers::save(sdk::ArchiveWriter& archive) const {
  std::vector<std::int64_t> places;
  std::vector<double> masses;
  for (const auto& [place, layer] : by_place()) {
    places.insert(places.end(), {place.first, place.second});
    masses.insert(masses.end(), layer.begin(), layer.end());
  }
  archive.integers(k_saved_layer_places, places);
  archive.numbers("layer_masses", masses);
}

void Layers::load(sdk::ArchiveReader& archive) {
  const std::vector<std::int64_t> places = archive.integers(k_saved_layer_places);
  const std::vector<double> masses = archive.numbers("layer_masses");
  places_.clear();
  mass_.clear();
  left_behind_.clear();
  for (std::size_t n = 0; 2 * n + 1 < places.size(); ++n) {
    const auto cell = static_cast<std::int32_t>(places[2 * n]);
    const auto surface = static_cast<std::int32_t>(places[2 * n + 1]);
    if (surface < 0) continue;  // its body is gone
    const auto first = masses.begin() + static_cast<std::ptrdiff_t>(classes_ * n);
    left_behind_[{cell, surface}] = {first, first + static_cast<std::ptrdiff_t>(classes_)};
  }
}

}  // namespace dust::airborne
