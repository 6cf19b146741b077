// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/flow.hpp"
#include "dust/sdk/archive.hpp"

#include <cstddef>
#include <cstdint>
#include <map>
#include <span>
#include <utility>
#include <vector>

namespace dust::airborne {

/// Name in a checkpoint of the pairs of cell and surface on which layers lie.
inline constexpr const char* k_saved_layer_places = "layer_places";

/// What lies on each piece of wall [kg], by class: rows in the order of the pieces.
class Layers {
 public:
  explicit Layers(std::size_t classes) : classes_(classes) {}

  /// Gives each piece its row, with what lies at its place. What lies where no piece is any more
  /// stays there, with `left_behind`.
  void match(std::span<const WallPiece> walls);

  void add(std::size_t piece, std::size_t n, double mass) { mass_[classes_ * piece + n] += mass; }
  [[nodiscard]] std::span<double> on(std::size_t piece) {
    return {mass_.data() + classes_ * piece, classes_};
  }
  /// [kg] Row after row.
  [[nodiscard]] std::span<double> rows() { return mass_; }

  using Place = std::pair<std::int32_t, std::int32_t>;  ///< cell, surface
  [[nodiscard]] const std::map<Place, std::vector<double>>& left_behind() const {
    return left_behind_;
  }
  /// What was left behind at a place comes to lie on a piece.
  void bring(Place place, std::size_t piece);

  /// Adds what of class `n` lies in each cell [kg].
  void add_to(std::size_t n, fluid::CellField& deposit) const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  /// By place, without those where nothing lies.
  [[nodiscard]] std::map<Place, std::vector<double>> by_place() const;

  std::size_t classes_;
  std::vector<Place> places_;  ///< of the rows
  std::vector<double> mass_;
  std::map<Place, std::vector<double>> left_behind_;
};

}  // namespace dust::airborne
