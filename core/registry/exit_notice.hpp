// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace dust::registry {

/// From now on the program ends where the engine says so (note_own_end). A plugin's call of exit()
/// or quick_exit() would end it as if all were done: it prints a line on stderr, and the status is
/// that of a plugin that cannot be used, or while a run is under way that of one that failed.
/// _exit() ends a process without a word, and cannot be noticed from inside it.
void report_exits();
/// Again, so that it comes before what libraries loaded since then do at the end; nothing where
/// exits are not reported.
void renew_exit_report();
/// The program has come to its own end.
void note_own_end() noexcept;

/// While it lives a run writes its folder.
class RunUnderway {
 public:
  explicit RunUnderway(const std::filesystem::path& checkpoint);
  ~RunUnderway();
  RunUnderway(const RunUnderway&) = delete;
  RunUnderway& operator=(const RunUnderway&) = delete;
};

}  // namespace dust::registry
