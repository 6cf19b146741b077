// SPDX-License-Identifier: Apache-2.0
#include "study/launchers/launcher.hpp"

#include "base/error.hpp"
#include "base/process/end_signals.hpp"

#include <fcntl.h>
#include <sys/prctl.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <cerrno>
#include <chrono>
#include <csignal>
#include <cstring>
#include <thread>

namespace dust::study {
namespace {

volatile std::sig_atomic_t g_signal = 0;
void on_signal(int signal) { g_signal = signal; }

/// Between looks at the children; a run lasts seconds to days.
constexpr auto k_pause = std::chrono::milliseconds(20);

struct Child {
  pid_t pid = -1;
  std::size_t job = 0;
  double memory_bytes = 0.0;
};

class LocalLauncher final : public Launcher {
 public:
  LocalLauncher(const PointStore& store, Resources resources)
      : store_(store), resources_(std::move(resources)) {}

  int run(const std::vector<Point>& points, const OnJobResult& on_result) override {
    std::size_t next = 0;
    bool goes_on = true;
    bool is_reported = false;
    while (next < points.size() || !children_.empty()) {
      const bool stops = SignalGuard::caught() != 0 || !goes_on;
      if (stops && !is_reported) {
        for (const Child& child : children_) kill(child.pid, SIGTERM);
        is_reported = true;
      }
      if (stops && children_.empty()) break;
      if (!stops && next < points.size() && has_room(points[next])) {
        children_.push_back(start(points[next], next));
        ++next;
        continue;
      }
      if (!collect(points, on_result, stops, goes_on)) std::this_thread::sleep_for(k_pause);
    }
    return SignalGuard::caught();
  }

 private:
  [[nodiscard]] bool has_room(const Point& point) const {
    if (children_.empty()) return true;
    if (static_cast<int>(children_.size()) >= resources_.jobs) return false;
    double taken = point.memory_bytes;
    for (const Child& child : children_) taken += child.memory_bytes;
    return taken <= resources_.memory_bytes;
  }

  Child start(const Point& point, std::size_t job) const {
    store_.prepare(point);
    std::vector<std::string> words = run_arguments(store_, resources_, point);
    std::vector<char*> argv;
    argv.reserve(words.size() + 1);
    for (std::string& word : words) argv.push_back(word.data());
    argv.push_back(nullptr);
    const std::string log = store_.log_of(point).string();
    const int output = open(log.c_str(), O_WRONLY | O_CREAT | O_TRUNC | O_CLOEXEC, 0666);
    if (output < 0) throw base::RunError("cannot write " + log + ": " + std::strerror(errno));
    const pid_t parent = getpid();
    const pid_t pid = fork();
    if (pid < 0) throw base::RunError(std::string("cannot start a run: ") + std::strerror(errno));
    if (pid == 0) {
      // Only calls that are safe between fork and exec. A run whose study is gone writes its
      // checkpoint and ends.
      prctl(PR_SET_PDEATHSIG, SIGTERM);
      if (getppid() != parent) _exit(1);
      dup2(output, STDOUT_FILENO);
      dup2(output, STDERR_FILENO);
      execv(argv.front(), argv.data());
      _exit(127);
    }
    close(output);
    return {pid, job, point.memory_bytes};
  }

  /// Tells of children that have ended; false when there are none.
  bool collect(const std::vector<Point>& points, const OnJobResult& on_result, bool stops,
               bool& goes_on) {
    bool has_ended = false;
    for (std::size_t n = 0; n < children_.size();) {
      int status = 0;
      const pid_t pid = waitpid(children_[n].pid, &status, WNOHANG);
      if (pid != children_[n].pid) {
        ++n;
        continue;
      }
      const Child child = children_[n];
      children_.erase(children_.begin() + static_cast<std::ptrdiff_t>(n));
      has_ended = true;
      const bool is_good = WIFEXITED(status) && WEXITSTATUS(status) == 0;
      // Stopped, not failed: it goes on from its checkpoint. A terminal sends its signal to study
      // and runs alike, so a run may have ended before the loop has looked.
      if ((stops || SignalGuard::caught() != 0) && !is_good) continue;
      goes_on = on_result({child.job, is_good, reason_of(points[child.job], status)}) && goes_on;
    }
    return has_ended;
  }

  [[nodiscard]] std::string reason_of(const Point& point, int status) const {
    if (WIFSIGNALED(status)) {
      const int signal = WTERMSIG(status);
      std::string text = std::string("killed by signal ") + std::to_string(signal) + " (" +
                         strsignal(signal) + ")";
      if (signal == SIGKILL) text += "; perhaps the memory ran out";
      return text;
    }
    const std::string reported = last_problem(store_.log_of(point));
    return reported.empty() ? "exit status " + std::to_string(WEXITSTATUS(status)) : reported;
  }

  const PointStore& store_;
  Resources resources_;
  std::vector<Child> children_;
};

}  // namespace

std::vector<std::string> run_arguments(const PointStore& store, const Resources& resources,
                                       const Point& point) {
  std::vector<std::string> words = {resources.engine.string(),
                                    "run",
                                    store.scenario_of(point).string(),
                                    "-o",
                                    store.results_of(point).string(),
                                    "--quiet",
                                    "--threads",
                                    std::to_string(resources.threads)};
  words.emplace_back(store.has_checkpoint(point) ? "--resume" : "--force");
  for (const std::string& folder : resources.plugin_path) {
    words.emplace_back("--plugin-path");
    words.push_back(folder);
  }
  return words;
}

SignalGuard::SignalGuard() {
  g_signal = 0;
  base::catch_end_signals(on_signal);
}
SignalGuard::~SignalGuard() { base::release_end_signals(); }
int SignalGuard::caught() { return static_cast<int>(g_signal); }

std::unique_ptr<Launcher> make_local_launcher(const PointStore& store, const Resources& resources) {
  return std::make_unique<LocalLauncher>(store, resources);
}

}  // namespace dust::study
