// SPDX-License-Identifier: Apache-2.0
// A guarded model answers as the model itself; what it throws, and numbers that are none, are
// said_of with kind, name, file and what was expected.
#include "registry/guard.hpp"

#include "base/error.hpp"
#include "registry/crash_notice.hpp"
#include "registry/guard_report.hpp"
#include "registry/registry.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <csignal>
#include <limits>
#include <memory>
#include <string>
#include <vector>

using namespace dust;

namespace {

constexpr double k_nan = std::numeric_limits<double>::quiet_NaN();
constexpr double k_infinite = std::numeric_limits<double>::infinity();

/// What a trial model does in its hot function.
enum class Deed { well, throws, throws_no_exception, no_number, negative, half, refuses };

/// Does the deed; returns what is to be written.
double deed(Deed what, double good) {
  if (what == Deed::throws) throw std::runtime_error("out of table");
  if (what == Deed::throws_no_exception) throw 42;
  if (what == Deed::refuses) throw sdk::ParameterError("does not fit");
  if (what == Deed::negative) return -good;
  if (what == Deed::half) return 0.5 * good;
  return what == Deed::no_number ? k_nan : good;
}

/// Of a model on which `set` has set something.
template <class Model, class Set>
std::unique_ptr<typename Model::Kind> guard_with(const Set& set) {
  registry::Entry entry;
  entry.info.kind = Model::Kind::k_kind;
  entry.info.name = "trial";
  entry.file = "/x/trial.so";
  auto trial = std::make_unique<Model>(Deed::well);
  set(*trial);
  auto model = registry::guarded(std::move(trial), entry);
  return std::unique_ptr<typename Model::Kind>(static_cast<typename Model::Kind*>(model.release()));
}

template <class Model>
std::unique_ptr<typename Model::Kind> guard(Deed what = Deed::well) {
  return guard_with<Model>([what](Model& model) { model.what = what; });
}

/// What calling says; "" if nothing is thrown.
template <class Call>
std::string said(const Call& call) {
  try {
    call();
  } catch (const sdk::ModelError& problem) {
    return problem.what();
  }
  return "";
}

template <class KindOfModel>
struct Trial : KindOfModel {
  using Kind = KindOfModel;
  explicit Trial(Deed d) : what(d) {}
  Deed what;
};

struct Contact final : Trial<sdk::ContactLaw> {
  using Trial::Trial;
  void prepare(const sdk::MaterialProperties& i, const sdk::MaterialProperties&) override {
    density = deed(what, i.density);
  }
  int history_size() const override { return columns; }
  void evaluate(const sdk::ContactBatch& b) const override {
    for (double* column : {b.normal_force, b.force.x, b.force.y, b.force.z}) {
      for (std::size_t n = 0; n < b.count; ++n) column[n] = density;
    }
    b.force.y[b.count - 1] = deed(what, 2.0);
    if (b.tangential_stiffness != nullptr) b.tangential_stiffness[0] = stiffness;
  }
  double collision_time(double r, double m, double v) const override { return r + 2 * m + 3 * v; }
  double half_period(double r, double m, double d) const override { return r + 4 * m + 5 * d; }
  double range() const override { return 0.25; }
  bool has_hertz_force() const override { return true; }
  double density = 0.0;
  double stiffness = 1.0;
  int columns = 3;
};

struct Rolling final : Trial<sdk::RollingLaw> {
  using Trial::Trial;
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  int history_size() const override { return 4; }
  int couple_column() const override { return couple; }
  void evaluate(const sdk::ContactBatch& b) const override { b.torque.z[0] = deed(what, 1.0); }
  int couple = 1;
};

struct Cohesion final : Trial<sdk::CohesionLaw> {
  using Trial::Trial;
  void prepare(const sdk::MaterialProperties&, const sdk::MaterialProperties&) override {}
  int history_size() const override { return 5; }
  void evaluate(const sdk::CohesionBatch& b) const override { b.attraction[0] = deed(what, 1.0); }
  double range(double r) const override { return 2 * r; }
  double resting_overlap(double r) const override { return 3 * r; }
  bool needs_hertz_force() const override { return true; }
};

struct Drag final : Trial<sdk::DragLaw> {
  using Trial::Trial;
  void evaluate(const sdk::DragBatch& b) const override {
    for (std::size_t n = 0; n < b.count; ++n) b.factor[n] = 1.0;
    b.factor[1] = deed(what, 2.0);
  }
  bool needs_size_ratio() const override { return true; }
};

/// The line that a crash would be reported with here.
std::string crash_line() {
  char room[1000];
  return {room, registry::write_crash_text(SIGSEGV, room)};
}

/// Notes that line where it is asked.
struct NotingDrag final : Trial<sdk::DragLaw> {
  using Trial::Trial;
  void evaluate(const sdk::DragBatch&) const override { *line = crash_line(); }
  std::string* line = nullptr;
};

struct FluidForce final : Trial<sdk::FluidForce> {
  using Trial::Trial;
  void evaluate(const sdk::FluidForceBatch& b) const override { b.force.y[0] = deed(what, 1.0); }
  sdk::FluidForceNeeds needs() const override { return {true, false, true, wall_reach}; }
  sdk::FluidForceParts takes_over() const override { return {false, true, false}; }
  sdk::FluidForceReaction reaction() const override { return sdk::FluidForceReaction::wall; }
  int history_size() const override { return 6; }
  double wall_reach = 1.5;
};

struct Voidage final : Trial<sdk::VoidageRule> {
  using Trial::Trial;
  int capacity(const sdk::GridShape&, double) const override { return cells; }
  double largest_diameter_over_spacing() const override { return 7.0; }
  void spread(const sdk::GridShape&, const sdk::VoidageBatch& b) const override {
    b.weight[0] = deed(what, 1.0);
    b.used[0] = too_many ? 3 : 1;
  }
  sdk::Vec3 reach(const sdk::GridShape&, double r) const override { return {r, 2 * r, 3 * r}; }
  bool too_many = false;
  int cells = 2;
};

struct Boundary final : Trial<sdk::BoundaryCondition> {
  using Trial::Trial;
  sdk::SideRules rules() const override {
    return {sdk::SideRule::fixed, sdk::SideRule::gradient, sdk::SideRule::gradient};
  }
  void evaluate(const sdk::SideBatch& b) const override {
    b.velocity.x[0] = deed(what, 1.0);
    b.velocity.y[0] = k_nan;  // not fixed: nobody reads it
  }
  bool needs_flow() const override { return true; }
};

struct Turbulence final : Trial<sdk::TurbulenceModel> {
  using Trial::Trial;
  void evaluate(const sdk::TurbulenceBatch& b) const override {
    b.eddy_viscosity[0] = deed(what, 1.0);
  }
};

struct Liberation final : Trial<sdk::LiberationLaw> {
  using Trial::Trial;
  void prepare(const sdk::DustProperties&) override {}
  void in_contacts(const sdk::GrainImpacts& b) const override {
    b.grains.released[0] = 0.0;
    b.grains.released[b.grains.stride] = deed(what, 1.0);
  }
  void in_wind(const sdk::GrainWind& b) const override {
    b.grains.released[0] = deed(what, 1.0);
    b.grains.released[b.grains.stride] = 0.0;
  }
  bool needs_wind() const override { return true; }
  bool uses_moisture() const override { return true; }
};

struct Emitter final : Trial<sdk::Emitter> {
  using Trial::Trial;
  void propose(const sdk::EmitterContext&, std::vector<sdk::InsertionRequest>& requests) override {
    sdk::InsertionRequest request;
    request.diameter = deed(what, diameter);
    request.weight = weight;
    request.material = material;
    request.time = time;
    requests.push_back(request);
  }
  double requested_mass_flow() const override { return 1.0; }
  std::vector<double> diameters() const override { return {1e-3}; }
  double largest_speed() const override { return 2.0; }
  sdk::EmitterRequest request() const override {
    sdk::EmitterRequest r;
    r.count = 9;
    return r;
  }
  sdk::InsertionRule insertion_rule() const override { return {false, 0.5}; }
  std::vector<std::string> materials() const override { return {"sand"}; }
  double diameter = 1e-3, weight = 1.0, time = 0.0;
  std::int32_t material = 0;
};

struct Motion final : Trial<sdk::Motion> {
  using Trial::Trial;
  void surface_velocity(const sdk::SurfaceBatch& b) const override {
    b.velocity.z[0] = deed(what, 1.0);
  }
  double largest_speed() const override { return 3.0; }
  bool moves_body() const override { return true; }
  sdk::RigidPose pose(double time) const override {
    sdk::RigidPose p;
    p.angle = deed(what, 2 * time);
    p.axis = axis;
    p.pivot = pivot;
    return p;
  }
  double largest_angular_velocity() const override { return 4.0; }
  sdk::Vec3 axis{0, 0, 1}, pivot{};
};

struct Sensor final : Trial<sdk::Sensor> {
  using Trial::Trial;
  void observe(const sdk::WorldView& world) override { time = deed(what, world.time); }
  bool wants_contacts() const override { return true; }
  bool wants_face_fluxes() const override { return true; }
  void series(sdk::FigureSink& sink) const override { sink.figure("time", time, "s"); }
  void summary(sdk::FigureSink& sink) const override { sink.figure("end", time, "s"); }
  void report(sdk::ReportSink& sink) const override {
    sink.section("Heading", "Text.");
    sink.curve("Curve", "t [s]", "y", "y", std::span(&time, 1), std::span(&time, points));
  }
  void fields(sdk::FieldSink& sink) const override {
    sink.field("one", "1", {}, std::span(&time, 1));
  }
  bool wants_walls() const override { return true; }
  bool wants_sliding() const override { return true; }
  void save(sdk::ArchiveWriter& a) const override { a.number("time", time); }
  void load(sdk::ArchiveReader& a) override { time = a.number("time"); }
  double time = 0.0;
  std::size_t points = 1;
};

/// Remembers the names it is given.
struct Names final : sdk::FigureSink, sdk::ReportSink, sdk::FieldSink {
  void figure(std::string_view name, double, std::string_view, double,
              const sdk::FigureRole&) override {
    text += std::string(name) + " ";
  }
  void section(std::string_view heading, std::string_view) override {
    text += std::string(heading) + " ";
  }
  void curve(std::string_view, std::string_view, std::string_view, std::string_view,
             std::span<const double>, std::span<const double>) override {}
  void row(std::string_view, std::span<const std::string>, std::span<const double>) override {}
  void field(std::string_view name, std::string_view, const sdk::GridShape&,
             std::span<const double>, const sdk::FigureRole&) override {
    text += std::string(name) + " ";
  }
  std::string text;
};

/// One number, as an archive.
struct OneNumber final : sdk::ArchiveWriter, sdk::ArchiveReader {
  void numbers(std::string_view, std::span<const double> values) override { kept = values[0]; }
  void integers(std::string_view, std::span<const std::int64_t>) override {}
  std::vector<double> numbers(std::string_view) override { return {kept}; }
  std::vector<std::int64_t> integers(std::string_view) override { return {}; }
  double kept = 0.0;
};

/// Columns for a batch of two.
struct Columns {
  double a[2] = {1.5, 2.5}, b[2] = {3.0, 4.0};
  double out[6][2] = {};
};

const sdk::MaterialProperties k_material{2500.0, 1e7, 0.3};

}  // namespace

