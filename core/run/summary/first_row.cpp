// SPDX-License-Identifier: Apache-2.0
#include "run/summary/first_row.hpp"

#include "dust/sdk/airborne_dust.hpp"

#include <algorithm>
#include <exception>
#include <memory>

namespace dust::run {
namespace {

void look(sdk::Sensor& sensor, const Simulation& s) {
  const sdk::WorldView view = s.world();
  sensor.observe(view);
  if (s.dust_stage() == nullptr) return;
  if (auto* observer = dynamic_cast<sdk::DustObserver*>(&sensor)) {
    observer->observe_dust(view, s.dust_stage()->columns());
  }
}

/// Puts into `row` what `sensor` shows of the moment.
void show(const sdk::Sensor& sensor, const std::string& name, SeriesRow& row) {
  for_sensor_columns(
      sensor, name,
      [&](const std::string& column, double value, sdk::RowValue kind, const sdk::FigureRole&) {
        if (kind != sdk::RowValue::instant) return;
        const auto found = std::find(row.names.begin(), row.names.end(), column);
        if (found != row.names.end()) {
          row.values[static_cast<std::size_t>(found - row.names.begin())] = value;
        }
      });
}

}  // namespace

SeriesRow first_row(const Simulation& s, const registry::Registry& registry,
                    std::span<const std::string> going_on) {
  SeriesRow row = series_row(s);
  for (const auto& spec : s.setup().sensors) {
    if (std::find(going_on.begin(), going_on.end(), spec.name) != going_on.end()) continue;
    try {
      const auto sensor = registry.create_as<sdk::Sensor>(spec.model);
      look(*sensor, s);
      show(*sensor, spec.name, row);
    } catch (const std::exception&) {
      // The run's own sensor says in the first step what it cannot do, and ends the run.
    }
  }
  return row;
}

}  // namespace dust::run
