// SPDX-License-Identifier: Apache-2.0
#include "residence_time.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/stays.hpp>

#include <array>
#include <limits>
#include <vector>

namespace {

namespace formula = dust::model::residence_time;
namespace sdk = dust::sdk;

constexpr double k_far = std::numeric_limits<double>::infinity();
constexpr sdk::Vec3 k_lowest{-k_far, -k_far, -k_far};
constexpr sdk::Vec3 k_highest{k_far, k_far, k_far};

class ResidenceTime final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
    std::string from = "entering";
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the box that grains stay in; without a box: the whole domain.")
        .optional();
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.")
        .optional();
    s.text(&Parameters::from, "from",
           "What the time is counted from: entering the box, or birth at an emitter.")
        .one_of({"entering", "birth"})
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "residence_time",
            .version = "1.0",
            .summary = "How long grains stay in a box: mean, quantiles, distribution by mass.",
            .equation = R"(\bar t = \frac{\sum_i w_i m_i (t_{i,out} - t_{i,in})}{\sum_i w_i m_i})",
            .source = "Danckwerts, Chem. Eng. Sci. 2 (1953) 1, doi:10.1016/0009-2509(53)80001-1"};
  }

  explicit ResidenceTime(const Parameters& p)
      : p_(p),
        box_(has_box(p) ? p.min : k_lowest, has_box(p) ? p.max : k_highest),
        domain_(k_lowest, k_highest) {
    if (has_box(p) && !(p.max.x > p.min.x && p.max.y > p.min.y && p.max.z > p.min.z)) {
      throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
    }
  }

  void begin(const sdk::WorldView& world) override {
    const auto takes = [&](double diameter) { return p_.takes(diameter); };
    box_.begin(world, takes);
    if (is_from_birth()) domain_.begin(world, takes);
  }
  void observe(const sdk::WorldView& world) override {
    if (!times_.has_unit() && world.interval > 0.0) times_.set_unit(world.interval);
    const double begin = world.time - world.interval;
    double left = 0.0;
    box_.update(
        world, [&](double diameter) { return p_.takes(diameter); }, [](const sdk::Stay&) {},
        [&](const sdk::Stay& stay, double gone) {
          left += stay.mass;
          const double time = beyond_.left_at(stay.id, gone);
          const double came = since(stay, begin);
          if (time < p_.steady_after || came == sdk::Stay::k_unknown) return;
          times_.add(stay.mass, time - came);
        });
    if (is_from_birth()) {
      domain_.update(
          world, [&](double diameter) { return p_.takes(diameter); }, [](const sdk::Stay&) {},
          [](const sdk::Stay&, double) {});
    }
    if (!has_box(p_)) beyond_.look(world);
    oldest_ = 0.0;
    double inside = 0.0;
    for (const sdk::Stay& stay : box_.all()) {
      if (beyond_.holds(stay.id)) continue;
      inside += stay.mass;
      const double came = since(stay, begin);
      if (came > sdk::Stay::k_unknown) oldest_ = std::max(oldest_, world.time - came);
    }
    values_ = {inside, world.interval > 0.0 ? left / world.interval : 0.0};
    if (world.interval > 0.0) row_.add({&values_[1], 1}, world.interval);
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass_inside", values_[0], "kg", -1.0, stock(sdk::Quantity::mass));
    sink.figure("mass_flow_out", row_.mean(0), "kg/s", -1.0, sdk::detail(sdk::Quantity::mass_rate));
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view column) const override {
    return column == "mass_inside" ? sdk::RowValue::instant : sdk::RowValue::mean;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    const sdk::FigureRole time = sdk::detail(sdk::Quantity::time);
    const auto figure = [&](const char* name, double value, double error,
                            const sdk::FigureRole& role) {
      sink.figure(name, value, "s", sdk::error_beside(value, error), role);
    };
    figure("mean", times_.mean(), times_.mean_error(), sdk::overview(sdk::Quantity::time, 1));
    figure("standard_deviation", times_.deviation(), sdk::k_no_estimate, time);
    constexpr std::array k_quantiles = {std::pair{"fastest_5_percent", 0.05},
                                        std::pair{"median", 0.5}, std::pair{"percent_95", 0.95}};
    for (const auto& [name, p] : k_quantiles) {
      figure(name, times_.quantile(p), times_.quantile_error(p), time);
    }
    sink.figure("grains", times_.count(), "1", -1.0, sdk::detail(sdk::Quantity::number));
    const double mass = means_.known_mean(0);
    const double flow = means_.known_mean(1);
    sink.figure("mass_inside", mass, "kg", sdk::error_beside(mass, means_.error(0)),
                stock(sdk::Quantity::mass));
    sink.figure("mass_flow_out", flow, "kg/s", sdk::error_beside(flow, means_.error(1)),
                sdk::detail(sdk::Quantity::mass_rate));
    figure("holdup_over_flow", formula::holdup_time(mass, flow), sdk::k_no_estimate, time);
    sink.figure("longest_inside", oldest_, "s", -1.0, time);
  }

  void report(sdk::ReportSink& sink) const override {
    if (!(times_.mass() > 0.0)) return;
    const std::array<std::string, 2> columns = {"mass that has left [%]", "after [s]"};
    for (const double percent : {5.0, 10.0, 25.0, 50.0, 75.0, 90.0, 95.0, 99.0}) {
      const std::array<double, 2> row = {percent, times_.quantile(0.01 * percent)};
      sink.row("Residence time", columns, row);
    }
    const double last = times_.quantile(0.995);
    std::vector<double> edges;
    std::vector<double> heights;
    for (std::size_t n = 0; n <= k_columns; ++n) {
      edges.push_back(last * static_cast<double>(n) / k_columns);
      if (n == 0) continue;
      const double width = edges[n] - edges[n - 1];
      heights.push_back(times_.mass_between(edges[n - 1], edges[n]) / (times_.mass() * width));
    }
    sink.histogram("Residence time", "time [s]", "share of the mass per time [1/s]", "by mass",
                   edges, heights);
  }

  void save(sdk::ArchiveWriter& a) const override {
    std::vector<double> last = {values_[0], values_[1], oldest_};
    beyond_.append_to(last);
    a.numbers("last", last);
    a.numbers("times", times_.numbers());
    box_.save(a, "box");
    domain_.save(a, "domain");
    row_.save(a, "row");
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    const auto last = a.numbers("last");
    values_ = {last.at(0), last.at(1)};
    oldest_ = last.at(2);
    beyond_.take_from(last, 3);
    times_.set_numbers(a.numbers("times"));
    box_.load(a, "box");
    domain_.load(a, "domain");
    row_.load(a, "row");
    means_.load(a, "means");
  }

 private:
  static constexpr std::size_t k_columns = 40;  ///< of the histogram

  static bool has_box(const Parameters& p) { return norm(p.min) > 0.0 || norm(p.max) > 0.0; }
  /// In the whole domain a grain is born as it enters.
  [[nodiscard]] bool is_from_birth() const { return p_.from == "birth" && has_box(p_); }
  [[nodiscard]] sdk::FigureRole stock(sdk::Quantity quantity) const {
    return p_.sized({.role = sdk::Role::stock}).of(quantity);
  }
  /// [s] From when the grain's time counts; one that is not known was born in this interval, which
  /// began at `begin`.
  [[nodiscard]] double since(const sdk::Stay& stay, double begin) const {
    if (!is_from_birth()) return stay.since;
    const sdk::Stay* known = domain_.find(stay.id);
    return known != nullptr ? known->since : begin;
  }

  Parameters p_;
  sdk::Stays box_;
  sdk::Stays domain_;  ///< all grains since their births; only where the time counts from there
  formula::Beyond beyond_;  ///< only where the box is the whole domain
  formula::Distribution times_;
  double oldest_ = 0.0;             ///< [s] at the last sample
  std::array<double, 2> values_{};  ///< mass inside [kg], flow out [kg/s] at the last sample
  sdk::RowMeans row_{1};
  sdk::BatchMeans means_{2};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<ResidenceTime>(); }
