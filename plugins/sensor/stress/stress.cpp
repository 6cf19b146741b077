// SPDX-License-Identifier: Apache-2.0
#include "stress.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <limits>

namespace {

namespace formula = dust::model::stress;
namespace sdk = dust::sdk;

class Stress final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
    sdk::Vec3 cells{1.0, 1.0, 1.0};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.vector(&Parameters::min, "min", sdk::dimension::length, "Lower corner of the box looked at.");
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.");
    s.vector(&Parameters::cells, "cells", sdk::dimension::none,
             "Number of cells along x, y and z over which the fields are averaged.")
        .at_least(1)
        .at_most(1000)
        .optional();
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {
        .name = "stress",
        .version = "1.0",
        .summary = "Stress, density and velocity of the grains as fields averaged over cells.",
        .equation =
            R"(\sigma_{ab} = \frac1V \Big(\beta \sum_i m_i v'_{i,a} v'_{i,b} - \sum_c s_c f_{c,a} b_{c,b}\Big))",
        .source = "Goldhirsch, Granular Matter 12 (2010) 239, doi:10.1007/s10035-010-0181-z"};
  }

  explicit Stress(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      const auto u = static_cast<std::size_t>(d);
      if (!(p.max[d] > p.min[d]))
        throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
      if (p.cells[d] != std::floor(p.cells[d]))
        throw sdk::ParameterError("'cells' must be whole numbers");
      cells_.low[u] = p.min[d];
      cells_.high[u] = p.max[d];
      cells_.count[u] = static_cast<std::size_t>(p.cells[d]);
    }
    if (cells_.size() > k_max_cells) {
      throw sdk::ParameterError("'cells' makes " + std::to_string(cells_.size()) +
                                " cells of the box; at most " + std::to_string(k_max_cells) +
                                " are kept");
    }
    fields_.assign(cells_.size() * k_fields, 0.0);
    sums_ = fields_;
  }
  [[nodiscard]] bool wants_contacts() const override { return true; }

  void observe(const sdk::WorldView& world) override {
    std::fill(fields_.begin(), fields_.end(), 0.0);
    add_grains(world.grains);
    add_contacts(world);
    const double volume = cells_.volume();
    totals_.assign(k_fields, 0.0);
    for (std::size_t c = 0; c < cells_.size(); ++c) {
      for (std::size_t f = 0; f < k_fields; ++f) {
        fields_[c * k_fields + f] /= volume;
        totals_[f] += fields_[c * k_fields + f] / static_cast<double>(cells_.size());
      }
    }
    if (sdk::is_after(world, p_.steady_after)) {
      means_.add(totals_, world.interval);
      for (std::size_t n = 0; n < fields_.size(); ++n) sums_[n] += world.interval * fields_[n];
    }
    curve_.add(world.time, pressure(totals_.data()));
  }

  void series(sdk::FigureSink& sink) const override {
    sink.figure("pressure", pressure(totals_.data()), "Pa", sdk::Quantity::pressure);
    sink.figure("xx", totals_[0], "Pa", sdk::Quantity::pressure);
    sink.figure("yy", totals_[1], "Pa", sdk::Quantity::pressure);
    sink.figure("zz", totals_[2], "Pa", sdk::Quantity::pressure);
  }
  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t f = 0; f < k_components; ++f) {
      sink.figure(k_names[f], means_.known_mean(f), "Pa", error(f),
                  sdk::detail(sdk::Quantity::pressure));
      sink.figure(std::string(k_names[f]) + "_at_end", totals_[f], "Pa", sdk::Quantity::pressure);
    }
    double p = 0.0;
    for (std::size_t f = 0; f < 3; ++f) p += means_.known_mean(f) / 3.0;
    sink.figure("pressure", p, "Pa", sdk::error_beside(p, sdk::k_no_estimate),
                sdk::overview(sdk::Quantity::pressure, 1));
    sink.figure("bulk_density", means_.known_mean(k_density), "kg/m3", error(k_density),
                sdk::detail(sdk::Quantity::mass_concentration));
  }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Pressure of the grains", "time [s]", "pressure [Pa]", "whole box", curve_.x(),
               curve_.y());
    const double time = means_.duration();
    if (cells_.size() > k_max_rows || !(time > 0.0)) return;
    const std::vector<std::string> columns = {
        "x [mm]",  "y [mm]",  "z [mm]",  "density [kg/m3]", "v_x [m/s]", "v_y [m/s]", "v_z [m/s]",
        "xx [Pa]", "yy [Pa]", "zz [Pa]", "xy [Pa]",         "xz [Pa]",   "yz [Pa]"};
    for (std::size_t k = 0; k < cells_.count[2]; ++k) {
      for (std::size_t j = 0; j < cells_.count[1]; ++j) {
        for (std::size_t i = 0; i < cells_.count[0]; ++i) {
          const double* f = sums_.data() + k_fields * cells_.index(i, j, k);
          const auto middle = [&](std::size_t d, std::size_t n) {
            return 1e3 * (cells_.low[d] + (static_cast<double>(n) + 0.5) * cells_.edge(d));
          };
          const double density = f[k_density];
          const auto speed = [&](std::size_t d) {
            return density > 0.0 ? f[k_density + 1 + d] / density : 0.0;
          };
          std::vector<double> row = {middle(0, i), middle(1, j), middle(2, k), density / time,
                                     speed(0),     speed(1),     speed(2)};
          for (std::size_t s = 0; s < k_components; ++s) row.push_back(f[s] / time);
          sink.row("Fields of the grains", columns, row);
        }
      }
    }
  }

  void save(sdk::ArchiveWriter& a) const override {
    a.numbers("totals", totals_);
    a.numbers("sums", sums_);
    means_.save(a, "means");
    curve_.save(a, "curve");
  }
  void load(sdk::ArchiveReader& a) override {
    totals_ = a.numbers("totals");
    sums_ = a.numbers("sums");
    means_.load(a, "means");
    curve_.load(a, "curve");
  }

 private:
  // Fields of a cell: six components of the stress, density, momentum density.
  static constexpr std::size_t k_components = 6;
  static constexpr std::size_t k_density = 6;
  static constexpr std::size_t k_fields = 10;
  static constexpr std::size_t k_max_rows = 2000;
  static constexpr std::size_t k_max_cells = 10'000'000;  ///< about 2 GB
  static constexpr const char* k_names[k_components] = {"xx", "yy", "zz", "xy", "xz", "yz"};

  static double pressure(const double* f) { return (f[0] + f[1] + f[2]) / 3.0; }

  [[nodiscard]] double error(std::size_t field) const {
    const double mean = means_.known_mean(field);
    return sdk::error_beside(mean, mean != 0.0 ? means_.error(field) : sdk::k_no_estimate);
  }

  static constexpr std::size_t k_outside = std::numeric_limits<std::size_t>::max();

  [[nodiscard]] std::size_t cell_of(const sdk::GrainColumns& g, std::size_t i) const {
    const formula::Point x{g.x[i], g.y[i], g.z[i]};
    if (!cells_.holds(x)) return k_outside;
    return cells_.index(cells_.at(0, x[0]), cells_.at(1, x[1]), cells_.at(2, x[2]));
  }
  void add_grains(const sdk::GrainColumns& g) {
    samples_.assign(cells_.size(), {});
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const std::size_t cell = cell_of(g, i);
      if (cell == k_outside) continue;
      formula::add_grain(g.weight[i], g.mass[i], samples_[cell]);
      double* f = fields_.data() + k_fields * cell;
      const double m = g.weight[i] * g.mass[i];
      f[k_density] += m;
      f[k_density + 1] += m * g.velocity_x[i];
      f[k_density + 2] += m * g.velocity_y[i];
      f[k_density + 3] += m * g.velocity_z[i];
    }
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const std::size_t cell = cell_of(g, i);
      if (cell == k_outside) continue;
      double* f = fields_.data() + k_fields * cell;
      const double* momentum = f + k_density + 1;
      const double mass = f[k_density];
      formula::add_motion(
          formula::unbiased(samples_[cell]) * g.weight[i] * g.mass[i],
          {g.velocity_x[i] - momentum[0] / mass, g.velocity_y[i] - momentum[1] / mass,
           g.velocity_z[i] - momentum[2] / mass},
          f);
    }
  }

  void add_contacts(const sdk::WorldView& world) {
    const sdk::GrainColumns& g = world.grains;
    const sdk::ContactColumns& c = world.contacts;
    for (std::size_t n = 0; n < c.grain_i.size(); ++n) {
      const auto i = static_cast<std::size_t>(c.grain_i[n]);
      const auto j = static_cast<std::size_t>(c.grain_j[n]);
      double weight = g.weight[i];
      if (c.grain_j[n] >= 0) weight = std::min(weight, g.weight[j]);
      const formula::Point force{weight * c.force_x[n], weight * c.force_y[n],
                                 weight * c.force_z[n]};
      const formula::Point branch{c.branch_x[n], c.branch_y[n], c.branch_z[n]};
      const auto add = [&](std::size_t cell, double share) {
        formula::add_contact(force, branch, share, fields_.data() + k_fields * cell);
      };
      const formula::Point from{g.x[i], g.y[i], g.z[i]};
      cells_.along(from, branch, add);
      if (c.grain_j[n] < 0) continue;
      // Through a periodic side the line leaves here and ends over there: its image counts too.
      const formula::Point end{g.x[j], g.y[j], g.z[j]};
      formula::Point image{};
      bool is_wrapped = false;
      for (std::size_t d = 0; d < 3; ++d) {
        image[d] = end[d] - branch[d];
        const double extent =
            world.domain_max[static_cast<int>(d)] - world.domain_min[static_cast<int>(d)];
        is_wrapped = is_wrapped || std::abs(image[d] - from[d]) > 0.5 * extent;
      }
      if (is_wrapped) cells_.along(image, branch, add);
    }
  }

  Parameters p_;
  formula::Cells cells_;
  std::vector<double> fields_;            ///< of the last sample; no state between calls
  std::vector<formula::Sample> samples_;  ///< the grains behind them, of each cell; likewise
  std::vector<double> totals_ = std::vector<double>(k_fields, 0.0);  ///< means over the box
  std::vector<double> sums_;  ///< integrals of the fields over time
  sdk::BatchMeans means_{k_fields};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Stress>(); }
