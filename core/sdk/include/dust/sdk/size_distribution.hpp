// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/emitter.hpp"
#include "dust/sdk/error.hpp"
#include "dust/sdk/parameter_schema.hpp"
#include "dust/sdk/sphere.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <numbers>
#include <numeric>
#include <span>
#include <string>
#include <vector>

/// How the sizes of grains are given: one part for all emitters. An emitter's `Parameters` derive
/// from SizeParameters, its schema calls declare_sizes, and a SizeDistribution is made from both.
namespace dust::sdk {

struct SizeParameters {
  std::string distribution = "table";
  std::vector<double> diameters;
  std::vector<double> number_fractions;
  std::vector<double> mass_fractions;
  std::string by = "mass";
  double median = 0.0;
  double spread = 0.0;
  double characteristic_diameter = 0.0;
  double exponent = 0.0;
  double smallest = 0.0;
  double largest = 0.0;
  std::int64_t size_classes = 12;
};

template <class P>
void declare_sizes(SchemaOf<P>& s) {
  s.text(&P::distribution, "distribution",
         "How the diameters are distributed: a table of diameters, or a law cut at smallest and "
         "largest.")
      .one_of({"table", "lognormal", "rosin_rammler", "uniform"})
      .optional();
  s.numbers(&P::diameters, "diameters", dimension::length, "Grain diameters of a table.")
      .above(0)
      .optional();
  s.numbers(&P::number_fractions, "number_fractions", dimension::none,
            "Share of each diameter by number; need not add up to 1.")
      .at_least(0)
      .optional();
  s.numbers(&P::mass_fractions, "mass_fractions", dimension::none,
            "Share of each diameter by mass, in place of number_fractions.")
      .at_least(0)
      .optional();
  s.text(&P::by, "by",
         "Whether the law of lognormal, rosin_rammler or uniform is by mass or by number.")
      .one_of({"mass", "number"})
      .optional();
  s.number(&P::median, "median", dimension::length, "Median diameter (lognormal).")
      .symbol("d_50")
      .at_least(0)
      .optional();
  s.number(&P::spread, "spread", dimension::none,
           "Geometric standard deviation, d_84 / d_50 (lognormal).")
      .symbol("sigma_g")
      .at_least(0)
      .optional();
  s.number(&P::characteristic_diameter, "characteristic_diameter", dimension::length,
           "Diameter below which 63.2 % lie (rosin_rammler).")
      .symbol("d'")
      .at_least(0)
      .optional();
  s.number(&P::exponent, "exponent", dimension::none, "Exponent of uniformity (rosin_rammler).")
      .symbol("n")
      .at_least(0)
      .optional();
  s.number(&P::smallest, "smallest", dimension::length, "Smallest diameter of a law.")
      .at_least(0)
      .optional();
  s.number(&P::largest, "largest", dimension::length, "Largest diameter of a law.")
      .at_least(0)
      .optional();
  s.integer(
       &P::size_classes, "size_classes",
       "Number of diameters that stand for a law; each keeps the number and the mass of its class.")
      .at_least(1)
      .at_most(200)
      .optional();
}

/// Diameters with their shares by number.
///
/// A law is cut at `smallest` and `largest` and split into classes of equal width in ln d. Class i
/// with number \f$ N_i = \int q_0\,dd \f$ becomes grains of the one diameter
/// \f$ d_i = (\int q_0 d^3\,dd / N_i)^{1/3} \f$, so that the shares by number and by mass are both
/// those of the law, class by class.
/// - lognormal: \f$ Q(d) = \Phi(\ln(d/d_{50}) / \ln\sigma_g) \f$;
/// - Rosin-Rammler: \f$ Q(d) = 1 - \exp(-(d/d')^n) \f$ (Rosin and Rammler, J. Inst. Fuel 7 (1933)
///   29);
/// - uniform: \f$ Q(d) \f$ linear between smallest and largest;
/// each by mass or by number.
class SizeDistribution {
 public:
  SizeDistribution() = default;
  explicit SizeDistribution(const SizeParameters& p) {
    if (p.distribution == "table") {
      from_table(p);
    } else {
      from_law(p);
    }
  }

