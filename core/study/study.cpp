// SPDX-License-Identifier: Apache-2.0
#include "study/study.hpp"

#include "base/error.hpp"
#include "base/process/end_signals.hpp"
#include "base/process/memory.hpp"
#include "base/process/shell_word.hpp"
#include "base/text.hpp"
#include "io/atomic_file.hpp"
#include "io/result_folder.hpp"
#include "registry/registry.hpp"
#include "study/calibration/calibrate_runs.hpp"
#include "study/effects.hpp"
#include "study/point_models.hpp"
#include "study/runner.hpp"
#include "study/study_folder.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <thread>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

/// [bytes] Where the system does not tell what is free.
constexpr double k_modest_memory = 1e9;

Resources resources_of(const StudyOptions& options, const Execution& execution,
                       std::size_t points) {
  Resources r;
  r.engine = fs::read_symlink("/proc/self/exe");
  for (const std::string& folder : options.plugin_path) {
    r.plugin_path.push_back(fs::absolute(folder).string());
  }
  const int cores = static_cast<int>(std::max(1u, std::thread::hardware_concurrency()));
  const int most = static_cast<int>(std::max<std::size_t>(1, points));
  const int threads = static_cast<int>(execution.threads);
  r.jobs = options.jobs > 0 ? options.jobs : static_cast<int>(execution.jobs);
  if (r.jobs == 0) r.jobs = std::max(1, cores / std::max(1, threads));
  r.jobs = std::min(r.jobs, most);
  r.threads = threads > 0 ? threads : std::max(1, cores / r.jobs);
  r.memory_bytes = execution.memory_share * base::free_memory().value_or(k_modest_memory);
  return r;
}

std::unique_ptr<Launcher> make_launcher(const StudyOptions& options, const Spec& spec,
                                        const PointStore& store, const Resources& resources) {
  if (options.launcher == "slurm") {
    return make_slurm_launcher(store, resources, spec.slurm, spec.name);
  }
  return make_local_launcher(store, resources);
}

std::string side_by_side(const Resources& resources) {
  return std::to_string(resources.jobs) + " at a time with " + std::to_string(resources.threads) +
         (resources.threads == 1 ? " thread each" : " threads each");
}

/// Says so where memory, not cores, bounds how many points run at a time.
void print_memory(double largest, const Resources& resources) {
  constexpr double k_megabyte = 1e6;
  const double budget = resources.memory_bytes;
  if (largest * resources.jobs <= budget || resources.jobs < 2) return;
  const double together = std::max(1.0, std::floor(budget / largest));
  std::printf(
      "memory: %.0f MB of the largest points, %.0f MB for the study (run.memory_share): %.0f of "
      "them "
      "at a time, the others wait\n",
      largest / k_megabyte, budget / k_megabyte, together);
}

void print_plan(const Plan& plan, const PointStore& store, const Resources& resources) {
  double core_seconds = 0.0;
  double largest = 0.0;
  std::size_t done = 0;
  std::string head = "point  hash            ";
  for (const InputColumn& c : plan.inputs) {
    head += "  " + c.name + (c.unit.empty() ? "" : " [" + c.unit + "]");
  }
  std::printf("%s\n", head.c_str());
  for (std::size_t n = 0; n < plan.points.size(); ++n) {
    const Point& point = plan.points[n];
    const bool is_done = store.read(point, plan.outputs).status == Status::finished;
    done += is_done ? 1 : 0;
    if (!is_done) core_seconds += point.core_seconds;
    largest = std::max(largest, point.memory_bytes);
    std::string row = std::to_string(n + 1);
    row.resize(7, ' ');
    row += point.hash;
    for (const InputValue& v : point.inputs) row += "  " + v.text;
    row += "  seed " + std::to_string(point.seed) + (is_done ? "  (finished)" : "");
    std::printf("%s\n", row.c_str());
  }
  constexpr double k_megabyte = 1e6;
  std::printf(
      "%zu points, %zu finished; %s; up to %.0f MB each; about %s on this machine (rough)\n",
      plan.points.size(), done, side_by_side(resources).c_str(), largest / k_megabyte,
      base::estimated_duration_text(core_seconds / (resources.jobs * resources.threads)).c_str());
  print_memory(largest, resources);
}

