// SPDX-License-Identifier: Apache-2.0
#include "carry_back.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <limits>

namespace {

namespace formula = dust::model::carry_back;
namespace sdk = dust::sdk;

class CarryBack final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
    sdk::Vec3 direction{-1.0, 0.0, 0.0};
    double faster_than = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the layer along the return run.");
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the layer.");
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Direction in which the return run moves, along one axis.")
        .symbol("d")
        .optional();
    s.number(&Parameters::faster_than, "faster_than", sdk::dimension::velocity,
             "Only grains that move faster than this along the direction ride on the belt.")
        .at_least(0)
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "carry_back",
            .version = "1.0",
            .summary = "Mass flow that rides back with the return run of a belt, by size class.",
            .equation = R"(\dot m = \frac{1}{L} \sum_i w_i m_i \mathbf{v}_i \cdot \mathbf{d})",
            .source = "own definition"};
  }

  explicit CarryBack(const Parameters& p) : p_(p) {
    const sdk::Vec3 extent = p.max - p.min;
    if (!(extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0)) {
      throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
    }
    const sdk::Vec3 d = p.direction;
    const int axes = (d.x != 0.0) + (d.y != 0.0) + (d.z != 0.0);
    if (axes != 1)
      throw sdk::ParameterError("'direction' must lie along one axis, e.g. [-1, 0, 0]");
    p_.direction = d / norm(d);
    length_ = formula::extent_along(extent.x, extent.y, extent.z, p_.direction.x, p_.direction.y,
                                    p_.direction.z);
  }

  void begin(const sdk::WorldView& world) override { emitted_mass_ = world.emitted_mass; }
  void observe(const sdk::WorldView& world) override {
    if (classes_.empty() && !world.class_diameters.empty()) {
      classes_.assign(world.class_diameters.begin(), world.class_diameters.end());
      means_ = sdk::BatchMeans(k_columns * (1 + classes_.size()) + 1);
    }
    values_.assign(means_.columns(), 0.0);
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const sdk::Vec3 x{g.x[i], g.y[i], g.z[i]};
      if (!is_inside(x)) continue;
      const double speed = dot({g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]}, p_.direction);
      if (speed <= p_.faster_than) continue;
      add(0, g.weight[i], g.mass[i], speed);
      if (!classes_.empty()) {
        add(1 + sdk::nearest_class(g.diameter[i], classes_), g.weight[i], g.mass[i], speed);
      }
    }
    if (knows_feed() && world.interval > 0.0) {
      values_.back() = (world.emitted_mass - emitted_mass_) / world.interval;
    }
    if (sdk::is_after(world, p_.steady_after)) {
      if (emitted_before_ < 0.0) emitted_before_ = emitted_mass_;
      means_.add(values_, world.interval);
    }
    emitted_mass_ = world.emitted_mass;
    curve_.add(world.time, values_[0]);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass_flow", values_[0], "kg/s", -1.0, k_flow.of(sdk::Quantity::mass_rate));
    sink.figure("mass", values_[2], "kg", -1.0, k_stock.of(sdk::Quantity::mass));
  }

  void summary(sdk::FigureSink& sink) const override {
    figures_of("", 0, 0.0, sink);
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      figures_of(sdk::class_name(classes_[c]) + "/", c + 1, classes_[c], sink);
    }
  }

  void report(sdk::ReportSink& sink) const override {
    sink.curve("Carried back", "time [s]", "mass flow [kg/s]", "all grains", curve_.x(),
               curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    const double emitted[] = {emitted_mass_, emitted_before_};
    a.numbers("classes", classes_);
    a.numbers("values", values_);
    a.numbers("emitted", emitted);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    classes_ = a.numbers("classes");
    values_ = a.numbers("values");
    const std::vector<double> emitted = a.numbers("emitted");
    emitted_mass_ = emitted.at(0);
    emitted_before_ = emitted.at(1);
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr std::size_t k_columns = 4;  ///< mass flow, number flow, mass, number
  static constexpr sdk::FigureRole k_flow{
      .role = sdk::Role::passage, .direction = sdk::Direction::forward, .towards = "carry_back"};
  static constexpr sdk::FigureRole k_stock{.role = sdk::Role::stock};

  [[nodiscard]] bool is_inside(sdk::Vec3 x) const {
    return x.x >= p_.min.x && x.x < p_.max.x && x.y >= p_.min.y && x.y < p_.max.y &&
           x.z >= p_.min.z && x.z < p_.max.z;
  }

  void add(std::size_t group, double weight, double mass, double speed) {
    double* v = values_.data() + k_columns * group;
    v[0] += formula::mass_flow(weight * mass, speed, length_);
    v[1] += formula::mass_flow(weight, speed, length_);
    v[2] += weight * mass;
    v[3] += weight;
  }

  /// Whether the mass emitted is among the means, after all groups: not in older checkpoints.
  [[nodiscard]] bool knows_feed() const { return means_.columns() % k_columns == 1; }
  /// Mass emitted while the means were taken.
  [[nodiscard]] double emitted() const {
    return emitted_before_ < 0.0 ? 0.0 : emitted_mass_ - emitted_before_;
  }

  /// `diameter` of the size class [m]; 0 = all.
  void figures_of(const std::string& prefix, std::size_t group, double diameter,
                  sdk::FigureSink& sink) const {
    static constexpr const char* k_names[k_columns] = {"mass_flow", "number_flow", "mean_mass",
                                                       "mean_number"};
    static constexpr const char* k_units[k_columns] = {"kg/s", "1/s", "kg", "1"};
    static constexpr sdk::FigureRole k_roles[k_columns] = {
        k_flow.of(sdk::Quantity::mass_rate), k_flow.of(sdk::Quantity::number_rate),
        k_stock.of(sdk::Quantity::mass), k_stock.of(sdk::Quantity::number)};
    const std::size_t first = k_columns * group;
    const auto error = [&](std::size_t column) {
      return means_.mean(column) > 0.0 ? means_.error(column) : sdk::k_no_estimate;
    };
    for (std::size_t q = 0; q < k_columns; ++q) {
      sink.figure(prefix + k_names[q], means_.known_mean(first + q), k_units[q], error(first + q),
                  k_roles[q].sizes(diameter, diameter));
    }
    constexpr double k_grams_per_tonne = 1e6;
    const auto role = k_flow.of(sdk::Quantity::mass_per_load).sizes(diameter, diameter);
    const bool is_without_feed = means_.duration() > 0.0 && !(emitted() > 0.0);
    if (is_without_feed ||
        (knows_feed() && means_.is_uneven(means_.columns() - 1, emitted_before_))) {
      const bool is_nothing =
          is_without_feed && !(emitted_before_ > 0.0) && !(means_.mean(first) > 0.0);
      sink.figure(prefix + "grams_per_tonne", sdk::k_no_value, "g/t",
                  is_nothing ? sdk::k_nothing_passed : sdk::k_feed_not_even, role);
      return;
    }
    const double per_flow =
        emitted() > 0.0 ? k_grams_per_tonne * means_.duration() / emitted() : 0.0;
    // Of a batch the load is known; that of a feed varies with what is carried back.
    const std::size_t feed = means_.columns() - 1;
    const bool is_of_feed = knows_feed() && means_.mean(first) > 0.0 && means_.is_even(feed);
    sink.figure(prefix + "grams_per_tonne", means_.known_mean(first) * per_flow, "g/t",
                is_of_feed ? sdk::scaled_error(means_.ratio_error(first, feed), k_grams_per_tonne)
                           : sdk::scaled_error(error(first), per_flow),
                role);
  }

  Parameters p_;
  double length_ = 1.0;
  std::vector<double> classes_;
  std::vector<double> values_ = std::vector<double>(k_columns + 1, 0.0);  ///< at the last sample
  double emitted_mass_ = 0.0;     ///< [kg] until the last sample
  double emitted_before_ = -1.0;  ///< [kg] until the first steady sample; -1 before it
  sdk::BatchMeans means_{k_columns + 1};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<CarryBack>(); }
