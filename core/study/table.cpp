// SPDX-License-Identifier: Apache-2.0
#include "study/table.hpp"

#include "io/atomic_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_files.hpp"
#include "scenario/text/units.hpp"
#include "study/calibration/calibration_h5.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::study {
namespace {

/// RFC 4180: a field with a comma, quote or line break is quoted.
std::string field(const std::string& text) {
  if (text.find_first_of(",\"\n\r") == std::string::npos) return text;
  std::string quoted = "\"";
  for (const char c : text) quoted += c == '"' ? std::string("\"\"") : std::string(1, c);
  return quoted + '"';
}

std::string column_name(const std::string& name, const std::string& unit) {
  return field(unit.empty() ? name : name + " [" + unit + "]");
}

/// A link in an HDF5 file must not hold '/'.
std::string link_name(std::string name) {
  std::replace(name.begin(), name.end(), '/', '|');
  return name;
}

void write_numbers(hid_t group, const std::string& name, const std::vector<double>& values,
                   const std::string& unit, const std::string& meaning) {
  io::write_array(group, link_name(name), H5T_NATIVE_DOUBLE, values.data(), {values.size()},
                  io::Storage::plain, {unit.c_str(), meaning.c_str()});
}

/// Texts of one length each, padded with zeros: read by h5py as bytes.
void write_texts(hid_t group, const std::string& name, const std::vector<std::string>& values,
                 const std::string& meaning) {
  std::size_t width = 1;
  for (const std::string& v : values) width = std::max(width, v.size());
  std::string packed;
  for (const std::string& v : values) packed += v + std::string(width - v.size(), '\0');
  io::Handle type(H5Tcopy(H5T_C_S1), H5Tclose, "a text type");
  H5Tset_size(type.get(), width);
  H5Tset_cset(type.get(), H5T_CSET_UTF8);
  io::write_array(group, link_name(name), type.get(), packed.data(), {values.size()},
                  io::Storage::plain, {"", meaning.c_str()});
}

}  // namespace

const char* status_word(Status status) {
  switch (status) {
    case Status::waiting:
      return "waiting";
    case Status::finished:
      return "finished";
    case Status::failed:
      return "failed";
  }
  return "";
}

std::string why_no_errors(const Plan& plan, const Outcome& outcome) {
  std::string text;
  for (std::size_t k = 0; k < outcome.outputs.size(); ++k) {
    const OutputValue& v = outcome.outputs[k];
    if (v.error >= 0.0 || v.no_error.empty()) continue;
    text += (text.empty() ? "" : "; ") + plan.outputs[k].name + ": " + v.no_error;
  }
  return text;
}

void write_csv(const std::filesystem::path& file, const Results& results) {
  const Plan& plan = results.plan;
  std::string text = "point";
  for (const InputColumn& c : plan.inputs) text += "," + column_name(c.name, c.unit);
  text += ",replicate";
  for (const OutputColumn& c : plan.outputs) {
    text += "," + column_name(c.name, c.unit);
    if (c.has_error) text += "," + column_name(c.name + " error", c.unit);
  }
  text += ",status,seed,hash,wall_s [s],reason,no_error\n";
  for (std::size_t n = 0; n < plan.points.size(); ++n) {
    const Point& point = plan.points[n];
    const Outcome& outcome = results.outcomes[n];
    text += std::to_string(n + 1);
    for (const InputValue& v : point.inputs) text += "," + field(v.text);
    text += "," + std::to_string(point.replicate);
    for (std::size_t k = 0; k < plan.outputs.size(); ++k) {
      const OutputValue v = k < outcome.outputs.size() ? outcome.outputs[k] : OutputValue{};
      text += "," + (v.value ? scenario::number_text(*v.value) : std::string());
      if (!plan.outputs[k].has_error) continue;
      text += "," + (v.value && v.error >= 0.0 ? scenario::number_text(v.error) : std::string());
    }
    text += std::string(",") + status_word(outcome.status) + "," + std::to_string(point.seed) +
            "," + point.hash + ",";
    if (outcome.status != Status::waiting) text += scenario::number_text(outcome.wall_s);
    text += "," + field(outcome.reason) + "," + field(why_no_errors(plan, outcome)) + "\n";
  }
  io::write_text(file, text);
}

