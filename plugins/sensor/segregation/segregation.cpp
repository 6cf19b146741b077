// SPDX-License-Identifier: Apache-2.0
#include "segregation.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <array>

namespace {

namespace formula = dust::model::segregation;
namespace sdk = dust::sdk;

class Segregation final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SelectionParameters {
    double split = 0.0;
    sdk::Vec3 min;
    sdk::Vec3 max;
    sdk::Vec3 cells{4.0, 4.0, 4.0};
    sdk::Vec3 direction{0.0, 0.0, 1.0};
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::split, "split", sdk::dimension::length,
             "Grains of a smaller diameter are the fine ones.")
        .above(0);
    s.vector(&Parameters::min, "min", sdk::dimension::length, "Lower corner of the box looked at.");
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.");
    s.vector(&Parameters::cells, "cells", sdk::dimension::none,
             "Number of cells along x, y and z in which shares are compared.")
        .at_least(1)
        .at_most(1000)
        .optional();
    s.vector(&Parameters::direction, "direction", sdk::dimension::none,
             "Direction along which the centres of fine and coarse grains are compared.")
        .optional();
    sdk::declare_selection(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "segregation",
            .version = "1.0",
            .summary =
                "How well fine and coarse grains are mixed, and how far apart their centres are.",
            .equation = R"(M = \frac{\sigma_0^2 - \sigma^2}{\sigma_0^2 - \sigma_r^2})",
            .source = "Lacey, J. Appl. Chem. 4 (1954) 257, doi:10.1002/jctb.5010040504"};
  }

  explicit Segregation(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d]))
        throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
      if (p.cells[d] != std::floor(p.cells[d]))
        throw sdk::ParameterError("'cells' must be whole numbers");
      count_[static_cast<std::size_t>(d)] = static_cast<std::size_t>(p.cells[d]);
    }
    const double length = norm(p.direction);
    if (!(length > 0.0)) throw sdk::ParameterError("'direction' must not be zero");
    p_.direction = p.direction / length;
  }

  void observe(const sdk::WorldView& world) override {
    std::vector<formula::Cell> cells(count_[0] * count_[1] * count_[2]);
    double number[2] = {0.0, 0.0};  // coarse, fine
    double place[2] = {0.0, 0.0};
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      const sdk::Vec3 x{g.x[i], g.y[i], g.z[i]};
      if (!p_.takes(g.diameter[i]) || !sdk::is_in_box(x, p_.min, p_.max)) continue;
      const bool is_fine = g.diameter[i] < p_.split;
      formula::Cell& c = cells[index_of(x)];
      c.all += 1.0;
      c.fine += is_fine ? 1.0 : 0.0;
      number[is_fine] += g.weight[i];
      place[is_fine] += g.weight[i] * dot(x - p_.min, p_.direction);
    }
    const bool has_both = number[0] > 0.0 && number[1] > 0.0;
    const double all = number[0] + number[1];
    figures_.add(world,
                 {formula::lacey(cells),
                  has_both ? place[1] / number[1] - place[0] / number[0] : sdk::k_no_value,
                  all > 0.0 ? number[1] / all : sdk::k_no_value},
                 p_.steady_after);
  }

  void series(sdk::FigureSink& sink) const override { figures_.series(sink); }
  void summary(sdk::FigureSink& sink) const override { figures_.summary(sink); }
  void report(sdk::ReportSink& sink) const override {
    sink.curve("Mixing of fine and coarse grains", "time [s]", "mixing index [1]", "all grains",
               figures_.curve().x(), figures_.curve().y());
  }

  void save(sdk::ArchiveWriter& a) const override { figures_.save(a); }
  void load(sdk::ArchiveReader& a) override { figures_.load(a); }

 private:
  [[nodiscard]] std::size_t index_of(sdk::Vec3 x) const {
    std::size_t c[3];
    for (int d = 0; d < 3; ++d) {
      const auto n = count_[static_cast<std::size_t>(d)];
      const double share = (x[d] - p_.min[d]) / (p_.max[d] - p_.min[d]);
      c[d] = std::min(n - 1, static_cast<std::size_t>(share * static_cast<double>(n)));
    }
    return c[0] + count_[0] * (c[1] + count_[1] * c[2]);
  }

  Parameters p_;
  std::array<std::size_t, 3> count_{1, 1, 1};
  sdk::SampledFigures figures_{{{"mixing_index", "1", sdk::Quantity::ratio},
                                {"centre_shift", "m", sdk::Quantity::length},
                                {"fine_number_fraction", "1", sdk::Quantity::ratio}}};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Segregation>(); }
