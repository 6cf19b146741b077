// SPDX-License-Identifier: Apache-2.0
#include "run/summary/series_row.hpp"

#include "run/summary/summary_dust.hpp"
#include "run/summary/summary_energy.hpp"

#include <numeric>
#include <utility>

namespace dust::run {
namespace {

using sdk::RowValue;

constexpr sdk::FigureRole k_mass_role = sdk::detail(sdk::Quantity::mass);
constexpr sdk::FigureRole k_balance = {.role = sdk::Role::balance, .quantity = sdk::Quantity::mass};

double kinetic_energy(const Simulation& s) {
  const auto c = s.world().grains;
  double translation = 0.0;
  double rotation = 0.0;
  for (std::size_t n = 0; n < c.id.size(); ++n) {
    const double m = c.weight[n] * c.mass[n];
    const double r = 0.5 * c.diameter[n];
    translation += 0.5 * m *
                   (c.velocity_x[n] * c.velocity_x[n] + c.velocity_y[n] * c.velocity_y[n] +
                    c.velocity_z[n] * c.velocity_z[n]);
    rotation += 0.2 * m * r * r *
                (c.angular_velocity_x[n] * c.angular_velocity_x[n] +
                 c.angular_velocity_y[n] * c.angular_velocity_y[n] +
                 c.angular_velocity_z[n] * c.angular_velocity_z[n]);
  }
  return translation + rotation;
}

void visit_own(const Simulation& s, const ColumnVisitor& visit) {
  const auto& b = s.dem().balance();
  const auto number = sdk::detail(sdk::Quantity::number);
  visit("time [s]", s.time(), RowValue::instant, sdk::detail(sdk::Quantity::time));
  visit("kinetic_energy [J]", kinetic_energy(s), RowValue::instant,
        sdk::detail(sdk::Quantity::energy));
  visit("particles [1]", static_cast<double>(b.in_domain), RowValue::instant, number);
  visit("real_particles [1]", b.real_in_domain, RowValue::instant, number);
  visit("mass_emitted [kg]", b.mass_emitted, RowValue::total, k_balance);
  visit("mass_in_domain [kg]", b.mass_in_domain, RowValue::instant, k_balance);
  visit("mass_left [kg]", b.mass_left, RowValue::total, k_balance);
  visit("mass_removed [kg]", b.mass_removed, RowValue::total, k_balance);
}

void visit_hoods(const Simulation& s, const ColumnVisitor& visit) {
  for (std::size_t o = 0; o < s.dem().openings().size(); ++o) {
    const Drawn drawn = drawn_by(s, o);
    const std::string hood = "hoods/" + s.dem().openings()[o].name;
    visit(hood + "/mass [kg]", drawn.mass, RowValue::total, k_mass_role);
    visit(hood + "/dust [kg]", drawn.dust, RowValue::total, k_mass_role);
    if (s.dust_stage() == nullptr) continue;
    visit(hood + "/field_dust [kg]", drawn.field_dust, RowValue::total, k_mass_role);
  }
}

void visit_dust_field(const Simulation& s, const ColumnVisitor& visit) {
  const DustStage* dust = s.dust_stage();
  if (dust == nullptr) return;
  for (std::size_t n = 0; n < dust->field().classes(); ++n) {
    const airborne::DustBalance balance = dust->field().balance(n);
    const std::string of = "dust_field/" + dust->class_names()[n];
    const auto sum = [](const auto& values) {
      return std::accumulate(values.begin(), values.end(), 0.0);
    };
    visit(of + "/released [kg]", balance.released, RowValue::total, k_mass_role);
    visit(of + "/airborne [kg]", balance.airborne, RowValue::instant, k_mass_role);
    visit(of + "/deposited [kg]", sum(balance.surfaces), RowValue::total, k_mass_role);
    visit(of + "/left [kg]", sum(balance.left), RowValue::total, k_mass_role);
    visit(of + "/hoods [kg]", sum(balance.outlets), RowValue::total, k_mass_role);
    if (dust->field().has_resuspension()) {
      visit(of + "/resuspended [kg]", balance.resuspended, RowValue::total, k_mass_role);
    }
    if (dust->field().has_running_surfaces()) {
      visit(of + "/carried_out [kg]", sum(balance.carried_out), RowValue::total, k_mass_role);
    }
    if (dust->has_scavenging())
      visit(of + "/caught [kg]", balance.caught, RowValue::total, k_mass_role);
  }
}

void visit_dust_on_grains(const Simulation& s, const ColumnVisitor& visit) {
  if (s.liberation() == nullptr) return;
  const std::vector<std::string>& classes = s.dust_stage()->class_names();
  for (std::size_t n = 0; n < classes.size(); ++n) {
    const particles::DustLoads::Balance balance = s.dem().dust_balance(n);
    const std::string of = "dust_on_grains/" + classes[n];
    visit(of + "/on_grains [kg]", balance.on_grains, RowValue::instant, k_mass_role);
    visit(of + "/set_free [kg]", balance.set_free, RowValue::total, k_mass_role);
  }
}

/// Passes on the columns of one sensor.
class SensorColumns final : public sdk::FigureSink {
 public:
  SensorColumns(const sdk::Sensor& sensor, std::string prefix, const ColumnVisitor& visit)
      : sensor_(sensor), prefix_(std::move(prefix)), visit_(visit) {}
  void figure(std::string_view name, double value, std::string_view unit, double,
              const sdk::FigureRole& role) override {
    visit_(prefix_ + std::string(name) + " [" + std::string(unit) + "]", value,
           sensor_.row_value(name), role);
  }

 private:
  const sdk::Sensor& sensor_;
  std::string prefix_;
  const ColumnVisitor& visit_;
};

}  // namespace

void for_sensor_columns(const sdk::Sensor& sensor, const std::string& name,
                        const ColumnVisitor& visit) {
  SensorColumns sink(sensor, name + "/", visit);
  sensor.series(sink);
}

void for_series_columns(const Simulation& s, const ColumnVisitor& visit) {
  visit_own(s, visit);
  visit_hoods(s, visit);
  visit_dust_field(s, visit);
  visit_dust_on_grains(s, visit);
  visit_energy(s, visit);
  for (std::size_t n = 0; n < s.models().sensors.size(); ++n) {
    for_sensor_columns(*s.models().sensors[n], s.setup().sensors[n].name, visit);
  }
}

SeriesRow series_row(const Simulation& s) {
  SeriesRow row;
  for_series_columns(
      s, [&](const std::string& name, double value, RowValue kind, const sdk::FigureRole&) {
        row.names.push_back(name);
        row.values.push_back(value);
        row.kinds.push_back(kind);
      });
  return row;
}

const char* name_of(RowValue kind) {
  static constexpr const char* k_names[] = {"instant", "mean", "total"};
  return k_names[static_cast<int>(kind)];
}

}  // namespace dust::run