namespace {

void write_inputs(hid_t root, const Plan& plan) {
  const io::Handle group = io::create_group(root, "inputs");
  for (std::size_t k = 0; k < plan.inputs.size(); ++k) {
    const InputColumn& c = plan.inputs[k];
    std::vector<double> numbers;
    std::vector<std::string> texts;
    for (const Point& point : plan.points) {
      numbers.push_back(point.inputs[k].number);
      texts.push_back(point.inputs[k].text);
    }
    if (c.is_text) {
      write_texts(group.get(), c.name, texts, "what was set");
    } else {
      write_numbers(group.get(), c.name, numbers, c.unit, "what was set");
    }
  }
}

void write_outputs(hid_t root, const Results& results) {
  const double nothing = std::numeric_limits<double>::quiet_NaN();
  const io::Handle outputs = io::create_group(root, "outputs");
  const io::Handle errors = io::create_group(root, "outputs_error");
  for (std::size_t k = 0; k < results.plan.outputs.size(); ++k) {
    const OutputColumn& c = results.plan.outputs[k];
    std::vector<double> values;
    std::vector<double> uncertain;
    for (const Outcome& o : results.outcomes) {
      const OutputValue v = k < o.outputs.size() ? o.outputs[k] : OutputValue{};
      values.push_back(v.value.value_or(nothing));
      uncertain.push_back(v.value && v.error >= 0.0 ? v.error : nothing);
    }
    write_numbers(outputs.get(), c.name, values, c.unit, c.quantity);
    if (c.has_error) {
      write_numbers(errors.get(), c.name, uncertain, c.unit, "standard error of " + c.quantity);
    }
  }
}

void write_points(hid_t root, const Results& results) {
  const io::Handle group = io::create_group(root, "points");
  std::vector<std::string> status;
  std::vector<std::string> hash;
  std::vector<std::string> reason;
  std::vector<std::string> no_error;
  std::vector<std::int64_t> seed;
  std::vector<std::int64_t> replicate;
  std::vector<double> wall;
  for (std::size_t n = 0; n < results.plan.points.size(); ++n) {
    const Point& point = results.plan.points[n];
    status.emplace_back(status_word(results.outcomes[n].status));
    hash.push_back(point.hash);
    reason.push_back(results.outcomes[n].reason);
    no_error.push_back(why_no_errors(results.plan, results.outcomes[n]));
    seed.push_back(static_cast<std::int64_t>(point.seed));
    replicate.push_back(point.replicate);
    wall.push_back(results.outcomes[n].wall_s);
  }
  write_texts(group.get(), "status", status, "finished, failed or waiting");
  write_texts(group.get(), "hash", hash, "of the resolved scenario; the folder in points/");
  write_texts(group.get(), "reason", reason, "of a failure");
  write_texts(group.get(), "no_error", no_error,
              "why an output has no standard error, or no value");
  io::write_array(group.get(), "seed", H5T_NATIVE_INT64, seed.data(), {seed.size()},
                  io::Storage::plain, {"1", "seed of the random numbers"});
  io::write_array(group.get(), "replicate", H5T_NATIVE_INT64, replicate.data(), {replicate.size()},
                  io::Storage::plain, {"1", "counted from 1"});
  write_numbers(group.get(), "wall_s", wall, "s", "time the run took");
}

}  // namespace

void write_h5(const std::filesystem::path& file, const Results& results,
              const CalibrationAnswer* answer) {
  io::Handle root = io::create_file(io::temporary_name(file));
  write_inputs(root.get(), results.plan);
  write_outputs(root.get(), results);
  write_points(root.get(), results);
  if (answer != nullptr) write_landscape(root.get(), *answer);
  root.close("study.h5");
  io::move_into_place(file, false);
}

}  // namespace dust::study