  /// [m] in the order given.
  [[nodiscard]] std::span<const double> diameters() const { return diameters_; }
  /// By number, add up to 1; as diameters().
  [[nodiscard]] std::span<const double> fractions() const { return fractions_; }
  [[nodiscard]] std::size_t size() const { return diameters_.size(); }
  [[nodiscard]] double largest() const {
    return *std::max_element(diameters_.begin(), diameters_.end());
  }
  [[nodiscard]] double smallest() const {
    return *std::min_element(diameters_.begin(), diameters_.end());
  }
  [[nodiscard]] std::vector<double> ascending() const {
    std::vector<double> d = diameters_;
    std::sort(d.begin(), d.end());
    return d;
  }
  /// Mean volume of a grain [m3].
  [[nodiscard]] double mean_volume() const {
    double mean = 0.0;
    for (std::size_t i = 0; i < size(); ++i) mean += fractions_[i] * sphere_volume(diameters_[i]);
    return mean;
  }

  /// Numbers of each size for `count` grains in all: whole numbers nearest to the shares (largest
  /// remainders).
  [[nodiscard]] std::vector<std::int64_t> for_count(std::int64_t count) const {
    std::vector<std::int64_t> numbers(size());
    std::vector<std::pair<double, std::size_t>> rest(size());
    std::int64_t given = 0;
    for (std::size_t i = 0; i < size(); ++i) {
      const double wanted = fractions_[i] * static_cast<double>(count);
      numbers[i] = static_cast<std::int64_t>(wanted);
      given += numbers[i];
      rest[i] = {static_cast<double>(numbers[i]) - wanted, i};
    }
    std::sort(rest.begin(), rest.end());
    for (std::size_t n = 0; given < count; ++n, ++given) ++numbers[rest[n % size()].second];
    return numbers;
  }

  /// Numbers of each size for `mass` [kg] of grains of `density` [kg/m3]: each size within one
  /// grain of its share, the mass within half of the largest grain's. Throws ParameterError above
  /// 1e15 grains.
  [[nodiscard]] std::vector<std::int64_t> for_mass(double mass, double density) const {
    const double count = mass / (density * mean_volume());
    if (!(count <= 1e15)) refuse("so much mass of so small grains is more than 1e15 grains");
    std::vector<std::int64_t> numbers(size());
    std::vector<std::size_t> coarse_first(size());
    double left = mass;
    for (std::size_t i = 0; i < size(); ++i) {
      numbers[i] = std::llround(fractions_[i] * count);
      left -= static_cast<double>(numbers[i]) * density * sphere_volume(diameters_[i]);
      coarse_first[i] = i;
    }
    std::sort(coarse_first.begin(), coarse_first.end(),
              [this](std::size_t a, std::size_t b) { return diameters_[a] > diameters_[b]; });
    for (const std::size_t i : coarse_first) {
      const double one = density * sphere_volume(diameters_[i]);
      const long long more = std::clamp(std::llround(left / one), -1LL, 1LL);
      if (fractions_[i] == 0.0 || numbers[i] + more < 0) continue;
      numbers[i] += more;
      left -= static_cast<double>(more) * one;
    }
    return numbers;
  }

 private:
  static double normal(double z) { return 0.5 * std::erfc(-z / std::numbers::sqrt2); }

  [[noreturn]] static void refuse(const std::string& text) { throw ParameterError(text); }

  static void only_for(bool is_given, const char* key, const char* laws) {
    if (is_given) refuse(std::string(key) + " belongs to distribution: " + laws + "; remove it");
  }

