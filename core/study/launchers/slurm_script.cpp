// SPDX-License-Identifier: Apache-2.0
#include "study/launchers/slurm_script.hpp"

#include <algorithm>
#include <cmath>

namespace dust::study {
namespace {

/// Estimates of memory are rough; a job that exceeds what it asked for is killed.
constexpr double k_memory_reserve = 2.0;
constexpr double k_megabyte = 1024.0 * 1024.0;
/// Before the time limit, so that a checkpoint is written [s].
constexpr int k_warning = 60;
/// Beside what is estimated: the program itself.
constexpr double k_extra_megabytes = 64.0;

/// Lines for sbatch: what the job asks for.
std::string requests(const SlurmJob& job) {
  const SlurmSpec& slurm = job.slurm;
  const auto together = static_cast<double>(slurm.points_per_job);
  const double memory = k_memory_reserve * job.memory_bytes / k_megabyte + k_extra_megabytes;
  std::string text;
  const auto ask = [&](const std::string& option) { text += "#SBATCH " + option + "\n"; };
  ask("--job-name=" + job.name);
  const std::int64_t jobs = (job.points + slurm.points_per_job - 1) / slurm.points_per_job;
  std::string array = "--array=0-" + std::to_string(jobs - 1);
  if (slurm.at_a_time > 0) {
    array +=
        "%" + std::to_string(std::max<std::int64_t>(1, slurm.at_a_time / slurm.points_per_job));
  }
  ask(array);
  ask("--ntasks=1");
  ask("--cpus-per-task=" + std::to_string(job.resources.threads * slurm.points_per_job));
  ask("--mem=" + std::to_string(static_cast<std::int64_t>(std::ceil(together * memory))) + "M");
  ask("--signal=B:TERM@" + std::to_string(k_warning));
  ask("--no-requeue");
  // What a run says goes to its own log; here stands what went wrong around it.
  ask("--output=\"" + (job.store / "slurm" / "%A_%a.out").string() + "\"");
  if (!slurm.partition.empty()) ask("--partition=" + slurm.partition);
  if (!slurm.account.empty()) ask("--account=" + slurm.account);
  if (!slurm.time_limit.empty()) ask("--time=" + slurm.time_limit);
  for (const std::string& option : slurm.options) ask(option);
  return text;
}

/// A function of the shell that runs one point: goes on from its checkpoint, hands TERM on to the
/// run, waits until its checkpoint is written, leaves the exit status.
std::string point_function(const SlurmJob& job) {
  std::string run = shell_quoted(job.resources.engine.string()) +
                    " run \"points/$1.yaml\" -o \"points/$1\" --quiet --threads " +
                    std::to_string(job.resources.threads) + " $how";
  for (const std::string& path : job.resources.plugin_path) {
    run += " --plugin-path " + shell_quoted(path);
  }
  return "point() {\n"
         "  how=--force\n"
         "  if [ -e \"points/$1/checkpoint.h5\" ]; then how=--resume; fi\n"
         "  " +
         run +
         " > \"points/$1.log\" 2>&1 &\n"
         "  run=$!\n"
         "  trap 'kill -TERM $run' TERM INT\n"
         "  wait $run\n"
         "  status=$?\n"
         // A signal ends the first wait; the run is still writing its checkpoint.
         "  while kill -0 $run 2> /dev/null; do wait $run; status=$?; done\n"
         "  echo $status > \"slurm/$1.exit.part\" && mv \"slurm/$1.exit.part\" \"slurm/$1.exit\"\n"
         "  return $status\n"
         "}\n";
}

}  // namespace

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string slurm_script(const SlurmJob& job) {
  const std::string together = std::to_string(job.slurm.points_per_job);
  std::string text = "#!/bin/sh\n" + requests(job);
  text += "cd " + shell_quoted(job.store.string()) + " || exit 1\n";
  for (const std::string& line : job.slurm.prologue) text += line + "\n";
  text += point_function(job);
  text += "first=$((SLURM_ARRAY_TASK_ID * " + together +
          " + 1))\n"
          "last=$((first + " +
          together +
          " - 1))\n"
          "points=\n"
          "for hash in $(sed -n \"${first},${last}p\" slurm/points); do\n"
          "  point \"$hash\" &\n"
          "  points=\"$points $!\"\n"
          "done\n"
          "trap 'kill -TERM $points' TERM INT\n"
          "failed=0\n"
          "for one in $points; do\n"
          "  wait $one || failed=1\n"
          "  while kill -0 $one 2> /dev/null; do wait $one; done\n"
          "done\n"
          "exit $failed\n";
  return text;
}

}  // namespace dust::study
