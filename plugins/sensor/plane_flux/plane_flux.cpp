// SPDX-License-Identifier: Apache-2.0
#include "plane_flux.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/rectangle.hpp>
#include <dust/sdk/sampling.hpp>

#include <limits>

namespace {

namespace formula = dust::model::plane_flux;
namespace sdk = dust::sdk;

class PlaneFlux final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 point;
    sdk::Vec3 normal;
    sdk::Vec3 min;
    sdk::Vec3 max;
    std::string role = "passage";
    std::string towards;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::point, "point", sdk::dimension::length, "A point of the plane.");
    s.vector(&Parameters::normal, "normal", sdk::dimension::none,
             "Normal of the plane; passages along it count as forward.")
        .symbol("n");
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the box that cuts the rectangle out of the plane.");
    s.vector(&Parameters::max, "max", sdk::dimension::length,
             "Upper corner of that box; may equal 'min' along the normal.");
    s.text(&Parameters::role, "role",
           "What the rectangle is: an opening, through which grains leave the plant, or a place "
           "inside that they pass.")
        .one_of({"passage", "opening"})
        .optional();
    s.text(&Parameters::towards, "towards",
           "The total that its net figures are a part of, for example 'product'; of an opening "
           "'emission' unless given.")
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "plane_flux",
            .version = "1.0",
            .summary = "Number and mass that pass a rectangle, by size class and direction.",
            .equation = R"(\dot m = \frac{1}{T} \sum_{\mathrm{passages}} \pm w_i m_i)",
            .source = "own definition"};
  }

  explicit PlaneFlux(const Parameters& p) : p_(p), rectangle_(p.point, p.normal, p.min, p.max) {
    if (p_.role == "opening" && p_.towards.empty()) p_.towards = "emission";
  }

  void begin(const sdk::WorldView& world) override { emitted_mass_ = world.emitted_mass; }
  void observe(const sdk::WorldView& world) override {
    if (classes_.empty() && !world.class_diameters.empty()) {
      classes_.assign(world.class_diameters.begin(), world.class_diameters.end());
      resize(1 + classes_.size());
    }
    std::vector<double>& passed = values_;
    passed.assign(means_.columns(), 0.0);
    const bool is_steady = sdk::is_after(world, p_.steady_after);
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      const int direction = rectangle_.passage_of(world, i);
      if (direction == 0) continue;
      count(0, direction, g.weight[i], g.mass[i], is_steady);
      if (!classes_.empty()) {
        count(1 + sdk::nearest_class(g.diameter[i], classes_), direction, g.weight[i], g.mass[i],
              is_steady);
      }
    }
    if (knows_feed()) passed.back() = world.emitted_mass - emitted_mass_;
    for (int way = 0; way < 2; ++way) mass_so_far_[way] += passed[k_ways * k_mass + way];
    if (world.interval > 0.0) {
      for (double& v : passed) v /= world.interval;
      const double rate = passed[k_ways * k_mass + k_net];
      row_.add({&rate, 1}, world.interval);
      curve_.add(world.time, rate);
    }
    if (is_steady) {
      if (emitted_before_ < 0.0) emitted_before_ = emitted_mass_;
      means_.add(passed, world.interval);
    }
    emitted_mass_ = world.emitted_mass;
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("net/mass_rate", row_.mean(0), "kg/s", -1.0,
                p_.sized(role_of(k_net).of(sdk::Quantity::mass_rate)));
    masses_of(sink);
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view column) const override {
    return column == "net/mass_rate" ? sdk::RowValue::mean : sdk::RowValue::total;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    masses_of(sink);
    sink.figure(
        "observed_time", means_.duration(), "s", -1.0,
        {.role = sdk::Role::observed_time, .quantity = sdk::Quantity::time, .towards = p_.towards});
    rates_of("", 0, p_.coarser_than, p_.finer_than, sink);
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!p_.takes(classes_[c])) continue;
      rates_of(sdk::class_name(classes_[c]) + "/", c + 1, classes_[c], classes_[c], sink);
    }
  }

  void report(sdk::ReportSink& sink) const override {
    sink.curve("Flux through the plane", "time [s]", "net mass rate [kg/s]", "all grains",
               curve_.x(), curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("classes", classes_);
    a.numbers("squares", squares_);
    a.numbers("mass_so_far", mass_so_far_);
    row_.save(a, "row");
    const double emitted[] = {emitted_mass_, emitted_before_};
    a.numbers("emitted", emitted);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    classes_ = a.numbers("classes");
    squares_ = a.numbers("squares");
    mass_so_far_ = a.numbers("mass_so_far");
    row_.load(a, "row");
    const std::vector<double> emitted = a.numbers("emitted");
    emitted_mass_ = emitted.at(0);
    emitted_before_ = emitted.at(1);
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  // Columns of a group: number forward, backward, net; mass forward, backward, net. After all
  // groups the mass emitted.
  static constexpr std::size_t k_ways = 3;
  static constexpr std::size_t k_net = 2;
  static constexpr std::size_t k_mass = 1;
  static constexpr std::size_t k_columns = 2 * k_ways;

  void resize(std::size_t groups) {
    means_ = sdk::BatchMeans(k_columns * groups + 1);
    squares_.assign(k_columns * groups, 0.0);
  }

  void count(std::size_t group, int direction, double weight, double mass, bool is_steady) {
    const double amounts[2] = {weight, weight * mass};
    for (std::size_t q = 0; q < 2; ++q) {
      const std::size_t column = k_columns * group + k_ways * q;
      const std::size_t way = direction > 0 ? 0 : 1;
      values_[column + way] += amounts[q];
      values_[column + k_net] += direction * amounts[q];
      if (!is_steady) continue;
      squares_[column + way] += amounts[q] * amounts[q];
      squares_[column + k_net] += amounts[q] * amounts[q];
    }
  }

  /// Only what is left of both ways counts towards a total.
  [[nodiscard]] sdk::FigureRole role_of(std::size_t way) const {
    static constexpr sdk::Direction k_directions[k_ways] = {
        sdk::Direction::forward, sdk::Direction::backward, sdk::Direction::net};
    sdk::FigureRole role;
    role.role = p_.role == "opening" ? sdk::Role::opening : sdk::Role::passage;
    role.direction = k_directions[way];
    if (way == k_net) role.towards = p_.towards;
    return role;
  }
  void masses_of(sdk::FigureSink& sink) const {
    sink.figure("forward/mass", mass_so_far_[0], "kg", -1.0,
                p_.sized(role_of(0).of(sdk::Quantity::mass)));
    sink.figure("backward/mass", mass_so_far_[1], "kg", -1.0,
                p_.sized(role_of(1).of(sdk::Quantity::mass)));
  }

  /// Whether the mass emitted is among the means: not in those of older checkpoints.
  [[nodiscard]] bool knows_feed() const { return means_.columns() % k_columns == 1; }
  /// `rate`: its place among the means, `counted` as in rates_of(); `error` is that of the rate.
  void per_load_of(const std::string& name, std::size_t rate, double counted, double error,
                   const sdk::FigureRole& role, sdk::FigureSink& sink) const {
    const double duration = means_.duration();
    const double emitted = emitted_before_ < 0.0 ? 0.0 : emitted_mass_ - emitted_before_;
    const bool is_without_feed = duration > 0.0 && !(emitted > 0.0);
    if (is_without_feed ||
        (knows_feed() && means_.is_uneven(means_.columns() - 1, emitted_before_))) {
      const bool is_nothing = is_without_feed && !(emitted_before_ > 0.0) && !(counted > 0.0);
      sink.figure(name, sdk::k_no_value, "g/t",
                  is_nothing ? sdk::k_nothing_passed : sdk::k_feed_not_even, role);
      return;
    }
    const double value = duration > 0.0
                             ? formula::grams_per_tonne(means_.mean(rate), duration, emitted)
                             : means_.known_mean(rate);
    // Of a batch the load is known; that of a feed varies with what passes.
    if (knows_feed() && emitted > 0.0 && means_.is_even(means_.columns() - 1)) {
      const double of_ratio = means_.ratio_error(rate, means_.columns() - 1);
      error = formula::rate_error(of_ratio < 0.0 ? of_ratio : of_ratio * emitted / duration,
                                  counted * duration, squares_[rate], duration);
    }
    if (error >= 0.0) {
      error =
          emitted > 0.0 ? formula::grams_per_tonne(error, duration, emitted) : sdk::k_no_estimate;
    }
    sink.figure(name, value, "g/t", error, role);
  }

  /// `smallest` and `largest` diameter of the group [m].
  void rates_of(const std::string& prefix, std::size_t group, double smallest, double largest,
                sdk::FigureSink& sink) const {
    static constexpr const char* k_way_names[k_ways] = {"forward/", "backward/", "net/"};
    static constexpr const char* k_quantities[2] = {"number_rate", "mass_rate"};
    static constexpr const char* k_units[2] = {"1/s", "kg/s"};
    static constexpr sdk::Quantity k_what[2] = {sdk::Quantity::number_rate,
                                                sdk::Quantity::mass_rate};
    const double duration = means_.duration();
    for (std::size_t way = 0; way < k_ways; ++way) {
      const sdk::FigureRole role = role_of(way).sizes(smallest, largest);
      for (std::size_t q = 0; q < 2; ++q) {
        const std::size_t first = k_columns * group + k_ways * q;
        // Both directions together tell how many grains a net rate rests on.
        const double counted =
            way == k_net ? means_.mean(first) + means_.mean(first + 1) : means_.mean(first + way);
        const double error = formula::rate_error(means_.error(first + way), counted * duration,
                                                 squares_[first + way], duration);
        sdk::FigureRole as_reported = role.of(k_what[q]);
        // What is part of a total says so, and stands with it.
        if (way == k_net && q == k_mass && prefix.empty() && as_reported.towards.empty()) {
          as_reported.towards = sdk::overview(k_what[q], 1).towards;
          as_reported.index = 1;
        }
        sink.figure(prefix + k_way_names[way] + k_quantities[q], means_.known_mean(first + way),
                    k_units[q], error, as_reported);
        if (q != k_mass) continue;
        per_load_of(prefix + k_way_names[way] + "grams_per_tonne", first + way, counted, error,
                    role.of(sdk::Quantity::mass_per_load), sink);
      }
    }
  }

  Parameters p_;
  sdk::Rectangle rectangle_;
  std::vector<double> classes_;
  std::vector<double> values_;  ///< what passed during one sample; no state between calls
  std::vector<double> squares_ = std::vector<double>(k_columns, 0.0);
  std::vector<double> mass_so_far_ = {0.0, 0.0};  ///< [kg] forward, backward, since the start
  sdk::RowMeans row_{1};                          ///< [kg/s] net
  double emitted_mass_ = 0.0;                     ///< [kg] until the last sample
  double emitted_before_ = -1.0;  ///< [kg] until the first steady sample; -1 before it
  sdk::BatchMeans means_{k_columns + 1};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<PlaneFlux>(); }