TEST_CASE("guarded pair laws shall answer as themselves and be said_of from their faults") {
  Columns c;
  sdk::ContactBatch batch;
  batch.count = 2;
  batch.overlap = c.a;
  batch.effective_mass = c.b;
  batch.normal_force = c.out[0];
  batch.force.x = c.out[1];
  batch.force.y = c.out[2];
  batch.force.z = c.out[3];
  batch.torque.x = c.out[4];
  batch.torque.y = c.out[5];
  batch.torque.z = c.out[5];
  {
    const auto law = guard<Contact>();
    law->prepare(k_material, k_material);
    law->evaluate(batch);
    CHECK(c.out[1][0] == 2500.0);
    CHECK(c.out[2][1] == 2.0);
    CHECK(law->history_size() == 3);
    CHECK(law->collision_time(1, 1, 1) == 6.0);
    CHECK(law->half_period(1, 1, 1) == 10.0);
    CHECK(law->range() == 0.25);
    CHECK(law->has_hertz_force());
  }
  CHECK(said([&] { guard<Contact>(Deed::no_number)->evaluate(batch); }) ==
        "contact/trial (/x/trial.so) gives force.y = nan in row 2 of 2 of a batch (overlap = 2.5, "
        "effective_mass = 4); expected: a finite number");
  CHECK(said([&] { guard<Contact>(Deed::throws)->evaluate(batch); }) ==
        "contact/trial (/x/trial.so) throws in evaluate: out of table; expected: a force for every "
        "contact of the batch");
  batch.tangential_stiffness = c.out[5];
  CHECK(said([&] { guard<Contact>()->evaluate(batch); }).empty());
  const auto poisoned = guard_with<Contact>([](Contact& law) { law.stiffness = k_infinite; });
  CHECK(
      said([&] { poisoned->evaluate(batch); })
          .starts_with("contact/trial (/x/trial.so) gives tangential_stiffness = inf in row 1 of 2 "
                       "of a batch ("));
  batch.tangential_stiffness = nullptr;
  CHECK_THROWS_AS(guard<Contact>(Deed::refuses)->prepare(k_material, k_material),
                  sdk::ParameterError);
  CHECK(guard<Rolling>()->history_size() == 4);
  CHECK(said([&] { guard<Rolling>()->evaluate(batch); }).empty());
  CHECK(said([&] {
          guard<Rolling>(Deed::no_number)->evaluate(batch);
        }).starts_with("rolling/trial (/x/trial.so) gives torque."));

  sdk::CohesionBatch pairs;
  pairs.count = 1;
  pairs.overlap = c.a;
  pairs.contact_overlap = c.b;
  pairs.attraction = c.out[0];
  const auto cohesion = guard<Cohesion>();
  CHECK(said([&] { cohesion->evaluate(pairs); }).empty());
  CHECK(cohesion->history_size() == 5);
  CHECK(cohesion->range(1.0) == 2.0);
  CHECK(cohesion->resting_overlap(1.0) == 3.0);
  CHECK(cohesion->needs_hertz_force());
  CHECK(said([&] { guard<Cohesion>(Deed::no_number)->evaluate(pairs); }) ==
        "cohesion/trial (/x/trial.so) gives attraction = nan in row 1 of 1 of a batch (overlap = "
        "1.5); expected: a finite number");
}

