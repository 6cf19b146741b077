// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <dust/sdk/sampling.hpp>
#include <dust/sdk/sensor.hpp>
#include <dust/sdk/stays.hpp>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <vector>

namespace dust::model::residence_time {

/// How mass is distributed over residence times: exact mean and variance, quantiles from classes
/// whose edges lie a factor 2^(1/64), 1.1 %, apart. A time is counted in units of `unit` [s], so
/// that the classes mean the same whatever the scale of the plant.
class Distribution {
 public:
  /// [s] What times are measured with, above 0; before the first add().
  void set_unit(double unit) { unit_ = unit; }
  [[nodiscard]] bool has_unit() const { return unit_ > 0.0; }

  /// Mass [kg] that left after `time` [s].
  void add(double mass, double time) {
    if (bins_.empty()) bins_.assign(k_bins, 0.0);
    bins_[bin_of(time)] += mass;
    count_ += 1.0;
    mass_ += mass;
    squares_ += mass * mass;
    first_ += mass * time;
    second_ += mass * time * time;
  }

  [[nodiscard]] double mass() const { return mass_; }
  [[nodiscard]] double count() const { return count_; }
  /// [s] By mass; sdk::k_no_value where nothing has left, as of the deviation and quantiles.
  [[nodiscard]] double mean() const { return mass_ > 0.0 ? first_ / mass_ : sdk::k_no_value; }
  /// [s]
  [[nodiscard]] double deviation() const {
    if (!(mass_ > 0.0)) return sdk::k_no_value;
    return std::sqrt(std::max(second_ / mass_ - mean() * mean(), 0.0));
  }
  /// Number of equal grains that scatter as these do: \f$ (\sum m)^2 / \sum m^2 \f$ (Kish 1965).
  [[nodiscard]] double effective_count() const {
    return squares_ > 0.0 ? mass_ * mass_ / squares_ : 0.0;
  }
  /// [s] Standard error of the mean for grains that come independently; -1 below two.
  [[nodiscard]] double mean_error() const {
    const double n = effective_count();
    return n >= 2.0 ? deviation() / std::sqrt(n - 1.0) : -1.0;
  }
  /// [s] The share `p` of the mass had left after.
  [[nodiscard]] double quantile(double p) const {
    if (!(mass_ > 0.0)) return sdk::k_no_value;
    const double wanted = std::clamp(p, 0.0, 1.0) * mass_;
    double below = 0.0;
    std::size_t last = 0;
    for (std::size_t n = 0; n < bins_.size(); ++n) {
      if (bins_[n] == 0.0) continue;
      last = n;
      if (below + bins_[n] >= wanted) {
        const double inside = (wanted - below) / bins_[n];
        return edge(n) + inside * (edge(n + 1) - edge(n));
      }
      below += bins_[n];
    }
    return edge(last + 1);  // rounding of the sums
  }
  /// [s] Half of what lies between the quantiles one standard error of the share to either side
  /// (Woodruff 1952, doi:10.1080/01621459.1952.10483443); -1 below eight grains.
  [[nodiscard]] double quantile_error(double p) const {
    const double n = effective_count();
    if (n < 8.0) return -1.0;
    const double off = std::sqrt(p * (1.0 - p) / n);
    return 0.5 * (quantile(p + off) - quantile(p - off));
  }
  /// [kg] that left between two times [s], spread evenly within a class.
  [[nodiscard]] double mass_between(double from, double to) const {
    double sum = 0.0;
    for (std::size_t n = 0; n < bins_.size(); ++n) {
      if (bins_[n] == 0.0) continue;
      const double both = std::min(to, edge(n + 1)) - std::max(from, edge(n));
      if (both > 0.0) sum += bins_[n] * both / (edge(n + 1) - edge(n));
    }
    return sum;
  }

  /// All of the state, and back.
  [[nodiscard]] std::vector<double> numbers() const {
    std::vector<double> all = {unit_, count_, mass_, squares_, first_, second_};
    all.insert(all.end(), bins_.begin(), bins_.end());
    return all;
  }
  void set_numbers(const std::vector<double>& all) {
    unit_ = all.at(0), count_ = all.at(1), mass_ = all.at(2);
    squares_ = all.at(3), first_ = all.at(4), second_ = all.at(5);
    bins_.assign(all.begin() + 6, all.end());
  }

