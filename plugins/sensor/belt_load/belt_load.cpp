// SPDX-License-Identifier: Apache-2.0
#include "belt_load.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <array>

namespace {

namespace formula = dust::model::belt_load;
namespace sdk = dust::sdk;

class BeltLoad final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 point;
    sdk::Vec3 direction;
    double length = 0.0;
    double width = 0.0;
    double height = 0.0;
    double belt_speed = 0.0;
    sdk::Vec3 up{0, 0, 1};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::point, "point", sdk::dimension::length,
             "Middle of the belt's top where the stretch looked at begins.");
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Direction in which the belt runs; its length does not matter.");
    s.number(&Parameters::length, "length", sdk::dimension::length, "Length of the stretch.")
        .symbol("L")
        .above(0);
    s.number(&Parameters::width, "width", sdk::dimension::length,
             "Width of the stretch, half on either side.")
        .above(0);
    s.number(&Parameters::height, "height", sdk::dimension::length,
             "Height over the belt up to which grains belong to its load.")
        .above(0);
    s.number(&Parameters::belt_speed, "belt_speed", sdk::dimension::velocity,
             "Speed of the belt, to compare the load's with; 0 = no comparison.")
        .optional();
    s.vector(&Parameters::up, "up", sdk::dimension::none,
             "Direction away from the belt; its length does not matter.")
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "belt_load",
            .version = "1.0",
            .summary = "Load of a stretch of belt: mass, flow, speed, and how far off the middle.",
            .equation = R"(\dot m = \frac{1}{L} \sum_i w_i m_i v_i,\quad )"
                        R"(\bar y = \frac{\sum_i w_i m_i y_i}{\sum_i w_i m_i})",
            .source = "own definition"};
  }

  explicit BeltLoad(const Parameters& p) : p_(p) {
    if (!(norm(p.direction) > 0.0)) throw sdk::ParameterError("'direction' must not be zero");
    along_ = p.direction / norm(p.direction);
    left_ = cross(p.up, along_);
    if (!(norm(left_) > 1e-6 * norm(p.up))) throw sdk::ParameterError("'up' is along the belt");
    left_ = left_ / norm(left_);
    up_ = cross(along_, left_);
  }

  [[nodiscard]] sdk::SurfacesWanted wanted_surfaces() const override {
    sdk::SurfacesWanted wanted;
    wanted.stretch = {p_.point + 0.5 * p_.length * along_, along_, p_.height};
    return wanted;
  }

  void observe(const sdk::WorldView& world) override {
    formula::Sums sums;
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const sdk::Vec3 q = sdk::Vec3{g.x[i], g.y[i], g.z[i]} - p_.point;
      const double x = dot(q, along_);
      const double y = dot(q, left_);
      const double z = dot(q, up_);
      if (x < 0.0 || x >= p_.length || std::abs(y) > 0.5 * p_.width || z < 0.0 || z >= p_.height)
        continue;
      const double speed = dot({g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]}, along_);
      sums += formula::Sums::of_grain(g.weight[i] * g.mass[i], y, speed);
    }
    values_ = {sums.mass / p_.length, sums.along / p_.length, formula::off_centre(sums),
               formula::half_width(sums), formula::speed(sums)};
    if (sums.mass > 0.0) curve_.add(world.time, values_[k_off_centre]);
    if (!sdk::is_after(world, p_.steady_after)) return;
    means_.add({values_.data(), k_off_centre}, world.interval);
    // Where nothing lies there is no place and no speed: such samples do not count for them.
    if (sums.mass > 0.0) {
      loaded_.add({values_.data() + k_off_centre, k_columns - k_off_centre}, world.interval);
    }
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t c = 0; c < k_columns; ++c)
      sink.figure(k_names[c], values_[c], k_units[c],
                  sdk::error_beside(values_[c], sdk::k_no_estimate), sdk::detail(k_quantities[c]));
  }

  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t c = 0; c < k_off_centre; ++c) {
      sink.figure(k_names[c], means_.known_mean(c), k_units[c], means_.error(c),
                  sdk::overview(k_quantities[c], c == 0 ? 2 : 1));
    }
    for (std::size_t c = k_off_centre; c < k_columns; ++c) {
      const std::size_t q = c - k_off_centre;
      const double mean = loaded_.known_mean(q);
      sink.figure(k_names[c], mean, k_units[c], sdk::error_beside(mean, loaded_.error(q)),
                  q == 0 ? sdk::overview(k_quantities[c], 3) : sdk::detail(k_quantities[c]));
    }
    if (p_.belt_speed == 0.0) return;
    const double ratio = loaded_.known_mean(2) / p_.belt_speed;
    sink.figure("speed_over_belt_speed", ratio, "1",
                sdk::error_beside(
                    ratio, sdk::scaled_error(loaded_.error(2), 1.0 / std::abs(p_.belt_speed))),
                sdk::overview(sdk::Quantity::ratio, 4));
  }

  void report(sdk::ReportSink& sink) const override {
    sink.curve("Load off the middle of the belt", "time [s]", "to the left [m]", "centre of mass",
               curve_.x(), curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    means_.save(a, "means");
    loaded_.save(a, "loaded");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    const auto values = a.numbers("values");
    std::copy_n(values.begin(), std::min(values.size(), values_.size()), values_.begin());
    means_.load(a, "means");
    loaded_.load(a, "loaded");
    curve_.load(a, "curve");
  }

 private:
  static constexpr std::size_t k_off_centre = 2;  ///< the first that only a load has
  static constexpr std::size_t k_columns = 5;
  static constexpr const char* k_names[k_columns] = {"mass_per_length", "mass_flow", "off_centre",
                                                     "half_width", "speed"};
  static constexpr const char* k_units[k_columns] = {"kg/m", "kg/s", "m", "m", "m/s"};
  static constexpr sdk::Quantity k_quantities[k_columns] = {
      sdk::Quantity::mass_per_length, sdk::Quantity::mass_rate, sdk::Quantity::length,
      sdk::Quantity::length, sdk::Quantity::velocity};

  Parameters p_;
  sdk::Vec3 along_, left_, up_;
  std::array<double, k_columns> values_{};  ///< at the last sample
  sdk::BatchMeans means_{k_off_centre};
  sdk::BatchMeans loaded_{k_columns - k_off_centre};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<BeltLoad>(); }
