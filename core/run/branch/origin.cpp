// SPDX-License-Identifier: Apache-2.0
#include "run/branch/origin.hpp"

#include "base/error.hpp"
#include "base/process/shell_word.hpp"
#include "base/text.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/text/tree.hpp"
#include "setup/mark.hpp"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <optional>
#include <system_error>

namespace dust::run {
namespace {

namespace fs = std::filesystem;

constexpr const char* k_remedy =
    "start_from needs a checkpoint of this version of the engine: run that scenario again";
/// Times that are meant to be the same differ by a few roundings.
constexpr double k_rounding = 1e-9;
/// Digits of a time in the name of a kept checkpoint: enough to tell two steps apart.
constexpr int k_digits = 10;

fs::path newest_of(const fs::path& folder) { return folder / "checkpoint.h5"; }

bool is_same_time(double a, double b) {
  return std::abs(a - b) <= k_rounding * std::max(1.0, std::abs(b));
}

struct Kept {
  double time = 0.0;
  fs::path file;
};

/// Ascending.
std::vector<Kept> kept_in(const fs::path& folder) {
  std::vector<Kept> kept;
  std::error_code none;
  for (const auto& entry : fs::directory_iterator(folder / k_kept_folder, none)) {
    const std::string stem = entry.path().stem().string();
    if (entry.path().extension() != ".h5" || !stem.ends_with("_s")) continue;
    double time = 0.0;
    const char* end = stem.data() + stem.size() - 2;
    const auto read = std::from_chars(stem.data(), end, time);
    if (read.ec == std::errc() && read.ptr == end) kept.push_back({time, entry.path()});
  }
  std::sort(kept.begin(), kept.end(), [](const Kept& a, const Kept& b) { return a.time < b.time; });
  return kept;
}

[[noreturn]] void refuse(const scenario::StartSpec& start, const std::string& problem) {
  throw base::UserError(scenario::place(start.where) + ": error: start_from: " + problem);
}

/// Throws base::UserError where there is none.
fs::path find_state(const scenario::StartSpec& start) {
  if (!has_origin(start)) {
    refuse(start, no_origin_text(start));
  }
  return *state_file(start);
}

/// The run has no state of the time that is asked for.
[[noreturn]] void refuse_time(const scenario::StartSpec& start, double newest) {
  std::string times;
  for (const Kept& kept : kept_in(start.folder)) {
    if (!is_same_time(kept.time, newest)) times += seconds(kept.time) + ", ";
  }
  refuse(start, start.folder.string() + " keeps no state of " + seconds(*start.time) +
                    ", only of " + times + seconds(newest) +
                    ": name one of these, or run it again with time.keep_every");
}

}  // namespace

std::string seconds(double time) { return base::digits_text(time, k_digits) + " s"; }

fs::path kept_checkpoint(const fs::path& folder, double time) {
  return folder / k_kept_folder / (base::digits_text(time, k_digits) + "_s.h5");
}

std::optional<fs::path> state_file(const scenario::StartSpec& start) {
  if (!has_origin(start)) return std::nullopt;
  if (!start.time) return newest_of(start.folder);
  for (const Kept& kept : kept_in(start.folder)) {
    if (is_same_time(kept.time, *start.time)) return kept.file;
  }
  return newest_of(start.folder);
}

bool has_origin(const scenario::StartSpec& start) {
  std::error_code none;
  return fs::is_regular_file(newest_of(start.folder), none);
}

std::string no_origin_text(const scenario::StartSpec& start) {
  std::error_code none;
  if (fs::is_regular_file(start.folder, none)) {
    return start.folder.string() + " is a file: give the folder of a run's results";
  }
  return start.folder.string() + " holds no checkpoint.h5: run that scenario first, with -o " +
         base::shell_word(start.folder.string());
}

std::vector<double> class_diameters_of(const io::StoredState& state) {
  std::vector<double> diameters;
  // Checkpoints from before there was start_from do not say.
  if (!state.has("clock", "class_diameters")) return diameters;
  state.read({{"clock", [&](sdk::ArchiveReader& a) { diameters = a.numbers("class_diameters"); }}});
  return diameters;
}

Origin::Origin(const scenario::StartSpec& start, const registry::Registry& registry)
    : state_(std::make_unique<io::StoredState>(find_state(start), k_remedy)),
      scenario_(read_scenario(start, registry)),
      leaves_(state_->resolved_yaml(), state_->inputs()),
      class_diameters_(class_diameters_of(*state_)) {
  state_->read({{"clock", [&](sdk::ArchiveReader& a) { steps_done_ = a.integer("steps_done"); }}});
  time_ = static_cast<double>(steps_done_) * scenario_.setup.time.fluid_step;
  if (start.time && !is_same_time(time_, *start.time)) refuse_time(start, time_);
}

scenario::ReadResult Origin::read_scenario(const scenario::StartSpec& start,
                                           const registry::Registry& registry) const {
  const std::string name = state_->file().string();
  scenario::Diagnostics diagnostics;
  const auto tree = scenario::parse_yaml(state_->resolved_yaml(), name, false, diagnostics);
  std::optional<scenario::ReadResult> read;
  if (tree) read = scenario::read_tree(*tree, start.folder, registry, diagnostics);
  if (read) return std::move(*read);
  const auto lines = diagnostics.error_lines();
  refuse(start, "the scenario of " + name + " cannot be read any more: " +
                    (lines.empty() ? std::string("it is no scenario") : lines.front()));
}

}  // namespace dust::run