  void from_table(const SizeParameters& p) {
    only_for(p.median > 0.0, "median", "lognormal");
    only_for(p.spread > 0.0, "spread", "lognormal");
    only_for(p.characteristic_diameter > 0.0, "characteristic_diameter", "rosin_rammler");
    only_for(p.exponent > 0.0, "exponent", "rosin_rammler");
    only_for(p.smallest > 0.0, "smallest", "lognormal, rosin_rammler or uniform");
    only_for(p.largest > 0.0, "largest", "lognormal, rosin_rammler or uniform");
    diameters_ = p.diameters;
    const std::size_t n = size();
    if (n == 0) refuse("diameters is empty: give at least one, or a distribution");
    for (std::size_t i = 0; i < n; ++i) {
      if (std::count(diameters_.begin(), diameters_.end(), diameters_[i]) > 1) {
        refuse("a diameter is given twice");
      }
    }
    fractions_ = p.number_fractions;
    if (fractions_.empty() && p.mass_fractions.empty() && n == 1) fractions_ = {1.0};
    if (fractions_.empty() == p.mass_fractions.empty() && fractions_.size() != 1) {
      refuse("give either number_fractions or mass_fractions");
    }
    if (!p.mass_fractions.empty()) {
      check_length("mass_fractions", p.mass_fractions.size());
      fractions_.resize(n);
      for (std::size_t i = 0; i < n; ++i) {
        const double d = diameters_[i];
        fractions_[i] = p.mass_fractions[i] / (d * d * d);
      }
    }
    check_length("number_fractions", fractions_.size());
    normalise();
  }

  void check_length(const char* name, std::size_t length) const {
    if (length == size()) return;
    refuse(std::string(name) + " has " + std::to_string(length) + " entries for " +
           std::to_string(size()) + " diameters");
  }

  void normalise() {
    const double sum = std::accumulate(fractions_.begin(), fractions_.end(), 0.0);
    if (!(sum > 0.0)) refuse("the fractions add up to nothing");
    for (double& f : fractions_) f /= sum;
  }

  static void check_law(const SizeParameters& p) {
    const bool is_lognormal = p.distribution == "lognormal";
    const bool is_rosin_rammler = p.distribution == "rosin_rammler";
    only_for(!p.diameters.empty(), "diameters", "table");
    only_for(!p.number_fractions.empty(), "number_fractions", "table");
    only_for(!p.mass_fractions.empty(), "mass_fractions", "table");
    if (!is_lognormal) only_for(p.median > 0.0, "median", "lognormal");
    if (!is_lognormal) only_for(p.spread > 0.0, "spread", "lognormal");
    if (!is_rosin_rammler) {
      only_for(p.characteristic_diameter > 0.0, "characteristic_diameter", "rosin_rammler");
      only_for(p.exponent > 0.0, "exponent", "rosin_rammler");
    }
    if (!(p.smallest > 0.0)) refuse("distribution: " + p.distribution + " needs smallest");
    if (!(p.largest > p.smallest)) refuse("largest must be larger than smallest");
    if (is_lognormal && !(p.median > 0.0)) refuse("distribution: lognormal needs median");
    if (is_lognormal && !(p.spread > 1.0)) {
      refuse("distribution: lognormal needs spread, the geometric standard deviation, above 1");
    }
    if (is_rosin_rammler && !(p.characteristic_diameter > 0.0)) {
      refuse("distribution: rosin_rammler needs characteristic_diameter");
    }
    if (is_rosin_rammler && !(p.exponent > 0.0)) {
      refuse("distribution: rosin_rammler needs exponent");
    }
  }

  /// Fraction Q(d) of a law that is finer than `d` [m].
  static double finer_than(const SizeParameters& p, double d) {
    if (p.distribution == "lognormal") return normal(std::log(d / p.median) / std::log(p.spread));
    if (p.distribution == "rosin_rammler") {
      return -std::expm1(-std::pow(d / p.characteristic_diameter, p.exponent));
    }
    return (d - p.smallest) / (p.largest - p.smallest);
  }

