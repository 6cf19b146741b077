// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/dem.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// Whole-number counts per population (diameter, weight, material): masses and real counts are
/// products of whole numbers, so that emitted = in the domain + left + removed to rounding.
class BalanceLedger {
 public:
  struct Population {
    double diameter = 0.0;
    double weight = 1.0;
    std::int32_t material = 0;
    double mass = 0.0;  ///< [kg] of one real grain
    std::int64_t emitted = 0, in_domain = 0, left = 0, removed = 0;
  };

  /// The population of such grains, made where it is new.
  std::int32_t population(double diameter, double weight, std::int32_t material, double mass);
  void enter(std::int32_t population);
  void leave(std::int32_t population);
  /// Drawn out through an opening: counts as removed.
  void extract(std::int32_t population, std::size_t opening);
  [[nodiscard]] const Balance& balance() const { return balance_; }
  [[nodiscard]] const Population& operator[](std::int32_t n) const {
    return populations_[static_cast<std::size_t>(n)];
  }
  /// Brings balance() up to date with the counts.
  void close();

  /// What was released of one diameter, in all materials and weights, and what became of it [kg].
  struct Masses {
    double emitted = 0.0, in_domain = 0.0, left = 0.0, removed = 0.0;
  };
  [[nodiscard]] Masses masses_of(double diameter) const;

  /// How many of each population an opening has drawn out; shorter than the populations where the
  /// newest have none.
  [[nodiscard]] std::span<const std::int64_t> extracted(std::size_t opening) const {
    return extracted_[opening];
  }
  [[nodiscard]] std::span<const Population> populations() const { return populations_; }
  void set_openings(std::size_t count) { extracted_.resize(count); }

  /// Goes on from another ledger: what had come stays counted. Materials and openings have the
  /// numbers here that are given by theirs (-1: none), a material its density [kg/m3] by the number
  /// here. Populations keep their numbers.
  void transfer_from(const BalanceLedger& other, std::span<const std::int32_t> materials,
                     std::span<const std::int32_t> openings, std::span<const double> density);
  /// [kg] of one real grain, by population.
  [[nodiscard]] std::vector<double> masses() const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  std::vector<Population> populations_;
  std::vector<std::vector<std::int64_t>> extracted_;  ///< by opening and population
  Balance balance_;
};

}  // namespace dust::particles
