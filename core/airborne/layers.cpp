// SPDX-License-Identifier: Apache-2.0
#include "airborne/layers.hpp"

namespace dust::airborne {

void Layers::add(const WallPiece& piece, std::size_t n, double mass) {
  if (mass == 0.0) return;
  std::vector<double>& layer = mass_[{piece.cell, piece.surface}];
  layer.resize(classes_, 0.0);
  layer[n] += mass;
}

std::span<double> Layers::on(const WallPiece& piece) {
  const auto found = mass_.find({piece.cell, piece.surface});
  return found == mass_.end() ? std::span<double>() : std::span<double>(found->second);
}

void Layers::save(sdk::ArchiveWriter& archive) const {
  std::vector<std::int64_t> places;
  std::vector<double> masses;
  for (const auto& [place, layer] : mass_) {
    places.insert(places.end(), {place.first, place.second});
    masses.insert(masses.end(), layer.begin(), layer.end());
  }
  archive.integers("layer_places", places);
  archive.numbers("layer_masses", masses);
}

void Layers::load(sdk::ArchiveReader& archive) {
  const std::vector<std::int64_t> places = archive.integers("layer_places");
  const std::vector<double> masses = archive.numbers("layer_masses");
  mass_.clear();
  for (std::size_t n = 0; 2 * n + 1 < places.size(); ++n) {
    const auto cell = static_cast<std::int32_t>(places[2 * n]);
    const auto surface = static_cast<std::int32_t>(places[2 * n + 1]);
    const auto first = masses.begin() + static_cast<std::ptrdiff_t>(classes_ * n);
    mass_[{cell, surface}] = {first, first + static_cast<std::ptrdiff_t>(classes_)};
  }
}

}  // namespace dust::airborne
