// SPDX-License-Identifier: Apache-2.0
// A rule that no model can break is none: one wrong model per rule, and what is said of it.
#include "contract/models/wrong_models.hpp"
#include "contact/batch.hpp"
#include "dust/sdk/cohesion_law.hpp"
#include "dust/sdk/plugin.hpp"
#include "dust/sdk/sphere.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <vector>

using namespace dust;
using wrong::described;
using wrong::rule_results_of;
using wrong::Seen;
using wrong::Verdict;

namespace {

using Evaluate = std::function<void(const sdk::DragBatch&, double)>;

struct Drag final : sdk::DragLaw {
  Drag(Evaluate e, double p) : evaluate_(std::move(e)), parameter(p) {}
  void evaluate(const sdk::DragBatch& batch) const override { evaluate_(batch, parameter); }
  Evaluate evaluate_;
  double parameter;
};

/// A drag law with one parameter, a length.
std::vector<contract::RuleResult> drag(const Evaluate& evaluate) {
  struct P {
    double size = 0.0;
  };
  sdk::SchemaOf<P> s;
  s.number(&P::size, "size", sdk::dimension::length, "A size.").above(0);
  return rule_results_of(described("drag", s.build()),
                         [evaluate](std::span<const sdk::Value> values) {
                           return std::make_unique<Drag>(evaluate, std::get<double>(values[0]));
                         });
}

void each(const sdk::DragBatch& b, const std::function<double(std::size_t)>& factor) {
  for (std::size_t n = 0; n < b.count; ++n) b.factor[n] = factor(n);
}

}  // namespace

TEST_CASE("a drag law that is wrong shall be told by the rule it breaks") {
  Seen seen;
  CHECK(seen.broken(drag([](auto& b, double) { each(b, [](auto) { return 1.0; }); }),
                    "parameter matters") == "no other value changes anything: 'size'");
  CHECK(
      seen.broken(drag([](auto& b, double p) { each(b, [&](auto) { return p; }); }), "homogeneous")
          .find("4.0") != std::string::npos);
  CHECK(seen.broken(drag([](auto& b, double) {
                      each(b, [&](auto n) { return n == 2 ? std::nan("") : 1.0; });
                    }),
                    "finite") ==
        "factor at Re 0.01, void fraction 0.3 is nan: not finite, or is not written; expected: a "
        "finite number");
  CHECK(seen.broken(drag([](auto& b, double) {
                      each(b, [&](auto n) { return static_cast<double>(n); });
                    }),
                    "split")
            .find("in batches of 1") != std::string::npos);
  CHECK(seen.broken(drag([](auto& b, double) { b.factor[b.count] = 1.0; }), "finite") ==
        "it writes beyond the end of the batch");
  CHECK(seen.broken(drag([](auto& b, double) { const_cast<double*>(b.reynolds)[0] = 1.0; }),
                    "finite") == "it overwrites its input");
  CHECK(seen.broken(drag([](auto& b, double) { each(b, [](auto) { return -1.0; }); }),
                    "negative") == "F = -1 at Re 0, void fraction 0.3; expected: from 0 on");
  CHECK(seen.broken(drag([](auto& b, double) {
                      each(b, [&](auto n) { return 1.0 / (1.0 + b.reynolds[n] * b.reynolds[n]); });
                    }),
                    "negative")
            .find("the force falls between Re 1 and 33") != std::string::npos);
  // A coefficient of form drag alone, Re F ~ Re^2: never negative, growing, and nothing at rest.
  CHECK(seen.broken(drag([](auto& b, double) { each(b, [&](auto n) { return b.reynolds[n]; }); }),
                    "without slip") ==
        "F = 0 at Re 0, void fraction 0.3: a slow grain has a drag; "
        "give the law its creeping limit");
  CHECK(seen.broken(drag([](auto& b, double) {
                      const std::vector<double> copy(b.count, 1.0);
                      each(b, [&](auto n) { return copy[n]; });
                    }),
                    "allocate") == "it allocates 1 times in one call");
  CHECK(seen.broken(drag([](auto&, double) { throw sdk::ModelError("too dense"); }), "finite") ==
        "it throws: too dense");
  static double memory = 1.0;
  CHECK(seen.broken(drag([](auto& b, double) { each(b, [](auto) { return memory *= 1.1; }); }),
                    "asked again")
            .find("differs between two models") != std::string::npos);
  CHECK(seen.remarked(drag([](auto& b, double) { each(b, [](auto) { return 2.0; }); }), "Stokes") ==
        "F = 2: meant for crowds only? Its limits should say so");
  sdk::ModelInfo silent = described("drag");
  silent.source.clear();
  CHECK(seen.broken(rule_results_of(std::move(silent),
                                    [](std::span<const sdk::Value>) {
                                      return std::make_unique<Drag>([](auto&, double) {}, 0.0);
                                    }),
                    "says what it is") == "it has no source: author, year, or \"own definition\"");
  struct P {
    double size = 0.0;
  };
  const auto declared = [](const std::function<void(sdk::SchemaOf<P>&)>& limit) {
    sdk::SchemaOf<P> s;
    s.number(&P::size, "size", sdk::dimension::length, "A size.").optional();
    limit(s);
    return rule_results_of(described("drag", s.build()), [](std::span<const sdk::Value>) {
      return std::make_unique<Drag>([](auto& b, double) { each(b, [](auto) { return 1.0; }); },
                                    0.0);
    });
  };
  CHECK(seen.broken(declared([](auto& s) { s.at_least(2).at_most(1); }), "says what it is") ==
        "the parameter 'size' can have no value: at least 2 and at most 1");
  CHECK(seen.broken(declared([](auto& s) { s.above(0); }), "says what it is") ==
        "the default of parameter 'size', 0, is outside its own range: above 0 and at most inf");
  CHECK(seen.broken(declared([](auto& s) { s.at_least(0).usual(-1, 2); }), "says what it is") ==
        "what is usual of parameter 'size', -1, is outside its range: at least 0 and at most inf");
  seen.check_complete(true);
}

