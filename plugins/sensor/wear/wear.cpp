// SPDX-License-Identifier: Apache-2.0
#include "wear.hpp"

#include <dust/sdk/grid_shape.hpp>
#include <dust/sdk/overview.hpp>
#include <dust/sdk/plugin.hpp>
#include <dust/sdk/sampling.hpp>

#include <algorithm>
#include <array>

namespace {

namespace formula = dust::model::wear;
namespace sdk = dust::sdk;

class Wear final : public sdk::Sensor {
 public:
  struct Parameters : sdk::SteadyParameters {
    sdk::Vec3 min;
    sdk::Vec3 max;
    double cell = 0.0;
    double coefficient = 0.0;
    double hardness = 0.0;
  };
  static sdk::ParameterSchema schema() {
    sdk::SchemaOf<Parameters> s;
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
            .version = "2.0",
            .summary = "Wear of liners by Archard's law and pressure on them, place by place.",
            .equation = R"(\dot V = \frac{k}{H} \sum_c w_c F_{n,c}\, v_{t,c},\quad )"
                        R"(p = \frac{1}{a^2} \sum_c w_c F_{n,c})",
            .source = "Archard, J. Appl. Phys. 24 (1953) 981, doi:10.1063/1.1721448"};
  }

  explicit Wear(const Parameters& p) : p_(p) {
    for (int d = 0; d < 3; ++d) {
      if (!(p.max[d] > p.min[d])) {
        throw sdk::ParameterError("'max' must lie above 'min' in x, y and z");
      }
      const double cells = std::ceil((p.max[d] - p.min[d]) / p.cell - 1e-9);
      if (cells > k_max_cells) throw sdk::ParameterError("'cell' makes too many places");
      grid_.count[d] = std::max(1, static_cast<int>(cells));
      grid_.spacing[d] = p.cell;
    }
    grid_.origin = p.min;
    const std::size_t cells = static_cast<std::size_t>(grid_.count[0]) *
                              static_cast<std::size_t>(grid_.count[1]) *
                              static_cast<std::size_t>(grid_.count[2]);
    volume_.assign(cells, 0.0);
    force_.assign(cells, 0.0);
  }

  [[nodiscard]] bool wants_contacts() const override { return true; }
  [[nodiscard]] sdk::SurfacesWanted wanted_surfaces() const override {
    sdk::SurfacesWanted wanted;
    wanted.wall_in = {p_.min, p_.max};
    return wanted;
  }

  void observe(const sdk::WorldView& world) override {
    values_.fill(0.0);
    const bool is_steady = sdk::is_after(world, p_.steady_after);
    const sdk::ContactColumns& c = world.contacts;
    for (std::size_t q = 0; q < c.grain_i.size(); ++q) {
      if (c.grain_j[q] >= 0) continue;
      const auto i = static_cast<std::size_t>(c.grain_i[q]);
      look_at(world, q, i, is_steady);
    }
    row_.add(values_, world.interval);
    if (!is_steady) return;
    means_.add(values_, world.interval);
    duration_ += world.interval;
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
    sink.figure("volume", means_.mean(0) * duration_, "m3", -1.0,
                sdk::detail(sdk::Quantity::volume));
    const double area = p_.cell * p_.cell;
    const double per_time = duration_ > 0.0 ? 1.0 / (duration_ * area) : sdk::k_no_value;
    largest("depth_rate", "m/s", sdk::Quantity::velocity, volume_, per_time, sink);
    largest("pressure", "Pa", sdk::Quantity::pressure, force_, per_time, sink);
  }

  void fields(sdk::FieldSink& sink) const override {
    const double per_time = duration_ > 0.0 ? 1.0 / (duration_ * p_.cell * p_.cell) : 0.0;
    std::vector<double> scaled(volume_.size());
    std::transform(volume_.begin(), volume_.end(), scaled.begin(),
                   [&](double v) { return v * per_time; });
    sink.field("depth_rate", "m/s", grid_, scaled, sdk::detail(sdk::Quantity::velocity));
    std::transform(force_.begin(), force_.end(), scaled.begin(),
                   [&](double v) { return v * per_time; });
    sink.field("pressure", "Pa", grid_, scaled, sdk::detail(sdk::Quantity::pressure));
  }

