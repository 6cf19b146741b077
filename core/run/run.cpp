// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/log.hpp"
#include "base/process/end_signals.hpp"
#include "dust/sdk/error.hpp"
#include "fluid/geometry/body_suction.hpp"
#include "io/run_files.hpp"
#include "io/scenario_leaves.hpp"
#include "io/stored_state.hpp"
#include "preflight/derived.hpp"
#include "preflight/learnt_costs.hpp"
#include "preflight/reader.hpp"
#include "registry/exit_notice.hpp"
#include "registry/guard_report.hpp"
#include "run/branch/branch.hpp"
#include "run/branch/used_models.hpp"
#include "run/folder/input_digests.hpp"
#include "run/folder/log_header.hpp"
#include "run/folder/output_folder.hpp"
#include "run/progress/end_request.hpp"
#include "run/run_loop.hpp"
#include "run/run_options.hpp"
#include "run/summary/taken_cost.hpp"
#include "scenario/diagnostics.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <cstdio>

namespace dust::run {
namespace {

namespace fs = std::filesystem;

/// The models of a scenario, with the sizes of grains that another run brings along.
Models make_models_of(const scenario::ReadResult& read, const registry::Registry& registry,
                      const Branch* branch, const std::optional<fs::path>& resumed) {
  Models models = make_models(read.setup, registry, read.dust);
  if (branch != nullptr) branch->add_diameters(models);
  if (read.start.from && resumed) {
    const io::StoredState state(*resumed / "checkpoint.h5", k_restart_remedy);
    preflight::set_class_diameters(models, class_diameters_of(state));
  }
  return models;
}

/// The files and folders that a run reads.
std::vector<fs::path> inputs_of(const RunOptions& options, const scenario::ReadResult& read) {
  std::vector<fs::path> inputs = read_paths(read);
  // Meshes and tables that models read without saying that it is a file.
  const fs::path beside = options.scenario.parent_path();
  for (const std::string& value : io::ScenarioLeaves(read.resolved_yaml).values()) {
    std::error_code none;
    if (fs::is_regular_file(beside / value, none)) inputs.push_back(beside / value);
  }
  return inputs;
}

/// Owners and graphs, without a state. What is wrong stands where it is written.
std::unique_ptr<Simulation> make_simulation(const scenario::ReadResult& read,
                                            const registry::Registry& registry,
                                            const Branch* branch,
                                            const std::optional<fs::path>& resumed,
                                            const fs::path& file) {
  try {
    return std::make_unique<Simulation>(read.setup, make_models_of(read, registry, branch, resumed),
                                        0, read.dust);
  } catch (const fluid::OpeningError& e) {
    const auto& suction = read.setup.bodies[e.body()].suction;
    throw base::UserError(scenario::place(suction->where) + ": error: " + e.what());
  } catch (const registry::PlacedFault& e) {
    throw base::UserError(e.line());
  } catch (const sdk::ModelError& e) {
    throw base::UserError(file.string() + ": error: " + e.what());
  }
}

/// The state at the beginning: what the scenario lets in, or that of another run.
void start(Simulation& simulation, Branch* branch) {
  try {
    if (branch != nullptr) {
      branch->give_to(simulation);
    } else {
      simulation.start();
    }
  } catch (const registry::PlacedFault& e) {
    throw base::UserError(e.line());
  } catch (const sdk::ModelError& e) {
    throw base::UserError(e.what());
  }
}

StartFacts start_facts(const Branch& branch, const Simulation& simulation) {
  CountsBefore before = branch.before();
  before.work = work_so_far(simulation);
  return {.state = branch.origin().state().file().string(),
          .time = branch.origin().time(),
          .particles = branch.report().particles,
          .contacts = branch.report().contacts,
          .without_past = branch.report().without_past,
          .is_same = branch.is_same(),
          .sensors = branch.sensors_going_on(),
          .before = std::move(before)};
}

RunFacts facts_of(const scenario::ReadResult& read, const std::vector<io::InputFile>& inputs,
                  const registry::Registry& registry, const RunOptions& options, int threads) {
  RunFacts facts;
  facts.threads = threads;
  facts.warnings = read.warnings;
  facts.references = read.references;
  facts.reference_curves = read.reference_curves;
  facts.registry = &registry;
  io::Sha256 digest;
  digest.update(read.resolved_yaml.data(), read.resolved_yaml.size());
  facts.scenario_sha256 = digest.hex_digest();
  facts.inputs = inputs;
  facts.log_header = log_header(read.setup, read.dust, registry, options, facts.scenario_sha256);
  for (const io::InputFile& input : inputs) {
    facts.log_header.push_back("input: " + input.written + ", sha256 " + input.sha256);
  }
  return facts;
}

/// Of this machine as it is now, so that it is no part of the results.
void warn_of_memory(const scenario::ReadResult& read, const registry::Registry& registry,
                    const fs::path& file) {
  const auto derived = preflight::derive(read.setup, registry, read.dust);
  const auto unasked = [] { return 1.0; };  // how fast the machine is
  const preflight::LearntCosts costs(preflight::LearntCosts::default_file(), unasked);
  const auto expected = costs.expect(read.setup.name, derived.cost);
  const std::string shortage = preflight::memory_shortage(expected.cost);
  if (!shortage.empty()) base::log_warning(file.string() + ": warning: " + shortage);
}

/// The port of --live, before anything is written.
void take_port(const RunOptions& options, std::optional<LiveReport>& live) {
  if (!options.live_port) return;
  if (!io::may_read_while_writing()) {
    throw base::UserError(
        "error: --live: the HDF5 library of this machine is not built thread-safe, so no page can "
        "be "
        "made while the run writes: leave --live out, or install a thread-safe one (Debian's is)");
  }
  live.emplace(*options.live_port);
}

}  // namespace

int run_scenario(const RunOptions& options) {
  base::ignore_write_signals();
  note_end_requests_while_making_ready();
  registry::Registry registry;
  registry.load(registry::Registry::search_path(options.plugin_path));
  const auto read =
      preflight::read_scenario(options.scenario, options.overrides, registry, options.set_files);
  base::log_to_terminal(options.verbose);
  for (const std::string& warning : read.warnings) base::log_warning(warning);

  const int threads = options.threads > 0 ? options.threads : tbb::info::default_concurrency();
  const tbb::global_control control(tbb::global_control::max_allowed_parallelism,
                                    static_cast<std::size_t>(threads));

  OutputFolder output(options, read.setup.name, inputs_of(options, read));
  const std::vector<io::InputFile> inputs = InputDigests().of(read);
  std::optional<LiveReport> live;
  take_port(options, live);
  warn_of_memory(read, registry, options.scenario);
  scenario::Diagnostics branching;
  std::optional<Branch> branch;
  if (read.start.from && !options.resume) branch.emplace(read, inputs, registry, branching);
  branching.throw_errors();
  Branch* const origin = branch ? &*branch : nullptr;
  const auto resumed = options.resume ? std::optional(output.path()) : std::nullopt;
  const auto simulation = make_simulation(read, registry, origin, resumed, options.scenario);
  if (!options.resume) start(*simulation, origin);
  RunFacts facts = facts_of(read, inputs, registry, options, threads);
  facts.models = used_models(read, registry);
  facts.past_warnings = branching.warning_lines();
  for (const std::string& warning : facts.past_warnings) warn(warning, facts);
  if (branch) facts.start = start_facts(*branch, *simulation);
  branch.reset();  // the other run's particles
  output.open();
  const fs::path folder = output.path();
  const registry::RunUnderway underway(folder / "checkpoint.h5");
  Recorder recorder(*simulation, folder, {read.resolved_yaml, inputs}, facts.models,
                    read.start.keep_every);
  RunLoop run(*simulation, recorder);
  if (options.resume) run.resume(read.start, facts);
  note_end_requests_between_steps();
  if (live) {
    live->begin(folder);
    facts.log_header.push_back("live at " + live->address());
    if (!options.quiet) std::printf("live: %s\n", live->address().c_str());
    std::fflush(stdout);
  }
  Progress progress(options.quiet, read.setup.time.end);
  const int status = run.execute(std::move(facts), progress, live ? &*live : nullptr);
  if (!options.quiet) std::printf("results: %s\n", folder.c_str());
  return status;
}

}  // namespace dust::run
