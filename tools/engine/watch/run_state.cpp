// SPDX-License-Identifier: Apache-2.0
#include "watch/run_state.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "io/atomic_file.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/text/tree.hpp"

#include <nlohmann/json.hpp>

#include <fcntl.h>
#include <sys/file.h>
#include <unistd.h>

#include <cerrno>
#include <cstdlib>
#include <sstream>
#include <vector>

namespace dust::engine {
namespace {

namespace fs = std::filesystem;

/// As core/run/folder/output_folder.cpp locks it.
bool is_locked(const fs::path& folder) {
  const int log = ::open((folder / "run.log").c_str(), O_RDONLY | O_CLOEXEC);
  if (log < 0) return false;
  const bool is_free = ::flock(log, LOCK_SH | LOCK_NB) == 0;
  const bool is_held = !is_free && errno == EWOULDBLOCK;
  ::close(log);
  return is_held;
}

std::vector<std::string> cells_of(const std::string& line) {
  std::vector<std::string> cells;
  std::istringstream in(line);
  for (std::string cell; std::getline(in, cell, ',');) cells.push_back(cell);
  return cells;
}

/// The last whole row; the one being written has no line end yet.
void read_series(const fs::path& file, RunState& state) {
  const std::string text = io::read_text(file);
  const std::size_t end = text.rfind('\n');
  if (end == std::string::npos || end == 0) return;
  const std::size_t begin = text.rfind('\n', end - 1);
  if (begin == std::string::npos) return;  // the header alone
  const auto names = cells_of(text.substr(0, text.find('\n')));
  const auto values = cells_of(text.substr(begin + 1, end - begin - 1));
  for (std::size_t n = 0; n < std::min(names.size(), values.size()); ++n) {
    if (names[n] == "time [s]") state.time = std::strtod(values[n].c_str(), nullptr);
    if (names[n] == "particles [1]") state.particles = std::strtod(values[n].c_str(), nullptr);
  }
}

double end_of(const fs::path& scenario) {
  scenario::Diagnostics ignored;
  const auto root =
      scenario::parse_yaml(io::read_text(scenario), scenario.string(), false, ignored);
  const scenario::Entry* time = root && root->is_map() ? root->find("time") : nullptr;
  const scenario::Entry* end =
      time != nullptr && time->value.is_map() ? time->value.find("end") : nullptr;
  return end != nullptr ? std::strtod(end->value.text.c_str(), nullptr) : 0.0;
}

}  // namespace

RunState read_run_state(const fs::path& folder) {
  if (!fs::exists(folder / "run.log") || !fs::exists(folder / "scenario.yaml")) {
    throw base::UserError("error: " + folder.string() +
                          " holds no run: run.log and scenario.yaml are not there");
  }
  RunState state;
  state.is_running = is_locked(folder);
  state.end = end_of(folder / "scenario.yaml");
  read_series(folder / "series.csv", state);
  const auto summary =
      nlohmann::json::parse(io::read_text(folder / "summary.json"), nullptr, false);
  if (summary.is_object()) {
    state.status = summary.value("status", "");
    state.reason = summary.value("reason", "");
  }
  return state;
}

std::string state_text(const RunState& state) {
  std::string text =
      "t = " + base::digits_text(state.time, 4) + " of " + base::digits_text(state.end, 4) + " s";
  if (state.end > 0.0) text += ", " + base::fixed_text(100.0 * state.time / state.end, 1) + " %";
  return text + ", " + base::fixed_text(state.particles, 0) + " grains";
}

}  // namespace dust::engine
