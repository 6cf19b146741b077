// SPDX-License-Identifier: Apache-2.0
#include "minimum_fluidisation.hpp"

#include <dust/sdk/fluid_cells.hpp>
#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::minimum_fluidisation;
namespace sdk = dust::sdk;
using formula::Point;

class MinimumFluidisation final : public sdk::Sensor {
 public:
  struct Parameters {
    sdk::Vec3 from;
    sdk::Vec3 to;
    double after = 0.0;
    double fixed_share = 0.7;
    double fluid_factor = 1.2;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::from, "from", sdk::dimension::length,
             "A point of the cross-section below the bed; heights are counted from it.");
    s.vector(&Parameters::to, "to", sdk::dimension::length,
             "A point of the cross-section above the bed.");
    s.number(&Parameters::after, "after", sdk::dimension::time,
             "Time from which the ramp is looked at.")
        .at_least(0)
        .optional();
    s.number(&Parameters::fixed_share, "fixed_share", sdk::dimension::none,
             "The bed counts as packed below this share of the velocity at which it would cost as "
             "much as the plateau.")
        .above(0)
        .below(1)
        .optional();
    s.number(&Parameters::fluid_factor, "fluid_factor", sdk::dimension::none,
             "It counts as fluidised above this multiple of that velocity.")
        .above(1)
        .optional();
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "minimum_fluidisation",
        .version = "1.0",
        .summary = "Velocity at which a bed becomes fluid, from a ramp of the flow up or down.",
        .equation =
            R"(\Delta p_{packed}(U_{mf}) = \Delta p_{fluid}(U_{mf}), \quad H_{packed}(U_{mf}) = H_{fluid}(U_{mf}))",
        .source =
            "Richardson, in Davidson, Harrison (ed.), Fluidization, Academic Press 1971, ch. 2"};
  }

  explicit MinimumFluidisation(const Parameters& p) : p_(p), axis_(sdk::common_axis(p.from, p.to)) {
    if (axis_ < 0) {
      throw sdk::ParameterError(
          "'from' and 'to' must differ along one axis only, which the planes cross");
    }
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    const sdk::FluidCells cells(world.fluid);
    if (cells.is_empty() || !sdk::is_after(world, p_.after)) return;
    const auto pressure = [&](std::size_t c) {
      return static_cast<double>(world.fluid.pressure[c]);
    };
    const double sign = p_.to[axis_] > p_.from[axis_] ? 1.0 : -1.0;
    last_ = {sign * cells.superficial_velocity(axis_, p_.from[axis_]),
             cells.plane_mean(axis_, p_.from[axis_], pressure) -
                 cells.plane_mean(axis_, p_.to[axis_], pressure),
             2.0 * sign * (centre(world.grains) - p_.from[axis_])};
    add(last_);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("superficial_velocity", last_.velocity, "m/s", sdk::Quantity::velocity);
    sink.figure("pressure_drop", last_.pressure, "Pa", sdk::Quantity::pressure);
    sink.figure("height", last_.height, "m", sdk::error_beside(last_.height, sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::length));
  }
  void summary(sdk::FigureSink& sink) const override {
    const auto [rising, falling] = branches();
    write(sink, "rising/", formula::evaluate(rising, p_.fixed_share, p_.fluid_factor), 2);
    write(sink, "falling/", formula::evaluate(falling, p_.fixed_share, p_.fluid_factor), 1);
  }
  void report(sdk::ReportSink& sink) const override {
    const auto [rising, falling] = branches();
    draw(sink, "rising", rising);
    draw(sink, "falling", falling);
  }

  void save(sdk::ArchiveWriter& a) const override {
    std::vector<double> numbers;
    for (const Point& p : points_) {
      numbers.insert(numbers.end(), {p.velocity, p.pressure, p.height});
    }
    const double open[] = {sum_.velocity,  sum_.pressure,  sum_.height,
                           last_.velocity, last_.pressure, last_.height};
    const std::int64_t counts[] = {samples_per_point_, samples_};
    a.numbers("points", numbers);
    a.numbers("open", open);
    a.integers("counts", counts);
  }
  void load(sdk::ArchiveReader& a) override {
    const std::vector<double> numbers = a.numbers("points");
    points_.clear();
    for (std::size_t n = 0; n + 2 < numbers.size(); n += 3) {
      points_.push_back({numbers[n], numbers[n + 1], numbers[n + 2]});
    }
    const std::vector<double> open = a.numbers("open");
    sum_ = {open.at(0), open.at(1), open.at(2)};
    last_ = {open.at(3), open.at(4), open.at(5)};
    const std::vector<std::int64_t> counts = a.integers("counts");
    samples_per_point_ = counts.at(0);
    samples_ = counts.at(1);
  }

 private:
  static constexpr std::size_t k_max_points = 2048;

  /// Centre of mass of the grains along the axis [m]; sdk::k_no_value without grains.
  [[nodiscard]] double centre(const sdk::GrainColumns& g) const {
    const std::span<const double> place = axis_ == 0 ? g.x : axis_ == 1 ? g.y : g.z;
    double mass = 0.0;
    double moment = 0.0;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      mass += g.weight[i] * g.mass[i];
      moment += g.weight[i] * g.mass[i] * place[i];
    }
    return mass > 0.0 ? moment / mass : sdk::k_no_value;
  }

  /// Means of more and more samples as the ramp gets longer.
  void add(const Point& p) {
    sum_.velocity += p.velocity;
    sum_.pressure += p.pressure;
    sum_.height += p.height;
    if (++samples_ < samples_per_point_) return;
    const auto n = static_cast<double>(samples_);
    points_.push_back({sum_.velocity / n, sum_.pressure / n, sum_.height / n});
    sum_ = {};
    samples_ = 0;
    if (points_.size() < k_max_points) return;
    for (std::size_t i = 0; i < k_max_points / 2; ++i) {
      const Point& a = points_[2 * i];
      const Point& b = points_[2 * i + 1];
      points_[i] = {0.5 * (a.velocity + b.velocity), 0.5 * (a.pressure + b.pressure),
                    0.5 * (a.height + b.height)};
    }
    points_.resize(k_max_points / 2);
    samples_per_point_ *= 2;
  }

  struct Branches {
    std::vector<Point> rising, falling;
  };
  /// Points by whether the flow grows or falls there; where it is held they belong to neither.
  [[nodiscard]] Branches branches() const {
    Branches b;
    double least = 0.0;
    double most = 0.0;
    for (const Point& p : points_) {
      least = std::min(least, p.velocity);
      most = std::max(most, p.velocity);
    }
    const double held = 1e-6 * (most - least);
    for (std::size_t n = 1; n + 1 < points_.size(); ++n) {
      const double change = points_[n + 1].velocity - points_[n - 1].velocity;
      if (change > held) b.rising.push_back(points_[n]);
      if (change < -held) b.falling.push_back(points_[n]);
    }
    return b;
  }
  static void write(sdk::FigureSink& sink, const std::string& name, const formula::Ramp& ramp,
                    int rank) {
    sink.figure(name + "by_pressure", ramp.by_pressure.velocity, "m/s", ramp.by_pressure.error,
                sdk::overview(sdk::Quantity::velocity, rank));
    sink.figure(name + "by_height", ramp.by_height.velocity, "m/s", ramp.by_height.error,
                sdk::detail(sdk::Quantity::velocity));
    sink.figure(name + "plateau", ramp.plateau, "Pa",
                sdk::error_beside(ramp.plateau, sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::pressure));
  }
  static void draw(sdk::ReportSink& sink, const std::string& name,
                   const std::vector<Point>& points) {
    std::vector<double> velocity;
    std::vector<double> pressure;
    std::vector<double> height;
    for (const Point& p : points) {
      velocity.push_back(p.velocity);
      pressure.push_back(p.pressure);
      height.push_back(p.height);
    }
    if (points.empty()) return;
    sink.curve("Pressure drop over the flow", "superficial velocity [m/s]", "pressure drop [Pa]",
               name, velocity, pressure);
    sink.curve("Bed height over the flow", "superficial velocity [m/s]", "height [m]", name,
               velocity, height);
  }

  Parameters p_;
  int axis_;
  std::vector<Point> points_;
  Point sum_;
  Point last_{0.0, 0.0, sdk::k_no_value};
  std::int64_t samples_per_point_ = 1;
  std::int64_t samples_ = 0;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MinimumFluidisation>(); }