namespace {

/// A linear spring with one fault.
struct Spring final : sdk::ContactLaw {
  struct P {
    double stiffness = 0.0;
    double restitution = 0.0;
  };
  enum Fault {
    none,
    one_sided,
    along_x,
    bouncy,
    slow_times,
    short_times,
    sticky_sliding,
    tells_stiffness_wrong,
    moves_by_velocity,
    moves_by_displacement,
    stiff_unloading,         ///< its times are those of the whole collision
    covers_stiff_unloading,  ///< those of the stiffer spring
    hides_stiff_unloading    ///< half_period is that of loading
  };
  Spring(P parameters, Fault f) : p(parameters), fault(f) {}
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    lead = i.density / j.density;
  }
  [[nodiscard]] bool has_spring() const {
    return fault == moves_by_velocity || fault == moves_by_displacement;
  }
  /// Loaded by k, unloaded by k / e^2: Walton and Braun 1986.
  [[nodiscard]] bool is_plastic() const { return fault >= stiff_unloading; }
  [[nodiscard]] double stiffest() const {
    return p.stiffness / (is_plastic() ? p.restitution * p.restitution : 1.0);
  }
  [[nodiscard]] double plastic_force(const sdk::ContactBatch& b, std::size_t q) const {
    double& deepest = b.history[0][q];
    deepest = std::max({deepest, b.overlap[q], 0.0});
    const double rest = deepest * (1.0 - p.stiffness / stiffest());
    return std::max(0.0, std::min(p.stiffness * b.overlap[q], stiffest() * (b.overlap[q] - rest)));
  }
  [[nodiscard]] int history_size() const override { return has_spring() || is_plastic() ? 1 : 0; }
  /// Along y alone, as the contract's collisions are.
  double spring(const sdk::ContactBatch& b, std::size_t q) const {
    const double way =
        fault == moves_by_velocity ? b.time_step * b.velocity.y[q] : b.displacement.y[q];
    b.history[0][q] += way;
    return -0.8 * p.stiffness * b.history[0][q];
  }
  void evaluate(const sdk::ContactBatch& b) const override {
    for (std::size_t q = 0; q < b.count; ++q) {
      const double vn = b.velocity.x[q] * b.normal.x[q] + b.velocity.y[q] * b.normal.y[q] +
                        b.velocity.z[q] * b.normal.z[q];
      const double log_e = std::log(p.restitution);
      const double zeta = -log_e / std::sqrt(9.869604401089358 + log_e * log_e);
      double f = p.stiffness * b.overlap[q] -
                 2.0 * zeta * std::sqrt(b.effective_mass[q] * p.stiffness) * vn;
      if (is_plastic()) f = plastic_force(b, q);
      if (fault == one_sided) f *= lead;
      if (fault == bouncy && vn > 0.0) f *= 1.5;
      b.normal_force[q] = f;
      b.normal_stiffness[q] = (fault == tells_stiffness_wrong ? 2.0 : 1.0) * p.stiffness;
      if (is_plastic() && b.overlap[q] > 0.0) b.normal_stiffness[q] = f / b.overlap[q];
      b.tangential_stiffness[q] = p.stiffness;
      b.force.x[q] = f * b.normal.x[q] + (fault == along_x ? 0.01 * f : 0.0);
      b.force.y[q] = f * b.normal.y[q];
      b.force.z[q] = f * b.normal.z[q];
      if (has_spring()) b.force.y[q] += spring(b, q);
      if (fault == sticky_sliding) b.force.y[q] += 5.0 * f * (b.velocity.y[q] > 0.0 ? 1.0 : -1.0);
    }
  }
  [[nodiscard]] double swing(double mass, double k) const {
    return 3.141592653589793 * std::sqrt(mass / k);
  }
  [[nodiscard]] double collision_time(double, double mass, double) const override {
    const double whole = 0.5 * swing(mass, p.stiffness) * (1.0 + p.restitution);
    if (fault == covers_stiff_unloading) return std::min(whole, 2.0 * swing(mass, stiffest()));
    if (is_plastic()) return whole;
    return swing(mass, p.stiffness) * time_factor();
  }
  [[nodiscard]] double half_period(double, double mass, double) const override {
    if (fault == hides_stiff_unloading) return swing(mass, p.stiffness);
    return swing(mass, stiffest()) * time_factor();
  }
  [[nodiscard]] double time_factor() const {
    return fault == slow_times ? 3.0 : fault == short_times ? 0.1 : 1.0;
  }
  P p;
  Fault fault;
  double lead = 1.0;
};

