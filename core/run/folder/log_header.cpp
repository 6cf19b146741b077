// SPDX-License-Identifier: Apache-2.0
#include "run/folder/log_header.hpp"

#include "io/input_files.hpp"
#include "run/summary/summary_models.hpp"

#include <nlohmann/json.hpp>

#include <sys/utsname.h>
#include <unistd.h>

#include <filesystem>
#include <fstream>
#include <system_error>
#include <thread>

namespace dust::run {
namespace {

std::string file_sha256(const std::filesystem::path& file) {
  const std::string digest = io::content_sha256(file);
  return digest.empty() ? "unknown" : digest;
}

std::string processor_name() {
  std::ifstream in("/proc/cpuinfo");
  for (std::string line; std::getline(in, line);) {
    if (!line.starts_with("model name")) continue;
    const std::size_t begin = line.find_first_not_of(" \t", line.find(':') + 1);
    if (begin != std::string::npos) return line.substr(begin);
  }
  return "unknown processor";
}

std::string machine_text() {
  utsname system{};
  uname(&system);
  const double bytes =
      static_cast<double>(sysconf(_SC_PHYS_PAGES)) * static_cast<double>(sysconf(_SC_PAGE_SIZE));
  return "machine: " + std::string(system.nodename) + ", " + processor_name() + ", " +
         std::to_string(std::thread::hardware_concurrency()) + " processors, " +
         std::to_string(static_cast<long long>(bytes / (1024.0 * 1024.0 * 1024.0) + 0.5)) +
         " GiB, " + system.sysname + " " + system.release;
}

}  // namespace

std::vector<std::string> log_header(const scenario::Setup& setup, const scenario::DustSetup& dust,
                                    const registry::Registry& registry, const RunOptions& options,
                                    const std::string& scenario_sha256) {
  std::error_code ignored;
  std::vector<std::string> lines;
  if (!options.program.empty()) lines.push_back(options.program);
  lines.push_back(machine_text());
  lines.push_back("process " + std::to_string(getpid()) + " in " +
                  std::filesystem::current_path(ignored).string());
  if (!options.command.empty()) lines.push_back("command: " + options.command);
  lines.push_back("scenario: " + setup.name + ", sha256 " + scenario_sha256);
  for (const auto& used : plugins_json(setup, dust, registry)) {
    const std::string kind = used.at("kind");
    const std::string name = used.at("name");
    const std::string version = used.at("version");
    const registry::Entry* entry = registry.find(kind, name);
    lines.push_back("plugin: " + kind + "/" + name + " " + version + ", " + entry->file.string() +
                    ", sha256 " + file_sha256(entry->file));
  }
  return lines;
}

}  // namespace dust::run
