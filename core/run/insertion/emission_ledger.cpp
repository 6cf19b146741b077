// SPDX-License-Identifier: Apache-2.0
#include "run/insertion/emission_ledger.hpp"

#include "dust/sdk/sphere.hpp"

namespace dust::run {

void EmissionLedger::enter(std::size_t emitter, double diameter, double weight,
                           std::int32_t material, double grain_mass) {
  ++lines_[emitter][{diameter, weight, grain_mass, material}];
}

std::vector<EmissionLedger::Line> EmissionLedger::lines_of(std::size_t emitter) const {
  std::vector<Line> lines;
  for (const auto& [key, count] : lines_[emitter]) {
    lines.push_back({key.diameter, key.weight, count, key.grain_mass});
  }
  return lines;
}

EmissionLedger::Totals EmissionLedger::totals_of(std::size_t emitter) const {
  Totals t;
  for (const auto& [key, count] : lines_[emitter]) {
    t.computed += count;
    t.real += key.weight * static_cast<double>(count);
    t.mass += key.weight * static_cast<double>(count) * key.grain_mass;
  }
  return t;
}

void EmissionLedger::transfer_from(const EmissionLedger& other,
                                   std::span<const std::int32_t> emitters,
                                   std::span<const std::int32_t> materials,
                                   std::span<const double> density) {
  for (std::size_t e = 0; e < emitters.size(); ++e) {
    if (emitters[e] < 0) continue;
    auto& lines = lines_[static_cast<std::size_t>(emitters[e])];
    lines.clear();
    for (const auto& [theirs, count] : other.lines_[e]) {
      Key key = theirs;
      if (key.material >= 0) key.material = materials[static_cast<std::size_t>(key.material)];
      if (key.material >= 0) {
        key.grain_mass =
            density[static_cast<std::size_t>(key.material)] * sdk::sphere_volume(key.diameter);
      }
      lines[key] += count;
    }
  }
}

void EmissionLedger::save(sdk::ArchiveWriter& archive) const {
  std::vector<double> numbers;
  std::vector<std::int64_t> integers;
  for (std::size_t e = 0; e < lines_.size(); ++e) {
    for (const auto& [key, count] : lines_[e]) {
      numbers.insert(numbers.end(), {key.diameter, key.weight, key.grain_mass});
      integers.insert(integers.end(), {static_cast<std::int64_t>(e), count, key.material});
    }
  }
  archive.numbers("emission_numbers", numbers);
  archive.integers("emission_counts", integers);
}

void EmissionLedger::load(sdk::ArchiveReader& archive) {
  const auto numbers = archive.numbers("emission_numbers");
  const auto integers = archive.integers("emission_counts");
  for (auto& lines : lines_) lines.clear();
  const std::size_t size = numbers.size() / 3;
  if (size == 0) return;
  // Two in checkpoints from before the material was kept.
  const std::size_t each = integers.size() / size;
  for (std::size_t n = 0; n < size; ++n) {
    const std::int64_t* line = integers.data() + each * n;
    const Key key{numbers[3 * n], numbers[3 * n + 1], numbers[3 * n + 2],
                  each > 2 ? static_cast<std::int32_t>(line[2]) : -1};
    lines_.at(static_cast<std::size_t>(line[0]))[key] = line[1];
  }
}

}  // namespace dust::run