TEST_CASE("guarded models of the air shall answer as themselves and be said_of from their faults") {
  Columns c;
  const sdk::DragBatch drag{2, c.a, c.b, c.out[0], nullptr};
  CHECK(guard<Drag>()->needs_size_ratio());
  guard<Drag>()->evaluate(drag);
  CHECK(c.out[0][1] == 2.0);
  CHECK(said([&] { guard<Drag>(Deed::no_number)->evaluate(drag); }) ==
        "drag/trial (/x/trial.so) gives factor = nan in row 2 of 2 of a batch (reynolds = 2.5, "
        "void_fraction = 4); expected: a finite number");
  CHECK(said([&] { guard<Drag>(Deed::negative)->evaluate(drag); }) ==
        "drag/trial (/x/trial.so) gives factor = -2 in row 2 of 2 of a batch (reynolds = 2.5, "
        "void_fraction = 4); expected: a number from 0 on");
  CHECK(said([&] { guard<Drag>(Deed::throws_no_exception)->evaluate(drag); }) ==
        "drag/trial (/x/trial.so) throws in evaluate: something that is no std::exception; "
        "expected: a factor for every grain of the batch");

  sdk::FluidForceBatch force;
  force.count = 1;
  force.force = {c.out[1], c.out[2], c.out[3]};
  const auto fluid_force = guard<FluidForce>();
  CHECK(said([&] { fluid_force->evaluate(force); }).empty());
  CHECK(fluid_force->needs().stresses);
  CHECK(fluid_force->needs().wall_reach == 1.5);
  CHECK(fluid_force->takes_over().viscous_stress);
  CHECK(fluid_force->reaction() == sdk::FluidForceReaction::wall);
  CHECK(fluid_force->history_size() == 6);
  CHECK(said([&] { guard<FluidForce>(Deed::no_number)->evaluate(force); }) ==
        "fluid_force/trial (/x/trial.so) gives force.y = nan in row 1 of 1 of a batch; expected: a "
        "finite number");

  sdk::SideBatch side;
  side.count = 1;
  side.normal = {1, 0, 0};
  side.velocity.x = c.out[0];
  side.velocity.y = c.out[1];
  const auto boundary = guard<Boundary>();
  CHECK(said([&] { boundary->evaluate(side); }).empty());
  CHECK(boundary->needs_flow());
  CHECK(boundary->rules().tangential_velocity == sdk::SideRule::gradient);
  CHECK(said([&] { guard<Boundary>(Deed::no_number)->evaluate(side); }) ==
        "boundary/trial (/x/trial.so) gives velocity.x = nan in row 1 of 1 of a batch; expected: a "
        "finite number");

  sdk::TurbulenceBatch cells;
  cells.count = 1;
  cells.strain_rate = c.a;
  cells.eddy_viscosity = c.out[0];
  CHECK(said([&] { guard<Turbulence>()->evaluate(cells); }).empty());
  CHECK(said([&] { guard<Turbulence>(Deed::no_number)->evaluate(cells); }) ==
        "turbulence/trial (/x/trial.so) gives eddy_viscosity = nan in row 1 of 1 of a batch "
        "(strain_rate = 1.5); expected: a finite number");
  CHECK(said([&] { guard<Turbulence>(Deed::negative)->evaluate(cells); }) ==
        "turbulence/trial (/x/trial.so) gives eddy_viscosity = -1 in row 1 of 1 of a batch "
        "(strain_rate = 1.5); expected: a number from 0 on");
}

