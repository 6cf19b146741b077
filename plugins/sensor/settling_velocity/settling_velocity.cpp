// SPDX-License-Identifier: Apache-2.0
#include "settling_velocity.hpp"

#include "dust/sdk/plugin.hpp"
#include "dust/sdk/sampling.hpp"

namespace {

using namespace dust::sdk;
namespace formula = dust::model::settling_velocity;

class SettlingVelocity final : public Sensor {
 public:
  struct Parameters : SelectionParameters {
    Vec3 base;
    Vec3 direction;
    std::vector<double> levels;
    double until = 0.0;
  };

  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::base, "base", dimension::length, "Heights count from this point.")
        .optional();
    s.vector(&Parameters::direction, "direction", dimension::none,
             "Downwards; [0, 0, 0] = along gravity.")
        .optional();
    s.numbers(&Parameters::levels, "levels", dimension::length,
              "Heights over base whose first passage is timed.")
        .at_least(0)
        .optional();
    s.number(&Parameters::until, "until", dimension::length,
             "Means end where the grains are below this height; 0 = never.")
        .at_least(0)
        .optional();
    declare_selection(s);
    return s.build();
  }

  static ModelInfo describe() {
    return {"",
            "settling_velocity",
            "1.0",
            "How fast grains sink, how fast at most, and when they pass given heights.",
            R"(v = \frac{\sum w_i m_i v_i \cdot n}{\sum w_i m_i})",
            "own definition",
            {}};
  }

  explicit SettlingVelocity(const Parameters& p) : p_(p), passages_(p.levels) {}

  void observe(const WorldView& world) override {
    Vec3 down = norm(p_.direction) > 0.0 ? p_.direction : world.gravity;
    if (!(norm(down) > 0.0)) {
      throw ModelError("settling_velocity needs a direction where there is no gravity");
    }
    down = down / norm(down);
    const GrainColumns& g = world.grains;
    double mass = 0.0;
    double height = 0.0;
    double velocity = 0.0;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      const double m = g.weight[i] * g.mass[i];
      mass += m;
      height -= m * dot(down, Vec3{g.x[i], g.y[i], g.z[i]} - p_.base);
      velocity += m * dot(down, Vec3{g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]});
    }
    if (!(mass > 0.0)) {
      values_ = {0.0, 0.0};
      has_grains_ = false;
      return;
    }
    height /= mass;
    velocity /= mass;
    if (has_grains_) {
      passages_.look(values_[1], height, values_[0], velocity, world.time, world.interval);
    }
    values_ = {velocity, height};
    has_grains_ = true;
    if (velocity > largest_[0]) largest_ = {velocity, world.time};
    is_down_ = is_down_ || height < p_.until;
    if (is_after(world, p_.steady_after) && !is_down_) {
      means_.add({&velocity, 1}, world.interval);
    }
    curve_.add(world.time, velocity);
  }

  void series(FigureSink& sink) const override {
    sink.figure("velocity", values_[0], "m/s");
    sink.figure("height", values_[1], "m");
  }
  void summary(FigureSink& sink) const override {
    const double mean = means_.mean(0);
    sink.figure("velocity", mean, "m/s", mean != 0.0 ? means_.error(0) : -1.0);
    sink.figure("velocity_at_end", values_[0], "m/s");
    sink.figure("height_at_end", values_[1], "m");
    sink.figure("largest/velocity", largest_[0], "m/s");
    sink.figure("largest/time", largest_[1], "s");
    for (std::size_t n = 0; n < passages_.levels().size(); ++n) {
      const std::string name = "level_" + name_of(passages_.levels()[n] * 1e3) + "_mm/";
      sink.figure(name + "time", passages_.times()[n], "s");
      sink.figure(name + "velocity", passages_.velocities()[n], "m/s");
    }
  }
  void report(ReportSink& sink) const override {
    sink.curve("Settling", "time [s]", "velocity [m/s]", "mean of the grains", curve_.x(),
               curve_.y());
  }

  void save(ArchiveWriter& a) const override {
    a.numbers("values", values_);
    a.numbers("largest", largest_);
    a.integer("has_grains", has_grains_ ? 1 : 0);
    a.integer("is_down", is_down_ ? 1 : 0);
    a.numbers("passage_times", passages_.times());
    a.numbers("passage_velocities", passages_.velocities());
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(ArchiveReader& a) override {
    values_ = a.numbers("values");
    largest_ = a.numbers("largest");
    has_grains_ = a.integer("has_grains") != 0;
    is_down_ = a.integer("is_down") != 0;
    passages_.times() = a.numbers("passage_times");
    passages_.velocities() = a.numbers("passage_velocities");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  Parameters p_;
  formula::Passages passages_;
  std::vector<double> values_{0.0, 0.0};   ///< velocity [m/s] and height [m] at the last sample
  std::vector<double> largest_{0.0, 0.0};  ///< velocity [m/s] and when [s]
  bool has_grains_ = false;
  bool is_down_ = false;  ///< below `until`: what bounces back no longer counts
  BatchMeans means_{1};
  ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<SettlingVelocity>(); }
