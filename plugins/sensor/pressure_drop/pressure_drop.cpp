// SPDX-License-Identifier: Apache-2.0
#include "pressure_drop.hpp"

#include "dust/sdk/fluid_cells.hpp"
#include "dust/sdk/plugin.hpp"
#include "dust/sdk/sampling.hpp"

namespace {

using namespace dust::sdk;
namespace formula = dust::model::pressure_drop;

class PressureDrop final : public Sensor {
 public:
  struct Parameters : SteadyParameters {
    Vec3 from;
    Vec3 to;
    std::string between = "planes";
  };

  static ParameterSchema schema() {
    SchemaOf<Parameters> s;
    s.vector(&Parameters::from, "from", dimension::length,
             "Upstream point, or a point of the plane.");
    s.vector(&Parameters::to, "to", dimension::length,
             "Downstream point, or a point of the plane.");
    s.text(&Parameters::between, "between",
           "Whether means over whole cross-sections are compared, or two points.")
        .one_of({"planes", "points"})
        .optional();
    declare_steady(s);
    return s.build();
  }

  static ModelInfo describe() {
    return {"",
            "pressure_drop",
            "1.0",
            "Pressure lost between two cross-sections or points, and the flow between them.",
            R"(\Delta p = \bar p(from) - \bar p(to), \quad U = \frac1A \int \varepsilon u_n\, dA)",
            "own definition",
            {}};
  }

  explicit PressureDrop(const Parameters& p) : p_(p), axis_(common_axis(p.from, p.to)) {
    if (p.from == p.to) throw ParameterError("'from' and 'to' are the same place");
    if (p.between == "planes" && axis_ < 0) {
      throw ParameterError(
          "'from' and 'to' must differ along one axis only, which the planes cross; or take "
          "between: points");
    }
  }

  void observe(const WorldView& world) override {
    const FluidCells cells(world.fluid);
    if (cells.is_empty()) return;
    const auto pressure = [&](std::size_t c) {
      return static_cast<double>(world.fluid.pressure[c]);
    };
    if (p_.between == "planes") {
      values_[0] = cells.plane_mean(axis_, p_.from[axis_], pressure) -
                   cells.plane_mean(axis_, p_.to[axis_], pressure);
      values_[1] = formula::along(p_.from[axis_], p_.to[axis_],
                                  cells.superficial_velocity(axis_, p_.from[axis_]));
    } else {
      values_[0] = cells.at(p_.from, pressure) - cells.at(p_.to, pressure);
    }
    if (is_after(world, p_.steady_after)) means_.add(values_, world.interval);
    curve_.add(world.time, values_[0]);
  }

  void series(FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) sink.figure(k_names[n], values_[n], k_units[n]);
  }
  void summary(FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) {
      const double mean = means_.mean(n);
      sink.figure(k_names[n], mean, k_units[n], mean != 0.0 ? means_.error(n) : -1.0);
      sink.figure(std::string(k_names[n]) + "_at_end", values_[n], k_units[n]);
    }
  }
  void report(ReportSink& sink) const override {
    sink.curve("Pressure drop", "time [s]", "pressure [Pa]", "from - to", curve_.x(), curve_.y());
  }

  void save(ArchiveWriter& a) const override {
    a.numbers("values", values_);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(ArchiveReader& a) override {
    values_ = a.numbers("values");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr std::size_t k_columns = 2;
  static constexpr const char* k_names[k_columns] = {"pressure_drop", "superficial_velocity"};
  static constexpr const char* k_units[k_columns] = {"Pa", "m/s"};

  Parameters p_;
  int axis_;
  std::vector<double> values_ = std::vector<double>(k_columns, 0.0);  ///< at the last sample
  BatchMeans means_{k_columns};
  ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<PressureDrop>(); }
