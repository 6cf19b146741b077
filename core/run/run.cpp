// SPDX-License-Identifier: Apache-2.0
#include "base/end_signals.hpp"
#include "base/error.hpp"
#include "base/log.hpp"
#include "base/shell_word.hpp"
#include "base/write_error.hpp"
#include "dust/sdk/error.hpp"
#include "fluid/geometry/body_suction.hpp"
#include "io/atomic_file.hpp"
#include "io/run_files.hpp"
#include "io/scenario_leaves.hpp"
#include "io/stored_state.hpp"
#include "particles/time_steps.hpp"
#include "preflight/derived.hpp"
#include "preflight/learnt_costs.hpp"
#include "preflight/reader.hpp"
#include "registry/guard_report.hpp"
#include "report/report.hpp"
#include "run/branch/branch.hpp"
#include "run/branch/past.hpp"
#include "run/branch/used_models.hpp"
#include "run/folder/input_digests.hpp"
#include "run/folder/log_header.hpp"
#include "run/folder/output_folder.hpp"
#include "run/progress/live_report.hpp"
#include "run/progress/progress.hpp"
#include "run/run_checks.hpp"
#include "run/run_options.hpp"
#include "run/run_times.hpp"
#include "run/simulation.hpp"
#include "run/summary/figure_json.hpp"
#include "run/summary/first_row.hpp"
#include "run/summary/series_row.hpp"
#include "run/summary/summary.hpp"
#include "run/summary/summary_audit.hpp"
#include "run/summary/summary_dust.hpp"
#include "run/summary/summary_emitters.hpp"
#include "run/summary/taken_cost.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/text/units.hpp"

#include <oneapi/tbb/global_control.h>
#include <oneapi/tbb/info.h>

#include <chrono>
#include <cmath>
#include <csignal>
#include <cstdio>

namespace dust::run {
namespace {

namespace fs = std::filesystem;
using Clock = RunTimes::Clock;

volatile std::sig_atomic_t g_signal = 0;
void on_signal(int signal) { g_signal = signal; }
/// Before the first step: the run is made ready, writes its checkpoint and ends. A second signal
/// ends it at once.
void on_early_signal(int signal) {
  g_signal = signal;
  std::signal(signal, SIG_DFL);
}

/// Collects the fields of the sensors for a frame.
class FieldsOfSensors final : public sdk::FieldSink {
 public:
  explicit FieldsOfSensors(const Simulation& simulation) {
    const auto& sensors = simulation.models().sensors;
    for (std::size_t n = 0; n < sensors.size(); ++n) {
      sensor_ = simulation.setup().sensors[n].name;
      sensors[n]->fields(*this);
    }
  }
  void field(std::string_view name, std::string_view unit, const sdk::GridShape& grid,
             std::span<const double> values, const sdk::FigureRole& role) override {
    const auto cells = static_cast<std::size_t>(grid.count[0]) * grid.count[1] * grid.count[2];
    if (values.size() != cells) {
      throw sdk::ModelError("the sensor " + sensor_ + " gives " + std::to_string(values.size()) +
                            " numbers for its field " + std::string(name) +
                            "; expected: one for "
                            "each of its " +
                            std::to_string(cells) + " cells");
    }
    fields_.push_back({sensor_,
                       std::string(name),
                       std::string(unit),
                       grid,
                       {values.begin(), values.end()},
                       std::string(sdk::name_of(role.role)),
                       std::string(sdk::info_of(role.quantity).name)});
  }
  std::vector<io::SensorField> take() { return std::move(fields_); }

 private:
  std::string sensor_;
  std::vector<io::SensorField> fields_;
};

/// Fluid steps from one thing that is written to the next.
struct Intervals {
  std::int64_t frame, checkpoint, row;
  std::int64_t kept;  ///< checkpoint that stays; 0: none does

