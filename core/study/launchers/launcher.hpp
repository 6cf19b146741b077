// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "study/plan.hpp"
#include "study/point_store.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <vector>

namespace dust::study {

/// How one run ended.
struct JobResult {
  std::size_t job = 0;   ///< index into the jobs
  bool is_good = false;  ///< exit status 0
  std::string reason;    ///< one line, of a bad end
};

/// What a launcher needs beside the points.
struct Resources {
  std::filesystem::path engine;  ///< the program
  std::vector<std::string> plugin_path;
  int jobs = 1;
  int threads = 1;
  double memory_bytes = 0.0;
};

/// Called for every run that ends; false stops the study.
using OnJobResult = std::function<bool(const JobResult&)>;

/// Runs points, somewhere.
class Launcher {
 public:
  virtual ~Launcher() = default;
  /// Runs all `points`, in this order, and returns when they have ended or were stopped. Returns
  /// the number of the signal that interrupted it, or 0.
  virtual int run(const std::vector<Point>& points, const OnJobResult& on_result) = 0;
};

/// Child processes of this machine, as many at a time as cores and memory allow.
std::unique_ptr<Launcher> make_local_launcher(const PointStore& store, const Resources& resources);

/// A job array on a Slurm cluster.
std::unique_ptr<Launcher> make_slurm_launcher(const PointStore& store, const Resources& resources,
                                              const SlurmSpec& slurm, const std::string& name);

/// Throws base::UserError where the cluster's commands are missing.
void check_slurm();

/// What the engine is called with to run a point.
std::vector<std::string> run_arguments(const PointStore& store, const Resources& resources,
                                       const Point& point);

/// Catches the signals that ask for an end (base::catch_end_signals) while it lives.
class SignalGuard {
 public:
  SignalGuard();
  ~SignalGuard();
  SignalGuard(const SignalGuard&) = delete;
  SignalGuard& operator=(const SignalGuard&) = delete;
  static int caught();
};

}  // namespace dust::study
