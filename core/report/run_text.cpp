// SPDX-License-Identifier: Apache-2.0
#include "report/run_text.hpp"

#include "base/error.hpp"
#include "base/process/shell_word.hpp"

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace dust::report {

namespace {

using nlohmann::json;

std::optional<std::string> read_text(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return std::nullopt;
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

std::string trimmed(const std::string& text) {
  const auto first = text.find_first_not_of(" \t");
  if (first == std::string::npos) return {};
  return text.substr(first, text.find_last_not_of(" \t") - first + 1);
}

std::vector<SeriesColumn> parse_series(const std::string& text) {
  std::istringstream lines(text);
  std::string line;
  std::vector<SeriesColumn> columns;
  if (!std::getline(lines, line)) return columns;
  for (const std::string& cell : csv_cells(line)) {
    SeriesColumn column;
    const auto open = cell.rfind('[');
    const auto close = cell.rfind(']');
    if (open != std::string::npos && close != std::string::npos && close > open) {
      column.unit = cell.substr(open + 1, close - open - 1);
      column.name = trimmed(cell.substr(0, open));
    } else {
      column.name = trimmed(cell);
    }
    columns.push_back(std::move(column));
  }
  while (std::getline(lines, line)) {
    const auto cells = csv_cells(line);
    if (cells.size() != columns.size()) continue;  // the row being written when the run stopped
    for (std::size_t k = 0; k < cells.size(); ++k) {
      char* end = nullptr;
      const double value = std::strtod(cells[k].c_str(), &end);
      columns[k].values.push_back(end == cells[k].c_str() ? std::nan("") : value);
    }
  }
  return columns;
}

}  // namespace

std::vector<std::string> csv_cells(const std::string& line) {
  std::vector<std::string> cells(1);
  bool is_quoted = false;
  for (std::size_t k = 0; k < line.size(); ++k) {
    const char c = line[k];
    if (c == '"' && is_quoted && k + 1 < line.size() && line[k + 1] == '"') {
      cells.back() += '"';
      ++k;
    } else if (c == '"') {
      is_quoted = !is_quoted;
    } else if (c == ',' && !is_quoted) {
      cells.emplace_back();
    } else if (c != '\r') {
      cells.back() += c;
    }
  }
  return cells;
}

std::optional<double> number_at(const json& object, const char* key) {
  if (!object.is_object()) return std::nullopt;
  const auto found = object.find(key);
  if (found == object.end() || !found->is_number()) return std::nullopt;
  return found->get<double>();
}

std::string text_at(const json& object, const char* key) {
  if (!object.is_object()) return {};
  const auto found = object.find(key);
  if (found == object.end() || !found->is_string()) return {};
  return found->get<std::string>();
}

const json& object_at(const json& object, const char* key) {
  static const json k_empty = json::object();
  if (!object.is_object()) return k_empty;
  const auto found = object.find(key);
  return found != object.end() && found->is_object() ? *found : k_empty;
}

const json& list_at(const json& object, const char* key) {
  static const json k_empty = json::array();
  if (!object.is_object()) return k_empty;
  const auto found = object.find(key);
  return found != object.end() && found->is_array() ? *found : k_empty;
}

namespace {

/// A run that goes on, or was killed, has not written what it is read from.
[[noreturn]] void refuse_unfinished(const std::filesystem::path& folder) {
  const std::string name = folder.string();
  const std::string quoted = base::shell_word(name);
  const bool can_go_on = std::filesystem::exists(folder / "checkpoint.h5");
  throw base::UserError(
      "error: " + name +
      " holds a run that has not ended: it has no summary.json yet; 'engine watch " + quoted +
      "' tells whether it goes on; one that was stopped goes on with 'engine run " +
      base::shell_word((folder / "scenario.yaml").string()) + " -o " + quoted +
      (can_go_on ? " --resume'" : " --force', from the start: it has no checkpoint"));
}

}  // namespace

RunText read_run_text(const std::filesystem::path& folder) {
  const std::string name = folder.string();
  if (!std::filesystem::is_directory(folder)) {
    throw base::UserError("error: " + name +
                          " is not a folder; give the output folder of a run, for example "
                          "results/transfer_point");
  }
  const auto summary = read_text(folder / "summary.json");
  if (!summary && std::filesystem::exists(folder / "scenario.yaml")) refuse_unfinished(folder);
  if (!summary) {
    throw base::UserError("error: " + name +
                          " is not the output folder of a run: it has no summary.json; give the "
                          "folder that 'engine run' named, or run the scenario first");
  }
  json parsed = json::parse(*summary, nullptr, false);
  if (!parsed.is_object()) {
    throw base::UserError("error: " + (folder / "summary.json").string() +
                          " is damaged (not a JSON object); run the scenario again, or go on from "
                          "its checkpoint with 'engine run SCENARIO --resume'");
  }
  const auto report = read_text(folder / "report.json");
  return read_run_text(folder, std::move(parsed),
                       report ? json::parse(*report, nullptr, false) : json::object());
}

RunText read_run_text(const std::filesystem::path& folder, json summary, json report) {
  RunText run;
  run.summary = std::move(summary);
  run.report = std::move(report);
  if (!run.report.is_object()) {
    run.report = json::object();
    run.notes.emplace_back("report.json is damaged: curves, tables and body outlines are missing.");
  }
  if (const auto text = read_text(folder / "scenario.yaml")) run.scenario = *text;
  if (const auto text = read_text(folder / "series.csv")) run.series = parse_series(*text);
  run.dust = DustSizes(object_at(run.report, "dust_rule"));
  run.figures = figures_of(object_at(run.summary, "sensors"));
  return run;
}

}  // namespace dust::report