void copy_study(const fs::path& from, const fs::path& folder) {
  io::write_text(folder / "study.yaml", io::read_text(from));
}

/// What a calibration will do, before it knows where its points lie.
void print_calibration(const Spec& spec, const Plan& plan, const std::vector<Point>& samples,
                       const Resources& resources) {
  const CalibrationSpec& c = *spec.calibration;
  double seconds = 0.0;
  for (const Point& p : samples) {
    seconds = std::max(seconds, p.core_seconds / static_cast<double>(spec.replicates));
  }
  for (std::size_t k = 0; k < c.parameters.size(); ++k) {
    const FreeParameter& p = c.parameters[k];
    std::printf("%s: %s to %s %s\n", p.name.c_str(), short_number(p.low).c_str(),
                short_number(p.high).c_str(), plan.inputs[k].unit.c_str());
  }
  for (const Target& t : c.targets) {
    std::printf("%s: %s +- %s %s\n", t.measure.name.c_str(), short_number(t.value).c_str(),
                short_number(t.error).c_str(), t.measure.unit.c_str());
  }
  const double runs = static_cast<double>(c.runs * spec.replicates);
  std::printf("at most %.0f runs of about %s on one core each; %s\n", runs,
              base::duration_text(seconds).c_str(), side_by_side(resources).c_str());
}

void print_expectations(const Spec& spec, const Results& results) {
  for (const Expectation& e : spec.expectations) {
    std::string what = e.from.empty() ? "with " + e.input : "from " + e.from + " to " + e.to;
    if (!e.at.empty()) what += " " + place_text(e);
    std::printf("%s %s %s: %s\n", e.output.c_str(), e.then.c_str(), what.c_str(),
                assess(e, spec, results).text.c_str());
  }
}

/// One study from its checked plan to its files.
class Study {
 public:
  Study(const StudyOptions& options, const Spec& spec, Planner& planner, Plan plan)
      : options_(options), spec_(spec), planner_(planner), plan_(std::move(plan)) {}

  int run(const fs::path& folder) {
    const PointStore store(folder);
    const bool is_calibration = spec_.calibration.has_value();
    const std::size_t expected =
        is_calibration ? static_cast<std::size_t>(spec_.calibration->runs * spec_.replicates)
                       : plan_.points.size();
    const std::size_t at_once =
        is_calibration ? static_cast<std::size_t>(spec_.calibration->batch * spec_.replicates)
                       : expected;
    const Resources resources = resources_of(options_, spec_.execution, at_once);
    if (options_.dry_run) {
      if (is_calibration) {
        print_calibration(spec_, plan_, ends(), resources);
      } else {
        print_plan(plan_, store, resources);
      }
      return 0;
    }
    io::make_result_folder(folder);
    const FolderLock lock(folder);
    check_still_unused(options_, folder);
    if (options_.force) clear_study_folder(folder);
    copy_study(options_.file, folder);
    const SignalGuard signals;
    const auto launcher = make_launcher(options_, spec_, store, resources);
    Runner runner(
        plan_, store, *launcher,
        {.fail_fast = options_.fail_fast, .quiet = options_.quiet, .expected_points = expected});
    int signal = 0;
    std::optional<CalibrationAnswer> answer;
    if (is_calibration) {
      try {
        answer = calibrate_with(runner, signal);
      } catch (const base::RunError&) {
        // What has been run is worth reading though too little of it is there to learn from.
        write_results(folder, runner, nullptr);
        throw;
      }
      write_calibration(folder / "calibration.json", *answer);
    } else {
      signal = runner.run();
    }
    write_results(folder, runner, answer ? &*answer : nullptr);
    return conclude(folder, runner, answer, signal);
  }

 private:
  void write_results(const fs::path& folder, const Runner& runner,
                     const CalibrationAnswer* answer) const {
    write_h5(folder / "study.h5", runner.results(), answer);
    write_study_report(folder / "report.html", spec_, runner.results(), answer);
  }

  /// Points at the lower ends, for what they cost.
  std::vector<Point> ends() {
    std::vector<double> low;
    for (const FreeParameter& p : spec_.calibration->parameters) low.push_back(p.low);
    return planner_.calibration_points(low);
  }

