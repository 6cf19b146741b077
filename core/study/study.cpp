// SPDX-License-Identifier: Apache-2.0
#include "study/study.hpp"

#include "base/error.hpp"
#include "io/run_files.hpp"
#include "registry/registry.hpp"
#include "study/runner.hpp"
#include "study/study_folder.hpp"

#include <algorithm>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <thread>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

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
  r.memory_bytes = execution.memory_share * free_memory();
  return r;
}

std::unique_ptr<Launcher> make_launcher(const StudyOptions& options, const Spec& spec,
                                        const PointStore& store, const Resources& resources) {
  if (options.launcher == "slurm") {
    return make_slurm_launcher(store, resources, spec.slurm, spec.name);
  }
  return make_local_launcher(store, resources);
}

void tell_plan(const Plan& plan, const PointStore& store, const Resources& resources) {
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
      "%zu points, %zu finished; %d at a time with %d threads each; up to %.0f MB each; about %s "
      "on "
      "this machine (rough)\n",
      plan.points.size(), done, resources.jobs, resources.threads, largest / k_megabyte,
      duration_text(core_seconds / (resources.jobs * resources.threads)).c_str());
}

void copy_study(const fs::path& from, const fs::path& folder) {
  std::ifstream stream(from, std::ios::binary);
  const std::string text((std::istreambuf_iterator<char>(stream)),
                         std::istreambuf_iterator<char>());
  io::write_text(folder / "study.yaml", text);
}

}  // namespace

int run_study(const StudyOptions& options) {
  registry::Registry registry;
  registry.load(
      registry::Registry::search_path({options.plugin_path.begin(), options.plugin_path.end()}));
  scenario::Diagnostics diagnostics;
  const auto spec = read_spec(options.file, diagnostics);
  diagnostics.throw_errors();
  Planner planner(*spec, registry, diagnostics);
  diagnostics.throw_errors();
  Plan plan = planner.plan();
  diagnostics.throw_errors();
  for (const std::string& warning : diagnostics.warning_lines()) {
    std::fprintf(stderr, "%s\n", warning.c_str());
  }

  const fs::path folder = choose_study_folder(options, spec->name);
  const PointStore store(folder);
  const Resources resources = resources_of(options, spec->execution, plan.points.size());
  if (options.dry_run) {
    tell_plan(plan, store, resources);
    return 0;
  }
  fs::create_directories(folder);
  const FolderLock lock(folder);
  if (options.force) clear_study_folder(folder);
  copy_study(options.file, folder);
  const SignalWatch watch;
  const auto launcher = make_launcher(options, *spec, store, resources);
  Runner runner(plan, store, *launcher,
                {.fail_fast = options.fail_fast,
                 .quiet = options.quiet,
                 .expected_points = plan.points.size()});
  const int signal = runner.run();
  write_h5(folder / "study.h5", runner.results());
  if (signal != 0) {
    std::fprintf(stderr, "interrupted; go on with --resume -o %s\n", folder.c_str());
    return 128 + signal;
  }
  if (!options.quiet) std::printf("results: %s\n", folder.c_str());
  if (runner.failures() > 0) {
    std::fprintf(stderr, "error: %zu of %zu points failed; study.csv says why\n", runner.failures(),
                 plan.points.size());
  }
  return runner.failures() > 0 ? 1 : 0;
}

}  // namespace dust::study
