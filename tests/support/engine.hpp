// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <functional>
#include <string>
#include <vector>

namespace dust::test {

/// What a finished engine left behind.
struct Outcome {
  int status = 0;  ///< exit status; 128 + signal when killed
  std::string out;
  std::string err;
};

/// Runs build/.../bin/engine with these arguments and waits.
Outcome engine(const std::vector<std::string>& arguments);

/// Starts the engine, sends `signal` as soon as `file` exists and holds at least `lines` lines, and
/// waits for the end.
Outcome engine_interrupted(const std::vector<std::string>& arguments, int signal,
                           const std::filesystem::path& file, int lines);

/// The same, as soon as `is_time` says so; it is asked every millisecond.
Outcome engine_interrupted_when(const std::vector<std::string>& arguments, int signal,
                                const std::function<bool()>& is_time);

/// A folder of its own, removed at the end of the test.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] std::filesystem::path operator/(const std::string& name) const;

 private:
  std::filesystem::path path_;
};

std::string read_file(const std::filesystem::path& file);
/// The text behind "key": in a JSON file, up to the end of the line, without quotes and comma.
std::string json_text(const std::filesystem::path& file, const std::string& key);

}  // namespace dust::test