  void save(sdk::ArchiveWriter& a) const override {
    const double numbers[] = {duration_};
    a.numbers("duration", numbers);
    a.numbers("volume", volume_);
    a.numbers("force", force_);
    row_.save(a, "row");
    means_.save(a, "means");
  }
  void load(sdk::ArchiveReader& a) override {
    duration_ = a.numbers("duration").at(0);
    volume_ = a.numbers("volume");
    force_ = a.numbers("force");
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

  void look_at(const sdk::WorldView& world, std::size_t q, std::size_t i, bool is_steady) {
    const sdk::ContactColumns& c = world.contacts;
    const sdk::GrainColumns& g = world.grains;
    const sdk::Vec3 branch{c.branch_x[q], c.branch_y[q], c.branch_z[q]};
    const sdk::Vec3 point = sdk::Vec3{g.x[i], g.y[i], g.z[i]} + branch;
    const double arm = norm(branch);
    if (!sdk::is_in_box(point, p_.min, p_.max) || !(arm > 0.0)) return;
    const sdk::Vec3 into = branch / arm;  // into the wall
    const sdk::Vec3 on_grain{c.force_x[q], c.force_y[q], c.force_z[q]};
    const double normal = -dot(on_grain, into);
    const sdk::Vec3 spin{g.angular_velocity_x[i], g.angular_velocity_y[i], g.angular_velocity_z[i]};
    sdk::Vec3 slip = sdk::Vec3{g.velocity_x[i], g.velocity_y[i], g.velocity_z[i]} +
                     cross(spin, branch) -
                     sdk::Vec3{c.wall_velocity_x[q], c.wall_velocity_y[q], c.wall_velocity_z[q]};
    slip -= dot(slip, into) * into;
    const sdk::Vec3 friction = on_grain + normal * into;
    if (!(normal > 0.0)) return;  // a grain that is held by cohesion only wears nothing
    const double worn =
        g.weight[i] * formula::archard(p_.coefficient, p_.hardness, normal, norm(slip));
    values_[0] += worn;
    values_[1] += g.weight[i] * normal;
    values_[2] -= g.weight[i] * dot(friction, slip);
    if (!is_steady) return;
    std::size_t cell = 0;
    for (int d = 2; d >= 0; --d) {
      const int n =
          std::min(static_cast<int>((point[d] - p_.min[d]) / p_.cell), grid_.count[d] - 1);
      cell = cell * static_cast<std::size_t>(grid_.count[d]) + static_cast<std::size_t>(n);
    }
    volume_[cell] += worn * world.interval;
    force_[cell] += g.weight[i] * normal * world.interval;
  }

  /// The largest of all places and where it is; nowhere where nothing wears.
  void largest(const std::string& name, const char* unit, sdk::Quantity quantity,
               const std::vector<double>& sums, double factor, sdk::FigureSink& sink) const {
    const auto most = std::max_element(sums.begin(), sums.end());
    auto index = static_cast<std::size_t>(most - sums.begin());
    const double value = *most * factor;
    sink.figure(name + "_largest/value", value, unit, sdk::error_beside(value, sdk::k_no_estimate),
                sdk::overview(quantity, quantity == sdk::Quantity::pressure ? 2 : 1));
    constexpr sdk::Quantity k_places[] = {sdk::Quantity::x, sdk::Quantity::y, sdk::Quantity::z};
    for (int d = 0; d < 3; ++d) {
      const auto count = static_cast<std::size_t>(grid_.count[d]);
      const double middle = p_.min[d] + (static_cast<double>(index % count) + 0.5) * p_.cell;
      index /= count;
      const double place = *most > 0.0 ? middle : sdk::k_no_value;
      sink.figure(name + "_largest/" + "xyz"[d], place, "m",
                  sdk::error_beside(place, sdk::k_no_estimate), sdk::detail(k_places[d]));
    }
  }

  Parameters p_;
  sdk::GridShape grid_;
  std::vector<double> volume_;  ///< [m3] worn off per place while steady
  std::vector<double> force_;   ///< [N s]
  double duration_ = 0.0;       ///< [s]
  std::array<double, k_columns> values_{};
  sdk::RowMeans row_{k_columns};
  sdk::BatchMeans means_{k_columns};
};

}  // namespace

DUST_PLUGIN(registrar) { registrar.add<Wear>(); }
