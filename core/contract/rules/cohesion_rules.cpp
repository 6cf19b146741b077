// SPDX-License-Identifier: Apache-2.0
// Rules of cohesive laws: pairs that touch, part beyond the law's range and come back.
#include "contract/rule_runner.hpp"
#include "contract/scenes/contact_bench.hpp"
#include "dust/sdk/cohesion_law.hpp"

#include <algorithm>
#include <cmath>
#include <functional>

namespace dust::contract {
namespace {

std::unique_ptr<sdk::CohesionLaw> make_law(const Maker& make, const Units& units = {}) {
  auto law = make_as<sdk::CohesionLaw>(make, units);
  law->prepare(material(false, units), material(true, units));
  require_history(law->history_size());
  return law;
}

/// Sizes, overlaps and speeds (> 0 apart) of the standard contacts.
struct Pairs {
  std::vector<double> radii, overlaps, masses, speeds;
  double largest = 0.0;
  double time_step = 0.0;
  explicit Pairs(const Units& units) : time_step(1e-6 * units.time) {
    for (const Touch& t : standard_contacts(0.0, 0)) {
      radii.push_back(t.radius * units.length);
      overlaps.push_back(t.overlap * units.length);
      masses.push_back(t.mass * units.mass);
      speeds.push_back(dot(t.velocity, t.normal) * units.of(sdk::dimension::velocity));
      largest = std::max(largest, radii.back());
    }
  }
  /// One pair at rest.
  explicit Pairs(double radius)
      : radii{radius}, overlaps{0.0}, masses{1e-6}, speeds{0.0}, largest(radius), time_step(1e-6) {}
};

/// Columns of pairs with guards behind every one of them, history included.
class CohesionBench {
 public:
  enum Column { overlap, radius, mass, normal_velocity, contact_overlap, attraction, k_columns };
  static constexpr Column k_first_output = contact_overlap;

  CohesionBench(std::size_t count, int history) : count_((count + 7) / 8 * 8), history_(history) {
    columns_.assign(static_cast<std::size_t>(k_columns + history),
                    std::vector<double>(count_ + k_guard, k_guard_value));
    for (std::size_t h = k_columns; h < columns_.size(); ++h) {
      std::fill_n(columns_[h].begin(), count_, 0.0);
    }
  }
  /// The pairs now, where they have these overlaps and part at these speeds times `pace`; outputs
  /// are forgotten, the history is not.
  void show(const Pairs& pairs, const std::vector<double>& overlaps, double pace) {
    time_step_ = pairs.time_step;
    for (std::size_t n = 0; n < count_; ++n) {
      const std::size_t pair = n % pairs.radii.size();
      columns_[overlap][n] = overlaps[pair];
      columns_[radius][n] = pairs.radii[pair];
      columns_[mass][n] = pairs.masses[pair];
      columns_[normal_velocity][n] = pace * pairs.speeds[pair];
      columns_[contact_overlap][n] = columns_[attraction][n] =
          std::numeric_limits<double>::quiet_NaN();
    }
  }
  void evaluate(const sdk::CohesionLaw& law, std::size_t size,
                const TestVariant* variant = nullptr) {
    if (size == 0) size = count_;
    const std::vector<std::vector<double>> inputs(columns_.begin(),
                                                  columns_.begin() + k_first_output);
    std::vector<double*> history(static_cast<std::size_t>(history_));
    for (std::size_t first = 0; first < count_; first += size) {
      sdk::CohesionBatch b;
      b.count = std::min(size, count_ - first);
      b.time_step = time_step_;
      b.overlap = columns_[overlap].data() + first;
      b.effective_radius = columns_[radius].data() + first;
      b.effective_mass = columns_[mass].data() + first;
      b.normal_velocity = columns_[normal_velocity].data() + first;
      b.contact_overlap = columns_[contact_overlap].data() + first;
      b.attraction = columns_[attraction].data() + first;
      for (std::size_t h = 0; h < history.size(); ++h) {
        history[h] = columns_[k_columns + h].data() + first;
      }
      b.history = history.data();
      if (variant != nullptr) {
        call_hot(*variant, [&] { law.evaluate(b); });
      } else {
        law.evaluate(b);
      }
    }
    require(std::equal(inputs.begin(), inputs.end(), columns_.begin()), "it overwrites its inputs");
    for (const auto& column : columns_) {
      require(std::all_of(column.begin() + static_cast<std::ptrdiff_t>(count_), column.end(),
                          [](double v) { return v == k_guard_value; }),
              "it writes beyond the end of a column");
    }
  }
  [[nodiscard]] double at(std::size_t column, std::size_t row) const {
    return columns_[column][row];
  }
  [[nodiscard]] std::size_t count() const { return count_; }

