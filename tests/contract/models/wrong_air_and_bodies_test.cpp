// SPDX-License-Identifier: Apache-2.0
// One wrong model per rule: what the air and the bodies are told by, and the rolling stage.
#include "contract/models/wrong_models.hpp"
#include "dust/sdk/boundary_condition.hpp"
#include "dust/sdk/contact_law.hpp"
#include "dust/sdk/fluid_force.hpp"
#include "dust/sdk/liberation_law.hpp"
#include "dust/sdk/motion.hpp"
#include "dust/sdk/turbulence_model.hpp"
#include "dust/sdk/voidage_rule.hpp"

#include <cmath>
#include <limits>

using wrong::rule_results_on;
using wrong::Seen;
using namespace dust::sdk;

namespace {

/// A couple against the rotation, or something that is none.
struct Rolling final : RollingLaw {
  enum Fault { none, one_sided, along_x, drives, restless, moves_by_rotation };
  explicit Rolling(Fault f) : fault(f) {}
  void prepare(const MaterialProperties& i, const MaterialProperties& j) override {
    lead = fault == one_sided ? i.density / j.density : 1.0;
  }
  [[nodiscard]] int history_size() const override { return fault == moves_by_rotation ? 1 : 0; }
  void evaluate(const ContactBatch& b) const override {
    for (std::size_t q = 0; q < b.count; ++q) {
      // Small beside what stops a grain within a step.
      const double brake = (fault == drives ? 1e-4 : -1e-4) * lead * b.effective_radius[q] *
                           b.effective_radius[q] * b.effective_mass[q];
      const double size = std::abs(brake) * std::abs(b.angular_velocity.y[q]);
      b.torque.x[q] = brake * b.angular_velocity.x[q] + (fault == along_x ? size : 0.0);
      b.torque.y[q] = brake * b.angular_velocity.y[q];
      b.torque.z[q] = brake * b.angular_velocity.z[q] + (fault == restless ? 1e-12 : 0.0);
      if (fault == drives) b.torque.y[q] *= 1e7;
      if (fault != moves_by_rotation) continue;
      b.history[0][q] += b.time_step * b.angular_velocity.y[q];
      b.torque.y[q] -= 1e-6 * b.history[0][q];
    }
  }
  Fault fault;
  double lead = 1.0;
};

}  // namespace

TEST_CASE("a rolling law that is wrong shall be told by the rule it breaks") {
  Seen seen;
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::none), "brakes").empty());
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::one_sided), "both sides")
            .find("seen from the other side the couple differs") == 0);
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::along_x), "direction")
            .find("in a turned world the couple differs") == 0);
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::drives), "brakes")
            .find("contact 0 is driven when it begins, not braked: ") == 0);
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::restless), "does not rotate") ==
        "contact 0 feels a couple of 1e-12 N m without any rotation; expected: 0");
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::drives), "energy")
            .find("a rolling grain gets faster: ") == 0);
  CHECK(seen.broken(rule_results_on<Rolling>(Rolling::moves_by_rotation), "second order")
            .find("a grain that rocks keeps ") == 0);
  seen.check_complete();
}

namespace {

/// All of a grain in the cell of its centre, or not quite.
struct Centre final : VoidageRule {
  enum Fault { none, loses, next_door };
  explicit Centre(Fault f) : fault(f) {}
  [[nodiscard]] int capacity(const GridShape&, double) const override { return 1; }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 0.5; }
  void spread(const GridShape& grid, const VoidageBatch& b) const override {
    for (std::size_t g = 0; g < b.count; ++g) {
      const auto cell = [&](int d, double at) {
        return static_cast<int>(std::floor((at - grid.origin[d]) / grid.spacing[d]));
      };
      b.used[g] = 1;
      b.cell_i[g] = cell(0, b.position.x[g]) + (fault == next_door ? 2 : 0);
      b.cell_j[g] = cell(1, b.position.y[g]);
      b.cell_k[g] = cell(2, b.position.z[g]);
      b.weight[g] = fault == loses ? 0.75 : 1.0;
    }
  }
  Fault fault;
};

}  // namespace

TEST_CASE("a rule of voidage that is wrong shall be told by the rule it breaks") {
  Seen seen;
  CHECK(seen.broken(rule_results_on<Centre>(Centre::none), "volume").empty());
  CHECK(seen.broken(rule_results_on<Centre>(Centre::loses), "volume") ==
        "the shares of a grain sum to 1 - 0.25");
  CHECK(seen.broken(rule_results_on<Centre>(Centre::next_door), "volume")
            .find("has a share in a cell beyond reach()") != std::string::npos);
  seen.check_complete();
}

namespace {

struct Side final : BoundaryCondition {
  explicit Side(SideRules r) : asked(r) {}
  [[nodiscard]] SideRules rules() const override { return asked; }
  void evaluate(const SideBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      b.velocity.x[n] = b.velocity.y[n] = b.velocity.z[n] = 1.0;
      if (b.pressure != nullptr) b.pressure[n] = 1.0;
    }
  }
  SideRules asked;
};

}  // namespace