TEST_CASE("a guarded liberation law shall be passed on and looked after in every class") {
  double energy[] = {0.25}, released[2] = {};
  const sdk::DustyGrains grains{.count = 1, .classes = 2, .stride = 1, .released = released};
  const auto law = guard<Liberation>();
  CHECK(said([&] { law->in_contacts({.grains = grains, .normal_energy = energy}); }).empty());
  CHECK(released[1] == 1.0);
  CHECK(law->needs_wind());
  CHECK(law->uses_moisture());
  const auto bad = guard<Liberation>(Deed::no_number);
  CHECK(said([&] { bad->in_contacts({.grains = grains, .normal_energy = energy}); }) ==
        "liberation/trial (/x/trial.so) gives released = nan in row 1 of 1 of a batch "
        "(normal_energy = 0.25); expected: a finite number");
  CHECK(said([&] { bad->in_wind({.grains = grains, .slip = energy}); }) ==
        "liberation/trial (/x/trial.so) gives released = nan in row 1 of 1 of a batch "
        "(slip = 0.25); expected: a finite number");
}

TEST_CASE("a guarded rule of voidage shall keep within its own capacity") {
  Columns c;
  int used[2] = {};
  sdk::VoidageBatch batch;
  batch.count = 1;
  batch.position.x = c.a;
  batch.capacity = 2;
  batch.used = used;
  batch.weight = c.out[0];
  const auto rule = guard<Voidage>();
  CHECK(said([&] { rule->spread({}, batch); }).empty());
  CHECK(rule->capacity({}, 1.0) == 2);
  CHECK(rule->largest_diameter_over_spacing() == 7.0);
  CHECK(rule->reach({}, 1.0).z == 3.0);
  CHECK(
      said([&] { guard<Voidage>(Deed::no_number)->spread({}, batch); }) ==
      "voidage/trial (/x/trial.so) gives weight = nan in row 1 of 1 of a batch (position.x = 1.5); "
      "expected: a finite number");
  const std::string who = "voidage/trial (/x/trial.so) gives weight";
  const std::string row = " in row 1 of 1 of a batch (position.x = 1.5); expected: ";
  CHECK(said([&] { guard<Voidage>(Deed::negative)->spread({}, batch); }) ==
        who + " = -1" + row + "weights from 0 on");
  CHECK(said([&] { guard<Voidage>(Deed::half)->spread({}, batch); }) ==
        who + "s that sum to 0.5" + row + "1: all of the grain's volume and no more");
  registry::Entry entry;
  entry.info.kind = "voidage";
  entry.info.name = "greedy";
  auto greedy = std::make_unique<Voidage>(Deed::well);
  greedy->too_many = true;
  const auto guarded = registry::guarded(std::move(greedy), entry);
  CHECK(said([&] { static_cast<sdk::VoidageRule&>(*guarded).spread({}, batch); }) ==
        "voidage/greedy () gives used = 3 in row 1 of 1 of a batch (position.x = 1.5); expected: 1 "
        "to 2 "
        "cells, its capacity");
}

