// SPDX-License-Identifier: Apache-2.0
// Rules of liberation laws: nothing from nothing, never more than there is, more from more.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/liberation_law.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <numeric>

namespace dust::contract {
namespace {

namespace dim = sdk::dimension;

constexpr std::size_t k_classes = 2;
constexpr double k_no_answer = -7.25e77;
const double k_diameters[k_classes] = {5e-6, 20e-6};  // m
constexpr double k_grain = 4e-3;                      // m
constexpr double k_mass = 8.4e-5;                     // kg
/// From nothing to more than all: energy [J], acceleration [m/s2], shear [Pa].
constexpr std::size_t k_strengths = 6;
const double k_energy[k_strengths] = {0.0, 1e-10, 1e-7, 1e-5, 1e-3, 1.0};
const double k_acceleration[k_strengths] = {0.0, 1.0, 1e3, 1e5, 1e6, 1e8};
const double k_shear[k_strengths] = {0.0, 0.05, 0.5, 3.0, 20.0, 200.0};
const double k_moisture[] = {0.01, 0.03, 0.1};
const double k_left[] = {1.0, 0.5, 0.0};  ///< of the fresh load
constexpr std::size_t k_rows = k_strengths * std::size(k_moisture) * std::size(k_left);

/// Row by strength, then load that is left, then moisture.
std::size_t row(std::size_t moisture, std::size_t left, std::size_t strength) {
  return (moisture * std::size(k_left) + left) * k_strengths + strength;
}

using Column = std::vector<double>;

/// The standard grains, and what a law has made of them, in units of its own.
struct Bench {
  Units units;
  double step = 1e-3;  ///< [s]
  std::array<double, k_classes> diameters{};
  struct {
    Column diameter, mass, moisture;
  } grain;
  struct {
    Column normal, tangential, acceleration;
  } impact;
  struct {
    Column slip, shear, void_fraction;
  } wind;
  Column load = Column(k_classes * k_rows, 0.0), fresh = load;
  Column in_contacts = Column(k_classes * k_rows + 1, k_no_answer), in_wind = in_contacts;
};

void add_grain(Bench& b, double wet, double left, std::size_t s) {
  const std::size_t n = b.grain.diameter.size();
  const Units& u = b.units;
  b.grain.diameter.push_back(k_grain * u.length);
  b.grain.mass.push_back(k_mass * u.mass);
  b.grain.moisture.push_back(wet);
  b.impact.normal.push_back(0.7 * k_energy[s] * u.of(dim::energy));
  b.impact.tangential.push_back(0.3 * k_energy[s] * u.of(dim::energy));
  b.impact.acceleration.push_back(k_acceleration[s] * u.of(dim::acceleration));
  b.wind.slip.push_back(std::sqrt(k_shear[s]) * u.of(dim::velocity));
  b.wind.shear.push_back(k_shear[s] * u.of(dim::pressure));
  b.wind.void_fraction.push_back(0.9);
  for (std::size_t k = 0; k < k_classes; ++k) {
    b.fresh[k * k_rows + n] = (k == 0 ? 0.002 : 0.01) * b.grain.mass[n];
    b.load[k * k_rows + n] = left * b.fresh[k * k_rows + n];
  }
}

Bench make_bench(const Units& units) {
  Bench b;
  b.units = units;
  for (std::size_t k = 0; k < k_classes; ++k) b.diameters[k] = k_diameters[k] * units.length;
  for (const double wet : k_moisture) {
    for (const double left : k_left) {
      for (std::size_t s = 0; s < k_strengths; ++s) add_grain(b, wet, left, s);
    }
  }
  return b;
}

/// A part of the rows, whose columns stand as far apart as those of all.
sdk::DustyGrains grains_of(Bench& b, std::size_t first, std::size_t count, Column& out) {
  return {.count = count,
          .classes = k_classes,
          .stride = k_rows,
          .time_step = b.step * b.units.time,
          .diameter = b.grain.diameter.data() + first,
          .mass = b.grain.mass.data() + first,
          .moisture = b.grain.moisture.data() + first,
          .load = b.load.data() + first,
          .fresh = b.fresh.data() + first,
          .released = out.data() + first};
}

/// `b` outlives the law.
void prepare(sdk::LiberationLaw& law, const Bench& b) {
  law.prepare({.classes = k_classes,
               .diameter = b.diameters.data(),
               .density = 2650.0 * b.units.of(dim::density),
               .gas_density = 1.2 * b.units.of(dim::density),
               .gas_viscosity = 1.8e-5 * b.units.of(dim::dynamic_viscosity),
               .gravity = 9.81 * b.units.of(dim::acceleration)});
}

void ask(const sdk::LiberationLaw& law, const TestVariant& variant, Bench& b) {
  const std::size_t most = variant.batch == 0 ? k_rows : variant.batch;
  for (std::size_t first = 0; first < k_rows; first += most) {
    const std::size_t count = std::min(most, k_rows - first);
    const sdk::GrainImpacts impacts{.grains = grains_of(b, first, count, b.in_contacts),
                                    .normal_energy = b.impact.normal.data() + first,
                                    .tangential_energy = b.impact.tangential.data() + first,
                                    .acceleration = b.impact.acceleration.data() + first};
    call_hot(variant, [&] { law.in_contacts(impacts); });
    if (!law.needs_wind()) continue;
    const sdk::GrainWind wind{.grains = grains_of(b, first, count, b.in_wind),
                              .slip = b.wind.slip.data() + first,
                              .shear = b.wind.shear.data() + first,
                              .void_fraction = b.wind.void_fraction.data() + first};
    call_hot(variant, [&] { law.in_wind(wind); });
  }
  require(b.in_contacts.back() == k_no_answer && b.in_wind.back() == k_no_answer,
          "it writes beyond the end of the batch");
  if (!law.needs_wind()) std::fill(b.in_wind.begin(), b.in_wind.end(), 0.0);
}

Bench asked(const Maker& make, const TestVariant& variant) {
  Bench bench = make_bench(variant.units);
  const auto law = make_as<sdk::LiberationLaw>(make, variant.units);
  prepare(*law, bench);
  ask(*law, variant, bench);
  return bench;
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const Bench bench = asked(make, variant);
  Observations observations;
  for (std::size_t at = 0; at < k_classes * k_rows; ++at) {
    observations.push_back({"mass set free in contacts", bench.in_contacts[at], dim::mass});
    observations.push_back({"mass set free in wind", bench.in_wind[at], dim::mass});
  }
  return observations;
}

std::string of_row(std::size_t at) {
  return " of class " + std::to_string(at / k_rows) + " in row " + std::to_string(at % k_rows);
}

void check_amounts(const Bench& bench) {
  for (const auto* out : {&bench.in_contacts, &bench.in_wind}) {
    for (std::size_t at = 0; at < k_classes * k_rows; ++at) {
      const double mass = (*out)[at];
      require(mass >= 0.0, shown(mass) + " kg" + of_row(at) + "; expected: from 0 on");
      require(mass <= bench.load[at] * (1.0 + sdk::LiberationLaw::k_rounding),
              shown(mass) + " kg of " + shown(bench.load[at]) + " kg" + of_row(at) +
                  "; expected: at most all of it");
    }
  }
}

void check_nothing_from_nothing(const Bench& bench) {
  for (std::size_t at = 0; at < k_classes * k_rows; at += k_strengths) {
    require(bench.in_contacts[at] == 0.0, shown(bench.in_contacts[at]) + " kg" + of_row(at) +
                                              " that nothing has touched; expected: 0");
    require(bench.in_wind[at] == 0.0,
            shown(bench.in_wind[at]) + " kg" + of_row(at) + " where there is no wind; expected: 0");
  }
}

void check_more_from_more(const Bench& bench) {
  for (std::size_t at = 1; at < k_classes * k_rows; ++at) {
    if (at % k_strengths == 0) continue;
    for (const auto* out : {&bench.in_contacts, &bench.in_wind}) {
      require((*out)[at] >= (*out)[at - 1], shown((*out)[at]) + " kg" + of_row(at) + ", but " +
                                                shown((*out)[at - 1]) +
                                                " kg where less has happened to the same grain");
    }
  }
}

/// Moisture binds, where the law reads it; else it changes nothing.
void check_moisture(const Bench& bench, bool uses_moisture) {
  for (std::size_t k = 0; k < k_classes; ++k) {
    for (std::size_t m = 1; m < std::size(k_moisture); ++m) {
      for (std::size_t r = 0; r < std::size(k_left) * k_strengths; ++r) {
        const std::size_t wetter = k * k_rows + row(m, 0, 0) + r;
        const std::size_t drier = k * k_rows + row(m - 1, 0, 0) + r;
        for (const auto* out : {&bench.in_contacts, &bench.in_wind}) {
          const double wet = (*out)[wetter];
          const double dry = (*out)[drier];
          require(uses_moisture || wet == dry,
                  "it reads the moisture and says that it does not: uses_moisture()");
          require(wet <= dry, shown(wet) + " kg" + of_row(wetter) + ", but " + shown(dry) +
                                  " kg of the same grain that is drier");
        }
      }
    }
  }
}

/// What two steps of half the energy, or half the time, set free beside one.
void check_steps(const Maker& make) {
  constexpr double k_rounding = 1e-9;
  Bench whole = make_bench({});
  const auto law = make_as<sdk::LiberationLaw>(make);
  prepare(*law, whole);
  Bench first = whole;
  ask(*law, {}, whole);
  for (auto* energy : {&first.impact.normal, &first.impact.tangential}) {
    for (double& e : *energy) e *= 0.5;
  }
  Bench second = first;
  ask(*law, {}, first);
  for (std::size_t at = 0; at < k_classes * k_rows; ++at) second.load[at] -= first.in_contacts[at];
  ask(*law, {}, second);
  for (std::size_t at = 0; at < k_classes * k_rows; ++at) {
    const double once = whole.in_contacts[at];
    const double twice = first.in_contacts[at] + second.in_contacts[at];
    if (std::abs(twice - once) <= k_rounding * whole.fresh[at]) continue;
    throw Remark("an impact in two halves sets free " + shown(twice) + " kg" + of_row(at) +
                 ", as one " + shown(once) +
                 " kg: figures depend on the fluid step; measure by the fresh load?");
  }
}

/// A law that answers to the wind and does not say so is never asked.
void check_wind_is_asked(const Maker& make) {
  const auto law = make_as<sdk::LiberationLaw>(make);
  if (law->needs_wind()) return;
  Bench b = make_bench({});
  prepare(*law, b);
  law->in_wind({.grains = grains_of(b, 0, k_rows, b.in_wind),
                .slip = b.wind.slip.data(),
                .shear = b.wind.shear.data(),
                .void_fraction = b.wind.void_fraction.data()});
  const bool has_answer = std::any_of(b.in_wind.begin(), b.in_wind.end(), [](double mass) {
    return mass > 0.0 && mass != k_no_answer;
  });
  require(!has_answer,
          "it sets dust free in wind and needs_wind() says that it does not: it is never asked for "
          "that; give needs_wind() as well");
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("sets free no more than there is, and nothing negative",
              [&] { check_amounts(asked(make, {})); });
  runner.rule("sets nothing free where nothing has happened",
              [&] { check_nothing_from_nothing(asked(make, {})); });
  runner.rule("sets no less free where more has happened",
              [&] { check_more_from_more(asked(make, {})); });
  runner.rule("is bound by moisture if it says so", [&] {
    check_moisture(asked(make, {}), make_as<sdk::LiberationLaw>(make)->uses_moisture());
  });
  runner.rule("sets the same free in one impact as in its two halves", [&] { check_steps(make); });
  runner.rule("is asked for all that it answers", [&] { check_wind_is_asked(make); });
  runner.rule("sets something free", [&] {
    const Bench bench = asked(make, {});
    const double sum =
        std::accumulate(bench.in_contacts.begin(), bench.in_contacts.end() - 1, 0.0) +
        std::accumulate(bench.in_wind.begin(), bench.in_wind.end() - 1, 0.0);
    require(sum > 0.0, "nothing comes off in the strongest impact or wind");
  });
}

}  // namespace

Kind liberation_kind() {
  return {.observe = observe,
          .batches = {1, 3, 8},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
