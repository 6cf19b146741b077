// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/text/tree.hpp"

#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dust::study {

/// One key of the base scenario and what it is set to.
struct Setting {
  std::string path;      ///< dotted, as for --set
  scenario::Node value;  ///< as written
  scenario::Mark where;  ///< of the key
};

/// One level of an axis: what is set together.
struct Level {
  std::string label;  ///< of a case; "" for values
  std::vector<Setting> settings;
  scenario::Mark where;
};

enum class AxisKind { values, zipped, cases, samples };

/// Something that is varied; the points of a study are all combinations of levels of its axes.
struct Axis {
  AxisKind kind = AxisKind::values;
  std::vector<std::string> paths;  ///< set by every level; empty for cases
  std::vector<Level> levels;
  scenario::Mark where;
};

/// A quantity that is taken from every run.
struct Measure {
  std::string name;      ///< column of the table
  std::string quantity;  ///< dotted path: sensors.NAME.FIGURE or a figure of summary.json
  std::string minus;     ///< a second quantity that is taken off; "" = none
  std::string unit;      ///< "" = that of the quantity
  scenario::Mark where;
};

/// A level at which an input is held.
struct HeldInput {
  std::string path;   ///< of an axis, or "case"
  std::string level;  ///< as written
  std::size_t axis = 0;
  std::size_t index = 0;  ///< of the level
};

/// The sign an effect should have, stated before the runs.
struct Expectation {
  std::string output;         ///< name of a measure
  std::string input;          ///< path of an axis, or "case"
  std::vector<HeldInput> at;  ///< where it is looked at; the mean over all other inputs
  std::string then;           ///< rises | falls
  std::string from;           ///< of cases: their names
  std::string to;
  std::string why;
  scenario::Mark where;
};

/// How many runs at a time.
struct Execution {
  std::int64_t jobs = 0;     ///< 0 = what the cores allow
  std::int64_t threads = 0;  ///< of each run; 0 = what the cores allow
  double memory_share = 0.8;
  static const sdk::ParameterSchema& schema();
};

/// What the cluster is asked for.
struct SlurmSpec {
  std::string partition;
  std::string account;
  std::string time_limit;
  std::int64_t at_a_time = 0;
  std::int64_t attempts = 2;
  std::int64_t points_per_job = 1;
  std::vector<std::string> options;
  std::vector<std::string> prologue;
  static const sdk::ParameterSchema& schema();
};

/// What a run should give: a measured value and its standard error.
struct Target {
  Measure measure;
  double value = 0.0;  ///< in the unit of the measure
  double error = 0.0;
};

/// A parameter to be found in an interval; it may stand in several places of the scenario.
struct FreeParameter {
  std::string name;
  std::vector<std::string> paths;
  double low = 0.0;
  double high = 0.0;
  std::string unit;  ///< of both, as written
  scenario::Mark where;
};

struct CalibrationSpec {
  std::vector<Target> targets;
  std::vector<FreeParameter> parameters;
  std::string surrogate = "gaussian_process";
  std::int64_t runs = 30;
  std::int64_t first_runs = 0;
  std::int64_t batch = 2;
  double confidence = 0.95;
  static const sdk::ParameterSchema& schema();
  scenario::Mark where;
};

/// A study as written: nothing is resolved yet.
struct Spec {
  std::filesystem::path file;
  std::string name;
  std::string title;
  std::filesystem::path base;
  scenario::Mark base_where;
  std::vector<Setting> settings;
  std::vector<Axis> axes;
  std::int64_t replicates = 1;
  std::int64_t seed = -1;  ///< of the first replicate; -1 = that of the scenario
  scenario::Mark where;
  std::vector<Measure> measures;
  std::vector<Expectation> expectations;
  Execution execution;
  SlurmSpec slurm;
  std::optional<CalibrationSpec> calibration;
};

/// Reads a study file; problems go to `diagnostics`. Nothing where the file cannot be used at all.
std::optional<Spec> read_spec(const std::filesystem::path& file,
                              scenario::Diagnostics& diagnostics);

/// JSON Schema (draft-07) of study files.
std::string study_schema();

/// A value with its unit where several were written with the unit on the last alone.
std::vector<scenario::Node> with_common_unit(std::vector<scenario::Node> values);

}  // namespace dust::study