TEST_CASE("a guarded emitter, motion and sensor shall answer as themselves") {
  std::vector<sdk::InsertionRequest> requests;
  const auto emitter = guard<Emitter>();
  emitter->propose({}, requests);
  CHECK(requests.size() == 1);
  CHECK(emitter->requested_mass_flow() == 1.0);
  CHECK(emitter->diameters() == std::vector<double>{1e-3});
  CHECK(emitter->largest_speed() == 2.0);
  CHECK(emitter->request().count == 9);
  CHECK(!emitter->insertion_rule().waits);
  CHECK(emitter->materials() == std::vector<std::string>{"sand"});
  CHECK(said([&] { guard<Emitter>(Deed::no_number)->propose({}, requests); }) ==
        "emitter/trial (/x/trial.so) gives diameter = nan in row 1 of 1 of a batch; expected: a "
        "finite number");

  Columns c;
  sdk::SurfaceBatch surface;
  surface.count = 1;
  surface.position.x = c.a;
  surface.velocity.z = c.out[0];
  const auto motion = guard<Motion>();
  CHECK(said([&] { motion->surface_velocity(surface); }).empty());
  CHECK(motion->largest_speed() == 3.0);
  CHECK(motion->moves_body());
  CHECK(motion->pose(2.0).angle == 4.0);
  CHECK(motion->largest_angular_velocity() == 4.0);
  CHECK(said([&] { static_cast<void>(guard<Motion>()->pose(k_infinite)); }) ==
        "motion/trial (/x/trial.so) gives pose (angle) = inf in row 1 of 1 of a batch (time = "
        "inf); expected: a finite number");
  CHECK(said([&] {
          const auto set = [](Motion& m) { m.pivot = {0.0, k_nan, 0.0}; };
          static_cast<void>(guard_with<Motion>(set)->pose(0.5));
        }) ==
        "motion/trial (/x/trial.so) gives pose (pivot.y) = nan in row 1 of 1 of a batch (time = "
        "0.5); expected: a finite number");

  const auto sensor = guard<Sensor>();
  sdk::WorldView world;
  world.time = 3.0;
  sensor->observe(world);
  OneNumber archive;
  sensor->save(archive);
  CHECK(archive.kept == 3.0);
  Names names;
  sensor->series(names);
  sensor->summary(names);
  sensor->report(names);
  sensor->fields(names);
  CHECK(names.text == "time end Heading one ");
  CHECK(sensor->wants_contacts());
  CHECK(sensor->wants_face_fluxes());
  CHECK(sensor->wants_walls());
  CHECK(sensor->wants_sliding());
  CHECK(
      said([&] { guard<Sensor>(Deed::throws)->observe(world); }) ==
      "sensor/trial (/x/trial.so) throws in observe: out of table; expected: a look at the world");
}