  /// Its density in ln d at `d` [m]: dQ / d ln d.
  static double log_density(const SizeParameters& p, double d) {
    if (p.distribution == "lognormal") {
      const double z = std::log(d / p.median) / std::log(p.spread);
      return std::exp(-0.5 * z * z) / (std::sqrt(2.0 * std::numbers::pi) * std::log(p.spread));
    }
    if (p.distribution == "rosin_rammler") {
      const double t = std::pow(d / p.characteristic_diameter, p.exponent);
      return p.exponent * t * std::exp(-t);
    }
    return d / (p.largest - p.smallest);
  }

  /// Integral of q d^power over the class from `low` [m] on that is `width` wide in ln d; Simpson's
  /// rule: 64 steps leave less than 1e-9 of it.
  static double moment(const SizeParameters& p, double low, double width, double power) {
    constexpr int k_steps = 64;
    double sum = 0.0;
    for (int k = 0; k <= k_steps; ++k) {
      const double d = low * std::exp(width * k / k_steps);
      const double factor = k == 0 || k == k_steps ? 1.0 : k % 2 == 1 ? 4.0 : 2.0;
      sum += factor * log_density(p, d) * std::pow(d, power);
    }
    return sum * (width / (3.0 * k_steps));
  }

  void from_law(const SizeParameters& p) {
    check_law(p);
    const bool is_by_mass = p.by == "mass";
    const auto classes = static_cast<std::size_t>(p.size_classes);
    const double width = std::log(p.largest / p.smallest) / static_cast<double>(classes);
    const auto edge = [&](std::size_t i) {
      return i == classes ? p.largest : p.smallest * std::exp(width * static_cast<double>(i));
    };
    for (std::size_t i = 0; i < classes; ++i) {
      const double low = edge(i);
      // The class in the law's own measure and in the other one.
      const double own = finer_than(p, edge(i + 1)) - finer_than(p, low);
      const double other = moment(p, low, width, is_by_mass ? -3.0 : 3.0);
      if (!(own > 0.0) || !(other > 0.0)) continue;  // no grain of the law is that small or large
      const double number = is_by_mass ? other : own;
      const double cubes = is_by_mass ? own : other;
      diameters_.push_back(std::cbrt(cubes / number));
      fractions_.push_back(number);
    }
    if (diameters_.empty())
      refuse("no grain of the distribution lies between smallest and largest");
    normalise();
  }

  std::vector<double> diameters_;
  std::vector<double> fractions_;
};

/// The shares as an emitter's request names them, ascending.
inline std::vector<EmitterRequest::Share> shares_of(const SizeDistribution& sizes) {
  std::vector<EmitterRequest::Share> shares;
  for (std::size_t i = 0; i < sizes.size(); ++i) {
    shares.push_back({sizes.diameters()[i], sizes.fractions()[i]});
  }
  std::sort(shares.begin(), shares.end(),
            [](const auto& a, const auto& b) { return a.diameter < b.diameter; });
  return shares;
}

/// Draws the next size so that the counts follow the fractions: size i with a chance proportional
/// to f_i (n + window) - count_i. No size strays from its share by more than f_i times the window.
/// `fractions` add up to 1; `u` in (0, 1).
inline std::size_t draw_size(std::span<const double> fractions, std::span<const long long> counts,
                             double window, double u) {
  double n = window;
  for (const long long c : counts) n += static_cast<double>(c);
  double sum = 0.0;
  const auto claim = [&](std::size_t i) {
    const double c = fractions[i] * n - static_cast<double>(counts[i]);
    return c > 0.0 ? c : 0.0;
  };
  for (std::size_t i = 0; i < fractions.size(); ++i) sum += claim(i);
  double x = u * sum;
  std::size_t last = 0;
  for (std::size_t i = 0; i < fractions.size(); ++i) {
    if (claim(i) <= 0.0) continue;
    last = i;
    x -= claim(i);
    if (x <= 0.0) return i;
  }
  return last;
}

}  // namespace dust::sdk
