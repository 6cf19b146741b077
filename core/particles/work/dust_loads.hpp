// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/exact_sum.hpp"
#include "dust/sdk/archive.hpp"
#include "particles/store/particle_store.hpp"

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

namespace dust::particles {

/// The dust that particles bring along, by class: how much each carries, row by row, and the books
/// of it: entered + caught = on the particles + set free + left + drawn out with particles, to
/// rounding.
class DustLoads {
 public:
  DustLoads() = default;
  /// `shares`: kg of dust per kg of grain, by material and class.
  explicit DustLoads(std::vector<std::vector<double>> shares);

  [[nodiscard]] std::size_t classes() const { return entered_.size(); }
  [[nodiscard]] bool is_on() const { return !entered_.empty(); }
  /// [kg] on a real particle, by class.
  [[nodiscard]] std::span<const double> on(std::size_t row) const {
    return std::span(load_).subspan(classes() * row, classes());
  }
  /// A particle of this `mass` [kg] comes at the end of the rows, with this statistical weight.
  void enter(std::size_t material, double mass, double weight);
  /// A particle leaves with what it still carries, or is drawn out.
  void leave(const ParticleStore& particles, std::size_t row, bool is_drawn_out);
  /// `mass` [kg] of a class comes off a real particle.
  void set_free(const ParticleStore& particles, std::size_t row, std::size_t n, double mass);
  /// Particles may catch dust out of the air from now on; before the first load() or save().
  void let_catch() { caught_.resize(classes()); }
  /// A real particle catches `mass` [kg] of a class. One whose material brings no dust along keeps
  /// it for good and carries nothing: what comes off is asked of what a particle came with.
  void take_up(const ParticleStore& particles, std::size_t row, std::size_t n, double mass);
  void reorder(std::span<const std::int32_t> order);

  /// [kg] since the start.
  struct Balance {
    double entered = 0.0, on_grains = 0.0, set_free = 0.0, left = 0.0, drawn_out = 0.0;
    double caught = 0.0;
    /// (entered + caught - all others) / (entered + caught); 0 where nothing was.
    [[nodiscard]] double error() const;
  };
  [[nodiscard]] Balance balance(const ParticleStore& particles, std::size_t n) const;

  /// Goes on from another's loads and books, if they are kept and there are any; else the particles
  /// get what their materials bring here.
  void transfer_from(const DustLoads& other, const ParticleStore& particles, bool is_kept);

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  std::vector<std::vector<double>> shares_;
  std::vector<double> load_;  ///< [kg] by row and class
  std::vector<base::ExactSum> entered_, set_free_, left_, drawn_out_;
  std::vector<base::ExactSum> caught_;  ///< empty: they catch nothing
};

}  // namespace dust::particles
