// SPDX-License-Identifier: Apache-2.0
#include "air_flow.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::air_flow;
namespace sdk = dust::sdk;

constexpr double k_per_hour = 3600.0;

class AirFlow final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length, "Lower corner of the rectangle.");
    s.vector(&Parameters::max, "max", sdk::dimension::length,
             "Upper corner; equal to 'min' along the axis that the air passes along.");
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "air_flow",
            .version = "2.0",
            .summary = "Air that passes a rectangle: volume flow both ways, and its velocities.",
            .equation = R"(\dot V = \int \varepsilon u_n\, dA)",
            .source = "own definition"};
  }

  explicit AirFlow(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (p.min[d] > p.max[d]) throw sdk::ParameterError("'min' is above 'max'");
      if (p.min[d] < p.max[d]) continue;
      if (axis_ >= 0)
        throw sdk::ParameterError("'min' and 'max' must span a rectangle, not a line");
      axis_ = d;
    }
    if (axis_ < 0) {
      throw sdk::ParameterError(
          "'min' and 'max' must be equal along one axis, which the rectangle lies across");
    }
    for (int d = 0; d < 3; ++d) {
      if (d != axis_) area_ *= p.max[d] - p.min[d];
    }
  }

  [[nodiscard]] bool wants_face_fluxes() const override { return true; }
  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    if (sdk::FluidFaces(world.fluid, axis_).is_empty()) return;
    const formula::Passing found = formula::through(world.fluid, axis_, p_.min, p_.max);
    figures_.add(world,
                 {k_per_hour * found.net(), k_per_hour * found.forward, k_per_hour * found.backward,
                  found.mean_velocity(), found.lowest, found.highest, found.area / area_},
                 p_.steady_after);
  }

  void series(sdk::FigureSink& sink) const override { figures_.series(sink); }
  void summary(sdk::FigureSink& sink) const override { figures_.summary(sink); }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Air flow", "time [s]", "flow [m3/h]", "net", figures_.curve().x(),
               figures_.curve().y());
  }

  void save(sdk::ArchiveWriter& a) const override { figures_.save(a); }
  void load(sdk::ArchiveReader& a) override { figures_.load(a); }

 private:
  Parameters p_;
  int axis_ = -1;
  double area_ = 1.0;  ///< [m2] of the rectangle
  sdk::SampledFigures figures_{{{"net", "m3/h", sdk::Quantity::volume_rate},
                                {"forward", "m3/h", sdk::Quantity::volume_rate},
                                {"backward", "m3/h", sdk::Quantity::volume_rate},
                                {"mean_velocity", "m/s", sdk::Quantity::velocity},
                                {"lowest_velocity", "m/s", sdk::Quantity::velocity},
                                {"highest_velocity", "m/s", sdk::Quantity::velocity},
                                {"open_share", "1", sdk::Quantity::ratio}}};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<AirFlow>(); }
