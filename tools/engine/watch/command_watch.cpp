// SPDX-License-Identifier: Apache-2.0
#include "base/process/shell_word.hpp"
#include "base/text.hpp"
#include "commands.hpp"
#include "watch/run_state.hpp"

#include <chrono>
#include <cmath>
#include <iostream>
#include <thread>

namespace dust::engine {
namespace {

using Clock = std::chrono::steady_clock;

double seconds_since(Clock::time_point begin) {
  return std::chrono::duration<double>(Clock::now() - begin).count();
}

/// 0 = finished.
int print_end(const std::string& folder, const RunState& state) {
  const std::string quoted = base::shell_word(folder);
  if (state.status == "finished") {
    std::cout << "finished: " << state_text(state) << "; engine report " << quoted << '\n';
    return 0;
  }
  // A killed run leaves the summary of before, or none.
  const bool is_failed = state.status == "failed" && !state.reason.empty();
  const bool can_go_on = std::filesystem::exists(std::filesystem::path(folder) / "checkpoint.h5");
  std::cout << (is_failed ? "failed: " + state.reason : "stopped") << " at " << state_text(state)
            << (can_go_on ? "; go on with --resume -o "
                          : " before its first checkpoint; start again with --force -o ")
            << quoted << '\n';
  return 1;
}

}  // namespace

void add_follow(CLI::App& app, int& status) {
  struct Arguments {
    std::string folder;
    double every = 5.0;
    bool is_once = false;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("watch", "Follow a run in its folder, from any terminal, to its end");
  command->add_option("DIR", arguments->folder, "Folder of the run's results")->required();
  command->add_option("--every", arguments->every, "Seconds between two lines (default: 5)")
      ->check(CLI::Range(0.1, 86400.0));
  command->add_flag("--once", arguments->is_once, "Tell how far it is and end");
  command->footer(
      "Exit status: 0 the run has finished (or, with --once, goes on), 1 it has stopped before.\n"
      "Example:\n  engine watch results/transfer_point");
  command->callback([arguments, &status] {
    const auto begin = Clock::now();
    const RunState first = read_run_state(arguments->folder);
    for (;;) {
      const RunState state = read_run_state(arguments->folder);
      if (!state.is_running) {
        status = print_end(arguments->folder, state);
        return;
      }
      std::cout << state_text(state);
      const double pace = (state.time - first.time) / seconds_since(begin);
      if (pace > 0.0) {
        std::cout << ", about " << base::duration_text(std::round((state.end - state.time) / pace))
                  << " left";
      }
      std::cout << std::endl;
      if (arguments->is_once) return;
      std::this_thread::sleep_for(std::chrono::duration<double>(arguments->every));
    }
  });
}

}  // namespace dust::engine
