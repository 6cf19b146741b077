// SPDX-License-Identifier: Apache-2.0
#include "study/point_store.hpp"

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "scenario/text/suggest.hpp"
#include "study/quantities.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <cmath>
#include <fstream>
#include <iterator>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

nlohmann::json json_of(const fs::path& file) {
  std::ifstream stream(file, std::ios::binary);
  if (!stream) return nullptr;
  auto json = nlohmann::json::parse(stream, nullptr, false);
  return json.is_object() ? json : nlohmann::json(nullptr);
}

/// One line without control characters.
std::string one_line(std::string text) {
  std::replace_if(
      text.begin(), text.end(), [](unsigned char c) { return c < 0x20 || c == 0x7f; }, ' ');
  return text;
}

/// The figure at `path`: 0 where the run leaves it out because it is; none where it tells nothing.
/// Its value is NaN where the run says that there is none.
std::optional<Figure> figure_at(const std::map<std::string, Figure>& figures,
                                const std::string& path, const std::string& zero_beside) {
  if (const auto at = figures.find(path); at != figures.end()) return at->second;
  if (!zero_beside.empty() && figures.contains(zero_beside)) return Figure{};
  return std::nullopt;
}

void take_off(const std::map<std::string, Figure>& figures, const OutputColumn& column,
              OutputValue& output) {
  const auto off = figure_at(figures, column.minus, column.minus_zero_beside);
  if (!off || std::isnan(off->value)) {
    if (off && output.value) output.no_error = off->no_error;
    output.value.reset();
  }
  if (!output.value) return;
  *output.value -= column.factor * off->value;
  // As if independent: quantiles of one stream are not quite.
  output.error = output.error >= 0.0 && off->error >= 0.0
                     ? std::hypot(output.error, column.factor * off->error)
                     : -1.0;
  if (output.no_error != k_not_steady && !off->no_error.empty()) output.no_error = off->no_error;
}

}  // namespace

std::string last_problem(const fs::path& log) {
  std::ifstream stream(log, std::ios::binary);
  std::string line;
  std::string last;
  std::string last_error;
  while (std::getline(stream, line)) {
    if (line.find_first_not_of(" \t\r") == std::string::npos) continue;
    last = line;
    if (line.find("error") != std::string::npos) last_error = line;
  }
  return one_line(last_error.empty() ? last : last_error);
}

fs::path PointStore::scenario_of(const Point& point) const {
  return folder_ / "points" / (point.hash + ".yaml");
}
fs::path PointStore::results_of(const Point& point) const {
  return folder_ / "points" / point.hash;
}
fs::path PointStore::log_of(const Point& point) const {
  return folder_ / "points" / (point.hash + ".log");
}
fs::path PointStore::failure_of(const Point& point) const {
  return folder_ / "points" / (point.hash + ".failed");
}

void PointStore::prepare(const Point& point) const {
  fs::create_directories(folder_ / "points");
  // Files that it reads may lie elsewhere by now.
  const fs::path file = scenario_of(point);
  if (fs::exists(file) && io::read_text(file) == point.resolved_yaml) return;
  io::write_text(file, point.resolved_yaml);
}

bool PointStore::has_checkpoint(const Point& point) const {
  return fs::exists(results_of(point) / "checkpoint.h5");
}

Outcome PointStore::read(const Point& point, const std::vector<OutputColumn>& columns) const {
  Outcome outcome;
  const fs::path summary = results_of(point) / "summary.json";
  const nlohmann::json json = json_of(summary);
  if (json.is_object() && json.value("status", "") == "finished") {
    outcome.status = Status::finished;
    const auto figures = read_figures(summary);
    if (const auto wall = figures.find("wall_s"); wall != figures.end()) {
      outcome.wall_s = wall->second.value;
    }
    for (const OutputColumn& column : columns) {
      OutputValue output;
      if (const auto at = figure_at(figures, column.quantity, column.zero_beside)) {
        if (!std::isnan(at->value)) output.value = column.factor * at->value;
        if (at->error >= 0.0) output.error = column.factor * at->error;
        output.no_error = at->no_error;
      }
      if (!column.minus.empty()) take_off(figures, column, output);
      outcome.outputs.push_back(output);
    }
    return outcome;
  }
  const nlohmann::json failure = json_of(failure_of(point));
  if (failure.is_object()) {
    outcome.status = Status::failed;
    outcome.reason = failure.value("reason", "");
    outcome.wall_s = failure.value("wall_s", 0.0);
  }
  return outcome;
}

void PointStore::note_failure(const Point& point, const std::string& fallback) const {
  const nlohmann::json summary = json_of(results_of(point) / "summary.json");
  nlohmann::json failure = {{"reason", fallback}, {"wall_s", 0.0}};
  if (summary.is_object()) {
    if (summary.value("status", "") == "failed" && summary.contains("reason")) {
      failure["reason"] = one_line(summary.value("reason", fallback));
    }
    failure["wall_s"] = summary.value("wall_s", 0.0);
  }
  io::write_text(failure_of(point), failure.dump() + "\n");
}

void PointStore::discard_failure(const Point& point) const {
  std::error_code ignored;
  fs::remove(failure_of(point), ignored);
}

}  // namespace dust::study
