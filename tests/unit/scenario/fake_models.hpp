// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/plugin.hpp"
#include "registry/registry.hpp"

#include <cmath>
#include <limits>
#include <memory>
#include <string>
#include <vector>

/// Models without physics, with the parameters that scenarios/transfer_point.yaml writes: the
/// reader is tested without the shipped plugins.
namespace fake {

using namespace dust::sdk;

template <class M>
ModelInfo info(const char* name) {
  ModelInfo i;
  i.name = name;
  i.version = "1.0";
  i.summary = "A model without physics.";
  return i;
}

struct HertzMindlin final : ContactLaw {
  struct Parameters {
    double restitution = 0.0;
    double friction = 0.0;
  };
  static ModelInfo describe() { return info<HertzMindlin>("hertz_mindlin"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.number(&Parameters::restitution, "restitution", dimension::none, "Ratio of speeds.")
        .symbol("e")
        .above(0)
        .at_most(1);
    s.number(&Parameters::friction, "friction", dimension::none, "Coulomb's coefficient.")
        .at_least(0);
    return s.build();
  }
  explicit HertzMindlin(const Parameters&) {}
  void prepare(const MaterialProperties& i, const MaterialProperties&) override { material = i; }
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const ContactBatch&) const override {}
  [[nodiscard]] double collision_time(double r, double m, double v) const override {
    const double e =
        material.young_modulus / (2 * (1 - material.poisson_ratio * material.poisson_ratio));
    return 2.87 * std::pow(m * m / (r * e * e * v), 0.2);
  }
  [[nodiscard]] double half_period(double, double, double) const override { return 1e-5; }
  MaterialProperties material;
};

struct Epsd2 final : RollingLaw {
  struct Parameters {
    double friction = 0.0;
  };
  static ModelInfo describe() { return info<Epsd2>("epsd2"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.number(&Parameters::friction, "friction", dimension::none, "Rolling.").at_least(0);
    return s.build();
  }
  explicit Epsd2(const Parameters&) {}
  void prepare(const MaterialProperties&, const MaterialProperties&) override {}
  [[nodiscard]] int history_size() const override { return 0; }
  void evaluate(const ContactBatch&) const override {}
};

struct Gidaspow final : DragLaw {
  struct Parameters {};
  static ModelInfo describe() { return info<Gidaspow>("gidaspow"); }
  static ParameterSchema schema() { return {}; }
  explicit Gidaspow(const Parameters&) {}
  void evaluate(const DragBatch&) const override {}
};

/// Reads the moisture, or a measured number that has it in it.
template <bool reads_moisture>
struct AnyLiberation final : LiberationLaw {
  struct Parameters {
    double number = 0.0;
  };
  static ModelInfo describe() { return info<AnyLiberation>(reads_moisture ? "energy" : "given"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.number(&Parameters::number, reads_moisture ? "binding_energy" : "emission",
             reads_moisture ? dimension::specific_energy : dimension::none, "Any number.")
        .above(0);
    return s.build();
  }
  explicit AnyLiberation(const Parameters&) {}
  void prepare(const DustProperties&) override {}
  void in_contacts(const GrainImpacts&) const override {}
  [[nodiscard]] bool uses_moisture() const override { return reads_moisture; }
};

struct Divided final : VoidageRule {
  struct Parameters {};
  static ModelInfo describe() { return info<Divided>("divided"); }
  static ParameterSchema schema() { return {}; }
  explicit Divided(const Parameters&) {}
  [[nodiscard]] int capacity(const GridShape&, double) const override { return 8; }
  [[nodiscard]] double largest_diameter_over_spacing() const override { return 1.0; }
  void spread(const GridShape&, const VoidageBatch&) const override {}
};

struct Side : BoundaryCondition {
  [[nodiscard]] SideRules rules() const override { return {}; }
  void evaluate(const SideBatch&) const override {}
};
struct TotalPressure final : Side {
  struct Parameters {
    double pressure = 0.0;
  };
  static ModelInfo describe() { return info<TotalPressure>("total_pressure"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.number(&Parameters::pressure, "pressure", dimension::pressure, "Total pressure.").optional();
    return s.build();
  }
  explicit TotalPressure(const Parameters&) {}
};
struct MovingWall final : Side {
  struct Parameters {
    Vec3 velocity;
  };
  static ModelInfo describe() { return info<MovingWall>("moving_wall"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", dimension::velocity, "Velocity of the wall.");
    return s.build();
  }
  explicit MovingWall(const Parameters&) {}
};
struct Slip final : Side {
  struct Parameters {};
  static ModelInfo describe() { return info<Slip>("slip"); }
  static ParameterSchema schema() { return {}; }
  explicit Slip(const Parameters&) {}
};
struct NoSlip final : Side {
  struct Parameters {};
  static ModelInfo describe() { return info<NoSlip>("no_slip"); }
  static ParameterSchema schema() { return {}; }
  explicit NoSlip(const Parameters&) {}
};

struct Belt final : Motion {
  struct Parameters {
    double speed = 0.0;
  };
  static ModelInfo describe() { return info<Belt>("belt"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.number(&Parameters::speed, "speed", dimension::velocity, "Speed of the belt.");
    return s.build();
  }
  explicit Belt(const Parameters& p) : speed(p.speed) {}
  void surface_velocity(const SurfaceBatch& b) const override { Motion::surface_velocity(b); }
  [[nodiscard]] double largest_speed() const override { return std::abs(speed); }
  double speed;
};

/// A motion that takes the body along.
struct Lift final : Motion {
  struct Parameters {
    Vec3 velocity;
    double radius = 0.0;  ///< a name that a shape has too
  };
  static ModelInfo describe() { return info<Lift>("lift"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::velocity, "velocity", dimension::velocity, "Velocity.");
    s.number(&Parameters::radius, "radius", dimension::length, "Nothing.").optional();
    return s.build();
  }
  explicit Lift(const Parameters& p) : velocity(p.velocity) {}
  [[nodiscard]] double largest_speed() const override { return norm(velocity); }
  [[nodiscard]] bool moves_body() const override { return true; }
  [[nodiscard]] RigidPose pose(double time) const override {
    RigidPose pose;
    pose.shift = time * velocity;
    pose.velocity = velocity;
    return pose;
  }
  Vec3 velocity;
};

struct Feed final : Emitter {
  struct Parameters {
    double mass_flow = 0.0;
    Vec3 min, max, velocity;
    std::vector<double> diameters, number_fractions;
    double rare_below = 0.0;
    std::int64_t samples_per_particle = 1;
  };
  static ModelInfo describe() { return info<Feed>("feed"); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.number(&Parameters::mass_flow, "mass_flow", dimension::mass_flow, "Mass rate.").above(0);
    s.vector(&Parameters::min, "min", dimension::length, "Lower corner.");
    s.vector(&Parameters::max, "max", dimension::length, "Upper corner.");
    s.vector(&Parameters::velocity, "velocity", dimension::velocity, "Velocity.").optional();
    s.numbers(&Parameters::diameters, "diameters", dimension::length, "Sizes.").above(0);
    s.numbers(&Parameters::number_fractions, "number_fractions", dimension::none, "Shares.")
        .at_least(0);
    s.number(&Parameters::rare_below, "rare_below", dimension::length, "Rare sizes.").optional();
    s.integer(&Parameters::samples_per_particle, "copies_of_rare", "Copies.")
        .at_least(1)
        .optional();
    return s.build();
  }
  explicit Feed(const Parameters& p) : parameters(p) {
    if (p.diameters.size() != p.number_fractions.size()) {
      throw ParameterError("diameters and number_fractions differ in length");
    }
  }
  void propose(const EmitterContext& context, std::vector<InsertionRequest>& requests) override {
    InsertionRequest request;
    request.time = context.begin;
    request.position = 0.5 * (parameters.min + parameters.max);
    request.diameter = 4e-4;
    requests.insert(requests.end(), 10, request);
  }
  [[nodiscard]] double requested_mass_flow() const override { return parameters.mass_flow; }
  [[nodiscard]] std::vector<double> diameters() const override { return parameters.diameters; }
  [[nodiscard]] double largest_speed() const override { return norm(parameters.velocity); }
  Parameters parameters;
};

/// One sensor with the union of what the scenario's sensors need, under any name.
template <int N>
struct AnySensor final : Sensor {
  static constexpr const char* k_names[] = {"trajectory", "plane_flux", "box_concentration",
                                            "carry_back", "low_pressure"};
  struct Parameters {
    Vec3 from, point, normal, min, max;
    std::vector<double> drops;
    double steady_after = 0.0, coarser_than = 0.0, reach = 0.0, averaging_after = 0.0;
    double finer_than = std::numeric_limits<double>::infinity();
    std::string body;
    std::int64_t count = 1;
  };
  static ModelInfo describe() { return info<AnySensor>(k_names[N]); }
  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::from, "from", dimension::length, "From.").optional();
    s.vector(&Parameters::point, "point", dimension::length, "Point.").optional();
    s.vector(&Parameters::normal, "normal", dimension::none, "Normal.").optional();
    s.vector(&Parameters::min, "min", dimension::length, "Min.").optional();
    s.vector(&Parameters::max, "max", dimension::length, "Max.").optional();
    s.numbers(&Parameters::drops, "drops", dimension::length, "Drops.").optional();
    s.number(&Parameters::steady_after, "steady_after", dimension::time, "After.").optional();
    s.number(&Parameters::coarser_than, "coarser_than", dimension::length, "Size.").optional();
    s.number(&Parameters::finer_than, "finer_than", dimension::length, "Size.").above(0).optional();
    s.number(&Parameters::reach, "reach", dimension::length, "Reach.").optional();
    s.number(&Parameters::averaging_after, "averaging_after", dimension::time, "After.").optional();
    s.text(&Parameters::body, "body", "Body.").refers_to(Refers::body).optional();
    s.integer(&Parameters::count, "count", "Count.").at_least(1).optional();
    return s.build();
  }
  explicit AnySensor(const Parameters&) {}
  void observe(const WorldView&) override {}
  void series(FigureSink&) const override {}
  void summary(FigureSink& sink) const override {
    sink.figure("angle", 0.0, "deg");
    sink.figure("rate", 0.0, "kg/s");
    sink.figure("drop_5_mm/median", 0.0, "m");
    sink.figure("count", 0.0, "1");
  }
  void report(ReportSink& sink) const override {
    sink.curve("Angle", "time [s]", "angle [deg]", "fit", {}, {});
    sink.curve("Path", "distance [m]", "height [m]", "median", {}, {});
    sink.curve("Share", "time [s]", "share [1]", "all", {}, {});
  }
};

inline void add_all(Registrar& registrar) {
  registrar.add<HertzMindlin>();
  registrar.add<Epsd2>();
  registrar.add<Gidaspow>();
  registrar.add<Divided>();
  registrar.add<AnyLiberation<true>>();
  registrar.add<AnyLiberation<false>>();
  registrar.add<TotalPressure>();
  registrar.add<MovingWall>();
  registrar.add<Slip>();
  registrar.add<NoSlip>();
  registrar.add<Belt>();
  registrar.add<Lift>();
  registrar.add<Feed>();
  registrar.add<AnySensor<0>>();
  registrar.add<AnySensor<1>>();
  registrar.add<AnySensor<2>>();
  registrar.add<AnySensor<3>>();
  registrar.add<AnySensor<4>>();
}

struct IntoRegistry final : Registrar {
  explicit IntoRegistry(dust::registry::Registry& r) : registry(r) {}
  using Registrar::add;
  void add(ModelInfo model, ModelFactory factory) override {
    registry.add({std::move(model), std::move(factory), {}});
  }
  dust::registry::Registry& registry;
};

inline std::unique_ptr<dust::registry::Registry> registry() {
  auto made = std::make_unique<dust::registry::Registry>();
  IntoRegistry into(*made);
  add_all(into);
  return made;
}

}  // namespace fake
