// SPDX-License-Identifier: Apache-2.0
#include "lattice.hpp"

#include <dust/sdk/placed_emitter.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/size_distribution.hpp>

#include <algorithm>
#include <cmath>
#include <limits>
#include <sstream>

namespace {

namespace formula = dust::model::lattice;
namespace sdk = dust::sdk;
using sdk::Vec3;

// What a random draw is for.
constexpr std::uint32_t k_shuffle = 0;
constexpr std::uint32_t k_jitter = 1;
constexpr std::uint32_t k_speed = 2;

/// More grains than any machine runs: a slip of the unit, told before the memory is full.
constexpr double k_max_sites = 5e7;

class Lattice final : public sdk::PlacedEmitter {
 public:
  struct Parameters : sdk::SizeParameters {
    Vec3 min;
    Vec3 max;
    std::string arrangement = "simple";
    double spacing = 0.0;
    std::int64_t count = 0;
    double jitter = 0.0;
    double time = 0.0;
    Vec3 velocity;
    double velocity_scatter = 0.0;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", dim::length, "Lower corner of the box.");
    s.vector(&Parameters::max, "max", dim::length, "Upper corner of the box.");
    s.text(&Parameters::arrangement, "arrangement", "Kind of the lattice.")
        .one_of({"simple", "face_centred"})
        .optional();
    s.number(&Parameters::spacing, "spacing", dim::length, "Distance of nearest neighbours.")
        .above(0);
    s.integer(&Parameters::count, "count",
              "Number of grains, spread evenly over the sites; 0 = one on every site.")
        .at_least(0)
        .optional();
    s.number(&Parameters::jitter, "jitter", dim::none,
             "How far a grain may be off its site, in half gaps between neighbours.")
        .at_least(0)
        .at_most(1)
        .optional();
    declare_sizes(s);
    declare_moment(s);
    s.vector(&Parameters::velocity, "velocity", dim::velocity, "Mean velocity of the grains.")
        .optional();
    s.number(&Parameters::velocity_scatter, "velocity_scatter", dim::velocity,
             "Standard deviation of each component of the velocity, normally distributed.")
        .at_least(0)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "lattice",
            .version = "1.0",
            .summary = "Grains on the sites of a regular lattice in a box.",
            .equation = "\\mathbf x_{ijk} = \\mathbf x_0 + a\\,(i, j, k) + \\mathbf s",
            .source = "own definition"};
  }

  explicit Lattice(const Parameters& p) : PlacedEmitter(p.time), p_(p), sizes_(p) {
    // Two numbers written in different units may differ by a rounding of each.
    constexpr double k_rounding = 4.0 * std::numeric_limits<double>::epsilon();
    if (p.spacing < sizes_.largest() * (1.0 - k_rounding)) {
      std::ostringstream text;
      text << "spacing, " << p.spacing << " m, is smaller than the largest grain, "
           << sizes_.largest() << " m: neighbours would overlap";
      throw sdk::ParameterError(text.str());
    }
    const formula::Point low{p.min.x, p.min.y, p.min.z};
    const formula::Point high{p.max.x, p.max.y, p.max.z};
    const bool is_face_centred = p.arrangement == "face_centred";
    const double sites = formula::count_sites(low, high, p.spacing, is_face_centred);
    if (sites > k_max_sites) {
      std::ostringstream text;
      text << "the box from min to max has " << sites << " sites, and at most " << k_max_sites
           << " are placed: make it smaller or spacing wider";
      throw sdk::ParameterError(text.str());
    }
    sites_ = formula::sites(low, high, p.spacing, is_face_centred);
    const auto all = static_cast<std::int64_t>(sites_.size());
    if (all == 0) throw sdk::ParameterError("the box from min to max holds no whole cell");
    count_ = p.count > 0 ? p.count : all;
    if (count_ > all) {
      throw sdk::ParameterError("the box has " + std::to_string(all) + " sites for " +
                                std::to_string(count_) +
                                " grains: widen it or reduce spacing or count");
    }
  }

  [[nodiscard]] std::vector<double> diameters() const override { return sizes_.ascending(); }
  [[nodiscard]] double largest_speed() const override {
    // Three standard deviations: a bound that one grain in 300 exceeds.
    return norm(p_.velocity) + 3.0 * p_.velocity_scatter;
  }
  [[nodiscard]] sdk::EmitterRequest request() const override {
    sdk::EmitterRequest r;
    r.begin = p_.time;
    r.count = count_;
    r.shares = sdk::shares_of(sizes_);
    return r;
  }

 protected:
  void place(const sdk::EmitterContext& context,
             std::vector<sdk::InsertionRequest>& requests) override {
    const std::size_t first = requests.size();
    const std::vector<std::size_t> size_of = shuffled_sizes(context.random);
    const auto all = static_cast<std::int64_t>(sites_.size());
    // A displacement of at most half the gap in any direction keeps neighbours apart.
    const double play = std::max(0.0, p_.spacing - sizes_.largest());
    const double reach = p_.jitter * 0.5 * play / std::sqrt(3.0);
    std::uint64_t n = 0;
    for (std::int64_t site = 0; site < all; ++site) {
      if ((site + 1) * count_ / all == site * count_ / all) continue;
      const formula::Point& x = sites_[static_cast<std::size_t>(site)];
      sdk::InsertionRequest request{.position = {x[0], x[1], x[2]},
                                    .velocity = p_.velocity,
                                    .diameter = sizes_.diameters()[size_of[n]]};
      for (int d = 0; d < 3; ++d) {
        const auto slot = static_cast<std::uint32_t>(d);
        if (reach > 0.0) {
          request.position[d] += reach * (2.0 * context.random.uniform(n, k_jitter, slot) - 1.0);
        }
        if (p_.velocity_scatter > 0.0) {
          // Box and Muller, Ann. Math. Stat. 29 (1958) 610.
          const double r = std::sqrt(-2.0 * std::log(context.random.uniform(n, k_speed, 2 * slot)));
          const double turn =
              2.0 * std::numbers::pi * context.random.uniform(n, k_speed, 2 * slot + 1);
          request.velocity[d] += p_.velocity_scatter * r * std::cos(turn);
        }
      }
      requests.push_back(request);
      ++n;
    }
    if (p_.velocity_scatter > 0.0) take_drift_away(requests, first);
  }

 private:
  /// The index of each grain's size: exact numbers in random order (Fisher and Yates).
  [[nodiscard]] std::vector<std::size_t> shuffled_sizes(const sdk::Random& random) const {
    std::vector<std::size_t> order;
    const auto numbers = sizes_.for_count(count_);
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      order.insert(order.end(), static_cast<std::size_t>(numbers[i]), i);
    }
    for (std::size_t n = order.size(); n > 1; --n) {
      const auto m =
          static_cast<std::size_t>(random.uniform(n, k_shuffle) * static_cast<double>(n));
      std::swap(order[n - 1], order[m]);
    }
    return order;
  }

  /// The scatter shall not move the whole: the momentum becomes that of `velocity`.
  void take_drift_away(std::vector<sdk::InsertionRequest>& requests, std::size_t first) const {
    Vec3 momentum;
    double mass = 0.0;
    for (std::size_t n = first; n < requests.size(); ++n) {
      const double m = sdk::sphere_volume(requests[n].diameter);
      momentum += m * (requests[n].velocity - p_.velocity);
      mass += m;
    }
    for (std::size_t n = first; n < requests.size(); ++n) requests[n].velocity -= momentum / mass;
  }

  Parameters p_;
  sdk::SizeDistribution sizes_;
  std::vector<formula::Point> sites_;
  std::int64_t count_ = 0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Lattice>(); }
