// SPDX-License-Identifier: Apache-2.0
#include "study/launchers/launcher.hpp"

#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "study/launchers/slurm_script.hpp"

#include <sys/wait.h>

#include <algorithm>
#include <chrono>
#include <cstdio>
#include <cstdlib>
#include <fstream>
#include <sstream>
#include <thread>

namespace dust::study {
namespace {

namespace fs = std::filesystem;

/// Between looks at the queue: soon after something happened, rarely while nothing does.
constexpr auto k_shortest_pause = std::chrono::milliseconds(500);
constexpr auto k_longest_pause = std::chrono::milliseconds(20000);
/// Clusters allow arrays of 1000 tasks unless told otherwise (MaxArraySize).
constexpr std::size_t k_max_tasks = 1000;
/// A file written on a node is seen here a little later on a network file system.
constexpr int k_looks_for_exit = 10;

struct Reply {
  int status = -1;
  std::string text;
};

/// Runs a command and returns what it printed on both streams.
Reply shell(const std::string& command) {
  Reply reply;
  std::FILE* pipe = popen((command + " 2>&1").c_str(), "r");
  if (pipe == nullptr) return reply;
  char buffer[4096];
  std::size_t got = 0;
  while ((got = std::fread(buffer, 1, sizeof buffer, pipe)) > 0) reply.text.append(buffer, got);
  const int status = pclose(pipe);
  reply.status = WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  return reply;
}

class SlurmLauncher final : public Launcher {
 public:
  SlurmLauncher(const PointStore& store, Resources resources, SlurmSpec slurm, std::string name)
      : store_(store),
        resources_(std::move(resources)),
        slurm_(std::move(slurm)),
        name_(std::move(name)),
        folder_(fs::absolute(store.folder()) / "slurm") {}

  int run(const std::vector<Point>& points, const OnJobResult& on_result) override {
    fs::create_directories(folder_);
    for (const Point& point : points) store_.prepare(point);
    wait_for_old_array();
    std::vector<std::size_t> pending(points.size());
    for (std::size_t n = 0; n < pending.size(); ++n) pending[n] = n;
    std::vector<int> attempts(points.size(), 0);
    bool goes_on = true;
    while (!pending.empty() && goes_on && SignalGuard::caught() == 0) {
      const std::size_t count = std::min(pending.size(), k_max_tasks);
      const std::vector<std::size_t> some(pending.begin(),
                                          pending.begin() + static_cast<std::ptrdiff_t>(count));
      pending.erase(pending.begin(), pending.begin() + static_cast<std::ptrdiff_t>(count));
      const std::string job = submit(points, some);
      for (const std::size_t n : some) ++attempts[n];
      for (const std::size_t n : gather(points, some, job, attempts, on_result, goes_on)) {
        pending.push_back(n);
      }
      if (!goes_on || SignalGuard::caught() != 0) cancel(job);
    }
    return SignalGuard::caught();
  }

 private:
  std::string submit(const std::vector<Point>& points, const std::vector<std::size_t>& some) {
    std::string list;
    double memory = 0.0;
    for (const std::size_t n : some) {
      list += points[n].hash + "\n";
      memory = std::max(memory, points[n].memory_bytes);
      fs::remove(exit_file(points[n]));
    }
    io::write_text(folder_ / "points", list);
    io::write_text(folder_ / "job.sh",
                   slurm_script({.name = name_,
                                 .store = fs::absolute(store_.folder()),
                                 .resources = resources_,
                                 .slurm = slurm_,
                                 .points = static_cast<std::int64_t>(some.size()),
                                 .memory_bytes = memory}));
    const Reply reply = shell("sbatch --parsable " + shell_quoted((folder_ / "job.sh").string()));
    const std::string job = reply.text.substr(0, reply.text.find_first_not_of("0123456789"));
    if (reply.status != 0 || job.empty()) {
      throw base::RunError("sbatch refused the job: " + reply.text);
    }
    io::write_text(folder_ / "job", job + "\n");
    return job;
  }

