// SPDX-License-Identifier: Apache-2.0
#include "box_concentration.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <algorithm>

namespace {

namespace formula = dust::model::box_concentration;
namespace sdk = dust::sdk;

class BoxConcentration final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length, "Lower corner of the box.");
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.");
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "box_concentration",
            .version = "1.0",
            .summary = "Mass per volume of the grains in a box, by size class.",
            .equation = R"(c = \frac{1}{V} \sum_{i \in V} w_i m_i)",
            .source = "own definition"};
  }

  explicit BoxConcentration(const Parameters& p) : p_(p) {
    const sdk::Vec3 extent = p.max - p.min;
    if (!(extent.x > 0.0 && extent.y > 0.0 && extent.z > 0.0)) {
      throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
    }
    volume_ = extent.x * extent.y * extent.z;
  }

  void observe(const sdk::WorldView& world) override {
    if (classes_.empty() && !world.class_diameters.empty()) {
      classes_.assign(world.class_diameters.begin(), world.class_diameters.end());
      means_ = sdk::BatchMeans(k_totals + k_per_class * classes_.size());
      seen_.assign(1 + classes_.size(), {});
    }
    const bool is_steady = sdk::is_after(world, p_.steady_after);
    const bool is_first = is_steady && means_.duration() == 0.0;
    std::int64_t newest = newest_;
    values_.assign(means_.columns(), 0.0);
    squares_ = 0.0;
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!is_inside(g, i) || !p_.takes(g.diameter[i])) continue;
      const double mass = g.weight[i] * g.mass[i];
      values_[0] += mass;
      values_[1] += g.weight[i];
      squares_ += mass * mass;
      newest = std::max(newest, g.id[i]);
      const bool has_come = is_first || g.id[i] > newest_ || !was_inside(world, i);
      if (is_steady) seen_[0].add(has_come, world.interval);
      if (classes_.empty()) continue;
      const std::size_t c = sdk::nearest_class(g.diameter[i], classes_);
      if (is_steady) seen_[1 + c].add(has_come, world.interval);
      values_[k_totals + k_per_class * c] += mass;
      values_[k_totals + k_per_class * c + 1] += g.weight[i];
    }
    emitted_mass_ = world.emitted_mass;
    newest_ = newest;
    if (is_steady) means_.add(values_, world.interval);
    curve_.add(world.time, formula::concentration(values_[0], volume_));
  }

  void series(sdk::FigureSink& sink) const override {
    const sdk::FigureRole role = p_.sized(k_stock);
    sink.figure("mass_concentration", formula::concentration(values_[0], volume_), "kg/m3", -1.0,
                role.of(sdk::Quantity::mass_concentration));
    sink.figure("mass", values_[0], "kg", -1.0, role.of(sdk::Quantity::mass));
    sink.figure("number", values_[1], "1", -1.0, role.of(sdk::Quantity::number));
  }

  void summary(sdk::FigureSink& sink) const override {
    const sdk::FigureRole role = p_.sized(k_stock);
    figures_of("", 0, seen_[0], role, sink);
    sink.figure("mass_at_end", values_[0], "kg", -1.0, role.of(sdk::Quantity::mass));
    const double error =
        error_of(values_[0] > 0.0 ? formula::moment_error(means_.deviation(0), squares_)
                                  : sdk::k_no_estimate,
                 means_.error(0, renewals_of(seen_[0])), seen_[0]);
    const double per_load = formula::grams_per_tonne(values_[0], emitted_mass_);
    const double per_load_error =
        error < 0.0 ? error : formula::grams_per_tonne(error, emitted_mass_);
    // What was there before the feed began is an amount of no load.
    const bool is_unfed = std::isnan(per_load) && values_[0] > 0.0;
    sink.figure("grams_per_tonne", per_load, "g/t",
                is_unfed ? sdk::k_feed_not_even : sdk::error_beside(per_load, per_load_error),
                role.of(sdk::Quantity::mass_per_load));
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!p_.takes(classes_[c])) continue;
      figures_of(sdk::class_name(classes_[c]) + "/", k_totals + k_per_class * c, seen_[1 + c],
                 k_stock.sizes(classes_[c], classes_[c]), sink);
    }
  }

  void report(sdk::ReportSink& sink) const override {
    sink.curve("Concentration in the box", "time [s]", "mass per volume [kg/m3]", "all grains",
               curve_.x(), curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    const double last[] = {squares_, emitted_mass_};
    a.numbers("classes", classes_);
    a.numbers("values", values_);
    a.numbers("last", last);
    std::vector<double> seen;
    for (const Seen& s : seen_) seen.insert(seen.end(), {s.grains, s.stay});
    a.numbers("seen", seen);
    const std::int64_t newest[] = {newest_};
    a.integers("newest", newest);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    classes_ = a.numbers("classes");
    values_ = a.numbers("values");
    const std::vector<double> last = a.numbers("last");
    squares_ = last.at(0);
    emitted_mass_ = last.at(1);
    const std::vector<double> seen = a.numbers("seen");
    seen_.resize(seen.size() / 2);
    for (std::size_t n = 0; n < seen_.size(); ++n) seen_[n] = {seen.at(2 * n), seen.at(2 * n + 1)};
    newest_ = a.integers("newest").at(0);
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr sdk::FigureRole k_stock{.role = sdk::Role::stock};
  static constexpr std::size_t k_totals = 2;     ///< mass [kg], number
  static constexpr std::size_t k_per_class = 2;  ///< the same by class

  [[nodiscard]] bool is_inside(const sdk::GrainColumns& g, std::size_t i) const {
    return sdk::is_in_box({g.x[i], g.y[i], g.z[i]}, p_.min, p_.max);
  }

  [[nodiscard]] bool was_inside(const sdk::WorldView& world, std::size_t i) const {
    return sdk::is_in_box(sdk::place_before(world, i), p_.min, p_.max);
  }

  /// The computed grains that were in the box since `steady_after`.
  struct Seen {
    double grains = 0.0;
    double stay = 0.0;  ///< [s] that all of them together were there
    void add(bool has_come, double interval) {
      if (has_come) grains += 1.0;
      stay += interval;
    }
  };

  /// `error` of a figure, unless its mean, of error `of_mean`, has not settled, it rests on few
  /// grains, or on hardly more than one population of them.
  [[nodiscard]] double error_of(double error, double of_mean, const Seen& seen) const {
    if (error < 0.0) return error;
    if (seen.grains < sdk::k_min_grains) return sdk::k_few_grains;
    if (of_mean == sdk::k_not_steady) return sdk::k_not_steady;
    return renewals_of(seen) >= formula::k_min_renewals || error == 0.0 ? error : sdk::k_not_steady;
  }
  [[nodiscard]] double renewals_of(const Seen& seen) const {
    return formula::renewals(seen.grains, seen.stay, means_.duration());
  }

  void figures_of(const std::string& prefix, std::size_t column, const Seen& seen,
                  const sdk::FigureRole& role, sdk::FigureSink& sink) const {
    const double mass = means_.known_mean(column);
    const auto checked = [&](double error) {
      return mass > 0.0 ? error_of(error, error, seen) : sdk::k_no_estimate;
    };
    const double error = checked(means_.error(column, renewals_of(seen)));
    const double number_error = checked(means_.error(column + 1, renewals_of(seen)));
    sink.figure(prefix + "mass_concentration", formula::concentration(mass, volume_), "kg/m3",
                error < 0.0 ? error : formula::concentration(error, volume_),
                role.of(sdk::Quantity::mass_concentration));
    sink.figure(prefix + "number_concentration", means_.known_mean(column + 1) / volume_, "1/m3",
                number_error < 0.0 ? number_error : number_error / volume_,
                role.of(sdk::Quantity::number_concentration));
  }

  Parameters p_;
  double volume_ = 1.0;
  std::vector<double> classes_;
  std::vector<double> values_ = std::vector<double>(k_totals, 0.0);  ///< at the last sample
  double squares_ = 0.0;           ///< [kg2] sum of (w m)^2 at the last sample
  double emitted_mass_ = 0.0;      ///< [kg]
  std::vector<Seen> seen_ = {{}};  ///< all, then by class
  std::int64_t newest_ = -1;       ///< the largest id in the box so far
  sdk::BatchMeans means_{k_totals};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<BoxConcentration>(); }
