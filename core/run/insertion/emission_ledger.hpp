// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <vector>

namespace dust::run {

/// What each emitter has brought into the domain, size by size, in whole numbers.
class EmissionLedger {
 public:
  struct Line {
    double diameter = 0.0;  ///< [m]
    double weight = 1.0;    ///< real grains per computed one
    std::int64_t count = 0;
    double grain_mass = 0.0;  ///< [kg] of one real grain
  };
  struct Totals {
    std::int64_t computed = 0;
    double real = 0.0;
    double mass = 0.0;  ///< [kg]
  };
  explicit EmissionLedger(std::size_t emitters = 0) : lines_(emitters) {}

  /// A grain of `material`, its number in the scenario, of which a real one has `grain_mass` [kg].
  void enter(std::size_t emitter, double diameter, double weight, std::int32_t material,
             double grain_mass);
  /// Ascending by diameter.
  [[nodiscard]] std::vector<Line> lines_of(std::size_t emitter) const;
  [[nodiscard]] Totals totals_of(std::size_t emitter) const;

  /// Goes on from another's: `emitters` and `materials` are the numbers here of its own, -1 = not
  /// here; `density` [kg/m3] by the number here. What had come weighs what it weighs here, as in
  /// the balance of the particles.
  void transfer_from(const EmissionLedger& other, std::span<const std::int32_t> emitters,
                     std::span<const std::int32_t> materials, std::span<const double> density);

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Key {
    double diameter, weight, grain_mass;
    std::int32_t material;  ///< -1: not known here
    // clang-tidy 14 takes the zero that <=> is compared with for a pointer.
    auto operator<=>(const Key&) const = default;  // NOLINT(modernize-use-nullptr)
  };
  std::vector<std::map<Key, std::int64_t>> lines_;
};

}  // namespace dust::run
