// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "run/simulation.hpp"

#include <functional>
#include <string>
#include <vector>

namespace dust::run {

/// Gets a column of series.csv: "name [unit]", its value, what that stands for, what it is. The
/// role holds for the call alone.
using ColumnVisitor = std::function<void(const std::string& name, double value, sdk::RowValue kind,
                                         const sdk::FigureRole& role)>;

/// All columns of series.csv in their order: the run's own, hoods, dust field, sensors.
void for_series_columns(const Simulation& simulation, const ColumnVisitor& visit);

/// The columns of one sensor, which a scenario calls `name`.
void for_sensor_columns(const sdk::Sensor& sensor, const std::string& name,
                        const ColumnVisitor& visit);

/// A row of series.csv.
struct SeriesRow {
  std::vector<std::string> names;  ///< "name [unit]"
  std::vector<double> values;
  std::vector<sdk::RowValue> kinds;  ///< what each column stands for
};
SeriesRow series_row(const Simulation& simulation);

/// What a column stands for, as files name it.
const char* name_of(sdk::RowValue kind);

}  // namespace dust::run
