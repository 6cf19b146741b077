// SPDX-License-Identifier: Apache-2.0
#include "registry/exit_notice.hpp"

#include "registry/crash_notice.hpp"

#include <unistd.h>

#include <array>
#include <atomic>
#include <cstdlib>
#include <cstring>
#include <string>

namespace dust::registry {
namespace {

/// Exit status, fixed by the contract.
constexpr int k_failed_run = 1;
constexpr int k_unusable_plugin = 2;

/// The process that reports; 0: none. What a plugin forks may end as it likes.
constinit std::atomic<pid_t> g_process = 0;
constinit std::atomic<bool> g_is_own_end = false;
constinit std::atomic<bool> g_is_underway = false;

/// No objects: those with destructors may be gone when the program ends.
constexpr std::size_t k_path_room = 8192;
char g_exit_line[2 * k_path_room];
char g_checkpoint[k_path_room];

void print(const char* text, std::size_t length) {
  [[maybe_unused]] const auto written = write(STDERR_FILENO, text, length);
}

void print(const char* text) { print(text, std::strlen(text)); }

void on_foreign_exit() {
  if (g_is_own_end || g_process != getpid()) return;
  // Many threads ask one faulty model: the first one's words, then the end of them all.
  if (!may_speak_last()) {
    for (;;) pause();
  }
  print(g_exit_line, write_exit_text(g_exit_line));
  if (g_is_underway && access(g_checkpoint, F_OK) == 0) {
    print("error: the last good checkpoint is ");
    print(g_checkpoint);
    print(": --resume goes on from it once the plugin is mended\n");
  }
  _exit(g_is_underway ? k_failed_run : k_unusable_plugin);
}

}  // namespace

void report_exits() {
  g_process = getpid();
  // They are called in reverse, and a function may stand among them more than once.
  std::atexit(on_foreign_exit);
  std::at_quick_exit(on_foreign_exit);
}

void renew_exit_report() {
  if (g_process == getpid()) report_exits();
}

void note_own_end() noexcept { g_is_own_end = true; }

RunUnderway::RunUnderway(const std::filesystem::path& checkpoint) {
  const std::string text = checkpoint.string();
  g_checkpoint[0] = '\0';
  if (text.size() < k_path_room) std::memcpy(g_checkpoint, text.c_str(), text.size() + 1);
  g_is_underway = true;
  renew_exit_report();
}

RunUnderway::~RunUnderway() { g_is_underway = false; }

}  // namespace dust::registry
