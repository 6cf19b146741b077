// SPDX-License-Identifier: Apache-2.0
#include "blockage.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/stays.hpp>

#include <array>
#include <cstdio>

namespace {

namespace formula = dust::model::blockage;
namespace sdk = dust::sdk;

class Blockage final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
    double largest_mass = 0.0;
    double largest_growth = 0.02;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the region, the inside of a chute for example.");
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the region.");
    s.number(&Parameters::largest_mass, "largest_mass", sdk::dimension::mass,
             "Mass held above which the region counts as blocked; 0 = no such limit.")
        .at_least(0)
        .optional();
    s.number(&Parameters::largest_growth, "largest_growth", sdk::dimension::none,
             "Share of what comes in that may stay, above which the region counts as filling.")
        .at_least(0)
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "blockage",
            .version = "1.0",
            .summary = "Whether a chute fills: mass held, how it grows, flow in and out.",
            .equation = R"(\dot M = \dot m_{in} - \dot m_{out})",
            .source = "own definition"};
  }

  explicit Blockage(const Parameters& p) : p_(p), region_(p.min, p.max) {
    if (!(p.max.x > p.min.x && p.max.y > p.min.y && p.max.z > p.min.z)) {
      throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
    }
  }

  void begin(const sdk::WorldView& world) override {
    region_.begin(world, [&](double diameter) { return p_.takes(diameter); });
  }
  void observe(const sdk::WorldView& world) override {
    double in = 0.0;
    double out = 0.0;
    region_.update(
        world, [&](double diameter) { return p_.takes(diameter); },
        [&](const sdk::Stay& stay) { in += stay.mass; },
        [&](const sdk::Stay& stay, double) { out += stay.mass; });
    const double mass = region_.mass();
    const double per_time = world.interval > 0.0 ? 1.0 / world.interval : 0.0;
    values_ = {mass, in * per_time, out * per_time};
    if (world.interval > 0.0) row_.add({values_.data() + 1, 2}, world.interval);
    curve_.add(world.time, mass);
    if (p_.largest_mass > 0.0 && mass > p_.largest_mass) {
      if (time_beyond_ == 0.0) first_beyond_ = world.time;
      time_beyond_ += world.interval;
    }
    if (!sdk::is_after(world, p_.steady_after)) return;
    means_.add(values_, world.interval);
    largest_ = std::max(largest_, mass);
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass_held", values_[0], "kg", -1.0, stock());
    sink.figure("inflow", row_.mean(0), "kg/s", -1.0, k_flow);
    sink.figure("outflow", row_.mean(1), "kg/s", -1.0, k_flow);
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view column) const override {
    return column == "mass_held" ? sdk::RowValue::instant : sdk::RowValue::mean;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    const formula::Trend growth = trend();
    sdk::FigureRole held = stock();
    const sdk::FigureRole first = sdk::overview(sdk::Quantity::mass, 1);
    held.towards = first.towards;
    held.index = first.index;
    const auto mean = [&](const char* name, std::size_t column, const char* unit,
                          const sdk::FigureRole& role) {
      const double value = means_.known_mean(column);
      sink.figure(name, value, unit, sdk::error_beside(value, means_.error(column)), role);
    };
    mean("mass_held", 0, "kg", held);
    sink.figure("mass_held_at_end", values_[0], "kg", -1.0, stock());
    sink.figure("mass_held_largest", largest_, "kg", -1.0, stock());
    mean("inflow", 1, "kg/s", k_flow);
    mean("outflow", 2, "kg/s", k_flow);
    sink.figure("growth", growth.slope, "kg/s", growth.error,
                sdk::overview(sdk::Quantity::mass_rate, 2));
    const double share = means_.mean(1) > 0.0 ? growth.slope / means_.mean(1) : sdk::k_no_value;
    const double share_error =
        means_.mean(1) > 0.0 && growth.error >= 0.0 ? growth.error / means_.mean(1) : -1.0;
    sink.figure("growth_over_inflow", share, "1", sdk::error_beside(share, share_error),
                sdk::detail(sdk::Quantity::ratio));
    const double allowed = p_.largest_growth > 0.0 ? share / p_.largest_growth : 0.0;
    sink.figure("growth_over_allowed", allowed, "1", sdk::error_beside(allowed, sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::ratio));
    sink.figure("is_filling", is_filling(growth) ? 1.0 : 0.0, "1", -1.0,
                sdk::detail(sdk::Quantity::number));
    sink.figure("mass_over_largest_mass", p_.largest_mass > 0.0 ? largest_ / p_.largest_mass : 0.0,
                "1", -1.0, sdk::detail(sdk::Quantity::ratio));
    sink.figure("time_beyond_largest_mass", time_beyond_, "s", -1.0,
                sdk::detail(sdk::Quantity::time));
    const double first_beyond = time_beyond_ > 0.0 ? first_beyond_ : sdk::k_no_value;
    sink.figure("first_beyond_largest_mass", first_beyond, "s",
                sdk::error_beside(first_beyond, sdk::k_no_estimate),
                sdk::detail(sdk::Quantity::time));
  }

  void report(sdk::ReportSink& sink) const override {
    if (!(means_.mean(1) > 0.0)) return;  // nothing came yet
    sink.section("Does it fill?", verdict());
    sink.curve("Mass held", "time [s]", "mass held [kg]", "in the region", curve_.x(), curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    const double numbers[] = {values_[0], values_[1],   values_[2],
                              largest_,   time_beyond_, first_beyond_};
    a.numbers("numbers", numbers);
    region_.save(a, "region");
    row_.save(a, "row");
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    const auto n = a.numbers("numbers");
    values_ = {n.at(0), n.at(1), n.at(2)};
    largest_ = n.at(3), time_beyond_ = n.at(4), first_beyond_ = n.at(5);
    region_.load(a, "region");
    row_.load(a, "row");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr sdk::FigureRole k_flow = sdk::detail(sdk::Quantity::mass_rate);

  [[nodiscard]] sdk::FigureRole stock() const {
    return p_.sized({.role = sdk::Role::stock}).of(sdk::Quantity::mass);
  }
  [[nodiscard]] formula::Trend trend() const {
    return formula::trend(curve_.x(), curve_.y(), p_.steady_after);
  }
  [[nodiscard]] bool is_filling(const formula::Trend& growth) const {
    return formula::is_filling(growth, means_.mean(1), p_.largest_growth);
  }

  /// What the report says, in tonnes per hour.
  [[nodiscard]] std::string verdict() const {
    constexpr double k_tonnes_per_hour = 3.6;
    const formula::Trend growth = trend();
    char text[400];
    std::snprintf(text, sizeof text,
                  "%.3g t/h come in, %.3g t/h go out; the mass held, %.3g kg, %s by %.2g t/h",
                  k_tonnes_per_hour * means_.mean(1), k_tonnes_per_hour * means_.mean(2),
                  means_.mean(0), growth.slope < 0.0 ? "falls" : "grows",
                  k_tonnes_per_hour * std::abs(growth.slope));
    std::string all = is_filling(growth) || time_beyond_ > 0.0 ? "Yes: " : "No: ";
    all += text;
    if (growth.error >= 0.0) {
      std::snprintf(text, sizeof text, " with a standard error of %.2g",
                    k_tonnes_per_hour * growth.error);
      all += text;
    }
    all += '.';
    if (p_.largest_mass <= 0.0) return all;
    if (time_beyond_ == 0.0) {
      std::snprintf(text, sizeof text, " It never held more than %.3g kg.", p_.largest_mass);
    } else {
      std::snprintf(text, sizeof text, " From %.3g s on it held more than %.3g kg, for %.3g s.",
                    first_beyond_, p_.largest_mass, time_beyond_);
    }
    return all + text;
  }

  Parameters p_;
  sdk::Stays region_;
  std::array<double, 3> values_{};  ///< mass held [kg], flow in and out [kg/s], last sample
  double largest_ = 0.0;            ///< [kg] while steady
  double time_beyond_ = 0.0;        ///< [s]
  double first_beyond_ = 0.0;       ///< [s] 0 = never
  sdk::RowMeans row_{2};
  sdk::BatchMeans means_{3};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Blockage>(); }
