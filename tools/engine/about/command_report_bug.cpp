// SPDX-License-Identifier: Apache-2.0
#include "about/version.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "dust/sdk/plugin.hpp"
#include "io/atomic_file.hpp"

#include <nlohmann/json.hpp>

#include <sys/utsname.h>

#include <algorithm>
#include <fstream>
#include <iostream>
#include <thread>

namespace dust::engine {
namespace {

namespace fs = std::filesystem;
using Json = nlohmann::ordered_json;

/// The end of a log says how a run ended; its start is in the summary and the scenario.
constexpr std::size_t k_max_log_lines = 60;

/// What stands behind "key" and a separator in a file like /proc/cpuinfo; "unknown" without.
std::string value_in(const fs::path& file, const std::string& key, char separator) {
  std::ifstream stream(file);
  for (std::string line; std::getline(stream, line);) {
    if (!line.starts_with(key)) continue;
    const std::size_t at = line.find(separator);
    const std::size_t begin = line.find_first_not_of(" \t\"", at + 1);
    if (at == std::string::npos || begin == std::string::npos) continue;
    return line.substr(begin, line.find_last_not_of(" \t\"") - begin + 1);
  }
  return "unknown";
}

std::string machine_text() {
  utsname system{};
  uname(&system);  // without the machine's name: nobody has to know it
  return "system: " + value_in("/etc/os-release", "PRETTY_NAME", '=') + ", " + system.sysname +
         " " + system.release + " " + system.machine +
         "\nprocessor: " + value_in("/proc/cpuinfo", "model name", ':') + ", " +
         std::to_string(std::thread::hardware_concurrency()) +
         " threads\nmemory: " + value_in("/proc/meminfo", "MemTotal", ':');
}

std::string section(const std::string& title, const std::string& text, const char* kind = "") {
  std::string body = text.empty() ? "(none)" : text;
  if (body.back() == '\n') body.pop_back();
  return "\n## " + title + "\n\n```" + kind + "\n" + body + "\n```\n";
}

/// The summary without what the other sections hold or what is long: sensors, sizes, columns.
std::string summary_text(const fs::path& file) {
  if (!fs::exists(file)) {
    return "there is no summary.json: the run is going on, or was killed or crashed";
  }
  Json summary = Json::parse(io::read_text(file), nullptr, false);
  if (summary.is_discarded()) return "summary.json is damaged";
  for (const char* key : {"sensors", "series", "references", "size_classes", "emitters"}) {
    summary.erase(key);
  }
  return summary.dump(1);
}

std::string last_lines(const std::string& text, std::size_t count) {
  std::size_t begin = text.size();
  for (std::size_t lines = 0; begin > 0; --begin) {
    if (text[begin - 1] == '\n' && begin != text.size() && ++lines == count) break;
  }
  return text.substr(begin);
}

std::string files_text(const fs::path& folder) {
  std::vector<std::string> lines;
  for (const auto& entry :
       fs::recursive_directory_iterator(folder, fs::directory_options::skip_permission_denied)) {
    if (!entry.is_regular_file()) continue;
    lines.push_back(fs::relative(entry.path(), folder).string() + "  " +
                    std::to_string(entry.file_size()));
  }
  std::sort(lines.begin(), lines.end());
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

std::string report_text(const fs::path& folder) {
  return "# What happened\n\n"
         "(What did you do, what did you expect, what came instead? If a smaller scenario shows it "
         "too, give that one.)\n" +
         section("Engine", version_text()) + section("Machine", machine_text()) +
         section("Summary", summary_text(folder / "summary.json"), "json") +
         section("Last lines of run.log",
                 last_lines(io::read_text(folder / "run.log"), k_max_log_lines)) +
         section("Files and bytes", files_text(folder)) +
         section("Scenario as run", io::read_text(folder / "scenario.yaml"), "yaml");
}

}  // namespace

void add_report_bug(CLI::App& app, int&) {
  struct Arguments {
    std::string folder;
    std::string file = "bug_report.md";
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command =
      app.add_subcommand("report-bug", "Write what an issue needs to know of a run into one file");
  command->add_option("DIR", arguments->folder, "Folder of the run")->required();
  command->add_option("-o", arguments->file, "The file to write (default: bug_report.md)")
      ->type_name("FILE");
  command->footer(
      "The file holds version, machine, summary, the end of run.log, names and sizes of the files "
      "and the\n"
      "scenario; nothing is sent anywhere. Read it, write what happened at its top, attach it.\n"
      "Example:\n"
      "  engine report-bug results/transfer_point");
  command->callback([arguments] {
    const fs::path folder = arguments->folder;
    if (!fs::is_directory(folder))
      throw base::UserError(folder.string() + ": error: no such folder");
    if (!fs::exists(folder / "run.log") && !fs::exists(folder / "scenario.yaml")) {
      throw base::UserError(folder.string() +
                            ": error: holds neither run.log nor scenario.yaml; give the output "
                            "folder of a run, for example results/transfer_point");
    }
    if (fs::exists(arguments->file)) {
      throw base::UserError(arguments->file + ": error: exists already; give another -o");
    }
    write_file(arguments->file, report_text(folder));
    std::cout << "written: " << arguments->file << "\n";
  });
}

}  // namespace dust::engine