  Intervals(const scenario::TimeSpec& time, double keep_every)
      : frame(std::max<std::int64_t>(1, steps(time, time.output_every))),
        checkpoint(time.checkpoint_every > 0.0
                       ? std::max<std::int64_t>(1, steps(time, time.checkpoint_every))
                       : frame),
        row(std::max<std::int64_t>(1, frame / 20)),
        kept(steps(time, keep_every)) {}

  [[nodiscard]] bool is_kept(std::int64_t done) const { return kept > 0 && done % kept == 0; }

 private:
  static std::int64_t steps(const scenario::TimeSpec& time, double every) {
    return std::llround(every / time.fluid_step);
  }
};

/// What helps where a checkpoint cannot be gone on with.
constexpr const char* k_restart_remedy = "start again with --force";

/// On the terminal, in run.log and in summary.json.
void warn(const std::string& text, RunFacts& facts) {
  base::log_warning(text);
  facts.warnings.push_back(text);
}

void note(const Past& past, RunFacts& facts) {
  facts.start = past.start;
  facts.past_warnings = past.warnings;
  for (const std::string& warning : past.warnings) warn(warning, facts);
}

/// What differs from the run's beginning without being in the way.
void note(const io::Resumption& resumption, RunFacts& facts) {
  facts.inputs = resumption.inputs;
  for (const std::string& line : resumption.log_lines) facts.log_header.push_back(line);
  for (const std::string& warning : resumption.warnings) warn(warning, facts);
}

/// The files of one run and the loop over fluid steps.
class Run {
 public:
  Run(Simulation& simulation, fs::path folder, io::ScenarioIdentity scenario,
      std::vector<UsedModel> models, double keep_every)
      : simulation_(simulation),
        folder_(std::move(folder)),
        scenario_(std::move(scenario)),
        models_(std::move(models)),
        steps_per_(simulation_.setup().time, keep_every) {}

  /// Puts what it knows of its past into `facts`. Throws base::UserError where time.end has passed.
  void resume(const scenario::StartSetup& start, RunFacts& facts) {
    const fs::path checkpoint = folder_ / "checkpoint.h5";
    refuse_changed_models(checkpoint, models_);
    auto parts = simulation_.load_parts();
    parts.emplace_back("files", [this](sdk::ArchiveReader& a) {
      frames_ = a.integer("frames");
      forces_.load(a);
      rows_ = a.integer("rows");
      times_.load(a);
    });
    const io::Resumption resumption = io::read_checkpoint(checkpoint, scenario_, parts);
    scenario_.inputs = resumption.inputs;
    is_resumed_ = true;
    refuse_past_end(start.end_where);
    const auto rebuilt = rebuilt_models(io::StoredState(checkpoint, k_restart_remedy), models_);
    note(load_past(io::StoredState(checkpoint, k_restart_remedy)), facts);
    note(resumption, facts);
    for (const ChangedModel& model : rebuilt) {
      facts.past_warnings.push_back(model.rebuilt_text());
      warn(facts.past_warnings.back(), facts);
    }
    // A branch of an older version does not know when it began.
    if (start.from && !facts.start) return;
    const double begin = facts.start ? facts.start->time : 0.0;
    if (const std::string text = simulation_.go_on_with_dust_figures(begin); !text.empty()) {
      warn(text, facts);
    }
  }

  /// `live` may be null.
  int execute(RunFacts facts, Progress& progress, LiveReport* live) {
    times_.start();
    facts_ = std::move(facts);
    facts_.status = "running";
    live_ = live;
    // What is wrong in the scenario or the folder is the caller's.
    if (!survives_writing([this] { open_files(); })) return close();
    if (survives([&] { loop(progress); })) survives([this] { end_files(); });
    progress.finish();
    return close();
  }

