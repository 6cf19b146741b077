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

/// What lies on each piece of wall [kg], by class.
class Layers {
 public:
  explicit Layers(std::size_t classes) : classes_(classes) {}

  void add(const WallPiece& piece, std::size_t n, double mass);
  /// Empty where nothing has ever lain.
  [[nodiscard]] std::span<double> on(const WallPiece& piece);

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  using Place = std::pair<std::int32_t, std::int32_t>;  ///< cell, surface
  std::size_t classes_;
  std::map<Place, std::vector<double>> mass_;
};

}  // namespace dust::airborne
