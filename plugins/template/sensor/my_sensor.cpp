// SPDX-License-Identifier: Apache-2.0
#include "my_sensor.hpp"

#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

namespace {

namespace formula = my_sensor;
namespace sdk = dust::sdk;

class MySensor final : public sdk::Sensor {
 public:
  // 1. What a scenario may say, each parameter once.
  struct Parameters {
    double steady_after = 0.0;
    double finer_than = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    s.number(&Parameters::steady_after, "steady_after", sdk::dimension::time,
             "Time from which the means are taken.")
        .at_least(0)
        .optional();
    s.number(&Parameters::finer_than, "finer_than", sdk::dimension::length,
             "Only grains of a smaller diameter count; 0 = all.")
        .at_least(0)
        .optional();
    return s.build();
  }
  // 2. What the model says of itself.
  static sdk::ModelInfo describe() {
    return {.name = "my_sensor",
            .version = "1.0",
            .summary = "Mass and kinetic energy of the grains, now and on average.",
            .equation = "E = \\sum_i w_i m_i v_i^2 / 2",
            .source = "own definition"};
  }

  explicit MySensor(const Parameters& p) : p_(p) {}

  // 3. One look at the world per fluid step.
  void observe(const sdk::WorldView& world) override {
    now_[0] = now_[1] = 0.0;
    grid_.origin = world.domain_min;
    for (int d = 0; d < 3; ++d) {
      grid_.spacing[d] = (world.domain_max[d] - world.domain_min[d]) / k_cells;
    }
    mass_in_.assign(mass_in_.size(), 0.0);
    const sdk::GrainColumns& g = world.grains;
    for (std::size_t i = 0; i < g.id.size(); ++i) {
      if (p_.finer_than > 0.0 && g.diameter[i] >= p_.finer_than) continue;
      const double mass = g.weight[i] * g.mass[i];
      now_[0] += mass;
      const double energy =
          formula::kinetic_energy(mass, g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]);
      now_[1] += energy;
      mass_in_[formula::cell({g.x[i], g.y[i], g.z[i]}, grid_)] += mass;
      if (energy > 0.0) mass_at_[formula::decade(energy / mass)] += mass * world.interval;
    }
    if (sdk::is_after(world, p_.steady_after)) means_.add(now_, world.interval);
    curve_.add(world.time, now_[1]);
  }

  // 4. What it reports: a row of series.csv, figures with their errors, a section of the report,
  // fields of results.h5.
  // Every figure says what it is: the report reads the role and never the name.
  void series(sdk::FigureSink& sink) const override {
    sink.figure("mass", now_[0], "kg", -1.0, role_of(sdk::Quantity::mass));
    sink.figure("kinetic_energy", now_[1], "J", -1.0, role_of(sdk::Quantity::energy));
  }
  void summary(sdk::FigureSink& sink) const override {
    const char* names[] = {"mass", "kinetic_energy"};
    const char* units[] = {"kg", "J"};
    const sdk::Quantity quantities[] = {sdk::Quantity::mass, sdk::Quantity::energy};
    for (std::size_t n = 0; n < 2; ++n) {
      const double mean = means_.mean(n);
      sink.figure(names[n], mean, units[n], mean > 0.0 ? means_.error(n) : -1.0,
                  role_of(quantities[n]));
    }
  }
  void report(sdk::ReportSink& sink) const override {
    sink.section("Motion of the grains", "How much they move, and how that is shared out.");
    sink.curve("Kinetic energy", "time [s]", "kinetic energy [J]", "all grains", curve_.x(),
               curve_.y());
    std::vector<double> edges;
    for (std::size_t n = 0; n <= mass_at_.size(); ++n) {
      edges.push_back(formula::k_first_decade + static_cast<double>(n));
    }
    sink.histogram("Energy per mass", "log10 of energy per mass in J/kg", "mass times time [kg s]",
                   "all grains", edges, mass_at_);
  }
  void fields(sdk::FieldSink& sink) const override {
    sink.field("mass", "kg", grid_, mass_in_, role_of(sdk::Quantity::mass));
  }

  // 5. What a resumed run needs: everything that lives between two looks.
  void save(sdk::ArchiveWriter& archive) const override {
    archive.numbers("now", now_);
    const sdk::Vec3 o = grid_.origin;
    const sdk::Vec3 s = grid_.spacing;
    archive.numbers("grid", std::vector<double>{o.x, o.y, o.z, s.x, s.y, s.z});
    archive.numbers("mass_in", mass_in_);
    archive.numbers("mass_at", mass_at_);
    means_.save(archive, "means");
    curve_.save(archive, "curve");
  }
  void load(sdk::ArchiveReader& archive) override {
    now_ = archive.numbers("now");
    const std::vector<double> grid = archive.numbers("grid");
    grid_.origin = {grid.at(0), grid.at(1), grid.at(2)};
    grid_.spacing = {grid.at(3), grid.at(4), grid.at(5)};
    mass_in_ = archive.numbers("mass_in");
    mass_at_ = archive.numbers("mass_at");
    means_.load(archive, "means");
    curve_.load(archive, "curve");
  }

 private:
  static constexpr int k_cells = 8;  ///< of the field, per direction

  /// What the whole domain holds of the sizes counted.
  [[nodiscard]] sdk::FigureRole role_of(sdk::Quantity quantity) const {
    return sdk::FigureRole{.role = sdk::Role::stock}.of(quantity).sizes(0.0, p_.finer_than);
  }

  Parameters p_;
  std::vector<double> now_ = {0.0, 0.0};  ///< mass [kg], kinetic energy [J]
  sdk::GridShape grid_{{}, {}, {k_cells, k_cells, k_cells}};
  std::vector<double> mass_in_ = std::vector<double>(k_cells * k_cells * k_cells);  ///< [kg]
  std::vector<double> mass_at_ = std::vector<double>(formula::k_decades);           ///< [kg s]
  sdk::BatchMeans means_{2};
  sdk::ThinnedCurve curve_;
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<MySensor>(); }
