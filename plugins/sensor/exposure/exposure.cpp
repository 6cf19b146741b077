// SPDX-License-Identifier: Apache-2.0
#include "exposure.hpp"

#include <dust/sdk/airborne_dust.hpp>
#include <dust/sdk/fluid_cells.hpp>
#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = dust::model::exposure;
namespace sdk = dust::sdk;

class Exposure final : public sdk::Sensor, public sdk::DustObserver {
 public:
  struct Parameters : sdk::SteadyParameters {
    std::vector<sdk::Vec3> points;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vectors(&Parameters::points, "points", sdk::dimension::length,
              "Where somebody breathes, or a sampler stands.");
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "exposure",
            .version = "1.0",
            .summary = "Inhalable, thoracic and respirable dust in the air at points.",
            .equation = R"(C_j(x) = \sum_k E_j(D_k)\, c_k(x))",
            .source = "conventions of EN 481:1993"};
  }

  explicit Exposure(const Parameters& p) : p_(p) {
    if (p.points.empty()) throw sdk::ParameterError("'points' holds no point");
    now_.assign(p.points.size() * k_parts, 0.0);
    means_ = sdk::BatchMeans(now_.size());
    highest_.assign(p.points.size(), 0.0);
  }

  [[nodiscard]] bool wants_fluid() const override { return true; }
  void observe(const sdk::WorldView&) override {}

  void observe_dust(const sdk::WorldView& world, const sdk::DustColumns& dust) override {
    const sdk::FluidCells cells(world.fluid);
    if (cells.is_empty()) return;
    parts_.clear();
    for (const double d : dust.diameter) parts_.push_back(formula::parts_of(d, dust.density));
    local_.resize(dust.diameter.size());
    for (std::size_t n = 0; n < p_.points.size(); ++n) {
      for (std::size_t k = 0; k < local_.size(); ++k) {
        local_[k] = cells.at(p_.points[n], dust.concentration[k]);
      }
      const formula::Parts found = formula::sampled(local_, parts_);
      std::copy(found.begin(), found.end(),
                now_.begin() + static_cast<std::ptrdiff_t>(n * k_parts));
      highest_[n] = std::max(highest_[n], found[0]);
    }
    if (sdk::is_after(world, p_.steady_after)) means_.add(now_, world.interval);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t n = 0; n < p_.points.size(); ++n) {
      for (std::size_t j = 0; j < k_parts; ++j) {
        sink.figure(name_of(n, j), k_milligrams * now_[n * k_parts + j], k_unit, k_quantity);
      }
    }
  }
  void summary(sdk::FigureSink& sink) const override {
    // Without a field there is no dust; with one, what was not observed is not known.
    const bool is_none = parts_.empty() && !(means_.duration() > 0.0);
    for (std::size_t n = 0; n < p_.points.size(); ++n) {
      for (std::size_t j = 0; j < k_parts; ++j) {
        const double mean = is_none ? 0.0 : means_.known_mean(n * k_parts + j);
        const double error = mean > 0.0 ? means_.error(n * k_parts + j) : sdk::k_no_estimate;
        sink.figure(
            name_of(n, j), k_milligrams * mean, k_unit, error < 0.0 ? error : k_milligrams * error,
            j == 0 ? sdk::overview(k_quantity, static_cast<int>(n) + 1) : sdk::detail(k_quantity));
      }
      sink.figure(point_of(n) + "highest_inhalable", k_milligrams * highest_[n], k_unit,
                  k_quantity);
    }
  }
  void report(sdk::ReportSink& sink) const override {
    const std::vector<std::string> columns{"x [m]",
                                           "y [m]",
                                           "z [m]",
                                           "inhalable [mg/m3]",
                                           "thoracic [mg/m3]",
                                           "respirable [mg/m3]",
                                           "all dust [mg/m3]"};
    for (std::size_t n = 0; n < p_.points.size(); ++n) {
      const sdk::Vec3 x = p_.points[n];
      std::vector<double> row{x.x, x.y, x.z};
      for (std::size_t j = 0; j < k_parts; ++j) {
        row.push_back(k_milligrams * means_.mean(n * k_parts + j));
      }
      sink.row("Exposure (mean, EN 481)", columns, row);
    }
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("now", now_);
    a.numbers("highest", highest_);
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    now_ = a.numbers("now");
    highest_ = a.numbers("highest");
    means_.load(a, "means");
  }

 private:
  static constexpr std::size_t k_parts = formula::k_parts;
  static constexpr const char* k_names[k_parts] = {"inhalable", "thoracic", "respirable", "dust"};
  static constexpr const char* k_unit = "mg/m3";
  static constexpr double k_milligrams = 1e6;  // per kg
  static constexpr sdk::Quantity k_quantity = sdk::Quantity::mass_concentration;

  static std::string point_of(std::size_t n) { return "point_" + std::to_string(n + 1) + "/"; }
  static std::string name_of(std::size_t n, std::size_t part) {
    return point_of(n) + k_names[part];
  }

  Parameters p_;
  std::vector<double> now_;      ///< [kg/m3] k_parts per point
  std::vector<double> highest_;  ///< [kg/m3] inhalable, by point
  sdk::BatchMeans means_;
  std::vector<formula::Parts> parts_;  ///< by class
  std::vector<double> local_;          ///< [kg/m3] by class
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Exposure>(); }
