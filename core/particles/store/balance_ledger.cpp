// SPDX-License-Identifier: Apache-2.0
#include "particles/store/balance_ledger.hpp"

#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <string>

namespace dust::particles {

std::int32_t BalanceLedger::population(double diameter, double weight, std::int32_t material,
                                       double mass) {
  for (std::size_t n = 0; n < populations_.size(); ++n) {
    const Population& p = populations_[n];
    if (p.diameter == diameter && p.weight == weight && p.material == material) {
      return static_cast<std::int32_t>(n);
    }
  }
  populations_.push_back(
      {.diameter = diameter, .weight = weight, .material = material, .mass = mass});
  return static_cast<std::int32_t>(populations_.size() - 1);
}

void BalanceLedger::enter(std::int32_t population) {
  Population& p = populations_[static_cast<std::size_t>(population)];
  ++p.emitted;
  ++p.in_domain;
}

void BalanceLedger::leave(std::int32_t population) {
  Population& p = populations_[static_cast<std::size_t>(population)];
  --p.in_domain;
  ++p.left;
}

void BalanceLedger::extract(std::int32_t population, std::size_t opening) {
  const auto n = static_cast<std::size_t>(population);
  --populations_[n].in_domain;
  ++populations_[n].removed;
  std::vector<std::int64_t>& counts = extracted_[opening];
  if (counts.size() <= n) counts.resize(n + 1, 0);
  ++counts[n];
}

void BalanceLedger::close() {
  const std::int64_t largest = balance_.max;
  const double real_largest = balance_.real_max;
  balance_ = {};
  for (const Population& p : populations_) {
    const auto add = [&](std::int64_t count, std::int64_t& sum, double& real, double& mass) {
      sum += count;
      real += static_cast<double>(count) * p.weight;
      mass += static_cast<double>(count) * p.weight * p.mass;
    };
    add(p.emitted, balance_.emitted, balance_.real_emitted, balance_.mass_emitted);
    add(p.in_domain, balance_.in_domain, balance_.real_in_domain, balance_.mass_in_domain);
    add(p.left, balance_.left, balance_.real_left, balance_.mass_left);
    add(p.removed, balance_.removed, balance_.real_removed, balance_.mass_removed);
  }
  balance_.max = std::max(largest, balance_.in_domain);
  balance_.real_max = std::max(real_largest, balance_.real_in_domain);
}

BalanceLedger::Masses BalanceLedger::masses_of(double diameter) const {
  Masses masses;
  for (const Population& p : populations_) {
    if (p.diameter != diameter) continue;
    const double unit = p.weight * p.mass;
    masses.emitted += static_cast<double>(p.emitted) * unit;
    masses.in_domain += static_cast<double>(p.in_domain) * unit;
    masses.left += static_cast<double>(p.left) * unit;
    masses.removed += static_cast<double>(p.removed) * unit;
  }
  return masses;
}

void BalanceLedger::transfer_from(const BalanceLedger& other,
                                  std::span<const std::int32_t> materials,
                                  std::span<const std::int32_t> openings,
                                  std::span<const double> density) {
  populations_ = other.populations_;
  for (Population& p : populations_) {
    p.material = materials[static_cast<std::size_t>(p.material)];
    // One whose grains are all gone may be of a material that is not known here.
    if (p.material < 0) continue;
    p.mass = density[static_cast<std::size_t>(p.material)] * sdk::sphere_volume(p.diameter);
  }
  for (std::size_t o = 0; o < openings.size(); ++o) {
    if (openings[o] >= 0) extracted_[static_cast<std::size_t>(openings[o])] = other.extracted_[o];
  }
  balance_.max = other.balance_.max;
  balance_.real_max = other.balance_.real_max;
  close();
}

std::vector<double> BalanceLedger::masses() const {
  std::vector<double> masses;
  for (const Population& p : populations_) masses.push_back(p.mass);
  return masses;
}

void BalanceLedger::save(sdk::ArchiveWriter& archive) const {
  std::vector<double> numbers;
  std::vector<std::int64_t> integers{balance_.max};
  for (const Population& p : populations_) {
    numbers.insert(numbers.end(), {p.diameter, p.weight, p.mass});
    integers.insert(integers.end(), {p.material, p.emitted, p.in_domain, p.left, p.removed});
  }
  numbers.push_back(balance_.real_max);
  archive.numbers("population_numbers", numbers);
  archive.integers("population_counts", integers);
  for (std::size_t opening = 0; opening < extracted_.size(); ++opening) {
    archive.integers("extracted_" + std::to_string(opening), extracted_[opening]);
  }
}

void BalanceLedger::load(sdk::ArchiveReader& archive) {
  const auto numbers = archive.numbers("population_numbers");
  const auto integers = archive.integers("population_counts");
  populations_.clear();
  for (std::size_t n = 0; n < numbers.size() / 3; ++n) {
    const std::int64_t* c = integers.data() + 1 + 5 * n;
    populations_.push_back({.diameter = numbers[3 * n],
                            .weight = numbers[3 * n + 1],
                            .material = static_cast<std::int32_t>(c[0]),
                            .mass = numbers[3 * n + 2],
                            .emitted = c[1],
                            .in_domain = c[2],
                            .left = c[3],
                            .removed = c[4]});
  }
  balance_.max = integers.at(0);
  // Behind the populations; checkpoints from before it was kept have none.
  balance_.real_max = numbers.size() % 3 == 1 ? numbers.back() : 0.0;
  for (std::size_t opening = 0; opening < extracted_.size(); ++opening) {
    extracted_[opening] = archive.integers("extracted_" + std::to_string(opening));
  }
  close();
}

}  // namespace dust::particles