 private:
  void refuse_past_end(const scenario::Mark& end_where) const {
    const double end = simulation_.setup().time.end, time = simulation_.time();
    if (end >= time * (1.0 - 1e-9)) return;
    const auto seconds = [](double value) { return scenario::number_text(value) + " s"; };
    throw base::UserError(scenario::place(end_where) + ": error: time.end: " + seconds(end) +
                          " is before the time that the run in " + folder_.string() +
                          " has reached, " + seconds(time) +
                          ": give a later end to go on, or another -o to run anew");
  }

  void open_files() {
    if (is_resumed_) {
      // What cannot be gone on with is refused before anything of the run is changed.
      open_results();
      drop_end();
    }
    base::log_to_file(folder_ / "run.log", is_resumed_);
    for (const std::string& line : facts_.log_header) base::log_info(line);
    // On the terminal they stand since the scenario was read.
    for (const std::string& warning : facts_.warnings) base::log_info(warning);
    io::write_text(folder_ / "scenario.yaml", scenario_.resolved_yaml);
    if (is_resumed_) {
      base::log_info("resumed at " + std::to_string(simulation_.time()) + " s");
      return;
    }
    open_results();
    if (facts_.start) log_start();
    print_bodies();
    print_steps();
    print_moisture();
    write_frame();
    io::write_text(folder_ / "series.csv-metadata.json",
                   series_metadata(simulation_).dump(1) + "\n");
    // Means that sensors take over rows have not begun yet, or go on from another run's.
    append_first_row();
    checkpoint();
  }

  void open_results() {
    std::vector<std::string> materials;
    for (const auto& m : simulation_.setup().materials) materials.push_back(m.name);
    const auto& domain = simulation_.setup().domain;
    results_ = std::make_unique<io::ResultsFile>(folder_, is_resumed_ ? frames_ : -1,
                                                 simulation_.models().bodies, materials, domain.min,
                                                 domain.max);
    series_ = std::make_unique<io::SeriesFile>(folder_ / "series.csv", is_resumed_ ? rows_ : -1);
  }

  /// What was written when the run ended before: one that is killed now has not ended.
  void drop_end() const {
    for (const char* name : {"summary.json", "report.json", "report.html"}) {
      std::error_code problem;
      fs::remove(folder_ / name, problem);
      if (problem) throw base::WriteError(folder_ / name, problem.value());
    }
  }

  /// What meshes say of themselves, and how fine they are beside the grains.
  void print_bodies() const {
    const auto& diameters = simulation_.models().class_diameters;
    for (const auto& body : simulation_.models().bodies) {
      for (const std::string& remark : body.shape->notes()) {
        base::log_info("body " + body.name + ": " + remark);
      }
      const double edge = body.shape->shortest_edge();
      if (!(edge > 0.0) || diameters.empty()) continue;
      char text[120];
      std::snprintf(text, sizeof text,
                    ": the shortest edge is %.3g of the largest grain's diameter",
                    edge / diameters.back());
      base::log_info("body " + body.name + text);
    }
  }

  void log_start() const {
    const StartFacts& s = *facts_.start;
    base::log_info("starts from " + s.state + " at " + scenario::number_text(s.time) + " s with " +
                   std::to_string(s.particles) + " grains, " + std::to_string(s.contacts) +
                   " contacts in touch" +
                   (s.is_same ? "; the scenario is the same: the same bits as if not cut" : ""));
  }

  /// As `engine check` tells them, every digit of them.
  void print_steps() const {
    const particles::TimeSteps& steps = simulation_.dem().time_steps();
    base::log_info("time step " + scenario::number_text(steps.coarse_step) + " s");
    if (simulation_.models().class_diameters.empty()) return;
    for (const auto& c : steps.classes) {
      base::log_info("grains of " + scenario::number_text(c.diameter) + " m: stable step " +
                     scenario::number_text(c.stable_step) + " s, step " +
                     scenario::number_text(steps.step_of(c)) + " s");
    }
  }