std::vector<contract::RuleResult> spring(Spring::Fault fault, double restitution = 0.0) {
  sdk::SchemaOf<Spring::P> s;
  s.number(&Spring::P::stiffness, "stiffness", sdk::dimension::stiffness, "Stiffness.").above(0);
  s.number(&Spring::P::restitution, "restitution", sdk::dimension::none, "Restitution.")
      .above(0)
      .at_most(1);
  return rule_results_of(
      described("contact", s.build()),
      [fault, schema = s.build()](std::span<const sdk::Value> v) {
        return std::make_unique<Spring>(sdk::parameters_from<Spring::P>(schema, v), fault);
      },
      restitution > 0.0 ? std::map<std::string, sdk::Value>{{"restitution", restitution}}
                        : std::map<std::string, sdk::Value>{});
}

}  // namespace

TEST_CASE("a contact law that is wrong shall be told by the rule it breaks") {
  Seen seen;
  for (const auto& result : spring(Spring::none)) {
    // History is out of reach of a law that has none; its spring is told as it is.
    INFO(result.rule);
    CHECK_MESSAGE(result.verdict != Verdict::fail, result.why);
  }
  CHECK(seen.broken(spring(Spring::one_sided), "both sides").find("seen from the other side") == 0);
  CHECK(seen.broken(spring(Spring::along_x), "direction").find("in a turned world") == 0);
  CHECK(seen.broken(spring(Spring::bouncy), "restitution").find("realised") != std::string::npos);
  CHECK(seen.broken(spring(Spring::slow_times), "times").find("collision_time says") !=
        std::string::npos);
  CHECK(seen.broken(spring(Spring::short_times), "times").find("collision_time says") !=
        std::string::npos);
  CHECK(seen.broken(spring(Spring::sticky_sliding), "energy").find("of its energy") !=
        std::string::npos);
  CHECK(
      seen.broken(spring(Spring::tells_stiffness_wrong), "stiffness").find("normal_stiffness is") ==
      0);
  CHECK(seen.broken(spring(Spring::moves_by_velocity), "second order").find("the energy along") !=
        std::string::npos);
  CHECK(Seen().broken(spring(Spring::moves_by_displacement), "second order").empty());
  seen.check_complete();
}

