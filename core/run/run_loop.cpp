// SPDX-License-Identifier: Apache-2.0
#include "run/run_loop.hpp"

#include "base/error.hpp"
#include "base/log.hpp"
#include "base/process/shell_word.hpp"
#include "base/write_error.hpp"
#include "io/stored_state.hpp"
#include "preflight/derived.hpp"
#include "preflight/learnt_costs.hpp"
#include "report/report.hpp"
#include "run/branch/past.hpp"
#include "run/folder/failure.hpp"
#include "run/folder/first_lines.hpp"
#include "run/progress/end_request.hpp"
#include "run/run_checks.hpp"
#include "run/summary/summary_audit.hpp"
#include "run/summary/summary_emitters.hpp"
#include "run/summary/taken_cost.hpp"
#include "scenario/diagnostics.hpp"
#include "scenario/text/units.hpp"

#include <cstdint>
#include <cstdio>
#include <exception>
#include <utility>

namespace dust::run {
namespace {

using Clock = RunTimes::Clock;

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

}  // namespace

void warn(const std::string& text, RunFacts& facts) {
  base::log_warning(text);
  facts.warnings.push_back(text);
}

void RunLoop::resume(const scenario::StartSetup& start, RunFacts& facts) {
  const io::Resumption resumption = recorder_.resume();
  refuse_past_end(start.end_where);
  const io::StoredState state(recorder_.folder() / "checkpoint.h5", k_restart_remedy);
  const auto rebuilt = rebuilt_models(state, recorder_.models());
  note(load_past(state), facts);
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

void RunLoop::refuse_past_end(const scenario::Mark& end_where) const {
  const double end = simulation_.setup().time.end, time = simulation_.time();
  if (end >= time * (1.0 - 1e-9)) return;
  const auto seconds = [](double value) { return scenario::number_text(value) + " s"; };
  throw base::UserError(scenario::place(end_where) + ": error: time.end: " + seconds(end) +
                        " is before the time that the run in " + recorder_.folder().string() +
                        " has reached, " + seconds(time) +
                        ": give a later end to go on, or another -o to run anew");
}

template <class Work>
bool RunLoop::survives_writing(Work&& work) {
  try {
    work();
    return true;
  } catch (const base::WriteError& e) {
    note_failure(e.what());
    is_disk_bad_ = true;
    return false;
  }
}

template <class Work>
bool RunLoop::survives(Work&& work) {
  try {
    return survives_writing(work);
  } catch (const std::exception& e) {
    note_failure(e.what());
    return false;
  }
}

/// The first reason is the one to tell.
void RunLoop::note_failure(const char* reason) {
  if (facts_.status != "failed") facts_.reason = reason;
  facts_.status = "failed";
}

int RunLoop::execute(RunFacts facts, Progress& progress, LiveReport* live) {
  recorder_.times().start();
  facts_ = std::move(facts);
  facts_.status = "running";
  live_ = live;
  // What is wrong in the scenario or the folder is the caller's.
  if (!survives_writing([this] { open_files(); })) return close();
  if (survives([&] { loop(progress); })) survives([this] { end_files(); });
  progress.finish();
  return close();
}

void RunLoop::open_files() {
  if (recorder_.is_resumed()) recorder_.open();
  base::log_to_file(recorder_.folder() / "run.log", recorder_.is_resumed());
  for (const std::string& line : facts_.log_header) base::log_info(line);
  // On the terminal they stand since the scenario was read.
  for (const std::string& warning : facts_.warnings) base::log_warning_to_file(warning);
  recorder_.write_scenario();
  if (recorder_.is_resumed()) {
    base::log_info("resumed at " + std::to_string(simulation_.time()) + " s");
    return;
  }
  recorder_.open();
  for (const std::string& line : first_lines(simulation_, facts_)) base::log_info(line);
  write_frame();
  recorder_.write_first_row(facts_);
  recorder_.checkpoint(facts_);
}

void RunLoop::loop(Progress& progress) {
  Pace pace(simulation_.time());
  while (!simulation_.is_finished() && end_request() == 0) {
    simulation_.step();
    const std::int64_t done = simulation_.steps_done();
    if (recorder_.is_row_due(done)) recorder_.write_row();
    if (recorder_.is_frame_due(done)) {
      write_frame();
      log_state();
    }
    if (recorder_.is_checkpoint_due(done) && !simulation_.is_finished()) {
      recorder_.checkpoint(facts_);
    }
    pace.update(simulation_.time());
    progress.update(simulation_.time(), simulation_.dem().balance().in_domain, pace);
    if (live_ != nullptr) live_->publish_progress(simulation_, facts_, pace);
  }
  facts_.status = simulation_.is_finished() ? "finished" : "interrupted";
}

void RunLoop::write_frame() {
  recorder_.write_frame();
  if (live_ != nullptr) publish_live();
}

void RunLoop::log_state() const {
  const auto& b = simulation_.dem().balance();
  char text[160];
  std::snprintf(text, sizeof text, "t = %.4f s: %lld grains, %lld emitted, %lld left, %lld removed",
                simulation_.time(), static_cast<long long>(b.in_domain),
                static_cast<long long>(b.emitted), static_cast<long long>(b.left),
                static_cast<long long>(b.removed));
  base::log_info(text);
}

/// The report so far, as if the run ended here.
void RunLoop::publish_live() {
  const auto begin = Clock::now();
  recorder_.note_progress(facts_);
  live_->publish_state(simulation_, facts_);
  live_->publish_progress(simulation_, facts_, Pace(simulation_.time()));
  recorder_.times().add_output(begin);
}

/// The state at the end.
void RunLoop::end_files() {
  recorder_.checkpoint(facts_);
  // What came after the last full interval counts, too. Not in the checkpoint: a run that is
  // continued to a later end has no such row.
  const bool has_row = recorder_.is_row_due(simulation_.steps_done());
  if (facts_.status == "finished" && !has_row) recorder_.write_row();
}

int RunLoop::close() {
  recorder_.note_progress(facts_);
  for (const std::string& text : shortfalls(simulation_, facts_)) warn(text, facts_);
  const auto& dem = simulation_.dem();
  const std::string overlaps = overlap_warning(dem.report(), dem.time_steps().expected_speed);
  // A run that failed has its own reason, often this one.
  if (!overlaps.empty() && facts_.status != "failed") warn(overlaps, facts_);
  const std::string energy =
      simulation_.setup().audit.energy ? energy_warning(dem.energy()) : std::string();
  if (!energy.empty() && facts_.status != "failed") warn(energy, facts_);
  for (const std::string& text : audit_lines(simulation_, recorder_.forces())) {
    base::log_info(text);
  }
  const bool has_summary =
      survives([this] { write_summary(recorder_.folder(), simulation_, facts_); });
  if (live_ != nullptr) live_->publish_progress(simulation_, facts_, Pace(simulation_.time()));
  base::log_info("status: " + facts_.status);
  recorder_.close();
  if (has_summary && !is_disk_bad_) write_report();
  if (facts_.status == "failed") {
    log_failure(recorder_.folder(), {simulation_.time(), facts_.reason, is_disk_bad_});
    return 1;
  }
  learn_cost();
  if (facts_.status == "interrupted") {
    std::fprintf(stderr, "interrupted at t = %.4g s; go on with --resume -o %s\n",
                 simulation_.time(), base::shell_word(recorder_.folder().string()).c_str());
    return 128 + end_request();
  }
  return 0;
}

/// Its page can be made again at any time: the run is none the worse.
void RunLoop::write_report() const {
  try {
    report::write_report(recorder_.folder());
  } catch (const std::exception& e) {
    base::log_warning(std::string("the report is not written: ") + e.what() +
                      "; write it again with 'engine report " +
                      base::shell_word(recorder_.folder().string()) + "'");
  }
}

/// The next estimate knows what this run took. A short run says more of the start than of the
/// steps.
void RunLoop::learn_cost() const {
  constexpr double k_shortest = 5.0;
  if (facts_.status != "finished" || facts_.cpu_s < k_shortest || facts_.registry == nullptr) {
    return;
  }
  try {
    const auto derived =
        preflight::derive(simulation_.setup(), *facts_.registry, simulation_.dust_setup(),
                          facts_.start ? facts_.start->time : 0.0);
    preflight::LearntCosts().add(simulation_.setup().name, derived.cost,
                                 taken_cost(simulation_, facts_, recorder_.folder()));
  } catch (const std::exception& e) {
    // The scenario's files may have gone since the run began, which needed them no longer.
    base::log_info(std::string("nothing learnt for the next estimate: ") + e.what());
  }
}

}  // namespace dust::run