  void print_moisture() const {
    const LiberationStage* liberation = simulation_.liberation();
    if (liberation == nullptr) return;
    for (const std::string& line : liberation->moisture_lines(simulation_.setup().materials)) {
      base::log_info(line);
    }
  }

  void loop(Progress& progress) {
    Pace pace(simulation_.time());
    while (!simulation_.is_finished() && g_signal == 0) {
      simulation_.step();
      const std::int64_t done = simulation_.steps_done();
      if (done % steps_per_.row == 0) write_row();
      if (done % steps_per_.frame == 0) {
        write_frame();
        const auto& b = simulation_.dem().balance();
        char text[160];
        std::snprintf(text, sizeof text,
                      "t = %.4f s: %lld grains, %lld emitted, %lld left, %lld removed",
                      simulation_.time(), static_cast<long long>(b.in_domain),
                      static_cast<long long>(b.emitted), static_cast<long long>(b.left),
                      static_cast<long long>(b.removed));
        base::log_info(text);
      }
      const bool is_due = done % steps_per_.checkpoint == 0 || steps_per_.is_kept(done);
      if (is_due && !simulation_.is_finished()) checkpoint();
      pace.update(simulation_.time());
      progress.update(simulation_.time(), simulation_.dem().balance().in_domain, pace);
      if (live_) live_->publish_progress(simulation_, facts_, pace);
    }
    facts_.status = simulation_.is_finished() ? "finished" : "interrupted";
  }

  /// Does `work`; false when a file could not be written, which ends the run.
  template <class Work>
  bool survives_writing(Work&& work) {
    try {
      work();
      return true;
    } catch (const base::WriteError& e) {
      note_failure(e.what());
      is_disk_bad_ = true;
      return false;
    }
  }

  /// The same, where whatever else goes wrong ends the run too.
  template <class Work>
  bool survives(Work&& work) {
    try {
      return survives_writing(work);
    } catch (const std::exception& e) {
      note_failure(e.what());
      return false;
    }
  }

  /// The first reason is the one to tell.
  void note_failure(const char* reason) {
    if (facts_.status != "failed") facts_.reason = reason;
    facts_.status = "failed";
  }

  /// The state at the end.
  void end_files() {
    checkpoint();
    // What came after the last full interval counts, too. Not in the checkpoint: a run that is
    // continued to a later end has no such row.
    if (facts_.status == "finished" && simulation_.steps_done() % steps_per_.row != 0) write_row();
  }

  int close() {
    take_times();
    for (const std::string& text : shortfalls(simulation_, facts_)) warn(text, facts_);
    const auto& dem = simulation_.dem();
    const std::string overlaps = overlap_warning(dem.report(), dem.time_steps().expected_speed);
    // A run that failed has its own reason, often this one.
    if (!overlaps.empty() && facts_.status != "failed") warn(overlaps, facts_);
    for (const std::string& text : audit_lines(simulation_, forces_)) base::log_info(text);
    const bool has_summary = survives([this] { write_summary(folder_, simulation_, facts_); });
    if (live_ != nullptr) live_->publish_progress(simulation_, facts_, Pace(simulation_.time()));
    base::log_info("status: " + facts_.status);
    results_.reset();
    if (has_summary && !is_disk_bad_) write_report();
    if (facts_.status == "failed") {
      log_failure();
      return 1;
    }
    learn_cost();
    if (facts_.status == "interrupted") {
      std::fprintf(stderr, "interrupted at t = %.4g s; go on with --resume -o %s\n",
                   simulation_.time(), base::shell_word(folder_.string()).c_str());
      return 128 + static_cast<int>(g_signal);
    }
    return 0;
  }

  /// Its page can be made again at any time: the run is none the worse.
  void write_report() const {
    try {
      report::write_report(folder_);
    } catch (const std::exception& e) {
      base::log_warning(std::string("the report is not written: ") + e.what() +
                        "; write it again with 'engine report " +
                        base::shell_word(folder_.string()) + "'");
    }
  }