TEST_CASE("a law stiffer in unloading shall be judged by its stiffest spring") {
  // At restitution 0.07 unloading is 204 times as stiff and lasts a fourteenth.
  const std::string hard = Seen().broken(spring(Spring::stiff_unloading, 0.07), "times");
  INFO(hard);
  CHECK(hard.find("unloading is 204.1 times as stiff as loading") == 0);
  CHECK(hard.find("give a collision_time that covers unloading") != std::string::npos);
  // At 0.15 its steps are few, and at 0.8 enough.
  const std::string few = Seen().remarked(spring(Spring::stiff_unloading, 0.15), "times");
  CHECK(few.find("unloading is 44.4") == 0);
  CHECK(Seen().remarked(spring(Spring::stiff_unloading, 0.8), "times").empty());
  for (const double restitution : {0.07, 0.15, 0.8}) {
    CAPTURE(restitution);
    for (const auto& result : spring(Spring::covers_stiff_unloading, restitution)) {
      INFO(result.rule);
      CHECK_MESSAGE(result.verdict != Verdict::fail, result.why);
      CHECK(result.why.find("shorter than they need be") == std::string::npos);
      CHECK(result.why.find("displacement") == std::string::npos);
    }
  }
  CHECK(Seen().broken(spring(Spring::hides_stiff_unloading, 0.5), "times").find("half_period") ==
        0);
}

namespace {

/// Attraction 2 pi gamma R* in touch, or something that is none.
struct Sticky final : sdk::CohesionLaw {
  enum Fault {
    none,
    pushes,
    reaches_far,
    rests_elsewhere,
    winds_up,
    shrinks,
    drives,
    resists_far,
    does_nothing,
    sticks_unsaid
  };
  Fault fault;
  double young = 1.0;
  int columns = 1;
  explicit Sticky(Fault f, int c = 1) : fault(f), columns(c) {}
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties& j) override {
    young = sdk::effective_young_modulus(i, j);
  }
  [[nodiscard]] int history_size() const override { return columns; }
  [[nodiscard]] static double strength(double radius) { return 0.3 * radius; }
  void evaluate(const sdk::CohesionBatch& b) const override {
    for (std::size_t q = 0; q < b.count; ++q) {
      b.contact_overlap[q] = b.overlap[q];
      double f = b.overlap[q] > 0.0 ? strength(b.effective_radius[q]) : 0.0;
      if (fault == pushes) f = -f;
      if (fault == reaches_far) f = strength(b.effective_radius[q]);
      // Pulls hard while the grains come closer, and hardly while they part.
      if (fault == winds_up && b.overlap[q] < b.history[0][q]) f *= 0.5;
      b.history[0][q] = b.overlap[q];
      const double film = 1e-3 * b.normal_velocity[q];
      if (fault == drives && b.overlap[q] > 0.0) f -= film;
      if (fault == resists_far) f += film;
      if (fault == does_nothing) f = 0.0;
      b.attraction[q] = f;
    }
  }
  [[nodiscard]] double range(double radius) const override {
    return fault == shrinks ? 1e-9 / radius : 0.0;
  }
  [[nodiscard]] double resting_overlap(double radius) const override {
    const double d =
        std::cbrt(std::pow(0.75 * strength(radius) / (young * std::sqrt(radius)), 2.0));
    if (fault == does_nothing || fault == sticks_unsaid) return 0.0;
    return fault == rests_elsewhere ? 10.0 * d : d;
  }
};

std::vector<contract::RuleResult> sticky(Sticky::Fault fault, int columns = 1) {
  return rule_results_of(described("cohesion", {}), [=](std::span<const sdk::Value>) {
    return std::make_unique<Sticky>(fault, columns);
  });
}

}  // namespace

TEST_CASE("a law shall keep as many numbers per contact as the core has room for, and no more") {
  constexpr int k_room = contact::k_max_history;
  CHECK(Seen().broken(sticky(Sticky::none, k_room), "finite").empty());
  CHECK(Seen().broken(sticky(Sticky::none, k_room + 1), "finite") ==
        "it keeps " + std::to_string(k_room + 1) + " numbers per contact; expected: 0 to " +
            std::to_string(k_room) + ", which it shares with the other laws of the contact");
}

