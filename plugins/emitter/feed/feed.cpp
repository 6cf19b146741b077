// SPDX-License-Identifier: Apache-2.0
#include "feed.hpp"
#include "large_first.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/size_distribution.hpp>

#include <algorithm>
#include <limits>
#include <optional>
#include <sstream>
#include <utility>

namespace {

namespace formula = dust::model::feed;
namespace sdk = dust::sdk;
using sdk::Vec3;

/// Random sequential placing finds no more room soon above this.
constexpr double k_largest_solids = 0.35;
/// Draws over which the size distribution may stray.
constexpr double k_window = 500.0;
constexpr std::uint32_t k_tries = 2000000;
/// Grains that a random place for the largest one meets on average. Beyond this so few places are
/// free (one in exp(10)) that a stream placed in order of time comes to an end.
constexpr double k_max_met = 10.0;
/// Free gap between placed grains relative to the sum of their radii.
constexpr double k_gap = 1e-6;

class Feed final : public sdk::Emitter {
 public:
  struct Parameters : sdk::SizeParameters {
    double mass_flow = 0.0;
    Vec3 min;
    Vec3 max;
    Vec3 velocity;
    double rare_below = 0.0;
    std::int64_t samples_per_particle = 20;
    double begin = 0.0;
    double end = std::numeric_limits<double>::infinity();
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::mass_flow, "mass_flow", dim::mass_flow, "Mass released per time.")
        .symbol("\\dot m")
        .above(0);
    s.vector(&Parameters::min, "min", dim::length,
             "Lower corner of the opening; flat along one axis, where it equals max.");
    s.vector(&Parameters::max, "max", dim::length, "Upper corner of the opening.");
    s.vector(&Parameters::velocity, "velocity", dim::velocity,
             "Velocity of the grains where they are released, the largest radius behind the "
             "opening; falling lumps are faster when they are through it.");
    sdk::declare_sizes(s);
    s.number(&Parameters::rare_below, "rare_below", dim::length,
             "Smaller grains are released as copies_of_rare copies of weight 1 / copies_of_rare.")
        .at_least(0)
        .optional();
    s.integer(&Parameters::samples_per_particle, "copies_of_rare", "Copies of each rare grain.")
        .symbol("k")
        .at_least(1)
        .optional();
    s.number(&Parameters::begin, "begin", dim::time, "When the feed opens.").at_least(0).optional();
    s.number(&Parameters::end, "end", dim::time, "When the feed closes.").at_least(0).optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "feed",
            .version = "1.0",
            .summary = "A steady stream of grains without overlaps through a rectangular opening.",
            .equation = "\\sum_{n: t_n < t} m_n = \\dot m\\, t \\pm m_n / 2",
            .source = "random sequential placing; own derivation"};
  }

  explicit Feed(const Parameters& p) : p_(p), sizes_(p) {
    check_opening();
    check_sizes();
  }

  void propose(const sdk::EmitterContext& context,
               std::vector<sdk::InsertionRequest>& requests) override {
    check_flow(context.grain_density);
    choose_order(context);
    const double end = std::min(context.end, p_.end);
    if (large_first_) {
      if (context.end > context.begin) release_large_first(end, context, requests);
      return;
    }
    for (;;) {
      Event next = next_common(context);
      for (std::size_t i = 0; i < sizes_.size(); ++i) {
        const Event rare = next_rare(i, context);
        if (rare.time < next.time) next = rare;
      }
      if (!(next.time < end)) return;
      requests.push_back(place(next, context));
      ++released_[next.size];
    }
  }
  [[nodiscard]] double requested_mass_flow() const override { return p_.mass_flow; }
  [[nodiscard]] std::vector<double> diameters() const override { return sizes_.ascending(); }
  [[nodiscard]] sdk::EmitterRequest request() const override {
    sdk::EmitterRequest r;
    r.mass_flow = p_.mass_flow;
    r.begin = p_.begin;
    r.end = p_.end;
    r.shares = sdk::shares_of(sizes_);
    return r;
  }
  [[nodiscard]] double largest_speed() const override { return norm(p_.velocity); }

  void save(sdk::ArchiveWriter& archive) const override {
    std::vector<std::int64_t> released(released_.begin(), released_.end());
    // One more than there are sizes says how they are placed.
    if (large_first_) released.push_back(1);
    archive.integers("released", released);
    if (large_first_) large_first_->save(archive);
    std::vector<double> rows;
    for (const Placed& g : recent_) {
      rows.insert(rows.end(), {g.time, g.position.x, g.position.y, g.position.z, g.radius});
    }
    archive.numbers("recent", rows);
  }
  void load(sdk::ArchiveReader& archive) override {
    const auto released = archive.integers("released");
    released_.assign(released.begin(), released.end());
    is_order_chosen_ = true;
    large_first_.reset();
    if (released_.size() > sizes_.size()) {
      released_.resize(sizes_.size());
      place_large_first();
      large_first_->load(archive);
    }
    const auto rows = archive.numbers("recent");
    recent_.clear();
    for (std::size_t n = 0; n + 4 < rows.size(); n += 5) {
      recent_.push_back({rows[n], {rows[n + 1], rows[n + 2], rows[n + 3]}, rows[n + 4]});
    }
  }

 private:
  struct Placed {
    double time;
    Vec3 position;  ///< at that time
    double radius;
  };
  struct Event {
    double time = std::numeric_limits<double>::infinity();
    std::size_t size = 0;
    std::uint64_t number = 0;  ///< key of its random draws
  };

  void check_opening() {
    int flat = 0;
    for (int d = 0; d < 3; ++d) {
      const double extent = p_.max[d] - p_.min[d];
      if (extent == 0.0) {
        axis_ = d;
        ++flat;
      } else if (extent < 0.0) {
        throw sdk::ParameterError(
            "min lies beyond max: give the lower corner of the opening first");
      } else {
        area_ *= extent;
      }
    }
    if (flat != 1) {
      throw sdk::ParameterError(
          "the opening must be flat: min and max have to agree along exactly "
          "one axis");
    }
    speed_ = std::abs(p_.velocity[axis_]);
    if (!(speed_ > 0.0)) {
      throw sdk::ParameterError("velocity has no part across the opening: nothing would pass it");
    }
  }

  void check_sizes() {
    const auto fractions = sizes_.fractions();
    const std::size_t n = sizes_.size();
    common_.assign(n, 0.0);
    double common = 0.0;
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_rare(i)) common += fractions[i];
    }
    for (std::size_t i = 0; i < n; ++i) {
      if (!is_rare(i)) common_[i] = fractions[i] / common;
    }
    has_common_ = common > 0.0;
    released_.assign(n, 0);
    for (int d = 0; d < 3; ++d) {
      const double width = p_.max[d] - p_.min[d];
      if (d == axis_ || width >= sizes_.largest()) continue;
      std::ostringstream text;
      text << "the opening is narrower than the largest grain: " << width << " m along "
           << "xyz"[d] << ", and the grain has " << sizes_.largest() << " m";
      throw sdk::ParameterError(text.str());
    }
  }

  void check_flow(double density) const {
    const double solids = formula::solids(p_.mass_flow, density, area_, speed_);
    if (solids <= k_largest_solids) return;
    std::ostringstream text;
    text << "the opening cannot pass the flow: " << p_.mass_flow << " kg/s through " << area_
         << " m2 at " << speed_ << " m/s is a solids fraction of " << solids << "; at most "
         << k_largest_solids << " can be placed without overlaps. Widen the opening or raise the "
         << "speed to " << speed_ * solids / k_largest_solids << " m/s";
    throw sdk::ParameterError(text.str());
  }

  /// Computed grains of size i per second.
  [[nodiscard]] double flow_of(std::size_t i, double density) const {
    return rate(i, density) * (is_rare(i) ? static_cast<double>(p_.samples_per_particle) : 1.0);
  }

  /// In order of time where that leads on, for it keeps the mass to within one grain; large ones
  /// first where it does not.
  void choose_order(const sdk::EmitterContext& context) {
    if (std::exchange(is_order_chosen_, true)) return;
    std::vector<double> flows;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      flows.push_back(flow_of(i, context.grain_density));
    }
    if (formula::met_by_largest(sizes_.diameters(), flows, area_, speed_) > k_max_met) {
      place_large_first();
    }
  }
  void place_large_first() {
    large_first_.emplace(formula::Opening{p_.min, p_.max, axis_, p_.velocity, speed_},
                         sizes_.largest(), sizes_.size());
  }

  void release_large_first(double end, const sdk::EmitterContext& context,
                           std::vector<sdk::InsertionRequest>& requests) {
    const double behind = 0.5 * sizes_.largest() / speed_;
    const double in_front = context.end - context.begin;
    std::vector<formula::LargeFirst::Size> sizes;
    for (std::size_t i = 0; i < sizes_.size(); ++i) {
      sizes.push_back({sizes_.diameters()[i], flow_of(i, context.grain_density),
                       is_rare(i) ? behind + in_front : 0.0});
    }
    for (const auto& g :
         large_first_->release(std::move(sizes), end, p_.begin, p_.end, context.random)) {
      requests.push_back(request_of(g.size, g.time, g.position, in_front));
      ++released_[g.size];
    }
  }

  /// `in_front`: [s] how far rare grains are let go in front of the opening.
  [[nodiscard]] sdk::InsertionRequest request_of(std::size_t size, double time, Vec3 x,
                                                 double in_front) const {
    const double behind = 0.5 * sizes_.largest() / speed_;  // [s] of travel behind the opening
    return {.time = time,
            .position = x + (is_rare(size) ? in_front : -behind) * p_.velocity,
            .velocity = p_.velocity,
            .diameter = sizes_.diameters()[size],
            .weight = is_rare(size) ? 1.0 / static_cast<double>(p_.samples_per_particle) : 1.0};
  }

  [[nodiscard]] bool is_rare(std::size_t i) const { return sizes_.diameters()[i] < p_.rare_below; }

  /// Real grains of size i per second.
  [[nodiscard]] double rate(std::size_t i, double density) const {
    double mean = 0.0;
    for (std::size_t n = 0; n < sizes_.size(); ++n) {
      mean += sizes_.fractions()[n] * formula::mass(density, sizes_.diameters()[n]);
    }
    return p_.mass_flow * sizes_.fractions()[i] / mean;
  }

  /// The next grain that is not rare: its time is when the stream has brought half of its mass.
  [[nodiscard]] Event next_common(const sdk::EmitterContext& context) const {
    if (!has_common_) return {};
    std::vector<long long> counts(released_.size(), 0);
    double mass = 0.0;
    double flow = 0.0;
    std::uint64_t number = 0;
    for (std::size_t i = 0; i < released_.size(); ++i) {
      if (is_rare(i)) continue;
      counts[i] = released_[i];
      number += static_cast<std::uint64_t>(released_[i]);
      const double m = formula::mass(context.grain_density, sizes_.diameters()[i]);
      mass += static_cast<double>(released_[i]) * m;
      flow += rate(i, context.grain_density) * m;
    }
    Event e;
    e.number = number;
    e.size = sdk::draw_size(common_, counts, k_window, context.random.uniform(number, 0, 1));
    e.time = p_.begin +
             (mass + 0.5 * formula::mass(context.grain_density, sizes_.diameters()[e.size])) / flow;
    return e;
  }

  /// The next copy of a rare size: one at a random instant of each interval 1 / (k rate).
  [[nodiscard]] Event next_rare(std::size_t i, const sdk::EmitterContext& context) const {
    if (!is_rare(i) || sizes_.fractions()[i] == 0.0) return {};
    const double copies =
        rate(i, context.grain_density) * static_cast<double>(p_.samples_per_particle);
    const auto n = static_cast<std::uint64_t>(released_[i]);
    Event e;
    e.size = i;
    e.number = n | (std::uint64_t{i} + 1) << 48;
    e.time = p_.begin + (static_cast<double>(n) + context.random.uniform(e.number, 0, 1)) / copies;
    return e;
  }

  /// A random place in the opening clear of the grains that passed shortly before. All grains move
  /// as one block inside the feed; common grains are let go while they are still wholly behind the
  /// opening, so that they meet what hovers in front of it as in life. Rare grains, which the air
  /// stops within a millisecond, are let go one interval in front of it: behind it they would hover
  /// where the next common grains appear.
  sdk::InsertionRequest place(const Event& e, const sdk::EmitterContext& context) {
    const double radius = 0.5 * sizes_.diameters()[e.size];
    const double largest = sizes_.largest();
    const double behind = 0.5 * largest / speed_;  // [s] of travel behind the opening
    const double in_front = context.end - context.begin;
    const double block_time = is_rare(e.size) ? e.time - behind - in_front : e.time;
    const double kept = 2.0 * largest / speed_ + in_front;
    std::erase_if(recent_, [&](const Placed& g) { return e.time - g.time > kept; });
    for (std::uint32_t trial = 0; trial < k_tries; ++trial) {
      Vec3 x = p_.min;
      for (int d = 0; d < 3; ++d) {
        if (d == axis_) continue;
        const double room = p_.max[d] - p_.min[d] - 2.0 * radius;
        x[d] = p_.min[d] + radius +
               room * context.random.uniform(e.number, trial, static_cast<std::uint32_t>(d) + 2);
      }
      const bool is_free = std::none_of(recent_.begin(), recent_.end(), [&](const Placed& g) {
        const Vec3 apart = x - g.position - (block_time - g.time) * p_.velocity;
        const double reach = (radius + g.radius) * (1.0 + k_gap);
        return dot(apart, apart) < reach * reach;
      });
      if (!is_free) continue;
      recent_.push_back({block_time, x, radius});
      return request_of(e.size, e.time, x, in_front);
    }
    std::ostringstream text;
    text << "no free place for a grain of " << 2.0 * radius << " m in the opening at " << e.time
         << " s (solids fraction "
         << formula::solids(p_.mass_flow, context.grain_density, area_, speed_)
         << "): widen the opening or raise the speed";
    throw sdk::ParameterError(text.str());
  }

  Parameters p_;
  sdk::SizeDistribution sizes_;
  int axis_ = 2;
  double area_ = 1.0;
  double speed_ = 0.0;
  std::vector<double> common_;  ///< by number among the sizes that are not rare
  bool has_common_ = false;
  std::vector<long long> released_;  ///< computed grains per size
  std::vector<Placed> recent_;
  bool is_order_chosen_ = false;
  std::optional<formula::LargeFirst> large_first_;  ///< where places would run out otherwise
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Feed>(); }