  /// The next estimate knows what this run took. A short run says more of the start than of the
  /// steps.
  void learn_cost() const {
    constexpr double k_shortest = 5.0;
    if (facts_.status != "finished" || facts_.cpu_s < k_shortest || facts_.registry == nullptr) {
      return;
    }
    try {
      const auto derived =
          preflight::derive(simulation_.setup(), *facts_.registry, simulation_.dust_setup(),
                            facts_.start ? facts_.start->time : 0.0);
      preflight::LearntCosts().add(simulation_.setup().name, derived.cost,
                                   taken_cost(simulation_, facts_, folder_));
    } catch (const std::exception& e) {
      // The scenario's files may have gone since the run began, which needed them no longer.
      base::log_info(std::string("nothing learnt for the next estimate: ") + e.what());
    }
  }

  void log_failure() const {
    const std::string checkpoint = (folder_ / "checkpoint.h5").string();
    const std::string when = "the run failed at t = " + std::to_string(simulation_.time()) + " s: ";
    if (is_disk_bad_) {
      base::log_error(when + facts_.reason + way_on());
      return;
    }
    base::log_error(when + facts_.reason);
    if (!fs::exists(checkpoint)) {
      base::log_error(
          "there is no checkpoint: after mending the cause start again with --force -o " +
          folder_.string());
      return;
    }
    base::log_error("the last good checkpoint is " + checkpoint +
                    ": the same scenario goes on from it with --resume, a changed one (steps, "
                    "speeds, laws, bodies) with 'start_from: " +
                    folder_.string() + "' (docs/how_to/branch_a_run.md)");
  }

  /// Behind a file that could not be written.
  [[nodiscard]] std::string way_on() const {
    const std::string to_folder = " -o " + base::shell_word(folder_.string());
    std::error_code none;
    if (fs::exists(folder_ / "checkpoint.h5", none)) {
      return ", then go on from the last good checkpoint with --resume" + to_folder;
    }
    if (fs::exists(folder_, none)) return ", then start again with --force" + to_folder;
    return " Where it has been moved it holds the last good checkpoint: go on with --resume -o and "
           "its new place; else start again with" +
           to_folder;
  }

  void write_frame() {
    const auto begin = Clock::now();
    io::Frame frame;
    if (simulation_.steps_done() > 0) simulation_.sample_forces(forces_);
    frame.number = frames_;
    frame.time = simulation_.time();
    frame.world = simulation_.world();
    frame.momentum_exchange = simulation_.momentum_exchange();
    if (simulation_.has_changing_walls()) frame.bodies = &simulation_.models().bodies;
    frame.fields = FieldsOfSensors(simulation_).take();
    if (const DustStage* dust = simulation_.dust_stage()) frame.fluid_fields = dust->fields();
    if (const LiberationStage* liberation = simulation_.liberation()) {
      for (io::SensorField& field : liberation->fields()) {
        frame.fluid_fields.push_back(std::move(field));
      }
    }
    results_->append(frame);
    ++frames_;
    if (live_) publish_live();
    times_.add_output(begin);
  }

  /// The report so far, as if the run ended here.
  void publish_live() {
    take_times();
    live_->publish_state(simulation_, facts_);
    live_->publish_progress(simulation_, facts_, Pace(simulation_.time()));
  }

  void append_first_row() {
    const std::vector<std::string> none;
    const auto& going_on = facts_.start ? facts_.start->sensors : none;
    const auto row = first_row(simulation_, *facts_.registry, going_on);
    series_->append(row.names, row.values);
  }

  void write_row() {
    const auto row = series_row(simulation_);
    series_->append(row.names, row.values);
    for (const auto& sensor : simulation_.models().sensors) sensor->end_row();
  }

