// SPDX-License-Identifier: Apache-2.0
#include "fill.hpp"

#include <dust/sdk/placed_emitter.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/size_distribution.hpp>

#include <algorithm>
#include <numeric>
#include <sstream>

namespace {

namespace formula = dust::model::fill;
namespace sdk = dust::sdk;
using sdk::Vec3;

/// No loose filling is as dense as this; refused before anything is placed.
constexpr double k_densest = 0.5;
/// Equal spheres at random places run out here (jamming of random sequential placing; Torquato,
/// Random Heterogeneous Materials, 2002, table 12.1); what the advice in messages rests on.
constexpr double k_advised = 0.33;
constexpr std::uint32_t k_tries = 40000;
/// Tries per grain on average, beyond which the region counts as full: up to a solids fraction of
/// 0.38 some 60 are needed.
constexpr std::int64_t k_mean_tries = 500;
/// Free gap between placed grains relative to the sum of their radii.
constexpr double k_gap = 1e-6;

class Fill final : public sdk::PlacedEmitter {
 public:
  struct Parameters : sdk::SizeParameters {
    std::string region = "box";
    Vec3 min;
    Vec3 max;
    Vec3 from;
    Vec3 to;
    double radius = 0.0;
    double end_radius = 0.0;
    double mass = 0.0;
    std::int64_t count = 0;
    double time = 0.0;
    Vec3 velocity;
  };
  static sdk::ParameterSchema schema() {
    namespace dim = sdk::dimension;
    sdk::SchemaOf<Parameters> s;
    s.text(&Parameters::region, "region", "Shape of the region to fill.")
        .one_of({"box", "cylinder"})
        .optional();
    s.vector(&Parameters::min, "min", dim::length, "Lower corner of a box.").optional();
    s.vector(&Parameters::max, "max", dim::length, "Upper corner of a box.").optional();
    s.vector(&Parameters::from, "from", dim::length, "Where the axis of a cylinder begins.")
        .optional();
    s.vector(&Parameters::to, "to", dim::length, "Where the axis of a cylinder ends.").optional();
    s.number(&Parameters::radius, "radius", dim::length, "Radius of a cylinder.")
        .at_least(0)
        .optional();
    s.number(&Parameters::end_radius, "end_radius", dim::length,
             "Radius at the end of the axis where it differs: a cone or frustum; 0 = the same.")
        .at_least(0)
        .optional();
    s.number(&Parameters::mass, "mass", dim::mass, "Mass to fill in.").at_least(0).optional();
    s.integer(&Parameters::count, "count", "Number of grains to fill in, in place of mass.")
        .at_least(0)
        .optional();
    declare_sizes(s);
    declare_moment(s);
    s.vector(&Parameters::velocity, "velocity", dim::velocity, "Velocity of the grains at first.")
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "fill",
            .version = "1.0",
            .summary = "Fills a region loosely with grains at random places, to settle by weight.",
            .equation = "\\sum_n m_n = M \\pm m_{max} / 2",
            .source = "random sequential placing, large grains first; own derivation"};
  }

  explicit Fill(const Parameters& p) : PlacedEmitter(p.time), p_(p), sizes_(p) {
    if ((p.mass > 0.0) == (p.count > 0)) {
      throw sdk::ParameterError("give either mass or count, above 0");
    }
    if (p.region == "box") {
      take_box();
    } else {
      take_cylinder();
    }
  }

  [[nodiscard]] std::vector<double> diameters() const override { return sizes_.ascending(); }
  [[nodiscard]] double largest_speed() const override { return norm(p_.velocity); }
  [[nodiscard]] sdk::EmitterRequest request() const override {
    sdk::EmitterRequest r;
    r.begin = p_.time;
    r.mass = p_.mass;
    r.count = p_.count;
    r.shares = sdk::shares_of(sizes_);
    return r;
  }