TEST_CASE("a boundary that is wrong shall be told by the rule it breaks") {
  Seen seen;
  const std::string rule = "determines the flow";
  CHECK(seen.broken(rule_results_on<Side>(SideRules{}), rule).empty());
  // Velocity and pressure both given, neither, a pressure's rule for a velocity.
  for (const SideRules rules :
       {SideRules{SideRule::fixed, SideRule::fixed, SideRule::fixed},
        SideRules{SideRule::gradient, SideRule::fixed, SideRule::gradient},
        SideRules{SideRule::pressure, SideRule::fixed, SideRule::gradient}}) {
    CHECK(
        seen.broken(rule_results_on<Side>(rules), rule).find("normal velocity and pressure must") ==
        0);
  }
  CHECK(seen.broken(rule_results_on<Side>(
                        SideRules{SideRule::fixed, SideRule::periodic, SideRule::gradient}),
                    rule)
            .find("the tangential velocity must") == 0);
  seen.check_complete();
}

namespace {

/// Goes along x with 1 m/s, or says so.
struct Slide final : Motion {
  enum Fault { none, elsewhere, faster, surface_faster, stands };
  explicit Slide(Fault f) : fault(f) {}
  void surface_velocity(const SurfaceBatch& b) const override {
    Motion::surface_velocity(b);
    if (fault == surface_faster) std::fill_n(b.velocity.y, b.count, 3.0);
  }
  [[nodiscard]] double largest_speed() const override { return fault == faster ? 0.5 : 1.0; }
  [[nodiscard]] bool moves_body() const override { return fault != stands; }
  [[nodiscard]] RigidPose pose(double time) const override {
    RigidPose p;
    p.shift.x = fault == elsewhere ? 1.1 * time : time;
    p.velocity.x = 1.0;
    return p;
  }
  Fault fault;
};

}  // namespace

TEST_CASE("a motion that is wrong shall be told by the rule it breaks") {
  Seen seen;
  CHECK(seen.broken(rule_results_on<Slide>(Slide::none), "velocity takes it").empty());
  CHECK(seen.broken(rule_results_on<Slide>(Slide::elsewhere), "velocity takes it")
            .find("in 1000 of 1000 short times the body goes elsewhere") == 0);
  CHECK(seen.broken(rule_results_on<Slide>(Slide::stands), "velocity takes it")
            .find("its pose changes with time and moves_body() says that it does not") == 0);
  CHECK(seen.broken(rule_results_on<Slide>(Slide::faster), "largest speed")
            .find("the body is faster at 0 s than the largest speed told") == 0);
  CHECK(seen.broken(rule_results_on<Slide>(Slide::surface_faster), "largest speed") ==
        "3 m/s at 0 s, told are 1 m/s");
  seen.check_complete();
}

namespace {

/// A push along the slip, or something that is none.
struct Push final : FluidForce {
  enum Fault { none, always, along_x, negative_mass, far_resistance, twice, nowhere };
  explicit Push(Fault f) : fault(f) {}
  void evaluate(const FluidForceBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      const double k = b.viscosity[n] * b.diameter[n];
      Vec3 force = k * b.slip[n];
      if (fault == always) force.z += k;
      if (fault == along_x) force = {norm(force), 0.0, 0.0};
      b.force.set(n, force);
      b.added_mass[n] = fault == negative_mass ? -b.mass[n] : 0.0;
      b.resistance[n] = fault == far_resistance ? k : 0.0;
    }
  }
  [[nodiscard]] FluidForceParts takes_over() const override {
    return {.pressure_gradient = fault == twice};
  }
  [[nodiscard]] FluidForceReaction reaction() const override {
    return fault == nowhere ? FluidForceReaction::momentum_set : FluidForceReaction::fluid;
  }
  Fault fault;
};

}  // namespace

TEST_CASE("a force of the fluid that is wrong shall be told by the rule it breaks") {
  Seen seen;
  for (const auto& result : rule_results_on<Push>(Push::none)) {
    INFO(result.rule);
    CHECK_MESSAGE(result.verdict != wrong::Verdict::fail, result.why);
  }
  CHECK(seen.broken(rule_results_on<Push>(Push::always), "uniform stream").find(" N on grain 0") !=
        std::string::npos);
  CHECK(seen.broken(rule_results_on<Push>(Push::along_x), "turns with the frame")
            .find("the force on grain 0 differs when the axes are exchanged") == 0);
  CHECK(seen.broken(rule_results_on<Push>(Push::negative_mass), "negative added mass")
            .find("added mass -") == 0);
  CHECK(seen.broken(rule_results_on<Push>(Push::far_resistance), "negative added mass")
            .find("kg/s where no wall is near") != std::string::npos);
  CHECK(seen.broken(rule_results_on<Push>(Push::twice), "takes over") ==
        "takes_over() names a part and reaction() is not momentum_set: the fluid would get it a "
        "second time");
  CHECK(seen.broken(rule_results_on<Push>(Push::nowhere), "takes over") ==
        "reaction() is momentum_set and takes_over() names no part: no part of the fluid's "
        "equation holds it");
  seen.check_complete();
}

