// SPDX-License-Identifier: Apache-2.0
#include "spillage.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/rectangle.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::spillage;
namespace sdk = dust::sdk;

class Spillage final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the level that spilt grains fall through.");
    s.vector(&Parameters::max, "max", sdk::dimension::length,
             "Upper corner; equal to 'min' along the axis that gravity pulls along.");
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "spillage",
            .version = "1.0",
            .summary = "Mass that falls beside the belt, per hour and per tonne of load.",
            .equation = R"(\dot m = \frac{3600}{T} \sum_{\mathrm{falls}} w_i m_i)",
            .source = "own definition"};
  }

  explicit Spillage(const Parameters& p)
      : p_(p),
        axis_(formula::axis_across(p.min, p.max)),
        level_(p.min, formula::unit_vector(axis_), p.min, p.max) {}

  void begin(const sdk::WorldView& world) override { emitted_ = world.emitted_mass; }
  void observe(const sdk::WorldView& world) override {
    const sdk::GrainColumns& g = world.grains;
    const bool is_steady = sdk::is_after(world, p_.steady_after);
    const double pull = world.gravity[axis_];
    if (pull == 0.0) {
      throw sdk::ModelError(std::string("gravity does not pull along ") + "xyz"[axis_] +
                            ", through the level: nothing falls through it");
    }
    double fell = 0.0;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      if (!(pull * level_.passage_of(world, i) > 0.0)) continue;
      const double mass = g.weight[i] * g.mass[i];
      fell += mass;
      if (!is_steady) continue;
      count_ += g.weight[i];
      steady_ += mass;
      squares_ += mass * mass;
    }
    mass_ += fell;
    if (is_steady) {
      if (duration_ == 0.0) emitted_before_ = emitted_;
      duration_ += world.interval;
      if (world.interval > 0.0) {
        const double fed = (world.emitted_mass - emitted_) / world.interval;
        feed_.add({&fed, 1}, world.interval);
      }
    }
    emitted_ = world.emitted_mass;
    if (world.interval > 0.0) {
      const double rate = formula::per_hour(fell, world.interval);
      row_.add({&rate, 1}, world.interval);
    }
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass", mass_, "kg", -1.0, sdk::detail(sdk::Quantity::mass));
    sink.figure("rate", row_.mean(0), "kg/h", -1.0, sdk::detail(sdk::Quantity::mass_rate));
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view column) const override {
    return column == "mass" ? sdk::RowValue::total : sdk::RowValue::mean;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    const double error = formula::error_of(squares_);
    const double emitted = duration_ > 0.0 ? emitted_ - emitted_before_ : 0.0;
    constexpr double k_grams_per_tonne = 1e6;
    const double reason = why_none(emitted);
    const double per_mass = reason < 0.0 ? sdk::k_no_value : k_grams_per_tonne / emitted;
    const double rate = formula::per_hour(steady_, duration_);
    sink.figure("rate", rate, "kg/h",
                sdk::error_beside(
                    rate, error < 0.0 ? sdk::k_no_estimate : formula::per_hour(error, duration_)),
                sdk::overview(sdk::Quantity::mass_rate, 1));
    sink.figure("grams_per_tonne", steady_ * per_mass, "g/t",
                reason < 0.0  ? reason
                : error < 0.0 ? sdk::k_no_estimate
                              : error * per_mass,
                sdk::overview(sdk::Quantity::mass_per_load, 2));
    sink.figure("mass", mass_, "kg", -1.0, sdk::detail(sdk::Quantity::mass));
    sink.figure("grains", count_, "1", -1.0, sdk::detail(sdk::Quantity::number));
  }

  void save(sdk::ArchiveWriter& a) const override {
    const double numbers[] = {mass_,     count_,   steady_,        squares_,
                              duration_, emitted_, emitted_before_};
    a.numbers("numbers", numbers);
    row_.save(a, "row");
    feed_.save(a, "feed");
  }
  void load(sdk::ArchiveReader& a) override {
    const auto n = a.numbers("numbers");
    mass_ = n.at(0), count_ = n.at(1), steady_ = n.at(2), squares_ = n.at(3);
    duration_ = n.at(4), emitted_ = n.at(5), emitted_before_ = n.at(6);
    row_.load(a, "row");
    feed_.load(a, "feed");
  }

 private:
  /// Why there is no amount per tonne; 0 where there is one. `emitted` [kg] while steady.
  [[nodiscard]] double why_none(double emitted) const {
    const bool is_nothing = !(emitted > 0.0) && !(emitted_before_ > 0.0) && steady_ == 0.0;
    if (is_nothing || !(duration_ > 0.0)) return sdk::k_nothing_passed;
    return !(emitted > 0.0) || feed_.is_uneven(0, emitted_before_) ? sdk::k_feed_not_even : 0.0;
  }

  Parameters p_;
  int axis_;  ///< that gravity pulls along
  sdk::Rectangle level_;
  double mass_ = 0.0;            ///< [kg] since the start
  double count_ = 0.0;           ///< real grains while steady
  double steady_ = 0.0;          ///< [kg] while steady
  double squares_ = 0.0;         ///< [kg2]
  double duration_ = 0.0;        ///< [s]
  double emitted_ = 0.0;         ///< [kg] until the last sample
  double emitted_before_ = 0.0;  ///< [kg] until the first steady sample
  sdk::RowMeans row_{1};
  sdk::BatchMeans feed_{1};  ///< [kg/s] emitted while steady
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Spillage>(); }