 private:
  static constexpr double k_per_octave = 64.0;
  /// The first class ends there below the unit. Not a whole number: times of whole units, as of
  /// grains that begin with a step, then lie inside classes and not on their edges.
  static constexpr double k_octaves_below = 10.3;
  static constexpr std::size_t k_bins = 64 * 34;  ///< up to 2^24 units

  [[nodiscard]] std::size_t bin_of(double time) const {
    const double place =
        k_per_octave * (std::log2(std::max(time / unit_, 1e-300)) + k_octaves_below);
    return static_cast<std::size_t>(std::clamp(place, 0.0, k_bins - 1.0));
  }
  [[nodiscard]] double edge(std::size_t n) const {
    if (n == 0) return 0.0;
    return unit_ * std::exp2(static_cast<double>(n) / k_per_octave - k_octaves_below);
  }

  double unit_ = 0.0;         ///< [s]
  double count_ = 0.0;        ///< computed grains
  double mass_ = 0.0;         ///< [kg]
  double squares_ = 0.0;      ///< [kg2]
  double first_ = 0.0;        ///< [kg s]
  double second_ = 0.0;       ///< [kg s2]
  std::vector<double> bins_;  ///< [kg] by class of time; empty before the first grain
};

/// Grains with their centre beyond the domain at the last sample, and when it crossed the side.
/// What is beyond an open side is gone by the next sample; dust that something pressed into a wall
/// is not, so that only the next sample tells the two apart.
class Beyond {
 public:
  /// One sample; paths are straight.
  void look(const sdk::WorldView& world) {
    const sdk::GrainColumns& g = world.grains;
    grains_.clear();
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const sdk::Path path = sdk::path_of(world, i);
      if (!is_beyond(path.now, world)) continue;
      const double to = sdk::part_in_box(path, world.domain_min, world.domain_max).to;
      grains_.push_back({g.id[i], world.time - (1.0 - std::clamp(to, 0.0, 1.0)) * world.interval});
    }
  }

  [[nodiscard]] bool holds(std::int64_t id) const { return find(id) != nullptr; }
  /// [s] When a grain that is gone left: as it crossed the side, else at `time` [s].
  [[nodiscard]] double left_at(std::int64_t id, double time) const {
    const Grain* grain = find(id);
    return grain != nullptr ? grain->exit_time : time;
  }

  /// All of the state behind other numbers, and back from number `from` on.
  void append_to(std::vector<double>& numbers) const {
    for (const Grain& grain : grains_) {
      numbers.insert(numbers.end(), {static_cast<double>(grain.id), grain.exit_time});
    }
  }
  void take_from(const std::vector<double>& numbers, std::size_t from) {
    grains_.clear();
    for (std::size_t n = from; n + 1 < numbers.size(); n += 2) {
      grains_.push_back({static_cast<std::int64_t>(numbers[n]), numbers[n + 1]});
    }
  }

 private:
  struct Grain {
    std::int64_t id = 0;
    double exit_time = 0.0;  ///< [s]
  };
  static bool is_beyond(sdk::Vec3 x, const sdk::WorldView& world) {
    for (int d = 0; d < 3; ++d) {
      if (x[d] < world.domain_min[d] || x[d] > world.domain_max[d]) return true;
    }
    return false;
  }
  [[nodiscard]] const Grain* find(std::int64_t id) const {
    const auto at =
        std::lower_bound(grains_.begin(), grains_.end(), id,
                         [](const Grain& g, std::int64_t wanted) { return g.id < wanted; });
    return at != grains_.end() && at->id == id ? &*at : nullptr;
  }

  std::vector<Grain> grains_;  ///< ascending by id
};

/// [s] Mean residence time of a steady flow by what it holds: \f$ \bar t = M / \dot m \f$ (Little
/// 1961, doi:10.1287/opre.9.3.383). It needs no grain to be followed: a check of the mean.
/// sdk::k_no_value where nothing flows out.
constexpr double holdup_time(double mass, double mass_flow) {
  return mass_flow > 0.0 ? mass / mass_flow : sdk::k_no_value;
}

}  // namespace dust::model::residence_time
