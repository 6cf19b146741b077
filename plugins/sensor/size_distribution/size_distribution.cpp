// SPDX-License-Identifier: Apache-2.0
#include "size_distribution.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <limits>

namespace {

namespace formula = dust::model::size_distribution;
namespace sdk = dust::sdk;

constexpr double k_far = std::numeric_limits<double>::infinity();

class Sizes final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    sdk::Vec3 min{-k_far, -k_far, -k_far};
    sdk::Vec3 max{k_far, k_far, k_far};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of the box looked at; without it, the whole domain.")
        .optional();
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.")
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "size_distribution",
            .version = "1.0",
            .summary = "Shares of the size classes by number and by mass, and their mean sizes.",
            .equation = R"(d_{32} = \sum_i w_i d_i^3 / \sum_i w_i d_i^2)",
            .source = "ISO 9276-2:2014 (mean sizes from distributions)"};
  }

  explicit Sizes(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d]))
        throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
    }
  }

  void observe(const sdk::WorldView& world) override {
    if (classes_.empty() && !world.class_diameters.empty()) {
      classes_.assign(world.class_diameters.begin(), world.class_diameters.end());
      means_ = sdk::BatchMeans(k_means + 2 * classes_.size());
      values_.assign(means_.columns(), sdk::k_no_value);
    }
    if (classes_.empty()) return;
    std::vector<double> numbers(classes_.size(), 0.0);
    std::vector<double> masses(classes_.size(), 0.0);
    double number = 0.0;
    double mass = 0.0;
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!p_.takes(g.diameter[i])) continue;
      if (!sdk::is_in_box({g.x[i], g.y[i], g.z[i]}, p_.min, p_.max)) continue;
      const std::size_t c = sdk::nearest_class(g.diameter[i], classes_);
      numbers[c] += g.weight[i];
      masses[c] += g.weight[i] * g.mass[i];
      number += g.weight[i];
      mass += g.weight[i] * g.mass[i];
    }
    values_.assign(means_.columns(), sdk::k_no_value);
    if (!(number > 0.0)) return;  // nothing has no distribution: such samples do not count
    values_[0] = formula::sauter(classes_, numbers);
    for (std::size_t q = 0; q < 3; ++q) {
      values_[1 + q] = formula::quantile(classes_, masses, k_quantiles[q]);
    }
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      values_[k_means + 2 * c] = numbers[c] / number;
      values_[k_means + 2 * c + 1] = masses[c] / mass;
    }
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_means; ++n) {
      const double value = values_.empty() ? sdk::k_no_value : values_[n];
      sink.figure(k_names[n], value, "m", sdk::error_beside(value, sdk::k_no_estimate),
                  sdk::detail(sdk::Quantity::length));
    }
  }
  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_means; ++n) {
      const bool is_median = n == k_median;
      figure(
          sink, k_names[n], n, "m",
          is_median ? sdk::overview(sdk::Quantity::length, 1) : sdk::detail(sdk::Quantity::length));
    }
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!p_.takes(classes_[c])) continue;
      const std::string prefix = sdk::class_name(classes_[c]) + "/";
      const auto role = sdk::detail(sdk::Quantity::ratio).sizes(classes_[c], classes_[c]);
      figure(sink, prefix + "number_fraction", k_means + 2 * c, "1", role);
      figure(sink, prefix + "mass_fraction", k_means + 2 * c + 1, "1", role);
    }
  }
  void report(sdk::ReportSink& sink) const override {
    if (!(means_.duration() > 0.0)) return;
    const std::vector<std::string> columns = {"diameter [um]", "number [%]", "mass [%]"};
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      const double row[] = {1e6 * classes_[c], 1e2 * means_.mean(k_means + 2 * c),
                            1e2 * means_.mean(k_means + 2 * c + 1)};
      sink.row("Size distribution", columns, row);
    }
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("classes", classes_);
    a.numbers("values", values_);
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    classes_ = a.numbers("classes");
    values_ = a.numbers("values");
    means_.load(a, "means");
  }

 private:
  static constexpr std::size_t k_means = 4;
  static constexpr double k_quantiles[3] = {0.1, 0.5, 0.9};
  static constexpr std::size_t k_median = 2;
  static constexpr const char* k_names[k_means] = {"sauter_diameter", "d_10", "d_50", "d_90"};

  void figure(sdk::FigureSink& sink, const std::string& name, std::size_t column, const char* unit,
              const sdk::FigureRole& role) const {
    const double mean = means_.known_mean(column);
    sink.figure(name, mean, unit,
                sdk::error_beside(mean, mean > 0.0 ? means_.error(column) : sdk::k_no_estimate),
                role);
  }

  Parameters p_;
  std::vector<double> classes_;
  std::vector<double> values_ =
      std::vector<double>(k_means, sdk::k_no_value);  ///< at the last sample
  sdk::BatchMeans means_{k_means};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Sizes>(); }