 protected:
  void check(const sdk::EmitterContext& context) const override {
    // Of a mass without numbers: there may be more grains of it than can be counted.
    const double solids = (p_.mass > 0.0 ? p_.mass / context.grain_density
                                         : solids_volume(sizes_.for_count(p_.count))) /
                          volume_;
    if (solids <= k_densest) return;
    std::ostringstream text;
    text << "the region cannot hold the grains: they would take up " << solids << " of its "
         << 1e6 * volume_ << " cm3, and a loose filling at random places reaches about "
         << k_advised << "; give a region of at least " << 1e6 * volume_ * solids / k_advised
         << " cm3, or fill in several steps";
    throw sdk::ParameterError(text.str());
  }

  void place(const sdk::EmitterContext& context,
             std::vector<sdk::InsertionRequest>& requests) override {
    check(context);
    const auto wanted = numbers(context.grain_density);
    const std::int64_t all = std::accumulate(wanted.begin(), wanted.end(), std::int64_t{0});
    std::vector<std::size_t> coarse_first(sizes_.size());
    std::iota(coarse_first.begin(), coarse_first.end(), std::size_t{0});
    std::sort(coarse_first.begin(), coarse_first.end(), [this](std::size_t a, std::size_t b) {
      return sizes_.diameters()[a] > sizes_.diameters()[b];
    });
    formula::PlacedSpheres placed({low_.x, low_.y, low_.z}, {high_.x, high_.y, high_.z},
                                  sizes_.largest(), all);
    requests.reserve(requests.size() + static_cast<std::size_t>(all));
    std::uint64_t number = 0;
    std::int64_t tries_left = k_mean_tries * all + k_tries;
    for (const std::size_t i : coarse_first) {
      const double radius = 0.5 * sizes_.diameters()[i];
      for (std::int64_t n = 0; n < wanted[i]; ++n, ++number) {
        Vec3 x;
        if (!find_place(number, radius, context, placed, tries_left, x)) {
          report_shortfall(number, all, radius, requests, context);
        }
        placed.add({x.x, x.y, x.z}, radius);
        requests.push_back(
            {.position = x, .velocity = p_.velocity, .diameter = sizes_.diameters()[i]});
      }
    }
  }

 private:
  void take_box() {
    if (p_.radius > 0.0 || p_.end_radius > 0.0 || p_.from != Vec3{} || p_.to != Vec3{}) {
      throw sdk::ParameterError(
          "from, to, radius and end_radius belong to region: cylinder; a box has min and max");
    }
    const Vec3 extent = p_.max - p_.min;
    for (int d = 0; d < 3; ++d) {
      if (!(extent[d] >= sizes_.largest())) {
        throw sdk::ParameterError("the box from min to max is narrower than the largest grain");
      }
    }
    low_ = p_.min;
    high_ = p_.max;
    volume_ = extent.x * extent.y * extent.z;
  }
  void take_cylinder() {
    if (p_.min != Vec3{} || p_.max != Vec3{}) {
      throw sdk::ParameterError(
          "min and max belong to region: box; a cylinder has from, to and radius");
    }
    length_ = norm(p_.to - p_.from);
    if (!(p_.radius > 0.0)) throw sdk::ParameterError("region: cylinder needs radius");
    end_radius_ = p_.end_radius > 0.0 ? p_.end_radius : p_.radius;
    const double widest = std::max(p_.radius, end_radius_);
    if (!(length_ >= sizes_.largest()) || 2.0 * widest < sizes_.largest()) {
      throw sdk::ParameterError("the cylinder is narrower or shorter than the largest grain");
    }
    axis_ = (p_.to - p_.from) / length_;
    const Vec3 off = std::abs(axis_.x) < 0.7 ? Vec3{1, 0, 0} : Vec3{0, 1, 0};
    side_ = cross(axis_, off) / norm(cross(axis_, off));
    other_side_ = cross(axis_, side_);
    for (int d = 0; d < 3; ++d) {
      low_[d] = std::min(p_.from[d], p_.to[d]) - widest;
      high_[d] = std::max(p_.from[d], p_.to[d]) + widest;
    }
    volume_ = formula::frustum_volume(length_, p_.radius, end_radius_);
  }

