// SPDX-License-Identifier: Apache-2.0
#include "wear.hpp"

#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>
#include <dust/sdk/wall_selection.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <string>
#include <vector>

namespace {

namespace formula = dust::model::wear;
namespace sdk = dust::sdk;
using formula::Places;

class Wear final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    std::vector<std::string> walls;
    sdk::Vec3 min;
    sdk::Vec3 max;
    double cell = 0.0;
    double coefficient = 0.0;
    double hardness = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
    sdk::declare_walls(s, "that are looked at in the box; none: all").optional();
    s.vector(&Parameters::min, "min", sdk::dimension::length,
             "Lower corner of a box round the part of a wall looked at.");
    s.vector(&Parameters::max, "max", sdk::dimension::length, "Upper corner of the box.");
    s.number(&Parameters::cell, "cell", sdk::dimension::length,
             "Edge of the cubes into which the box is cut: the places.")
        .above(0);
    s.number(&Parameters::coefficient, "coefficient", sdk::dimension::none,
             "Wear coefficient of Archard's law for wall and grains.")
        .symbol("k")
        .above(0)
        .usual(1e-9, 1);
    s.number(&Parameters::hardness, "hardness", sdk::dimension::pressure,
             "Hardness of the wall's material.")
        .symbol("H")
        .above(0)
        .usual(1e6, 1.5e11);
    sdk::declare_steady(s);
    return s.build();
  }
  static sdk::ModelInfo describe() {
    return {.name = "wear",
            .version = "3.0",
            .summary = "Wear of liners by Archard's law and pressure on them, place by place.",
            .equation = R"(\dot V = \frac{k}{H} \sum_c w_c F_{n,c}\, v_{t,c},\quad )"
                        R"(p = \frac{1}{a^2} \sum_c w_c F_{n,c})",
            .source = "Archard, J. Appl. Phys. 24 (1953) 981, doi:10.1063/1.1721448"};
  }

  explicit Wear(const Parameters& p) : p_(p), walls_(p.walls), places_(p.min, p.cell) {
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d])) {
        throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
      }
      const double cells = std::ceil((p.max[d] - p.min[d]) / p.cell - 1e-9);
      if (cells > k_max_cells) throw sdk::ParameterError("'cell' makes too many places");
      places_.set_count(d, std::max(1, static_cast<int>(cells)));
    }
  }

  [[nodiscard]] bool wants_sliding() const override { return true; }
  [[nodiscard]] sdk::SurfacesWanted wanted_surfaces() const override {
    sdk::SurfacesWanted wanted;
    wanted.wall_in = {p_.min, p_.max};
    wanted.walls = walls_.names();
    return wanted;
  }

  void observe(const sdk::WorldView& world) override {
    values_.fill(0.0);
    const bool is_steady = sdk::is_after(world, p_.steady_after);
    if (!walls_.is_empty()) walls_.look(world.walls);
    for (const sdk::WallSliding& s : world.walls.slidings) {
      const bool is_meant = walls_.is_empty() || walls_.holds(s.wall);
      if (!is_meant || !sdk::is_in_box(s.place, p_.min, p_.max)) continue;
      const double worn = formula::archard(p_.coefficient, p_.hardness, s.sliding);
      values_[0] += worn / world.interval;
      values_[1] += s.impulse / world.interval;
      values_[2] += s.friction / world.interval;
      if (is_steady) places_.add(s.place, worn, s.impulse);
    }
    row_.add(values_, world.interval);
    if (!is_steady) return;
    means_.add(values_, world.interval);
    places_.close(world.interval);
  }

  void series(sdk::FigureSink& sink) const override {
    for (std::size_t c = 0; c < k_columns; ++c)
      sink.figure(k_names[c], row_.mean(c), k_units[c], -1.0, sdk::detail(k_quantities[c]));
  }
  [[nodiscard]] sdk::RowValue row_value(std::string_view) const override {
    return sdk::RowValue::mean;
  }
  void end_row() override { row_.end_row(); }

  void summary(sdk::FigureSink& sink) const override {
    for (std::size_t c = 0; c < k_columns; ++c) {
      const double mean = means_.known_mean(c);
      sink.figure(k_names[c], mean, k_units[c], sdk::error_beside(mean, means_.error(c)),
                  sdk::detail(k_quantities[c]));
    }
    const double duration = means_.duration();
    const double volume = means_.mean(0) * duration;
    sink.figure("volume", volume, "m3",
                sdk::error_beside(volume, sdk::scaled_error(means_.error(0), duration)),
                sdk::detail(sdk::Quantity::volume));
    largest("depth_rate", "m/s", sdk::Quantity::velocity, Places::k_worn, sink);
    largest("pressure", "Pa", sdk::Quantity::pressure, Places::k_pressed, sink);
  }

  void fields(sdk::FieldSink& sink) const override {
    sink.field("depth_rate", "m/s", places_.grid(), places_.means(Places::k_worn),
               sdk::overview(sdk::Quantity::velocity, 1));
    sink.field("pressure", "Pa", places_.grid(), places_.means(Places::k_pressed),
               sdk::overview(sdk::Quantity::pressure, 2));
  }

  void save(sdk::ArchiveWriter& a) const override {
    places_.save(a);
    row_.save(a, "row");
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    places_.load(a);
    row_.load(a, "row");
    means_.load(a, "means");
  }

 private:
  static constexpr double k_max_cells = 500.0;  ///< per direction
  static constexpr std::size_t k_columns = 3;
  static constexpr const char* k_names[k_columns] = {"volume_rate", "normal_force",
                                                     "friction_power"};
  static constexpr const char* k_units[k_columns] = {"m3/s", "N", "W"};
  static constexpr sdk::Quantity k_quantities[k_columns] = {
      sdk::Quantity::volume_rate, sdk::Quantity::force, sdk::Quantity::power};

  /// The largest of all places and where it is; nowhere where nothing wears.
  void largest(const std::string& name, const char* unit, sdk::Quantity quantity,
               std::size_t column, sdk::FigureSink& sink) const {
    const Places::Place place = places_.largest(column);
    sink.figure(name + "_largest/value", place.mean, unit,
                sdk::error_beside(place.mean, place.error),
                sdk::overview(quantity, quantity == sdk::Quantity::pressure ? 2 : 1));
    constexpr sdk::Quantity k_places[] = {sdk::Quantity::x, sdk::Quantity::y, sdk::Quantity::z};
    for (int d = 0; d < 3; ++d) {
      const double middle = place.mean > 0.0 ? place.middle[d] : sdk::k_no_value;
      sink.figure(name + "_largest/" + "xyz"[d], middle, "m",
                  sdk::error_beside(middle, sdk::k_no_estimate), sdk::detail(k_places[d]));
    }
  }

  Parameters p_;
  sdk::WallSelection walls_;
  formula::Places places_;
  std::array<double, k_columns> values_{};
  sdk::RowMeans row_{k_columns};
  sdk::BatchMeans means_{k_columns};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Wear>(); }