 private:
  static constexpr std::size_t k_guard = 8;
  static constexpr double k_guard_value = -7.25e77;
  std::size_t count_;
  int history_;
  double time_step_ = 0.0;
  std::vector<std::vector<double>> columns_;
};

constexpr double k_radius = 5e-4;
constexpr int k_looks = 25;
constexpr int k_parting = 12;  ///< looks until all are parted; the rest they come back
constexpr int k_beyond = 10;   ///< looks from which on a pair is beyond its range

/// Overlaps at a look: in touch at first, then apart to beyond `range`, then back short of touch.
std::vector<double> overlaps_at(int look, const std::vector<double>& touch, double range) {
  const double share = look <= k_parting ? look / 10.0 : (k_looks - 1 - look + 0.01) / 10.0;
  std::vector<double> overlaps;
  for (const double d : touch) {
    double now = (1.0 - share) * d - share * 1.001 * range;
    if (look > k_parting) now = std::min(now, -0.01 * range);
    overlaps.push_back(now);
  }
  return overlaps;
}

/// How far pairs are pulled apart: the law's range, or a little where it has none.
double pull(const sdk::CohesionLaw& law, double largest) {
  return std::max(law.range(largest), 1e-3 * largest);
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto law = make_law(make, variant.units);
  const Pairs pairs(variant.units);
  CohesionBench bench(pairs.radii.size(), law->history_size());
  Observations observations;
  for (int look = 0; look < k_looks; ++look) {
    bench.show(pairs, overlaps_at(look, pairs.overlaps, pull(*law, pairs.largest)), 1.0);
    bench.evaluate(*law, variant.batch, &variant);
    for (std::size_t n = 0; n < bench.count(); ++n) {
      const std::string row = " of pair " + std::to_string(n);
      observations.push_back(
          {"attraction" + row, bench.at(CohesionBench::attraction, n), sdk::dimension::force});
      observations.push_back({"contact_overlap" + row, bench.at(CohesionBench::contact_overlap, n),
                              sdk::dimension::length});
      for (int h = 0; h < law->history_size(); ++h) {
        const auto column = static_cast<std::size_t>(CohesionBench::k_columns + h);
        observations.push_back(
            {"history_" + std::to_string(h) + row, bench.at(column, n), {}, false});
      }
    }
  }
  for (const double r : pairs.radii) {
    observations.push_back({"range", law->range(r), sdk::dimension::length});
    observations.push_back({"resting_overlap", law->resting_overlap(r), sdk::dimension::length});
  }
  return observations;
}

/// A law that resists motion and nothing else.
bool is_viscous(const sdk::CohesionLaw& law) { return !(law.resting_overlap(k_radius) > 0.0); }

void check_attracts(const Maker& make) {
  const auto law = make_law(make);
  const Pairs pairs(Units{});
  CohesionBench bench(pairs.radii.size(), law->history_size());
  for (int look = 0; look < k_looks; ++look) {
    bench.show(pairs, overlaps_at(look, pairs.overlaps, pull(*law, pairs.largest)), 0.0);
    bench.evaluate(*law, 0);
    for (std::size_t n = 0; n < bench.count(); ++n) {
      const double force = bench.at(CohesionBench::attraction, n);
      require(force >= 0.0,
              "it pushes: the attraction is " + shown(force) + " N; expected: 0 or above");
      if (is_viscous(*law)) {
        require(force == 0.0, "resting_overlap() is 0, and a pair at rest is attracted with " +
                                  shown(force) + " N; expected: 0, or where it rests");
        continue;
      }
      require(look > 0 || force > 0.0, "a pair in touch is not attracted: " + shown(force) +
                                           " N where resting_overlap() is above 0");
      if (look < k_beyond || look > k_looks - k_beyond) continue;
      const bool is_beyond = overlaps_at(look, pairs.overlaps, pull(*law, pairs.largest))[n] <
                             -law->range(pairs.largest);
      require(!is_beyond || (force == 0.0 && bench.at(CohesionBench::contact_overlap, n) <= 0.0),
              "a pair beyond range() still feels " + shown(force) + " N; expected: 0");
    }
  }
}

/// Moving pairs beside resting ones: what motion adds pulls those that part and pushes those that
/// come closer.
void check_resists(const Maker& make) {
  const auto law = make_law(make);
  const Pairs pairs(Units{});
  CohesionBench still(pairs.radii.size(), law->history_size());
  CohesionBench moving(pairs.radii.size(), law->history_size());
  bool resists = false;
  for (int look = 0; look < k_looks; ++look) {
    const auto overlaps = overlaps_at(look, pairs.overlaps, pull(*law, pairs.largest));
    still.show(pairs, overlaps, 0.0);
    still.evaluate(*law, 0);
    moving.show(pairs, overlaps, 1.0);
    moving.evaluate(*law, 0);
    for (std::size_t n = 0; n < still.count(); ++n) {
      const double added =
          moving.at(CohesionBench::attraction, n) - still.at(CohesionBench::attraction, n);
      const double speed = moving.at(CohesionBench::normal_velocity, n);
      require(added * speed >= 0.0, "motion adds " + shown(added) +
                                        " N of attraction to a pair that parts at " + shown(speed) +
                                        " m/s: that drives it");
      require(overlaps[n % overlaps.size()] >= -law->range(pairs.largest) || added == 0.0,
              "a pair beyond range() still resists with " + shown(added) + " N; expected: 0");
      resists = resists || added != 0.0;
    }
  }
  require(resists || !is_viscous(*law),
          "it neither attracts at rest nor resists motion: 0 N for every pair that was shown");
}

void check_range(const Maker& make) {
  const auto law = make_law(make);
  for (double radius = 1e-6; radius < 0.1; radius *= 2.0) {
    const double range = law->range(radius);
    require(std::isfinite(range) && range >= 0.0, "range(" + shown(radius) + " m) is " +
                                                      shown(range) +
                                                      " m; expected: a finite length from 0 on");
    const double farther = law->range(2.0 * radius);
    require(farther >= range, "range() falls as grains grow, from " + shown(range) + " m to " +
                                  shown(farther) + " m at twice the radius of " + shown(radius) +
                                  " m: the core asks for the largest pair alone");
    const double rest = law->resting_overlap(radius);
    require(rest >= 0.0, "resting_overlap(" + shown(radius) + " m) is " + shown(rest) +
                             " m; expected: from 0 on");
  }
}

/// Force on a pair [N], repulsion above 0, with Hertz' contact behind the law.
class Pair {
 public:
  Pair(const sdk::CohesionLaw& law, double radius)
      : law_(law),
        pairs_(radius),
        radius_(radius),
        young_(sdk::effective_young_modulus(material(false, {}), material(true, {}))),
        bench_(1, law.history_size()) {}
  double force(double overlap) {
    bench_.show(pairs_, {overlap}, 0.0);
    bench_.evaluate(law_, 0);
    seen_ = bench_.at(CohesionBench::contact_overlap, 0);
    const double pressed = std::max(seen_, 0.0);
    return 4.0 / 3.0 * young_ * std::sqrt(radius_) * pressed * std::sqrt(pressed) -
           bench_.at(CohesionBench::attraction, 0);
  }
  /// Overlap that the contact law saw at the last call.
  [[nodiscard]] double seen() const { return seen_; }

