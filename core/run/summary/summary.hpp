// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/input_files.hpp"
#include "run/audit/force_shares.hpp"
#include "run/branch/used_models.hpp"
#include "run/simulation.hpp"
#include "setup/reference_curve.hpp"
#include "setup/reference_spec.hpp"

#include <cstdint>
#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// When a plant began to be as it is, and what was counted by then. Masses go on, for they have to
/// balance; rates, amounts per load and shares count from there on, so that they are of one plant.
struct PlantBegin {
  /// What a mass is counted by.
  struct Key {
    enum class Way {
      hood,    ///< drawn out, grains and field, what is dust
      outlet,  ///< of a field, drawn out by a hood
      side,    ///< of a field, out through a side
      cause,   ///< set free from grains
    };
    Way way = Way::hood;
    std::string name;             ///< of the hood, the side, the cause
    std::string dust_class = {};  ///< "": all together
    bool operator==(const Key&) const = default;
  };
  struct Counted {
    Key key;
    double mass = 0.0;  ///< [kg]
  };
  /// [kg] By then; 0 of what was not there yet.
  [[nodiscard]] double mass_of(const Key& key) const;

  double time = 0.0;  ///< [s]
  double mass = 0.0;  ///< [kg] emitted
  double dust = 0.0;  ///< [kg] of dust, emitted as grains and released into the air
  std::vector<Counted> counted = {};
};

/// What was there when a run that started from another began, or one that it comes from by way of
/// others.
struct CountsBefore {
  PlantBegin plant = {};
  std::vector<std::string> new_emitters = {};
  /// One that had brought something by other settings.
  struct ChangedEmitter {
    std::string name;
    double mass = 0.0;  ///< [kg] by then, with what waited for its place
  };
  std::vector<ChangedEmitter> changed_emitters = {};
  /// Work that another run has done and that counters hold which go on.
  struct Work {
    std::int64_t particle_steps = 0, fine_steps = 0;
    std::int64_t steps = 0, fluid_sub_steps = 0, dust_sub_steps = 0;
  };
  Work work = {};
};

/// The state that a run started from.
struct StartFacts {
  std::string state;                 ///< the file
  double time = 0.0;                 ///< [s]
  std::int64_t particles = 0;        ///< that came along
  std::int64_t contacts = 0;         ///< of them, in touch
  std::int64_t without_past = 0;     ///< contacts that began anew
  bool is_same = false;              ///< the scenario says the same
  std::vector<std::string> sensors;  ///< names of those that go on
  CountsBefore before = {};
};

/// What the run loop knows beside the simulation. Times include those before a resume.
struct RunFacts {
  std::string status;  ///< finished | interrupted | failed
  std::string reason;  ///< of a failure
  int threads = 1;
  double wall_s = 0.0;
  double cpu_s = 0.0;
  double output_s = 0.0;
  std::vector<double> node_s;  ///< node_seconds, from the very start of the run
  std::int64_t frames = 0;
  ForceShares forces;  ///< sampled at frames
  std::vector<std::string> warnings;
  std::vector<scenario::ReferenceSpec> references;
  std::vector<scenario::ReferenceCurve> reference_curves;
  const registry::Registry* registry = nullptr;  ///< where the models came from; null in tests
  std::vector<UsedModel> models;                 ///< as the run began, or went on, with them
  std::string scenario_sha256;                   ///< of scenario.yaml as run
  std::vector<io::InputFile> inputs;             ///< files that it reads
  std::vector<std::string> past_warnings;        ///< of `warnings`, those that a resume keeps
  std::optional<StartFacts> start;               ///< nothing: at 0 s
  std::vector<std::string> log_header;           ///< the first lines of run.log
};

/// The nodes of the two graphs, those of a grain step first, with their times since the last
/// resume.
std::vector<graph::NodeTiming> node_timings(const Simulation& simulation);

/// Seconds in each of them; `before` holds those of the run up to
/// the checkpoint it resumed from, or nothing.
std::vector<double> node_seconds(const Simulation& simulation, const std::vector<double>& before);

/// summary.json and report.json (what the report needs beyond the other files) as they are now.
struct RunRecord {
  nlohmann::ordered_json summary, report;
};
RunRecord record_of(const Simulation& simulation, const RunFacts& facts);

/// Writes summary.json and report.json (what the report needs beyond the other files).
void write_summary(const std::filesystem::path& folder, const Simulation& simulation,
                   const RunFacts& facts);

/// The two graphs as one DOT text, with timings once they have run.
std::string graph_dot(const Simulation& simulation);

}  // namespace dust::run