TEST_CASE("answers that the core cannot work with shall be said_of, not met as a crash") {
  const std::string who = "/trial (/x/trial.so) answers ";
  CHECK(said([] { guard_with<Contact>([](Contact& c) { c.columns = -1; })->history_size(); }) ==
        "contact" + who + "-1 to history_size; expected: a number from 0 on");
  CHECK(guard<Rolling>()->couple_column() == 1);  // the last three of four
  CHECK(said([] { guard_with<Rolling>([](Rolling& r) { r.couple = 2; })->couple_column(); }) ==
        "rolling" + who +
            "2 to couple_column; expected: the first of three of its columns of "
            "history, or -1 for none");
  CHECK(said([] { guard_with<Voidage>([](Voidage& v) { v.cells = 0; })->capacity({}, 1.0); }) ==
        "voidage" + who + "0 to capacity; expected: a number from 1 on");
  CHECK(said([] { static_cast<void>(guard<Contact>()->collision_time(-1.0, 0.0, 0.0)); }) ==
        "contact" + who + "-1 to collision_time; expected: a number above 0");
}

TEST_CASE("a factory that makes nothing, or another kind, shall be said_of") {
  registry::Entry entry;
  entry.info.kind = "drag";
  entry.info.name = "trial";
  entry.file = "/x/trial.so";
  const std::string end = "; expected: an object of its kind from its factory";
  CHECK(said([&] { registry::guarded(nullptr, entry); }) ==
        "drag/trial (/x/trial.so) is made as nothing" + end);
  CHECK(said([&] { registry::guarded(std::make_unique<Voidage>(Deed::well), entry); }) ==
        "drag/trial (/x/trial.so) is made as a model of another kind" + end);
}

