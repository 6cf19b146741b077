// SPDX-License-Identifier: Apache-2.0
#include "vorticity.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <limits>

namespace {

namespace formula = dust::model::vorticity;
namespace sdk = dust::sdk;

class Vorticity final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 min = {-k_far, -k_far, -k_far};
    sdk::Vec3 max = {k_far, k_far, k_far};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length, "Lower corner of the box looked at.")
        .optional();
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box looked at.")
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "vorticity",
        .version = "1.0",
        .summary =
            "How the air turns: mean and largest vorticity, and where the mean flow turns fastest.",
        .equation = R"(\omega = \nabla \times u)",
        .source = "own definition"};
  }

  explicit Vorticity(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (p.max[d] > p.min[d]) continue;
      throw sdk::ParameterError("'max' must lie above 'min' along each axis");
    }
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView& world) override {
    const sdk::FluidColumns& f = world.fluid;
    const sdk::FluidCells cells(f);
    if (cells.is_empty()) return;
    if (total_.size() != 3 * cells.size()) total_.assign(3 * cells.size(), 0.0);
    const bool is_steady = sdk::is_after(world, p_.steady_after);
    sdk::Vec3 sum;
    double magnitude = 0.0;
    double largest = 0.0;
    double count = 0.0;
    for (int k = 0; k < f.count[2]; ++k) {
      for (int j = 0; j < f.count[1]; ++j) {
        for (int i = 0; i < f.count[0]; ++i) {
          const std::size_t c = cells.index(i, j, k);
          if (!cells.is_open(c) || !sdk::is_in_box(cells.centre(i, j, k), p_.min, p_.max)) continue;
          const sdk::Vec3 curl = formula::curl(f, cells, i, j, k);
          sum += curl;
          magnitude += norm(curl);
          largest = std::max(largest, norm(curl));
          count += 1.0;
          if (!is_steady) continue;
          for (int d = 0; d < 3; ++d) {
            total_[3 * c + static_cast<std::size_t>(d)] += world.interval * curl[d];
          }
        }
      }
    }
    const double share = count > 0.0 ? 1.0 / count : 0.0;
    values_ = {share * magnitude, largest, share * sum.x, share * sum.y, share * sum.z};
    if (is_steady) {
      means_.add(values_, world.interval);
      find_place(f, cells);
    }
    curve_.add(world.time, values_[1]);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n)
      sink.figure(k_names[n], values_[n], "1/s", sdk::Quantity::vorticity);
  }
  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < k_columns; ++n) {
      const double mean = means_.known_mean(n);
      const double error = mean != 0.0 ? means_.error(n) : sdk::k_no_estimate;
      sink.figure(k_names[n], mean, "1/s", sdk::error_beside(mean, error),
                  sdk::detail(sdk::Quantity::vorticity));
    }
    // Where nothing turns there is no place that turns fastest.
    const auto place = [&](const char* name, double value, sdk::Quantity quantity) {
      sink.figure(name, fastest_ > 0.0 ? value : sdk::k_no_value, "m",
                  fastest_ > 0.0 ? sdk::k_no_estimate : sdk::k_nothing_passed,
                  sdk::detail(quantity));
    };
    place("fastest/x", place_.x, sdk::Quantity::x);
    place("fastest/y", place_.y, sdk::Quantity::y);
    place("fastest/z", place_.z, sdk::Quantity::z);
    sink.figure("fastest/vorticity", fastest_, "1/s", sdk::k_no_estimate,
                sdk::overview(sdk::Quantity::vorticity, 1));
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Largest vorticity", "time [s]", "vorticity [1/s]", "open cells", curve_.x(),
               curve_.y());
  }

  void save(sdk::ArchiveWriter& a) const override {
    const double place[] = {place_.x, place_.y, place_.z, fastest_};
    a.numbers("values", values_);
    a.numbers("total", total_);
    a.numbers("place", place);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    values_ = a.numbers("values");
    total_ = a.numbers("total");
    const std::vector<double> place = a.numbers("place");
    place_ = {place.at(0), place.at(1), place.at(2)};
    fastest_ = place.at(3);
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  static constexpr double k_far = 1e6;  ///< [m] beyond any domain
  static constexpr std::size_t k_columns = 5;
  static constexpr const char* k_names[k_columns] = {"mean_size", "largest", "mean_x", "mean_y",
                                                     "mean_z"};

  /// Where the time mean turns fastest; the first of equals.
  void find_place(const sdk::FluidColumns& f, const sdk::FluidCells& cells) {
    const double time = means_.duration();
    double best = -1.0;
    for (int k = 0; k < f.count[2]; ++k) {
      for (int j = 0; j < f.count[1]; ++j) {
        for (int i = 0; i < f.count[0]; ++i) {
          const std::size_t c = 3 * cells.index(i, j, k);
          const double size = norm(sdk::Vec3{total_[c], total_[c + 1], total_[c + 2]});
          if (!(size > best) || size == 0.0) continue;
          best = size;
          place_ = cells.centre(i, j, k);
        }
      }
    }
    fastest_ = best > 0.0 ? best / time : 0.0;
  }

  Parameters p_;
  std::vector<double> values_ = std::vector<double>(k_columns, 0.0);  ///< at the last sample
  std::vector<double> total_;  ///< [1] vorticity times time, 3 per cell
  sdk::Vec3 place_;            ///< [m]
  double fastest_ = 0.0;       ///< [1/s]
  sdk::BatchMeans means_{k_columns};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Vorticity>(); }