namespace {

struct Eddies final : TurbulenceModel {
  enum Fault { negative, always, of_all_sizes };
  explicit Eddies(Fault f) : fault(f) {}
  void evaluate(const TurbulenceBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) {
      const double d = b.wall_distance[n];
      const double size = b.density[n] * d * d * b.strain_rate[n];
      b.eddy_viscosity[n] = fault == negative ? -size : size + (fault == always ? 1.0 : 0.0);
    }
  }
  Fault fault;
};

}  // namespace

TEST_CASE("a turbulence model that is wrong shall be told by the rule it breaks") {
  Seen seen;
  CHECK(seen.broken(rule_results_on<Eddies>(Eddies::of_all_sizes), "no negative").empty());
  CHECK(seen.broken(rule_results_on<Eddies>(Eddies::negative), "no negative").find("-") == 0);
  CHECK(seen.broken(rule_results_on<Eddies>(Eddies::always), "no negative") ==
        "1 Pa s without any shear; expected: 0");
  CHECK(seen.remarked(rule_results_on<Eddies>(Eddies::of_all_sizes), "cells become small")
            .find("cells 10,000 times smaller still have ") == 0);
  seen.check_complete();
}

namespace {

/// A share of the load by the energy, or something that is none.
struct Liberation final : LiberationLaw {
  enum Fault {
    none,
    too_much,
    too_much_by_rounding,
    negative,
    from_nothing,
    less_from_more,
    hides_moisture,
    bound_by_dryness,
    by_step,
    hides_wind,
    idle
  };
  explicit Liberation(Fault f) : fault(f) {}
  void prepare(const DustProperties&) override {}
  [[nodiscard]] bool uses_moisture() const override { return fault == bound_by_dryness; }
  void in_contacts(const GrainImpacts& b) const override {
    const DustyGrains& g = b.grains;
    for (std::size_t q = 0; q < g.count; ++q) {
      double x = 1e3 * (b.normal_energy[q] + b.tangential_energy[q]);
      if (fault == less_from_more) x = x > 1.0 ? 0.1 : x;
      if (fault == hides_moisture) x /= 1.0 + g.moisture[q];
      if (fault == bound_by_dryness) x *= 1.0 + g.moisture[q];
      if (fault == from_nothing) x += 1e-9;
      double share = fault == by_step ? x / (1.0 + x) : -std::expm1(-x);
      if (fault == too_much) share *= 1.5;
      if (fault == too_much_by_rounding && x > 1.0) share = 1.0 + 1e-15;
      if (fault == negative) share = -share;
      if (fault == idle) share = 0.0;
      for (std::size_t k = 0; k < g.classes; ++k) {
        g.released[k * g.stride + q] = share * g.load[k * g.stride + q];
      }
    }
  }
  void in_wind(const GrainWind& b) const override {
    const DustyGrains& g = b.grains;
    for (std::size_t k = 0; k < g.classes; ++k) {
      for (std::size_t q = 0; q < g.count; ++q) {
        const double share = fault == hides_wind && b.shear[q] > 0.0 ? 0.01 : 0.0;
        g.released[k * g.stride + q] = share * g.load[k * g.stride + q];
      }
    }
  }
  Fault fault;
};

}  // namespace

TEST_CASE("a liberation law that is wrong shall be told by the rule it breaks") {
  using L = Liberation;
  Seen seen;
  for (const auto& result : rule_results_on<L>(L::none)) {
    INFO(result.rule);
    // It knows no units: 1000 per joule.
    if (result.rule.find("homogeneous") != std::string::npos) continue;
    CHECK_MESSAGE(result.verdict != wrong::Verdict::fail, result.why);
  }
  CHECK(seen.broken(rule_results_on<L>(L::too_much), "no more than there is").find(" kg of ") !=
        std::string::npos);
  CHECK(Seen().broken(rule_results_on<L>(L::too_much_by_rounding), "no more than").empty());
  CHECK(seen.broken(rule_results_on<L>(L::negative), "nothing negative").find("-") == 0);
  CHECK(seen.broken(rule_results_on<L>(L::from_nothing), "nothing has happened")
            .find("that nothing has touched") != std::string::npos);
  CHECK(seen.broken(rule_results_on<L>(L::less_from_more), "more has happened")
            .find("where less has happened") != std::string::npos);
  CHECK(seen.broken(rule_results_on<L>(L::hides_moisture), "moisture") ==
        "it reads the moisture and says that it does not: uses_moisture()");
  CHECK(seen.broken(rule_results_on<L>(L::bound_by_dryness), "moisture")
            .find("of the same grain that is drier") != std::string::npos);
  CHECK(seen.remarked(rule_results_on<L>(L::by_step), "two halves")
            .find("an impact in two halves sets free ") == 0);
  CHECK(seen.broken(rule_results_on<L>(L::hides_wind), "asked for all")
            .find("it sets dust free in wind and needs_wind() says that it does not") == 0);
  CHECK(seen.broken(rule_results_on<L>(L::idle), "something free") ==
        "nothing comes off in the strongest impact or wind");
  seen.check_complete();
}
