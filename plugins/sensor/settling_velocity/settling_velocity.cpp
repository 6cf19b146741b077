// SPDX-License-Identifier: Apache-2.0
#include "settling_velocity.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::settling_velocity;
namespace sdk = dust::sdk;

class SettlingVelocity final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 base;
    sdk::Vec3 direction;
    std::vector<double> levels;
    double until = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::base, "base", sdk::dimension::length, "Heights count from this point.")
        .optional();
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Downwards; [0, 0, 0] = along gravity.")
        .optional();
    s.numbers(&Parameters::levels, "levels", sdk::dimension::length,
              "Heights over base whose first passage is timed.")
        .at_least(0)
        .optional();
    s.number(&Parameters::until, "until", sdk::dimension::length,
             "Means end where the grains are below this height; 0 = never.")
        .at_least(0)
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "settling_velocity",
            .version = "1.0",
            .summary = "How fast grains sink, how fast at most, and when they pass given heights.",
            .equation = R"(v = \frac{\sum w_i m_i v_i \cdot n}{\sum w_i m_i})",
            .source = "own definition"};
  }

  explicit SettlingVelocity(const Parameters& p) : p_(p), passages_(p.levels) {}

  void observe(const sdk::WorldView& world) override {
    sdk::Vec3 down = norm(p_.direction) > 0.0 ? p_.direction : world.gravity;
    if (!(norm(down) > 0.0)) {
      throw sdk::ModelError("settling_velocity needs a direction where there is no gravity");
    }
    down = down / norm(down);
    const sdk::GrainColumns& g = world.grains;
    double mass = 0.0;
    double height = 0.0;
    double velocity = 0.0;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      const double m = g.weight[i] * g.mass[i];
      mass += m;
      height -= m * dot(down, sdk::Vec3{g.x[i], g.y[i], g.z[i]} - p_.base);
      velocity += m * dot(down, sdk::Vec3{g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]});
    }
    if (!(mass > 0.0)) {
      values_ = {sdk::k_no_value, sdk::k_no_value};
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
    is_down_ = is_down_ || (p_.until > 0.0 && height < p_.until);
    if (sdk::is_after(world, p_.steady_after) && !is_down_) {
      means_.add({&velocity, 1}, world.interval);
    }
    curve_.add(world.time, velocity);
  }

  void series(sdk::FigureSink& sink) const override {
    figure(sink, "velocity", values_[0], "m/s", sdk::Quantity::velocity);
    figure(sink, "height", values_[1], "m", sdk::Quantity::length);
  }
  void summary(sdk::FigureSink& sink) const override {
    const double mean = means_.known_mean(0);
    sink.figure("velocity", mean, "m/s",
                sdk::error_beside(mean, mean != 0.0 ? means_.error(0) : sdk::k_no_estimate),
                sdk::overview(sdk::Quantity::velocity, 1));
    figure(sink, "velocity_at_end", values_[0], "m/s", sdk::Quantity::velocity);
    figure(sink, "height_at_end", values_[1], "m", sdk::Quantity::length);
    const bool has_settled = largest_[0] > 0.0;
    figure(sink, "largest/velocity", has_settled || has_grains_ ? largest_[0] : sdk::k_no_value,
           "m/s", sdk::Quantity::velocity);
    figure(sink, "largest/time", has_settled ? largest_[1] : sdk::k_no_value, "s",
           sdk::Quantity::time);
    for (std::size_t n = 0; n < passages_.levels().size(); ++n) {
      const std::string name = "level_" + sdk::name_of(passages_.levels()[n] * 1e3) + "_mm/";
      const bool is_passed = passages_.times()[n] > 0.0;
      figure(sink, name + "time", is_passed ? passages_.times()[n] : sdk::k_no_value, "s",
             sdk::Quantity::time);
      figure(sink, name + "velocity", is_passed ? passages_.velocities()[n] : sdk::k_no_value,
             "m/s", sdk::Quantity::velocity);
    }
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Settling", "time [s]", "velocity [m/s]", "mean of the grains", curve_.x(),
               curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    a.numbers("largest", largest_);
    a.integer("has_grains", has_grains_ ? 1 : 0);
    a.integer("is_down", is_down_ ? 1 : 0);
    a.numbers("passage_times", passages_.times());
    a.numbers("passage_velocities", passages_.velocities());
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
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
  static void figure(sdk::FigureSink& sink, const std::string& name, double value, const char* unit,
                     sdk::Quantity quantity) {
    sink.figure(name, value, unit, sdk::error_beside(value, sdk::k_no_estimate),
                sdk::detail(quantity));
  }

  Parameters p_;
  formula::Passages passages_;
  /// Velocity [m/s] and height [m] at the last sample.
  std::vector<double> values_{sdk::k_no_value, sdk::k_no_value};
  std::vector<double> largest_{0.0, 0.0};  ///< velocity [m/s] and when [s]
  bool has_grains_ = false;
  bool is_down_ = false;  ///< below `until`: what bounces back no longer counts
  sdk::BatchMeans means_{1};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<SettlingVelocity>(); }