  void checkpoint() {
    const auto begin = Clock::now();
    results_->sync();
    series_->sync();
    auto parts = simulation_.save_parts();
    parts.emplace_back("files", [this](sdk::ArchiveWriter& a) {
      a.integer("frames", frames_);
      forces_.save(a);
      a.integer("rows", series_->rows());
      times_.save(a, node_seconds(simulation_, times_.nodes_before()));
    });
    parts.emplace_back(k_models_part, [this](sdk::ArchiveWriter& a) { save_models(models_, a); });
    parts.emplace_back(k_past_part, [this](sdk::ArchiveWriter& a) {
      save_past({facts_.start, facts_.past_warnings}, a);
    });
    io::write_checkpoint(folder_ / "checkpoint.h5", scenario_, parts);
    if (steps_per_.is_kept(simulation_.steps_done())) {
      io::keep_checkpoint(folder_ / "checkpoint.h5", kept_checkpoint(folder_, simulation_.time()));
    }
    times_.add_output(begin);
  }

  void take_times() {
    facts_.wall_s = times_.wall();
    facts_.cpu_s = times_.cpu();
    facts_.node_s = node_seconds(simulation_, times_.nodes_before());
    facts_.output_s = times_.output();
    facts_.frames = frames_;
    facts_.forces = forces_;
  }

  Simulation& simulation_;
  fs::path folder_;
  io::ScenarioIdentity scenario_;
  std::vector<UsedModel> models_;
  bool is_resumed_ = false;
  bool is_disk_bad_ = false;  ///< a file could not be written
  Intervals steps_per_;
  std::int64_t frames_ = 0;
  std::int64_t rows_ = 0;
  ForceShares forces_;
  RunTimes times_;
  std::unique_ptr<io::ResultsFile> results_;
  std::unique_ptr<io::SeriesFile> series_;
  RunFacts facts_;
  LiveReport* live_ = nullptr;
};

/// The models of a scenario, with the sizes of grains that another run brings along.
Models make_models_of(const scenario::ReadResult& read, const registry::Registry& registry,
                      const Branch* branch, const std::optional<fs::path>& resumed) {
  Models models = make_models(read.setup, registry, read.dust);
  if (branch != nullptr) branch->add_diameters(models.class_diameters);
  if (read.start.from && resumed) {
    const io::StoredState state(*resumed / "checkpoint.h5", k_restart_remedy);
    models.class_diameters = class_diameters_of(state);
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
  base::catch_end_signals(on_early_signal);
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
  scenario::Diagnostics branching;
  std::optional<Branch> branch;
  if (read.start.from && !options.resume) branch.emplace(read, inputs, registry, branching);
  branching.throw_errors();
  Branch* const origin = branch ? &*branch : nullptr;
  std::unique_ptr<Simulation> simulation;
  try {
    const auto resumed = options.resume ? std::optional(output.path()) : std::nullopt;
    simulation = std::make_unique<Simulation>(
        read.setup, make_models_of(read, registry, origin, resumed), 0, read.dust);
  } catch (const registry::PlacedFault& e) {
    throw base::UserError(e.line());
  } catch (const fluid::OpeningError& e) {
    const auto& suction = read.setup.bodies[e.body()].suction;
    throw base::UserError(scenario::place(suction->where) + ": error: " + e.what());
  } catch (const sdk::ModelError& e) {
    throw base::UserError(options.scenario.string() + ": error: " + e.what());
  }
  if (!options.resume) start(*simulation, origin);
  RunFacts facts = facts_of(read, inputs, registry, options, threads);
  facts.models = used_models(read, registry);
  facts.past_warnings = branching.warning_lines();
  for (const std::string& warning : facts.past_warnings) warn(warning, facts);
  if (branch) facts.start = start_facts(*branch, *simulation);
  branch.reset();  // the other run's particles
  output.open();
  const fs::path folder = output.path();
  Run run(*simulation, folder, {read.resolved_yaml, inputs}, facts.models, read.start.keep_every);
  if (options.resume) run.resume(read.start, facts);
  base::catch_end_signals(on_signal);
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
