// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/scenario_leaves.hpp"
#include "io/stored_state.hpp"
#include "registry/registry.hpp"
#include "scenario/reader.hpp"
#include "setup/start_setup.hpp"

#include <cstdint>
#include <filesystem>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// Where a run keeps those of its checkpoints that others may start from.
constexpr const char* k_kept_folder = "checkpoints";
/// A time [s] with as many digits as tell two steps apart, and its unit.
std::string seconds(double time);

/// The kept checkpoint of `time` [s] in the results of a run.
std::filesystem::path kept_checkpoint(const std::filesystem::path& folder, double time);

/// The state of a run that another one starts from: its checkpoint and the scenario it is of.
class Origin {
 public:
  /// Throws base::UserError with the place of `start_from` and a remedy.
  Origin(const scenario::StartSpec& start, const registry::Registry& registry);

  [[nodiscard]] const io::StoredState& state() const { return *state_; }
  [[nodiscard]] const scenario::ReadResult& scenario() const { return scenario_; }
  [[nodiscard]] const io::ScenarioLeaves& leaves() const { return leaves_; }
  [[nodiscard]] double time() const { return time_; }                    ///< [s]
  [[nodiscard]] std::int64_t steps_done() const { return steps_done_; }  ///< of its fluid steps
  /// [m] all sizes of its grains.
  [[nodiscard]] const std::vector<double>& class_diameters() const { return class_diameters_; }

 private:
  [[nodiscard]] scenario::ReadResult read_scenario(const scenario::StartSpec& start,
                                                   const registry::Registry& registry) const;

  std::unique_ptr<io::StoredState> state_;
  scenario::ReadResult scenario_;
  io::ScenarioLeaves leaves_;
  std::int64_t steps_done_ = 0;
  double time_ = 0.0;
  std::vector<double> class_diameters_;
};

/// The checkpoint that `start_from` names; nothing where there is none yet.
[[nodiscard]] std::optional<std::filesystem::path> state_file(const scenario::StartSpec& start);

/// Whether there is a run to start from yet.
[[nodiscard]] bool has_origin(const scenario::StartSpec& start);
/// What to do where there is none.
[[nodiscard]] std::string no_origin_text(const scenario::StartSpec& start);

/// [m] the sizes of grains in a checkpoint.
std::vector<double> class_diameters_of(const io::StoredState& state);

}  // namespace dust::run
