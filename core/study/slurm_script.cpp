// SPDX-License-Identifier: Apache-2.0
#include "study/slurm_script.hpp"

#include <cmath>

namespace dust::study {
namespace {

/// Estimates of memory are rough; a job that exceeds what it asked for is killed.
constexpr double k_memory_reserve = 2.0;
constexpr double k_megabyte = 1024.0 * 1024.0;
/// Before the time limit, so that a checkpoint is written [s].
constexpr int k_warning = 60;

}  // namespace

std::string shell_quoted(const std::string& text) {
  std::string quoted = "'";
  for (const char c : text) quoted += c == '\'' ? std::string("'\\''") : std::string(1, c);
  return quoted + "'";
}

std::string slurm_script(const SlurmJob& job) {
  const std::string folder = job.store.string();
  const int memory =
      static_cast<int>(std::ceil(k_memory_reserve * job.memory_bytes / k_megabyte)) + 64;
  std::string text = "#!/bin/sh\n";
  const auto ask = [&](const std::string& option) { text += "#SBATCH " + option + "\n"; };
  ask("--job-name=" + job.name);
  std::string array = "--array=0-" + std::to_string(job.tasks - 1);
  if (job.slurm.at_a_time > 0) array += "%" + std::to_string(job.slurm.at_a_time);
  ask(array);
  ask("--ntasks=1");
  ask("--cpus-per-task=" + std::to_string(job.resources.threads));
  ask("--mem=" + std::to_string(memory) + "M");
  ask("--signal=B:TERM@" + std::to_string(k_warning));
  ask("--no-requeue");
  ask("--output=/dev/null");
  if (!job.slurm.partition.empty()) ask("--partition=" + job.slurm.partition);
  if (!job.slurm.account.empty()) ask("--account=" + job.slurm.account);
  if (!job.slurm.time_limit.empty()) ask("--time=" + job.slurm.time_limit);
  for (const std::string& option : job.slurm.options) ask(option);
  text += "cd " + shell_quoted(folder) + " || exit 1\n";
  text += "hash=$(sed -n \"$((SLURM_ARRAY_TASK_ID + 1))p\" slurm/points)\n";
  text += "how=--force\n";
  text += "if [ -e \"points/$hash/checkpoint.h5\" ]; then how=--resume; fi\n";
  text += shell_quoted(job.resources.engine.string()) +
          " run \"points/$hash.yaml\" -o \"points/$hash\" --quiet --threads " +
          std::to_string(job.resources.threads) + " $how";
  for (const std::string& path : job.resources.plugin_path) {
    text += " --plugin-path " + shell_quoted(path);
  }
  text += " > \"points/$hash.log\" 2>&1 &\n";
  text +=
      "run=$!\n"
      "trap 'kill -TERM $run' TERM INT\n"
      "wait $run\n"
      "status=$?\n"
      // A signal ends the first wait; the run is still writing its checkpoint.
      "while kill -0 $run 2> /dev/null; do wait $run; status=$?; done\n"
      "echo $status > \"slurm/$hash.exit.part\" && mv \"slurm/$hash.exit.part\" "
      "\"slurm/$hash.exit\"\n"
      "exit $status\n";
  return text;
}

}  // namespace dust::study
