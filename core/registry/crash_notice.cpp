// SPDX-License-Identifier: Apache-2.0
#include "registry/crash_notice.hpp"

#include <unistd.h>

#include <algorithm>
#include <array>
#include <atomic>
#include <csignal>
#include <cstring>
#include <string>
#include <string_view>
#include <utility>

namespace dust::registry {
namespace {

constexpr std::pair<int, const char*> k_crashes[] = {
    {SIGSEGV, "SIGSEGV, memory that it may not use"},
    {SIGBUS, "SIGBUS, memory that is not there"},
    {SIGFPE, "SIGFPE, arithmetic without a result"},
    {SIGILL, "SIGILL, an instruction that the processor refuses"},
    {SIGABRT, "SIGABRT, its own code gave up"}};

constinit thread_local const Asking* g_asking = nullptr;
constinit std::atomic_flag g_has_spoken;

/// All that a handler reads has its place from the beginning: it may not allocate.
constexpr std::size_t k_room = 4096;
char g_libraries[k_room];
constinit std::atomic<std::size_t> g_libraries_length = 0;
constinit std::atomic<bool> g_has_more_libraries = false;
/// As the two above were before the last one was noted.
constinit std::size_t g_length_before = 0;
constinit bool g_had_more_before = false;
char g_line[3 * k_room];
/// Of the first thread, for a stack that has run over.
char g_stack[16 * k_room];

/// Text in a given room; what does not fit is left out.
class FixedText {
 public:
  explicit FixedText(std::span<char> room) : room_(room) {}
  void add(std::string_view text) {
    const std::size_t count = std::min(text.size(), room_.size() - length_);
    std::memcpy(room_.data() + length_, text.data(), count);
    length_ += count;
  }
  [[nodiscard]] std::size_t length() const { return length_; }

 private:
  std::span<char> room_;
  std::size_t length_ = 0;
};

/// What was asked when it happened, and who may have been at work.
void add_circumstances(FixedText& text) {
  const std::size_t libraries = g_libraries_length;
  if (g_asking != nullptr) {
    text.add(" while ");
    text.add(g_asking->who());
    text.add(g_asking->question());
    text.add(g_asking->subject());
  } else if (libraries > 0) {
    text.add(" while no model of others was asked");
  }
  if (libraries > 0) {
    text.add("; loaded plugins that are not the engine's own: ");
    text.add({g_libraries, libraries});
    if (g_has_more_libraries) text.add(" and others");
  } else {
    text.add(
        "; no plugins but the engine's own are loaded: please report it, 'engine report-bug' "
        "gathers what helps");
  }
}

void on_crash(int signal, siginfo_t* info, void*) {
  // One faulty model crashes many threads at once: the first one's line, then the end of them all.
  if (!may_speak_last()) {
    for (;;) pause();
  }
  // What another process sends is no crash.
  if (info->si_code != SI_USER && info->si_code != SI_QUEUE) {
    const std::size_t length = write_crash_text(signal, g_line);
    [[maybe_unused]] const auto written = write(STDERR_FILENO, g_line, length);
  }
  // The instruction at fault is tried again after this, and ends the process as it would have.
  std::signal(signal, SIG_DFL);
  if (info->si_code <= 0) raise(signal);  // it was sent, and would not come again
}

}  // namespace

Asking::Asking(const char* who, const char* question, const char* subject) noexcept
    : who_(who), question_(question), subject_(subject), outer_(g_asking) {
  g_asking = this;
}
Asking::~Asking() { g_asking = outer_; }

void note_foreign_library(const std::filesystem::path& file) {
  const std::size_t length = g_libraries_length;
  g_length_before = length;
  g_had_more_before = g_has_more_libraries;
  const std::string text = (length > 0 ? ", " : "") + file.string();
  if (length + text.size() > k_room) {
    g_has_more_libraries = true;
    return;
  }
  std::memcpy(g_libraries + length, text.data(), text.size());
  g_libraries_length = length + text.size();
}

void withdraw_noted_library() {
  g_libraries_length = g_length_before;
  g_has_more_libraries = g_had_more_before;
}

bool may_speak_last() noexcept { return !g_has_spoken.test_and_set(); }

std::size_t write_crash_text(int signal, std::span<char> room) noexcept {
  if (room.empty()) return 0;
  FixedText text(room.first(room.size() - 1));  // the end of the line has its place
  text.add("error: crashed (");
  for (const auto& [crash, name] : k_crashes) {
    if (crash == signal) text.add(name);
  }
  text.add(")");
  add_circumstances(text);
  room[text.length()] = '\n';
  return text.length() + 1;
}

std::size_t write_exit_text(std::span<char> room) noexcept {
  if (room.empty()) return 0;
  FixedText text(room.first(room.size() - 1));
  text.add("error: ended by a call of exit() that is not the engine's");
  add_circumstances(text);
  room[text.length()] = '\n';
  return text.length() + 1;
}

void report_crashes() {
  stack_t stack{};
  stack.ss_sp = g_stack;
  stack.ss_size = sizeof g_stack;
  sigaltstack(&stack, nullptr);
  struct sigaction action {};
  action.sa_sigaction = on_crash;
  action.sa_flags = SA_SIGINFO | SA_ONSTACK;
  sigfillset(&action.sa_mask);
  for (const auto& [crash, name] : k_crashes) {
    struct sigaction before {};
    if (sigaction(crash, nullptr, &before) != 0 || before.sa_handler != SIG_DFL) continue;
    sigaction(crash, &action, nullptr);
  }
}

}  // namespace dust::registry