TEST_CASE("a cohesive law that is wrong shall be told by the rule it breaks") {
  Seen seen;
  for (const auto& result : sticky(Sticky::none)) {
    INFO(result.rule);
    // Its strength per radius, 0.3 N/m, is a hidden unit.
    if (result.rule.find("homogeneous") != std::string::npos) continue;
    CHECK_MESSAGE(result.verdict != Verdict::fail, result.why);
  }
  CHECK(seen.broken(sticky(Sticky::pushes), "attracts").find("it pushes") == 0);
  CHECK(seen.broken(sticky(Sticky::reaches_far), "attracts").find("beyond range()") !=
        std::string::npos);
  CHECK(seen.broken(sticky(Sticky::rests_elsewhere), "rests").find("resting_overlap() says") == 0);
  CHECK(seen.broken(sticky(Sticky::sticks_unsaid), "attracts").find("resting_overlap() is 0") == 0);
  CHECK(seen.broken(sticky(Sticky::drives), "resists").find("that drives it") != std::string::npos);
  CHECK(seen.broken(sticky(Sticky::resists_far), "resists").find("beyond range()") !=
        std::string::npos);
  CHECK(seen.broken(sticky(Sticky::does_nothing), "resists").find("it neither") == 0);
  CHECK(seen.broken(sticky(Sticky::shrinks), "range that grows").find("range() falls") == 0);
  CHECK(seen.broken(sticky(Sticky::winds_up), "energy").find("more than there were") !=
        std::string::npos);
  seen.check_complete();
}

namespace {

/// Says 1 g/s and gives `share` of it; forgets where it was when it is resumed.
struct Drip final : sdk::Emitter {
  explicit Drip(double s) : share(s) {}
  void propose(const sdk::EmitterContext& context,
               std::vector<sdk::InsertionRequest>& requests) override {
    const double mass = context.grain_density * sdk::sphere_volume(k_diameter);
    for (; (released + 1.0) * mass / (share * k_flow) < context.end; ++released) {
      sdk::InsertionRequest request;
      request.time = (released + 1.0) * mass / (share * k_flow);
      request.velocity = {0.0, 0.0, -1.0};
      request.diameter = k_diameter;
      requests.push_back(request);
    }
  }
  [[nodiscard]] double requested_mass_flow() const override { return k_flow; }
  [[nodiscard]] std::vector<double> diameters() const override { return {k_diameter}; }
  [[nodiscard]] double largest_speed() const override { return 0.5; }
  static constexpr double k_diameter = 1e-3;
  static constexpr double k_flow = 1e-3;
  double share;
  double released = 0.0;
};

}  // namespace

TEST_CASE("an emitter that is wrong shall be told by the rule it breaks") {
  Seen seen;
  const auto results = rule_results_of(described("emitter"), [](std::span<const sdk::Value>) {
    return std::make_unique<Drip>(0.8);
  });
  CHECK(seen.broken(results, "mass").find("kg came in") != std::string::npos);
  CHECK(seen.broken(results, "speeds").find("told are 0.5") != std::string::npos);
  CHECK(seen.broken(results, "homogeneous").find("the number of results") != std::string::npos);
  CHECK(seen.broken(results, "saved and loaded").find("it gives ") != std::string::npos);
  seen.check_complete();
}