  /// Tells of tasks as they end; returns those that shall be tried again.
  std::vector<std::size_t> gather(const std::vector<Point>& points,
                                  const std::vector<std::size_t>& some, const std::string& job,
                                  const std::vector<int>& attempts, const OnJobResult& on_result,
                                  bool& goes_on) {
    std::vector<std::size_t> open = some;
    std::vector<std::size_t> again;
    auto pause = k_shortest_pause;
    while (!open.empty() && goes_on && SignalGuard::caught() == 0) {
      const bool is_queued = is_in_queue(job);
      std::vector<std::size_t> left;
      for (const std::size_t n : open) {
        const auto status = exit_status(points[n], !is_queued);
        if (!status && is_queued) {
          left.push_back(n);
        } else if (should_repeat(status) && attempts[n] < slurm_.attempts) {
          again.push_back(n);
        } else {
          goes_on = on_result({n, status == 0, reason_of(points[n], status)}) && goes_on;
        }
      }
      pause = left.size() < open.size() ? k_shortest_pause : std::min(2 * pause, k_longest_pause);
      open = std::move(left);
      if (!open.empty()) wait(pause);
    }
    return again;
  }

  /// Cut off by a limit or lost with its node: it goes on from its checkpoint. Wrong input and
  /// failed runs would fail again.
  static bool should_repeat(const std::optional<int>& status) {
    constexpr int k_interrupted = 130;
    constexpr int k_terminated = 143;
    constexpr int k_killed = 137;
    return !status || *status == k_interrupted || *status == k_terminated || *status == k_killed;
  }

  [[nodiscard]] std::string reason_of(const Point& point, const std::optional<int>& status) const {
    if (!status) return "the cluster ended the job: time or memory limit, or a lost node";
    const std::string reported = last_problem(store_.log_of(point));
    return reported.empty() ? "exit status " + std::to_string(*status) : reported;
  }

  [[nodiscard]] fs::path exit_file(const Point& point) const {
    return folder_ / (point.hash + ".exit");
  }

  [[nodiscard]] std::optional<int> exit_status(const Point& point, bool must_be_there) const {
    for (int look = 0; look < (must_be_there ? k_looks_for_exit : 1); ++look) {
      std::ifstream stream(exit_file(point));
      int status = 0;
      if (stream >> status) return status;
      if (must_be_there) std::this_thread::sleep_for(std::chrono::milliseconds(200));
    }
    return std::nullopt;
  }

  /// Whether tasks of the job wait or run. A controller that does not answer is no answer.
  [[nodiscard]] static bool is_in_queue(const std::string& job) {
    const Reply reply = shell("squeue --noheader --jobs=" + job + " --format=%T");
    if (reply.status == 0) return reply.text.find_first_not_of(" \n") != std::string::npos;
    return reply.text.find("Invalid job id") == std::string::npos;
  }

  /// The array of a study that was killed goes on by itself.
  void wait_for_old_array() const {
    std::string job;
    std::ifstream(folder_ / "job") >> job;
    if (job.empty() || job.find_first_not_of("0123456789") != std::string::npos) return;
    while (SignalGuard::caught() == 0 && is_in_queue(job)) wait(k_shortest_pause);
  }

  void cancel(const std::string& job) const {
    shell("scancel " + job);
    // Runs write their checkpoints when they are told to end.
    for (int n = 0; n < 60 && is_in_queue(job); ++n) {
      std::this_thread::sleep_for(k_shortest_pause);
    }
  }

  static void wait(std::chrono::milliseconds pause) {
    const auto end = std::chrono::steady_clock::now() + pause;
    while (SignalGuard::caught() == 0 && std::chrono::steady_clock::now() < end) {
      std::this_thread::sleep_for(std::chrono::milliseconds(50));
    }
  }

  const PointStore& store_;
  Resources resources_;
  SlurmSpec slurm_;
  std::string name_;
  fs::path folder_;
};

bool is_in_path(const std::string& program) {
  const char* path = std::getenv("PATH");
  std::istringstream folders(path != nullptr ? path : "");
  std::string folder;
  while (std::getline(folders, folder, ':')) {
    if (fs::exists(fs::path(folder) / program)) return true;
  }
  return false;
}

}  // namespace

void check_slurm() {
  for (const char* program : {"sbatch", "squeue", "scancel"}) {
    if (is_in_path(program)) continue;
    throw base::UserError(std::string("error: --launcher slurm: there is no ") + program +
                          " in PATH; run the study where the cluster's commands are, or with "
                          "--launcher local");
  }
}

std::unique_ptr<Launcher> make_slurm_launcher(const PointStore& store, const Resources& resources,
                                              const SlurmSpec& slurm, const std::string& name) {
  return std::make_unique<SlurmLauncher>(store, resources, slurm, name);
}

}  // namespace dust::study
