// SPDX-License-Identifier: Apache-2.0
#include "pressure_drop.hpp"

#include <dust/sdk/fluid_cells.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::pressure_drop;
namespace sdk = dust::sdk;

class PressureDrop final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 from;
    sdk::Vec3 to;
    std::string between = "planes";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::from, "from", sdk::dimension::length,
             "Upstream point, or a point of the plane.");
    s.vector(&Parameters::to, "to", sdk::dimension::length,
             "Downstream point, or a point of the plane.");
    s.text(&Parameters::between, "between",
           "Whether means over whole cross-sections are compared, or two points.")
        .one_of({"planes", "points"})
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "pressure_drop",
        .version = "1.0",
        .summary = "Pressure lost between two cross-sections or points, and the flow between them.",
        .equation =
            R"(\Delta p = \bar p(from) - \bar p(to), \quad U = \frac1A \int \varepsilon u_n\, dA)",
        .source = "own definition"};
  }

  explicit PressureDrop(const Parameters& p) : p_(p), axis_(sdk::common_axis(p.from, p.to)) {
    if (p.from == p.to) throw sdk::ParameterError("'from' and 'to' are the same place");
    if (p.between == "planes" && axis_ < 0) {
      throw sdk::ParameterError(
          "'from' and 'to' must differ along one axis only, which the planes cross; or take "
          "between: points");
    }
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    const sdk::FluidCells cells(world.fluid);
    if (cells.is_empty()) return;
    const auto pressure = [&](std::size_t c) {
      return static_cast<double>(world.fluid.pressure[c]);
    };
    double drop = 0.0;
    double flow = 0.0;
    if (p_.between == "planes") {
      drop = cells.plane_mean(axis_, p_.from[axis_], pressure) -
             cells.plane_mean(axis_, p_.to[axis_], pressure);
      flow = formula::along(p_.from[axis_], p_.to[axis_],
                            cells.superficial_velocity(axis_, p_.from[axis_]));
    } else {
      drop = cells.at(p_.from, pressure) - cells.at(p_.to, pressure);
    }
    figures_.add(world, {drop, flow}, p_.steady_after);
  }

  void series(sdk::FigureSink& sink) const override { figures_.series(sink); }
  void summary(sdk::FigureSink& sink) const override { figures_.summary(sink); }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Pressure drop", "time [s]", "pressure [Pa]", "from - to", figures_.curve().x(),
               figures_.curve().y());
  }

  void save(sdk::ArchiveWriter& a) const override { figures_.save(a); }
  void load(sdk::ArchiveReader& a) override { figures_.load(a); }

 private:
  Parameters p_;
  int axis_;
  sdk::SampledFigures figures_{{{"pressure_drop", "Pa", sdk::Quantity::pressure},
                                {"superficial_velocity", "m/s", sdk::Quantity::velocity}}};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<PressureDrop>(); }
