// SPDX-License-Identifier: Apache-2.0
// Rules of boundaries: a combination the solver can use, values where it wants them.
#include "contract/as_kind.hpp"
#include "contract/rule_runner.hpp"
#include "dust/sdk/boundary_condition.hpp"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <string>
#include <vector>

namespace dust::contract {
namespace {

using sdk::SideRule;

/// Points on a side of a cube, and times, in SI.
constexpr std::size_t k_points = 24;
constexpr double k_edge = 0.3;  ///< [m]
const double k_times[] = {0.0, 0.013, 0.5};

/// A layer of cells with grains next to the side.
class Flow {
 public:
  explicit Flow(const Units& units) {
    const double face = k_edge * units.length / k_points;
    for (std::size_t n = 0; n < k_points; ++n) {
      void_fraction_.push_back(1.0 - 0.02 * static_cast<double>(n));
      density_.push_back((1.2 + 0.01 * static_cast<double>(n)) * units.of(sdk::dimension::density));
      area_.push_back(n % 5 == 0 ? 0.0 : face * face);  // some faces are covered by a body
    }
  }
  void show(sdk::SideBatch& batch) const {
    batch.void_fraction = void_fraction_.data();
    batch.density = density_.data();
    batch.area = area_.data();
  }

 private:
  std::vector<double> void_fraction_, density_, area_;
};

/// A side of the cube and what a condition writes there.
class SidePoints {
 public:
  SidePoints(int side, const Units& units) : side_(side), edge_(k_edge * units.length) {
    for (auto& column : out_) column.assign(k_points + 1, k_unset);
    for (int d = 0; d < 3; ++d) {
      for (std::size_t n = 0; n < k_points; ++n) {
        const double along = d == axis() ? (side % 2 == 0 ? 0.0 : k_edge)
                                         : k_edge * (static_cast<double>(n) + 0.5) / k_points;
        at_[d].push_back(along * units.length);
      }
    }
  }
  [[nodiscard]] int axis() const { return side_ / 2; }
  [[nodiscard]] double written(int column, std::size_t n) const { return out_[column][n]; }
  [[nodiscard]] bool has_overrun(int column) const { return !std::isnan(out_[column].back()); }
  sdk::SideBatch batch(std::size_t first, std::size_t size, double time) {
    sdk::SideBatch b;
    b.count = std::min(size, k_points - first);
    b.time = time;
    b.normal[axis()] = side_ % 2 == 0 ? -1.0 : 1.0;
    b.position.x = at_[0].data() + first;
    b.position.y = at_[1].data() + first;
    b.position.z = at_[2].data() + first;
    b.velocity.x = out_[0].data() + first;
    b.velocity.y = out_[1].data() + first;
    b.velocity.z = out_[2].data() + first;
    b.pressure = out_[3].data() + first;
    b.high = {edge_, edge_, edge_};
    b.spacing = (1.0 / k_points) * b.high;
    (side_ % 2 == 0 ? b.high : b.low)[axis()] = (side_ % 2 == 0 ? b.low : b.high)[axis()];
    return b;
  }

 private:
  static constexpr double k_unset = std::numeric_limits<double>::quiet_NaN();
  int side_;
  double edge_;
  std::vector<double> at_[3];
  std::vector<double> out_[4];  ///< velocity, pressure; one more as a guard
};

/// What the rules of the condition ask for.
bool is_wanted(const sdk::SideRules& asked, int column, int axis) {
  if (column == 3) return asked.pressure == SideRule::fixed || asked.pressure == SideRule::pressure;
  return (column == axis ? asked.normal_velocity : asked.tangential_velocity) == SideRule::fixed;
}

void observe_side(const sdk::BoundaryCondition& condition, const TestVariant& variant, int side,
                  double time, Observations& observations) {
  SidePoints points(side, variant.units);
  const Flow flow(variant.units);
  // What reads the flow sums over the side: it is shown in one piece.
  const bool is_whole = variant.batch == 0 || condition.needs_flow();
  const std::size_t size = is_whole ? k_points : variant.batch;
  for (std::size_t first = 0; first < k_points; first += size) {
    sdk::SideBatch batch = points.batch(first, size, time * variant.units.time);
    if (condition.needs_flow()) flow.show(batch);
    call_hot(variant, [&] { condition.evaluate(batch); });
  }
  const std::string where = " on side " + std::to_string(side) + " at " + shown(time) + " s";
  for (int c = 0; c < 4; ++c) {
    require(!points.has_overrun(c), "it writes beyond the end of the batch");
    if (!is_wanted(condition.rules(), c, points.axis())) continue;
    for (std::size_t n = 0; n < k_points; ++n) {
      const std::string name = c == 3 ? "pressure" : std::string("velocity_") + "xyz"[c];
      observations.push_back({name + where, points.written(c, n),
                              c == 3 ? sdk::dimension::pressure : sdk::dimension::velocity});
    }
  }
}

Observations observe(const Maker& make, const TestVariant& variant) {
  const auto condition = make_as<sdk::BoundaryCondition>(make, variant.units);
  const sdk::SideRules asked = condition->rules();
  Observations observations;
  observations.push_back({"rule normal_velocity", static_cast<double>(asked.normal_velocity), {}});
  observations.push_back({"rule pressure", static_cast<double>(asked.pressure), {}});
  observations.push_back({"rule tangential", static_cast<double>(asked.tangential_velocity), {}});
  for (int side = 0; side < 6; ++side) {
    for (const double time : k_times) observe_side(*condition, variant, side, time, observations);
  }
  return observations;
}

std::string text_of(SideRule rule) {
  const char* const texts[] = {"fixed", "gradient", "pressure", "periodic"};
  const auto n = static_cast<std::size_t>(rule);
  return n < std::size(texts) ? texts[n] : "no SideRule, " + std::to_string(n);
}

void rules(const Maker& make, const ModelUnderTest&, RuleRunner& runner) {
  runner.rule("asks for a combination that determines the flow", [&] {
    const sdk::SideRules r = make_as<sdk::BoundaryCondition>(make)->rules();
    require(r.tangential_velocity == SideRule::fixed || r.tangential_velocity == SideRule::gradient,
            "the tangential velocity must be fixed or have zero gradient; rules() answers " +
                text_of(r.tangential_velocity));
    require(sdk::can_be_solved(r),
            "normal velocity and pressure must be fixed and gradient (walls, inlets), or gradient "
            "and fixed or total pressure (open sides); rules() answers " +
                text_of(r.normal_velocity) + " and " + text_of(r.pressure));
  });
}

}  // namespace

Kind boundary_kind() {
  return {.observe = observe,
          .batches = {1, 5},
          .other_units = {4.0, 2.0, 0.5},
          .is_hot = true,
          .rules = rules};
}

}  // namespace dust::contract