TEST_CASE("what a model throws when it is asked before the run shall come with its place") {
  const scenario::ModelChoice choice{.kind = "contact",
                                     .name = "trial",
                                     .values = {},
                                     .path = "interactions[0].contact",
                                     .where = {}};
  std::string text;
  try {
    registry::ask_at_place(choice, [] { guard<Contact>(Deed::refuses)->prepare({}, {}); });
  } catch (const base::UserError& problem) {
    text = problem.what();
  }
  CHECK(text == "error: interactions[0].contact: does not fit");
}

TEST_CASE("grains that an emitter has not announced shall be said_of as its own") {
  const auto said_of = [](const auto& set) {
    std::vector<sdk::InsertionRequest> requests;
    return said([&] { guard_with<Emitter>(set)->propose({}, requests); });
  };
  const std::string row = " in row 1 of 1 of a batch; expected: ";
  CHECK(said_of([](Emitter&) {}).empty());
  CHECK(said_of([](Emitter& e) { e.diameter = 2e-3; }) ==
        "emitter/trial (/x/trial.so) gives diameter = 0.002" + row +
            "one of its diameters(), which go from 0.001 to 0.001 m");
  CHECK(said_of([](Emitter& e) { e.diameter = 5e-4; }).find("gives diameter = 0.0005") !=
        std::string::npos);
  CHECK(said_of([](Emitter& e) { e.diameter = 0.0; }).find("gives diameter = 0 in") !=
        std::string::npos);
  CHECK(said_of([](Emitter& e) { e.weight = 0.0; }) ==
        "emitter/trial (/x/trial.so) gives weight = 0" + row + "a weight above 0");
  CHECK(said_of([](Emitter& e) { e.material = -2; }).find("gives material = -2") !=
        std::string::npos);
  CHECK(said_of([](Emitter& e) { e.time = 1.0; }) ==
        "emitter/trial (/x/trial.so) gives time = 1" + row +
            "a time from 0 s on and before 0 s, the interval that it was asked for");
  CHECK(said_of([](Emitter& e) { e.material = 1; }) ==
        "emitter/trial (/x/trial.so) gives material = 1" + row +
            "an index into its 1 materials(), or -1 for the emitter's own");
}