 private:
  const sdk::CohesionLaw& law_;
  Pairs pairs_;
  double radius_;
  double young_;
  double seen_ = 0.0;
  CohesionBench bench_;
};

void check_rest(const Maker& make) {
  const auto law = make_law(make);
  if (is_viscous(*law)) return;  // "attracts ..." has seen that nothing acts at rest
  Pair pair(*law, k_radius);
  double low = 1e-9 * k_radius;
  double high = 0.3 * k_radius;
  if (!(pair.force(low) < 0.0)) throw Remark("a pair that just touches is not pulled together");
  if (!(pair.force(high) > 0.0)) {
    throw Remark(
        "attraction outweighs the contact up to an overlap of 0.3 R*: choose a weaker one");
  }
  for (int n = 0; n < 60; ++n) {
    const double middle = 0.5 * (low + high);
    (pair.force(middle) < 0.0 ? low : high) = middle;
  }
  const double reported = law->resting_overlap(k_radius);
  // The stiffness there, which sets the time step, goes with the root of the overlap.
  constexpr double k_close = 0.2;
  require(std::abs(reported - pair.seen()) <= k_close * pair.seen(),
          "resting_overlap() says " + shown(reported) + " m; with Hertz contacts a pair rests at " +
              shown(pair.seen()) + " m");
}

void check_energy(const Maker& make) {
  const auto law = make_law(make);
  Pair pair(*law, k_radius);
  // From beyond the range into touch and out again, slowly: what the pair gains on the way in it
  // must at least give back.
  const double far = 1.5 * std::max(law->range(k_radius), 1e-4 * k_radius);
  const double deep = std::max(2.0 * law->resting_overlap(k_radius), 1e-3 * k_radius);
  constexpr int k_steps = 4000;
  const double step = (far + deep) / k_steps;
  double gained = 0.0;
  double largest = 0.0;
  double before = pair.force(-far);
  for (int n = 1; n <= 2 * k_steps; ++n) {
    const bool goes_in = n <= k_steps;
    const double overlap = goes_in ? n * step - far : deep - (n - k_steps) * step;
    const double now = pair.force(overlap);
    gained += (goes_in ? -1.0 : 1.0) * 0.5 * (before + now) * step;
    largest = std::max(largest, std::abs(now));
    before = now;
  }
  // A force that jumps is known to one step of the way, on each way once.
  require(gained <= 4.0 * largest * step,
          "touch and parting leave " + shown(gained) + " J more than there were");
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("attracts in touch, never pushes, ends within its range",
              [&] { check_attracts(make); });
  runner.rule("resists motion, if it heeds it, and never drives it", [&] { check_resists(make); });
  runner.rule("has a range that grows with the grains", [&] { check_range(make); });
  runner.rule("tells where a pair rests as it is", [&] { check_rest(make); });
  runner.rule("creates no energy in touch and parting", [&] { check_energy(make); });
}

}  // namespace

Kind cohesion_kind() {
  return {.observe = observe,
          .batches = {8, 24},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