namespace {

/// Counts looks, also those at nothing, and forgets them.
struct Counter final : sdk::Sensor {
  void observe(const sdk::WorldView&) override { ++looks; }
  void series(sdk::FigureSink& sink) const override { sink.figure("Looks", looks, "1"); }
  void summary(sdk::FigureSink& sink) const override { sink.figure("looks", looks, "1"); }
  double looks = 0.0;
};

/// Tells the last look for the mean of all since the row before.
struct Last final : sdk::Sensor {
  void observe(const sdk::WorldView&) override { ++looks; }
  void series(sdk::FigureSink& sink) const override { sink.figure("looks", looks, "1"); }
  [[nodiscard]] sdk::RowValue row_value(std::string_view) const override {
    return sdk::RowValue::mean;
  }
  void summary(sdk::FigureSink&) const override {}
  double looks = 0.0;
};

/// Columns of another name with every look.
struct Restless final : sdk::Sensor {
  void observe(const sdk::WorldView&) override { ++looks; }
  void series(sdk::FigureSink& sink) const override {
    sink.figure("looks_" + std::to_string(looks), 0.0, "1");
  }
  void summary(sdk::FigureSink& sink) const override { sink.figure("looks", 0.0, "1"); }
  int looks = 0;
};

/// A table whose rows do not fit its head.
struct Ragged final : sdk::Sensor {
  void observe(const sdk::WorldView&) override {}
  void series(sdk::FigureSink&) const override {}
  void summary(sdk::FigureSink& sink) const override { sink.figure("looks", 0.0, "1"); }
  void report(sdk::ReportSink& sink) const override {
    const std::string columns[] = {"time", "looks"};
    const double values[] = {1.0};
    sink.row("Looks", columns, values);
  }
};

/// Calls a time a mass.
struct Mislabelled final : sdk::Sensor {
  void observe(const sdk::WorldView&) override {}
  void series(sdk::FigureSink&) const override {}
  void summary(sdk::FigureSink& sink) const override {
    sink.figure("fed", 0.0, "s", sdk::Quantity::mass);
  }
};

/// An opening of which nobody knows what it measures.
struct Unspecified final : sdk::Sensor {
  void observe(const sdk::WorldView&) override {}
  void series(sdk::FigureSink&) const override {}
  void summary(sdk::FigureSink& sink) const override {
    sink.figure("out", 0.0, "kg", -1.0,
                {.role = sdk::Role::opening, .direction = sdk::Direction::net});
  }
};

struct Blind final : sdk::Sensor {
  void observe(const sdk::WorldView&) override {}
  void series(sdk::FigureSink&) const override {}
  void summary(sdk::FigureSink&) const override {}
};

}  // namespace

TEST_CASE("a sensor that is wrong shall be told by the rule it breaks") {
  Seen seen;
  const auto results = rule_results_of(
      described("sensor"), [](std::span<const sdk::Value>) { return std::make_unique<Counter>(); });
  CHECK(seen.broken(results, "names") ==
        "'Looks' is not a path of snake_case words: a to z, 0 to 9, _ and /");
  CHECK(seen.broken(results, "zeros") ==
        "'looks' is 90 in an empty domain; expected: 0 of an amount, a rate or a count; of a mean, "
        "a place or a ratio no number, with k_nothing_passed for its error "
        "(Role::observed_time: how long it has looked)");
  CHECK(seen.broken(results, "saved and loaded").find("after 1 samples 'looks' differs") !=
        std::string::npos);
  CHECK(seen.broken(wrong::rule_results_on<Last>(), "between rows") ==
        "'looks' is 9 in a row for every 9 samples; the samples say 5");
  CHECK(seen.broken(wrong::rule_results_on<Blind>(), "sees something")
            .find("its summary is empty after ") == 0);
  CHECK(seen.broken(wrong::rule_results_on<Restless>(), "zeros")
            .find("the columns of its series change in an empty domain after 1 samples: "
                  "'looks_0 [1]', now 'looks_1 [1]'; expected: ") == 0);
  CHECK(seen.broken(wrong::rule_results_on<Ragged>(), "finite numbers") ==
        "the table 'Looks' has a row of 1 numbers under a head of 2 columns; expected: as many");
  CHECK(seen.broken(wrong::rule_results_on<Mislabelled>(), "its figures are") ==
        "'fed' is said to be a mass, which has no unit s");
  CHECK(seen.broken(wrong::rule_results_on<Unspecified>(), "its figures are") ==
        "'out' has the role opening but no quantity");
  seen.check_complete();
}

TEST_CASE("parameters that cannot be guessed shall be asked for, unknown ones refused") {
  struct P {
    std::string file;
  };
  sdk::SchemaOf<P> s;
  s.text(&P::file, "file", "A table.");
  const registry::Entry entry{
      described("drag", s.build()), [](std::span<const sdk::Value>) { return nullptr; }, {}};
  CHECK_THROWS_WITH(
      contract::check_model(entry),
      "error: drag/wrong: no value can be guessed; write --set file=VALUE (A table.)");
  contract::Options options;
  options.given["fiel"] = std::string("x");
  CHECK_THROWS_WITH(contract::check_model(entry, options),
                    "error: drag/wrong: there is no parameter 'fiel'");
}