TEST_CASE("a pose that turns about an axis of another length than 1 shall be the motion's fault") {
  const auto said_of = [](sdk::Vec3 axis, double time) {
    return said([&] {
      static_cast<void>(guard_with<Motion>([&](Motion& m) { m.axis = axis; })->pose(time));
    });
  };
  CHECK(said_of({0, 1, 0}, 0.5).empty());
  CHECK(said_of({0, 2, 0}, 0.0).empty());  // it does not turn yet
  CHECK(said_of({0, 2, 0}, 0.5) ==
        "motion/trial (/x/trial.so) answers 2 to pose; expected: an axis of the length 1 of a pose "
        "that turns");
  CHECK(said_of({}, 0.5).find("answers 0 to pose") != std::string::npos);
}

TEST_CASE("a crash shall be reported with the guarded model that is asked, and no longer") {
  std::string line;
  const auto drag = guard_with<NotingDrag>([&](NotingDrag& d) { d.line = &line; });
  drag->evaluate({});
  const std::string start = "error: crashed (SIGSEGV, memory that it may not use)";
  CHECK(line.starts_with(start + " while drag/trial (/x/trial.so) was asked for evaluate; "));
  CHECK(crash_line().starts_with(start + "; no plugins but the engine's own are loaded: "));
  registry::note_foreign_library("/x/trial.so");
  registry::note_foreign_library("/x/other.so");
  CHECK(crash_line() == start +
                            " while no model of others was asked; loaded plugins that are not the "
                            "engine's own: /x/trial.so, /x/other.so\n");
  char little[10];
  CHECK(registry::write_crash_text(SIGSEGV, little) == 10);
  CHECK(std::string(little, 10) == "error: cr\n");
}

TEST_CASE("a guarded sensor shall be refused for curves whose columns differ in length") {
  const auto sensor = guard_with<Sensor>([](Sensor& s) { s.points = 0; });
  Names sink;
  CHECK(said([&] { sensor->report(sink); }) ==
        "sensor/trial (/x/trial.so), asked for report, gives the curve 'Curve' 1 numbers for x and "
        "0 for y; expected: as many");
}

TEST_CASE("reaches that are none shall be refused") {
  const auto force = guard_with<FluidForce>([](FluidForce& f) { f.wall_reach = k_nan; });
  CHECK(
      said([&] { (void)force->needs(); }) ==
      "fluid_force/trial (/x/trial.so) answers nan to needs (wall_reach); expected: a number from "
      "0 on");
  CHECK(said([&] { (void)guard<Voidage>()->reach({}, -1.0); }) ==
        "voidage/trial (/x/trial.so) answers -1 to reach; expected: lengths from 0 on along x, y "
        "and z");
}

TEST_CASE("a fault shall know the place where the scenario chooses the model") {
  registry::Entry entry;
  entry.info.kind = "drag";
  entry.info.name = "trial";
  entry.file = "/x/trial.so";
  entry.factory = [](std::span<const sdk::Value>) { return std::make_unique<Drag>(Deed::throws); };
  const auto drag =
      registry::make_model(entry, {}, registry::error_prefix({"s.yaml", 3, 5}, "drag"));
  Columns c;
  const sdk::DragBatch batch{2, c.a, c.b, c.out[0], nullptr};
  const std::string fault =
      "drag/trial (/x/trial.so) throws in evaluate: out of table; expected: a factor for every "
      "grain "
      "of the batch";
  try {
    static_cast<sdk::DragLaw&>(*drag).evaluate(batch);
    FAIL("accepted");
  } catch (const registry::PlacedFault& problem) {
    CHECK(problem.what() == fault);
    CHECK(problem.line() == "s.yaml:3:5: error: drag: " + fault);
  }
}
