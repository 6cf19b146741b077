// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <filesystem>
#include <span>

namespace dust::registry {

/// What this thread asks of a plugin's code while the object lives: "drag/rough (/x/rough.so)",
/// " was asked for ", "evaluate". A crash is reported with it. The texts are not copied: they have
/// to live as long. Costs two stores.
class Asking {
 public:
  Asking(const char* who, const char* question, const char* subject = "") noexcept;
  ~Asking();
  Asking(const Asking&) = delete;
  Asking& operator=(const Asking&) = delete;

  [[nodiscard]] const char* who() const { return who_; }
  [[nodiscard]] const char* question() const { return question_; }
  [[nodiscard]] const char* subject() const { return subject_; }

 private:
  const char* who_;
  const char* question_;
  const char* subject_;
  const Asking* outer_;
};

/// A library that is not known to be the engine's own is loaded from now on: noted before it is
/// opened, for its code runs then. Not while other threads run.
void note_foreign_library(const std::filesystem::path& file);
/// The library noted last is the engine's own after all, or was not opened. Once for each.
void withdraw_noted_library();

/// The line for a crash of this thread by this signal; returns its length. Claims no more than is
/// known: what was being asked, not whose fault it is. Async-signal-safe.
std::size_t write_crash_text(int signal, std::span<char> room) noexcept;
/// The line for a call of exit() by this thread that is not the engine's; as above.
std::size_t write_exit_text(std::span<char> room) noexcept;

/// The last words are one thread's: true for the first that asks. Async-signal-safe.
bool may_speak_last() noexcept;

/// From now on a crash (SIGSEGV, SIGBUS, SIGFPE, SIGILL, SIGABRT) prints that line on stderr. The
/// process still ends by its signal, with a core dump where those are wanted. Leaves alone signals
/// that somebody else handles (sanitizers) or that are ignored.
void report_crashes();

}  // namespace dust::registry