  CalibrationAnswer calibrate_with(Runner& runner, int& signal) {
    CalibrationAnswer answer{settings_of(spec_, plan_), {}};
    RunEvaluator evaluator(spec_, planner_, plan_, runner);
    answer.calibration = calibrate(answer.settings, evaluator, [&](const Calibration& c) {
      if (options_.quiet) return;
      std::string text = std::to_string(c.places.size()) + " places:";
      for (std::size_t d = 0; d < c.estimates.size(); ++d) {
        text += (d == 0 ? " " : ", ") + answer.settings.parameters[d].name + " " +
                short_number(c.estimates[d].low) + " to " + short_number(c.estimates[d].high);
      }
      std::printf("%s\n", text.c_str());
      std::fflush(stdout);
    });
    signal = evaluator.signal();
    return answer;
  }

  [[nodiscard]] int conclude(const fs::path& folder, const Runner& runner,
                             const std::optional<CalibrationAnswer>& answer, int signal) const {
    if (signal != 0) {
      std::fprintf(stderr, "interrupted; go on with --resume -o %s\n",
                   base::shell_word(folder.string()).c_str());
      return 128 + signal;
    }
    if (!options_.quiet) {
      print_expectations(spec_, runner.results());
      if (answer) {
        for (const std::string& line : answer->calibration.statements) {
          std::printf("%s\n", line.c_str());
        }
      }
      std::printf("results: %s\n", folder.c_str());
    }
    if (runner.failures() == 0) return 0;
    const auto& outcomes = runner.results().outcomes;
    const auto waiting = std::count_if(outcomes.begin(), outcomes.end(), [](const Outcome& o) {
      return o.status == Status::waiting;
    });
    std::fprintf(stderr, "error: %zu of %zu points failed; study.csv says why\n", runner.failures(),
                 outcomes.size());
    if (waiting > 0) {
      std::fprintf(
          stderr,
          "stopped at the first failure (--fail-fast): %td left waiting; --resume -o %s goes "
          "on with them\n",
          waiting, base::shell_word(folder.string()).c_str());
    }
    return 1;
  }

  const StudyOptions& options_;
  const Spec& spec_;
  Planner& planner_;
  Plan plan_;
};

/// Whether what the study says is understood, but for keys that it has not.
bool can_be_planned(const Spec& spec, const scenario::Diagnostics& diagnostics) {
  if (!diagnostics.has_errors()) return true;
  const auto& errors = diagnostics.errors();
  const bool has_points = !spec.axes.empty() || spec.replicates > 1;
  return has_points && !spec.base.empty() &&
         std::all_of(errors.begin(), errors.end(),
                     [](const auto& problem) { return problem.text.starts_with("unknown key "); });
}

}  // namespace

int run_study(const StudyOptions& options) {
  base::ignore_write_signals();
  registry::Registry registry;
  registry.load(
      registry::Registry::search_path({options.plugin_path.begin(), options.plugin_path.end()}));
  scenario::Diagnostics diagnostics;
  const auto spec = read_spec(options.file, diagnostics);
  // The rest is told with what is wrong here.
  if (!spec || !can_be_planned(*spec, diagnostics)) diagnostics.throw_errors();
  Planner planner(*spec, registry, diagnostics,
                  options.dry_run ? Origins::to_come : Origins::there);
  Plan plan = spec->calibration ? planner.calibration_columns() : planner.plan();
  diagnostics.throw_errors();
  for (const std::string& warning : diagnostics.warning_lines()) {
    std::fprintf(stderr, "%s\n", warning.c_str());
  }
  if (options.launcher == "slurm" && !options.dry_run) check_slurm();
  // The study's own file, that of its base and what these include, then what the points read.
  std::vector<fs::path> inputs(diagnostics.documents().begin(), diagnostics.documents().end());
  inputs.insert(inputs.end(), plan.read_paths.begin(), plan.read_paths.end());
  const fs::path folder = choose_study_folder(options, spec->name, inputs);
  if (options.resume) {
    const PointStore store(folder);
    refuse_changed_models(plan, store, registry);
    for (const std::string& line : rebuilt_models(plan, store, registry)) {
      std::fprintf(stderr, "warning: %s\n", line.c_str());
    }
  }
  return Study(options, *spec, planner, std::move(plan)).run(folder);
}

}  // namespace dust::study
