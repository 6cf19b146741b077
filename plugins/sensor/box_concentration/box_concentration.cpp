// SPDX-License-Identifier: Apache-2.0
#include "box_concentration.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

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
    }
    values_.assign(means_.columns(), 0.0);
    squares_ = 0.0;
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (!is_inside(g, i) || !p_.takes(g.diameter[i])) continue;
      const double mass = g.weight[i] * g.mass[i];
      values_[0] += mass;
      values_[1] += g.weight[i];
      squares_ += mass * mass;
      if (classes_.empty()) continue;
      const std::size_t c = sdk::nearest_class(g.diameter[i], classes_);
      values_[k_totals + k_per_class * c] += mass;
      values_[k_totals + k_per_class * c + 1] += g.weight[i];
    }
    emitted_mass_ = world.emitted_mass;
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
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
    figures_of("", 0, role, sink);
    sink.figure("mass_at_end", values_[0], "kg", -1.0, role.of(sdk::Quantity::mass));
    // Grains come one by one: the mass present scatters like a sum of independent grains.
    const double scatter = values_[0] > 0.0 ? std::sqrt(squares_) : -1.0;
    sink.figure("grams_per_tonne", formula::grams_per_tonne(values_[0], emitted_mass_), "g/t",
                scatter < 0.0 ? -1.0 : formula::grams_per_tonne(scatter, emitted_mass_),
                role.of(sdk::Quantity::mass_per_load));
    for (std::size_t c = 0; c < classes_.size(); ++c) {
      if (!p_.takes(classes_[c])) continue;
      figures_of(sdk::class_name(classes_[c]) + "/", k_totals + k_per_class * c,
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
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    classes_ = a.numbers("classes");
    values_ = a.numbers("values");
    const std::vector<double> last = a.numbers("last");
    squares_ = last.at(0);
    emitted_mass_ = last.at(1);
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr sdk::FigureRole k_stock{.role = sdk::Role::stock};
  static constexpr std::size_t k_totals = 2;     ///< mass [kg], number
  static constexpr std::size_t k_per_class = 2;  ///< the same by class

  [[nodiscard]] bool is_inside(const sdk::GrainColumns& g, std::size_t i) const {
    return g.x[i] >= p_.min.x && g.x[i] < p_.max.x && g.y[i] >= p_.min.y && g.y[i] < p_.max.y &&
           g.z[i] >= p_.min.z && g.z[i] < p_.max.z;
  }

  void figures_of(const std::string& prefix, std::size_t column, const sdk::FigureRole& role,
                  sdk::FigureSink& sink) const {
    const double mass = means_.mean(column);
    const double error = mass > 0.0 ? means_.error(column) : -1.0;
    const double number_error = mass > 0.0 ? means_.error(column + 1) : -1.0;
    sink.figure(prefix + "mass_concentration", formula::concentration(mass, volume_), "kg/m3",
                error < 0.0 ? -1.0 : formula::concentration(error, volume_),
                role.of(sdk::Quantity::mass_concentration));
    sink.figure(prefix + "number_concentration", means_.mean(column + 1) / volume_, "1/m3",
                number_error < 0.0 ? -1.0 : number_error / volume_,
                role.of(sdk::Quantity::number_concentration));
  }

  Parameters p_;
  double volume_ = 1.0;
  std::vector<double> classes_;
  std::vector<double> values_ = std::vector<double>(k_totals, 0.0);  ///< at the last sample
  double squares_ = 0.0;       ///< [kg2] sum of (w m)^2 at the last sample
  double emitted_mass_ = 0.0;  ///< [kg]
  sdk::BatchMeans means_{k_totals};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<BoxConcentration>(); }
