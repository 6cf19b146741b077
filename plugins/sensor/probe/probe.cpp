// SPDX-License-Identifier: Apache-2.0
#include "probe.hpp"

#include <dust/sdk/fluid_cells.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::probe;
namespace sdk = dust::sdk;

class Probe final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 from;
    sdk::Vec3 to;
    std::int64_t count = 11;
    sdk::Vec3 across;
    std::int64_t count_across = 1;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::from, "from", sdk::dimension::length, "Where the line begins.");
    s.vector(&Parameters::to, "to", sdk::dimension::length, "Where it ends.");
    s.integer(&Parameters::count, "count", "Number of places on the line; 1 = its middle.")
        .at_least(1)
        .at_most(1000)
        .optional();
    s.vector(&Parameters::across, "across", sdk::dimension::length,
             "From the first to the last of the lines of a plane.")
        .optional();
    s.integer(&Parameters::count_across, "count_across", "Number of lines of a plane.")
        .at_least(1)
        .at_most(1000)
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "probe",
        .version = "1.0",
        .summary =
            "Velocity, pressure and void fraction of the air at a point, along a line, in a plane.",
        .equation = R"(\bar q(x_n) = \frac1T \int q(x_n, t)\, dt)",
        .source = "own definition"};
  }

  explicit Probe(const Parameters& p)
      : p_(p), places_(formula::lattice(p.from, p.to, p.count, p.across, p.count_across)) {
    constexpr std::size_t k_max = 2000;
    if (places_.size() > k_max) {
      throw sdk::ParameterError("count times count_across are " + std::to_string(places_.size()) +
                                " places; at most " + std::to_string(k_max) + " are kept");
    }
    if (p.count_across > 1 && !(norm(p.across) > 0.0)) {
      throw sdk::ParameterError(
          "several lines need 'across': where the last one lies from the first");
    }
    values_.assign(places_.size() * k_columns, 0.0);
    overall_.assign(k_columns, 0.0);
    means_ = sdk::BatchMeans(values_.size());
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    const sdk::FluidColumns& f = world.fluid;
    const sdk::FluidCells cells(f);
    if (cells.is_empty()) return;
    const std::span<const float> columns[k_columns] = {f.velocity_x, f.velocity_y, f.velocity_z,
                                                       f.pressure, f.void_fraction};
    overall_.assign(k_columns, 0.0);
    for (std::size_t n = 0; n < places_.size(); ++n) {
      for (std::size_t c = 0; c < k_columns; ++c) {
        const double value = cells.at(places_[n], columns[c]);
        values_[n * k_columns + c] = value;
        overall_[c] += value / static_cast<double>(places_.size());
      }
    }
    if (sdk::is_after(world, p_.steady_after)) means_.add(values_, world.interval);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t c = 0; c < k_columns; ++c)
      sink.figure(k_names[c], overall_[c], k_units[c], k_quantities[c]);
  }
  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < places_.size(); ++n) {
      const std::string place = "place_" + std::to_string(n + 1) + "/";
      for (std::size_t c = 0; c < k_columns; ++c) {
        const std::size_t column = n * k_columns + c;
        const double mean = means_.known_mean(column);
        const double error = mean != 0.0 ? means_.error(column) : sdk::k_no_estimate;
        sink.figure(place + k_names[c], mean, k_units[c], sdk::error_beside(mean, error),
                    sdk::detail(k_quantities[c]));
      }
    }
  }
  void report(sdk::ReportSink& sink) const override {
    const auto count = static_cast<std::size_t>(p_.count);
    std::vector<double> way;
    for (std::size_t n = 0; n < count; ++n) way.push_back(norm(places_[n] - places_[0]));
    for (std::size_t line = 0; line < places_.size() / count; ++line) {
      const std::string name =
          p_.count_across > 1 ? " of line " + std::to_string(line + 1) : std::string();
      for (std::size_t c = 0; c < k_columns; ++c) {
        std::vector<double> along;
        for (std::size_t n = 0; n < count; ++n) {
          along.push_back(means_.mean((line * count + n) * k_columns + c));
        }
        sink.curve(std::string("Mean ") + k_titles[c], "from the beginning [m]", k_axes[c],
                   k_names[c] + name, way, along);
      }
    }
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("values", values_);
    a.numbers("overall", overall_);
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    values_ = a.numbers("values");
    overall_ = a.numbers("overall");
    means_.load(a, "means");
  }

 private:
  static constexpr std::size_t k_columns = 5;
  static constexpr const char* k_names[k_columns] = {"velocity_x", "velocity_y", "velocity_z",
                                                     "pressure", "void_fraction"};
  static constexpr const char* k_units[k_columns] = {"m/s", "m/s", "m/s", "Pa", "1"};
  static constexpr sdk::Quantity k_quantities[k_columns] = {
      sdk::Quantity::velocity, sdk::Quantity::velocity, sdk::Quantity::velocity,
      sdk::Quantity::pressure, sdk::Quantity::ratio};
  static constexpr const char* k_titles[k_columns] = {"velocity", "velocity", "velocity",
                                                      "pressure", "void fraction"};
  static constexpr const char* k_axes[k_columns] = {
      "velocity [m/s]", "velocity [m/s]", "velocity [m/s]", "pressure [Pa]", "void fraction [1]"};

  Parameters p_;
  std::vector<sdk::Vec3> places_;  ///< [m] line by line
  std::vector<double> values_;     ///< k_columns per place, at the last sample
  std::vector<double> overall_;    ///< means over the places
  sdk::BatchMeans means_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Probe>(); }
