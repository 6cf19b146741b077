// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "study/spec/spec.hpp"

#include <cstdint>
#include <filesystem>
#include <map>
#include <memory>
#include <set>
#include <string>
#include <vector>

namespace dust::study {

/// A column of the table: what was set.
struct InputColumn {
  std::string name;      ///< the path, "case", or the name of a calibrated parameter
  std::string unit;      ///< "" = none
  bool is_text = false;  ///< names, vectors
  std::size_t axis = 0;
};

/// What was set in one point.
struct InputValue {
  double number = 0.0;  ///< in the unit of the column
  std::string text;     ///< as shown
};

/// One run of a study.
struct Point {
  std::vector<InputValue> inputs;   ///< one per column
  std::vector<std::size_t> levels;  ///< one per axis
  std::int64_t replicate = 1;
  std::uint64_t seed = 0;
  std::string hash;           ///< of the resolved scenario and its files, 16 hexadecimal digits
  std::string resolved_yaml;  ///< what is run
  double core_seconds = 0.0;  ///< rough, for the order and the remaining time
  double memory_bytes = 0.0;  ///< rough
};

/// A measure with the unit it is told in.
struct OutputColumn {
  std::string name;
  std::string quantity;  ///< dotted path in summary.json
  std::string minus;     ///< another one that is taken off; "" = none
  std::string unit;
  double factor = 1.0;                 ///< from the run's unit
  bool has_error = false;              ///< sensors tell one
  std::string zero_beside = {};        ///< as Quantity::zero_beside
  std::string minus_zero_beside = {};  ///< the same of `minus`
};

/// Everything that is to be run, checked.
struct Plan {
  std::vector<InputColumn> inputs;
  std::vector<OutputColumn> outputs;
  std::vector<Point> points;
  std::set<std::filesystem::path> read_paths;  ///< files and folders that the points read
};

/// Whether the runs that points start from have to be there by now: not for a plan alone.
enum class Origins { there, to_come };

/// Resolves a study against its base scenario.
class Planner {
 public:
  /// Reads the base scenario with what the study sets. Problems go to `diagnostics`.
  Planner(const Spec& spec, const registry::Registry& registry, scenario::Diagnostics& diagnostics,
          Origins origins);
  ~Planner();

  /// All points with all checks; the plan is of use only where no errors were told.
  Plan plan();

  /// The columns of a calibration.
  Plan calibration_columns();
  /// One point of a calibration, at `values` in the units of the parameters. Throws
  /// base::UserError where the scenario refuses them.
  std::vector<Point> calibration_points(const std::vector<double>& values);

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

}  // namespace dust::study
