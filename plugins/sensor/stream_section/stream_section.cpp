// SPDX-License-Identifier: Apache-2.0
#include "stream_section.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/rectangle.hpp>
#include <dust/sdk/sampling.hpp>

#include <array>
#include <cmath>
#include <string>

namespace {

namespace formula = dust::model::stream_section;
namespace sdk = dust::sdk;

class StreamSection final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 point;
    sdk::Vec3 normal;
    sdk::Vec3 min;
    sdk::Vec3 max;
    double bulk_density = 0.0;
    sdk::Vec3 belt_velocity;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::point, "point", sdk::dimension::length, "A point of the plane.");
    s.vector(&Parameters::normal, "normal", sdk::dimension::none,
             "Normal of the plane, in the direction of the stream.")
        .symbol("n");
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the box that cuts the opening out of the plane; the plane is along "
             "two axes.");
    s.vector(&Parameters::max, "max", sdk::dimension::length,
             "Upper corner of that box; may equal 'min' along the normal.");
    s.number(&Parameters::bulk_density, "bulk_density", sdk::dimension::density,
             "Bulk density of the resting material.")
        .symbol("\\rho_b")
        .above(0);
    s.vector(&Parameters::belt_velocity, "belt_velocity", sdk::dimension::velocity,
             "Velocity of the belt that the stream falls on; 0 = no comparison.")
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "stream_section",
            .version = "1.0",
            .summary = "Velocity, angle, fill ratio and impact pressure of a stream at an opening.",
            .equation = R"(\phi = \frac{\dot m}{\rho_b v_n A},\quad p = \rho_b v_n^2)",
            .source = "own definition"};
  }

  explicit StreamSection(const Parameters& p)
      : p_(p), rectangle_(p.point, p.normal, p.min, p.max), area_(rectangle_.area()) {}

  void observe(const sdk::WorldView& world) override {
    values_.fill(0.0);
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size() && world.interval > 0.0; ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      sdk::any_way(world, i, [&](const sdk::Path& way) {
        if (rectangle_.passage_of(way) <= 0) return false;
        add(world, i, way);
        return true;
      });
    }
    row_.add({values_.data(), 1}, world.interval);
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass_flow", row_.mean(0), "kg/s", -1.0, sdk::detail(sdk::Quantity::mass_rate));
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view) const override {
    return sdk::RowValue::mean;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    const Stream s = stream();
    const sdk::Vec3 n = rectangle_.normal();
    const double normal = dot(s.velocity, n);
    const double speed = norm(s.velocity);
    const sdk::Vec3 tangential = s.velocity - normal * n;
    sink.figure("mass_flow", s.mass_flow, "kg/s", means_.error(0),
                sdk::overview(sdk::Quantity::mass_rate, 1));
    for (int d = 0; d < 3; ++d) {
      sdk::Vec3 axis;
      axis[d] = 1.0;
      sink.figure(std::string("velocity_") + "xyz"[d], s.velocity[d], "m/s",
                  error_along(s, axis, s.velocity[d]), sdk::detail(sdk::Quantity::velocity));
    }
    sink.figure("speed", speed, "m/s", error_along(s, s.velocity / speed, speed),
                sdk::overview(sdk::Quantity::velocity, 2));
    const double angle = formula::angle(normal, norm(tangential));
    // What goes across the stream in the plane of both turns it.
    const sdk::Vec3 turning =
        (norm(tangential) / speed) * n - (normal / speed / norm(tangential)) * tangential;
    sink.figure("angle", angle, "rad", error_along(s, turning / speed, angle),
                sdk::overview(sdk::Quantity::angle, 3));
    const double fill = fill_ratio(s);
    sink.figure("fill_ratio", fill, "1", fill_error(s, fill),
                sdk::overview(sdk::Quantity::ratio, 4));
    const double pressure = formula::impact_pressure(p_.bulk_density, normal);
    sink.figure("impact_pressure", pressure, "Pa",
                error_along(s, 2.0 * p_.bulk_density * normal * n, pressure),
                sdk::overview(sdk::Quantity::pressure, 5));
    const double belt = norm(p_.belt_velocity);
    if (belt == 0.0) return;
    const sdk::Vec3 along_belt = p_.belt_velocity / belt;
    const double along = dot(s.velocity, along_belt);
    sink.figure("speed_along_belt", along, "m/s", error_along(s, along_belt, along),
                sdk::detail(sdk::Quantity::velocity));
    sink.figure("speed_along_belt_over_belt_speed", along / belt, "1",
                error_along(s, along_belt / belt, along / belt),
                sdk::overview(sdk::Quantity::ratio, 6));
  }

  void save(sdk::ArchiveWriter& a) const override {
    row_.save(a, "row");
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    row_.load(a, "row");
    means_.load(a, "means");
  }

 private:
  static constexpr std::size_t k_columns = 4;  ///< mass flow, momentum flow
  struct Stream {
    double mass_flow = 0.0;  ///< [kg/s]
    sdk::Vec3 velocity;      ///< [m/s] mean by mass passed; no numbers where nothing passed
  };

  /// A grain that has passed, at its velocity where it did: back from that at the end of the sample
  /// along the acceleration there.
  void add(const sdk::WorldView& world, std::size_t i, const sdk::Path& way) {
    const sdk::GrainColumns& g = world.grains;
    const auto height = [&](sdk::Vec3 x) { return dot(x - p_.point, rectangle_.normal()); };
    const double fraction = sdk::passage(height(way.before), height(way.now)).fraction;
    const double since = (1.0 - fraction) * world.interval;
    const sdk::Vec3 force{g.force_x[i], g.force_y[i], g.force_z[i]};
    const sdk::Vec3 velocity =
        sdk::Vec3{g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]} - (since / g.mass[i]) * force;
    const double rate = g.weight[i] * g.mass[i] / world.interval;
    values_[0] += rate;
    for (int d = 0; d < 3; ++d) values_[static_cast<std::size_t>(1 + d)] += rate * velocity[d];
  }
  [[nodiscard]] Stream stream() const {
    const double flow = means_.known_mean(0);
    // A flow of nothing has no velocity; without a time not even the flow is known.
    constexpr sdk::Vec3 k_none{sdk::k_no_value, sdk::k_no_value, sdk::k_no_value};
    if (!(flow > 0.0)) return {flow, k_none};
    return {flow, sdk::Vec3{means_.mean(1), means_.mean(2), means_.mean(3)} / flow};
  }
  /// Of a `value` that follows from the mean velocity alone: `gradient` are its derivatives by
  /// that.
  [[nodiscard]] double error_along(const Stream& s, sdk::Vec3 gradient, double value) const {
    // A stream straight onto the plane has no direction along it to turn to.
    const bool is_known = std::isfinite(value) && std::isfinite(norm(gradient));
    if (!is_known) return sdk::error_beside(value, sdk::k_no_estimate);
    const double f = s.mass_flow;
    const std::array<double, k_columns> partials{-dot(gradient, s.velocity) / f, gradient.x / f,
                                                 gradient.y / f, gradient.z / f};
    return means_.error_of_function(partials, value);
  }
  /// Of a ratio that goes as the square of the mass flow over the momentum flow along the normal.
  [[nodiscard]] double fill_error(const Stream& s, double value) const {
    const sdk::Vec3 n = rectangle_.normal();
    const double normal = dot(s.velocity, n);
    if (!(normal > 0.0)) return sdk::error_beside(value, sdk::k_no_estimate);
    const double f = s.mass_flow;
    const sdk::Vec3 g = (-value / (f * normal)) * n;
    const std::array<double, k_columns> partials{2.0 * value / f, g.x, g.y, g.z};
    return means_.error_of_function(partials, value);
  }
  [[nodiscard]] double fill_ratio(const Stream& s) const {
    return formula::fill_ratio(s.mass_flow, p_.bulk_density, dot(s.velocity, rectangle_.normal()),
                               area_);
  }

  Parameters p_;
  sdk::Rectangle rectangle_;
  double area_;                             ///< [m2]
  std::array<double, k_columns> values_{};  ///< of one sample
  sdk::RowMeans row_{1};                    ///< of the mass flow
  sdk::BatchMeans means_{k_columns};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<StreamSection>(); }