  [[nodiscard]] std::vector<std::int64_t> numbers(double density) const {
    return p_.count > 0 ? sizes_.for_count(p_.count) : sizes_.for_mass(p_.mass, density);
  }
  [[nodiscard]] double solids_volume(const std::vector<std::int64_t>& numbers) const {
    double volume = 0.0;
    for (std::size_t i = 0; i < numbers.size(); ++i) {
      volume += static_cast<double>(numbers[i]) * sdk::sphere_volume(sizes_.diameters()[i]);
    }
    return volume;
  }

  /// A random point at which a sphere lies wholly in the region; false where it would stick out.
  [[nodiscard]] bool draw(std::uint64_t number, std::uint32_t trial, double radius,
                          const sdk::Random& random, Vec3& x) const {
    double u[3];
    for (std::uint32_t d = 0; d < 3; ++d) u[d] = random.uniform(number, trial, d);
    if (p_.region == "box") {
      for (int d = 0; d < 3; ++d)
        x[d] = low_[d] + radius + (high_[d] - low_[d] - 2.0 * radius) * u[d];
      return true;
    }
    const double widest = std::max(p_.radius, end_radius_);
    const double along = radius + (length_ - 2.0 * radius) * u[0];
    const double off = widest * std::sqrt(u[1]);
    if (formula::mantle_clearance(along, off, length_, p_.radius, end_radius_) < radius) {
      return false;
    }
    const double angle = 2.0 * std::numbers::pi * u[2];
    x = p_.from + along * axis_ + (off * std::cos(angle)) * side_ +
        (off * std::sin(angle)) * other_side_;
    return true;
  }

  [[nodiscard]] bool find_place(std::uint64_t number, double radius,
                                const sdk::EmitterContext& context,
                                const formula::PlacedSpheres& placed, std::int64_t& tries_left,
                                Vec3& x) const {
    for (std::uint32_t trial = 0; trial < k_tries && tries_left > 0; ++trial, --tries_left) {
      if (!draw(number, trial, radius, context.random, x)) continue;
      if (!placed.is_free({x.x, x.y, x.z}, radius, k_gap)) continue;
      if (context.surroundings == nullptr || context.surroundings->is_free(x, radius)) return true;
    }
    return false;
  }

  [[noreturn]] void report_shortfall(std::uint64_t number, std::int64_t all, double radius,
                                     const std::vector<sdk::InsertionRequest>& requests,
                                     const sdk::EmitterContext& context) const {
    const double wanted = solids_volume(numbers(context.grain_density));
    double placed = 0.0;
    for (auto s = requests.end() - static_cast<std::ptrdiff_t>(number); s != requests.end(); ++s) {
      placed += sdk::sphere_volume(s->diameter);
    }
    std::ostringstream text;
    text << "only " << number << " of " << all << " grains ("
         << 1e3 * placed * context.grain_density << " g of " << 1e3 * wanted * context.grain_density
         << " g) found a place: no free one for a diameter of " << 2e3 * radius
         << " mm is left, with " << placed / volume_ << " of the region's " << 1e6 * volume_
         << " cm3 taken by grains; what stands in the region (bodies, walls, other grains) takes "
         << "its share too. Give a region of at least " << 1e6 * wanted / k_advised
         << " cm3 of free space, or fill in several steps";
    throw sdk::ParameterError(text.str());
  }

  Parameters p_;
  sdk::SizeDistribution sizes_;
  Vec3 low_, high_;
  double volume_ = 0.0;
  double length_ = 0.0;
  double end_radius_ = 0.0;
  Vec3 axis_, side_, other_side_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Fill>(); }
