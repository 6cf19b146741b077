// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <sys/resource.h>
#include <sys/wait.h>
#include <unistd.h>

#include <algorithm>
#include <chrono>
#include <csignal>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <thread>

namespace dust::test {
namespace fs = std::filesystem;
namespace {

pid_t start(const std::vector<std::string>& arguments, const fs::path& out, const fs::path& err) {
  const pid_t pid = fork();
  if (pid != 0) return pid;
  if (freopen(out.c_str(), "w", stdout) == nullptr ||
      freopen(err.c_str(), "w", stderr) == nullptr) {
    _exit(127);
  }
  const rlimit no_core_dumps{0, 0};  // some tests crash on purpose
  setrlimit(RLIMIT_CORE, &no_core_dumps);
  std::vector<char*> argv;
  std::string program = DUST_ENGINE;
  argv.push_back(program.data());
  std::vector<std::string> copies = arguments;
  for (std::string& argument : copies) argv.push_back(argument.data());
  argv.push_back(nullptr);
  execv(DUST_ENGINE, argv.data());
  _exit(127);
}

Outcome wait_for(pid_t pid, const fs::path& out, const fs::path& err) {
  int status = 0;
  waitpid(pid, &status, 0);
  return {WIFEXITED(status) ? WEXITSTATUS(status) : 128 + WTERMSIG(status), read_file(out),
          read_file(err)};
}

}  // namespace

Outcome engine(const std::vector<std::string>& arguments) {
  const TemporaryFolder folder;
  return wait_for(start(arguments, folder / "out", folder / "err"), folder / "out", folder / "err");
}

Outcome engine_interrupted_when(const std::vector<std::string>& arguments, int signal,
                                const std::function<bool()>& is_time) {
  using namespace std::chrono_literals;
  const TemporaryFolder folder;
  const pid_t pid = start(arguments, folder / "out", folder / "err");
  for (int n = 0; n < 60000 && !is_time(); ++n) {
    if (waitpid(pid, nullptr, WNOHANG) == pid) {
      throw std::runtime_error("the engine ended before the signal: " + read_file(folder / "err"));
    }
    std::this_thread::sleep_for(1ms);
  }
  kill(pid, signal);
  return wait_for(pid, folder / "out", folder / "err");
}

Outcome engine_interrupted(const std::vector<std::string>& arguments, int signal,
                           const fs::path& file, int lines) {
  return engine_interrupted_when(arguments, signal, [&] {
    const std::string text = read_file(file);
    return std::count(text.begin(), text.end(), '\n') >= lines;
  });
}

TemporaryFolder::TemporaryFolder() {
  std::string name = (fs::temp_directory_path() / "dust-test-XXXXXX").string();
  if (mkdtemp(name.data()) == nullptr) throw std::runtime_error("no temporary folder");
  path_ = name;
}
TemporaryFolder::~TemporaryFolder() {
  std::error_code ignored;
  fs::remove_all(path_, ignored);
}
fs::path TemporaryFolder::operator/(const std::string& name) const { return path_ / name; }

std::string read_file(const fs::path& file) {
  std::ifstream in(file, std::ios::binary);
  std::ostringstream text;
  text << in.rdbuf();
  return text.str();
}

std::string json_text(const fs::path& file, const std::string& key) {
  const std::string text = read_file(file);
  const std::string mark = "\"" + key + "\": ";
  const auto at = text.find(mark);
  if (at == std::string::npos) throw std::runtime_error("no " + key + " in " + file.string());
  std::string value = text.substr(at + mark.size(), text.find('\n', at) - at - mark.size());
  std::erase_if(value, [](char c) { return c == '"' || c == ','; });
  return value;
}

}  // namespace dust::test
