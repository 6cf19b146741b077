// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/launchers/launcher.hpp"

#include <filesystem>
#include <string>

namespace dust::study {

/// What goes into a job array.
struct SlurmJob {
  std::string name;
  std::filesystem::path store;  ///< folder of the study, seen by all nodes
  Resources resources;
  SlurmSpec slurm;
  std::int64_t points = 1;
  double memory_bytes = 0.0;  ///< of the largest point, by its estimate
};

/// The script for sbatch: task k of the array runs `points_per_job` points of `slurm/points` side
/// by side, from line k * points_per_job + 1 on. Each goes on from its checkpoint where there is
/// one, is handed the cluster's signal, and leaves its exit status in `slurm/HASH.exit`.
std::string slurm_script(const SlurmJob& job);

/// `text` as one word of a shell.
std::string shell_quoted(const std::string& text);

}  // namespace dust::study
