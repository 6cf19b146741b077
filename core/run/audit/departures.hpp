// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "dust/sdk/vec3.hpp"
#include "particles/grain_rows.hpp"
#include "particles/openings/opening.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::run {

/// The grains that have left through open sides of the domain: how many by each side, and which the
/// first of them were. What hoods and suction openings draw out is not among them.
class Departures {
 public:
  /// As many grains as are named for each side.
  static constexpr std::size_t k_named = 20;

  struct Grain {
    std::int64_t id = 0;
    std::int64_t step = 0;  ///< of the grains, at the coarse rate
    double time = 0.0;      ///< [s] when it was found outside: at the end of a fluid step
    double diameter = 0.0;  ///< [m]
    sdk::Vec3 place;        ///< [m] then
  };
  struct Side {
    std::int64_t count = 0;
    double mass = 0.0;         ///< [kg] with statistical weights
    std::vector<Grain> first;  ///< in the order of time, then of their ids
  };
  /// What a grain is looked at with.
  struct Moment {
    std::int64_t step = 0;
    double time = 0.0;  ///< [s]
  };

  explicit Departures(const scenario::DomainSpec& domain) : domain_(domain) {}

  /// Notes the grains that stand beyond an open side and are about to be removed; those that one
  /// of `openings` takes are left out (`rounding` [m] of its box).
  void note(const particles::GrainRows& grains, std::span<const particles::Opening> openings,
            double rounding, const Moment& now);

  [[nodiscard]] const Side& through(std::size_t side) const { return sides_[side]; }

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  /// The side a point is beyond, -1 inside: the last one where it is beyond several.
  [[nodiscard]] int side_of(sdk::Vec3 point) const;

  scenario::DomainSpec domain_;
  std::array<Side, 6> sides_;
};

}  // namespace dust::run
