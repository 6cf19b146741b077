// SPDX-License-Identifier: Apache-2.0
#include "particles/work/dust_loads.hpp"

#include "particles/store/reorder_rows.hpp"

#include <algorithm>
#include <utility>

namespace dust::particles {
namespace {

using Sums = std::vector<base::ExactSum>;

void save_sums(sdk::ArchiveWriter& archive, const char* name, const Sums& sums) {
  std::vector<double> numbers;
  for (const base::ExactSum& s : sums) numbers.insert(numbers.end(), {s.sum(), s.lost()});
  archive.numbers(name, numbers);
}

void load_sums(sdk::ArchiveReader& archive, const char* name, Sums& sums) {
  const auto numbers = archive.numbers(name);
  for (std::size_t n = 0; n < sums.size(); ++n) {
    sums[n] = {numbers.at(2 * n), numbers.at(2 * n + 1)};
  }
}

}  // namespace

DustLoads::DustLoads(std::vector<std::vector<double>> shares) : shares_(std::move(shares)) {
  std::size_t classes = 0;
  for (const auto& of_material : shares_) classes = std::max(classes, of_material.size());
  for (auto& of_material : shares_) of_material.resize(classes, 0.0);
  for (Sums* sums : {&entered_, &set_free_, &left_, &drawn_out_}) sums->resize(classes);
}

void DustLoads::enter(std::size_t material, double mass, double weight) {
  for (std::size_t n = 0; n < classes(); ++n) {
    load_.push_back(shares_[material][n] * mass);
    entered_[n] += weight * load_.back();
  }
}

void DustLoads::leave(const ParticleStore& particles, std::size_t row, bool is_drawn_out) {
  Sums& sums = is_drawn_out ? drawn_out_ : left_;
  for (std::size_t n = 0; n < classes(); ++n) {
    sums[n] += particles.weight(row) * on(row)[n];
  }
}

void DustLoads::set_free(const ParticleStore& particles, std::size_t row, std::size_t n,
                         double mass) {
  double& load = load_[classes() * row + n];
  const double rest = load - mass;
  // What is booked is what the load has lost, to the last digit.
  set_free_[n] += particles.weight(row) * (load - rest);
  load = rest;
}

void DustLoads::take_up(const ParticleStore& particles, std::size_t row, std::size_t n,
                        double mass) {
  if (caught_.empty()) return;
  const auto& brought = shares_[static_cast<std::size_t>(particles.material(row))];
  if (std::none_of(brought.begin(), brought.end(), [](double share) { return share > 0.0; }))
    return;
  double& load = load_[classes() * row + n];
  const double more = load + mass;
  caught_[n] += particles.weight(row) * (more - load);
  load = more;
}

double DustLoads::Balance::error() const {
  const double come = entered + caught;
  return come > 0.0 ? (come - on_grains - set_free - left - drawn_out) / come : 0.0;
}

DustLoads::Balance DustLoads::balance(const ParticleStore& particles, std::size_t n) const {
  base::ExactSum on_grains;
  for (std::size_t row = 0; row < particles.size(); ++row) {
    on_grains += particles.weight(row) * on(row)[n];
  }
  return {entered_[n].value(), on_grains.value(),     set_free_[n].value(),
          left_[n].value(),    drawn_out_[n].value(), caught_.empty() ? 0.0 : caught_[n].value()};
}

void DustLoads::transfer_from(const DustLoads& other, const ParticleStore& particles,
                              bool is_kept) {
  if (!is_on()) return;
  if (is_kept && other.classes() == classes()) {
    load_ = other.load_;
    entered_ = other.entered_;
    set_free_ = other.set_free_;
    left_ = other.left_;
    drawn_out_ = other.drawn_out_;
    for (std::size_t n = 0; n < other.caught_.size(); ++n) {
      // Of particles that catch nothing any more it is what they came with.
      (caught_.empty() ? entered_[n] : caught_[n]) += other.caught_[n].value();
    }
    return;
  }
  for (std::size_t row = 0; row < particles.size(); ++row) {
    enter(static_cast<std::size_t>(particles.material(row)), 1.0 / particles.inverse_mass(row),
          particles.weight(row));
  }
}

void DustLoads::reorder(std::span<const std::int32_t> order) {
  if (is_on()) reorder_rows(load_, order, classes());
}

void DustLoads::save(sdk::ArchiveWriter& archive) const {
  if (!is_on()) return;
  archive.numbers("dust_load", load_);
  save_sums(archive, "dust_entered", entered_);
  save_sums(archive, "dust_set_free", set_free_);
  save_sums(archive, "dust_left", left_);
  save_sums(archive, "dust_drawn_out", drawn_out_);
  if (!caught_.empty()) save_sums(archive, "dust_caught", caught_);
}

void DustLoads::load(sdk::ArchiveReader& archive) {
  if (!is_on()) return;
  load_ = archive.numbers("dust_load");
  load_sums(archive, "dust_entered", entered_);
  load_sums(archive, "dust_set_free", set_free_);
  load_sums(archive, "dust_left", left_);
  load_sums(archive, "dust_drawn_out", drawn_out_);
  if (!caught_.empty()) load_sums(archive, "dust_caught", caught_);
}

}  // namespace dust::particles
