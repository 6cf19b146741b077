// SPDX-License-Identifier: Apache-2.0
#include "about/version.hpp"
#include "base/error.hpp"
#include "commands.hpp"
#include "io/run_files.hpp"
#include "memory/huge_pages.hpp"
#include "program/program.hpp"
#include "registry/crash_notice.hpp"
#include "registry/exit_notice.hpp"
#include "registry/guard_report.hpp"
#include "scenario/text/suggest.hpp"

#include <algorithm>
#include <cstdio>
#include <filesystem>
#include <iostream>
#include <new>

namespace {

using namespace dust;

/// Exit status, fixed by the contract.
constexpr int k_failed = 1;
constexpr int k_wrong_input = 2;

std::vector<std::string> command_names(const CLI::App& app) {
  std::vector<std::string> names;
  for (const CLI::App* command : app.get_subcommands([](const CLI::App*) { return true; })) {
    names.push_back(command->get_name());
  }
  return names;
}

/// `engine SCENARIO.yaml` means `engine run SCENARIO.yaml`. A first word that is neither a command
/// nor looks like a file is a mistyped command.
void complete_arguments(const CLI::App& app, std::vector<std::string>& arguments) {
  if (arguments.empty()) return;
  const std::string& first = arguments.front();
  const auto commands = command_names(app);
  const bool is_global = first == "--help" || first == "-h" || first == "--version";
  if (is_global || std::find(commands.begin(), commands.end(), first) != commands.end()) return;
  std::error_code code;
  const bool is_file = first.starts_with("-") || first.find('.') != std::string::npos ||
                       first.find('/') != std::string::npos || std::filesystem::exists(first, code);
  if (!is_file) {
    throw base::UserError("engine: error: unknown command '" + scenario::printable(first) + "'" +
                          scenario::suggestion(first, commands, "commands"));
  }
  arguments.insert(arguments.begin(), "run");
}

/// Prints what the command-line parser found: help on stdout, problems on stderr.
int report(const CLI::App& app, const CLI::ParseError& problem) {
  if (problem.get_exit_code() == 0) return app.exit(problem, std::cout, std::cerr);
  std::string command = "engine";
  for (const CLI::App* sub : app.get_subcommands()) command += " " + sub->get_name();
  std::string text = problem.what();
  std::replace(text.begin(), text.end(), '\n', ' ');
  std::cerr << command << ": error: " << text << " (see " << command << " --help)\n";
  return k_wrong_input;
}

/// A result that has not come where it was sent is none. What a run or a study prints is progress:
/// theirs is in their folder, and they go on without anybody who reads along.
int with_output_checked(const CLI::App& app, int status) {
  const bool is_progress = app.got_subcommand("run") || app.got_subcommand("study");
  std::cout.flush();
  const bool is_flushed = std::fflush(stdout) == 0 && std::cout.good() && std::ferror(stdout) == 0;
  if (is_flushed || is_progress || status != 0) return status;
  std::cerr << "error: standard output cannot be written, and what was printed is not whole: is "
               "its disk full?\n";
  return k_failed;
}

int engine_main(int argc, char** argv) {
  CLI::App app{"Bulk solids, the air around them and the dust that gets loose."};
  app.name("engine");
  app.set_version_flag("--version", engine::version_text());
  app.require_subcommand(1);
  app.get_formatter()->column_width(34);
  app.footer(
      "Examples:\n"
      "  engine scenarios/transfer_point.yaml\n"
      "  engine check scenarios/transfer_point.yaml --set bodies.belt.speed='0.4 m/s'\n"
      "  engine describe drag/gidaspow\n"
      "'engine COMMAND --help' tells more.\n"
      "Exit status: 0 finished, 1 failed while running, 2 wrong input, 128 + the "
      "signal interrupted (130, 143).");
  int status = 0;
  std::vector<std::string> words{"engine"};
  words.insert(words.end(), argv + 1, argv + argc);
  engine::add_run(app, status, engine::command_text(words));
  engine::add_check(app, status);
  engine::add_list(app, status);
  engine::add_plugins(app, status);
  engine::add_describe(app, status);
  engine::add_schema(app, status);
  engine::add_graph(app, status);
  engine::add_study(app, status);
  engine::add_suggest_hoods(app, status);
  engine::add_follow(app, status);
  engine::add_report(app, status);
  engine::add_compare(app, status);
  engine::add_new(app, status);
  engine::add_new_plugin(app, status);
  engine::add_test_plugin(app, status);
  engine::add_report_bug(app, status);
  engine::add_man(app, status);
  engine::add_completion(app, status);
  engine::add_help(app, status);
  std::vector<std::string> arguments(argv + 1, argv + argc);
  complete_arguments(app, arguments);
  if (!arguments.empty() && arguments.front() == "run") engine::ask_for_huge_pages(argv);
  registry::report_crashes();
  registry::report_exits();
  std::reverse(arguments.begin(), arguments.end());
  try {
    app.parse(arguments);
  } catch (const CLI::ParseError& problem) {
    return with_output_checked(app, report(app, problem));
  }
  return with_output_checked(app, status);
}

/// Prints on stderr what ends it.
int reported_main(int argc, char** argv) {
  try {
    return engine_main(argc, argv);
  } catch (const base::UserError& problem) {
    for (const std::string& line : problem.warnings()) std::cerr << line << '\n';
    for (const std::string& line : problem.lines()) std::cerr << line << '\n';
    return k_wrong_input;
  } catch (const registry::PlacedFault& problem) {
    std::cerr << problem.line() << '\n';
    return k_wrong_input;
  } catch (const std::filesystem::filesystem_error& problem) {
    std::cerr << "error: " << problem.path1().string() << ": " << problem.code().message() << '\n';
    return k_failed;
  } catch (const std::bad_alloc&) {
    std::cerr << "error: there is no more memory; take coarser cells of the fluid or fewer grains, "
                 "or a larger machine ('engine check' says what a run needs)\n";
    return k_failed;
  } catch (const std::exception& problem) {
    std::cerr << "error: " << problem.what() << '\n';
    return k_failed;
  }
}

}  // namespace

int main(int argc, char** argv) {
  io::leave_hdf5_open_at_exit();
  const int status = reported_main(argc, argv);
  registry::note_own_end();
  return status;
}
