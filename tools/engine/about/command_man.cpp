// SPDX-License-Identifier: Apache-2.0
#include "about/command_words.hpp"
#include "commands.hpp"

#include <iostream>
#include <sstream>

namespace dust::engine {
namespace {

/// Text for roff: a backslash, a hyphen and a point at the start of a line have meanings of their
/// own.
std::string escaped(const std::string& text) {
  std::string result;
  for (const char c : text) {
    const bool is_line_start = result.empty() || result.back() == '\n';
    if (is_line_start && (c == '.' || c == '\'')) result += "\\&";
    if (c == '\\') {
      result += "\\e";
    } else if (c == '-') {
      result += "\\-";
    } else {
      result += c;
    }
  }
  return result;
}

std::string bold(const std::string& text) { return "\\fB" + escaped(text) + "\\fR"; }
std::string italic(const std::string& text) { return "\\fI" + escaped(text) + "\\fR"; }

void print_option(const OptionWords& option) {
  std::cout << ".TP\n";
  std::string head;
  for (const std::string& name : option.names) {
    if (!head.empty()) head += ", ";
    head += option.is_positional ? italic(name) : bold(name);
  }
  if (!option.is_positional && !option.value.empty()) head += " " + italic(option.value);
  if (option.is_required) head += " (required)";
  std::cout << head << '\n' << escaped(option.sentence);
  for (std::size_t n = 0; n < option.choices.size(); ++n) {
    std::cout << (n == 0 ? ": " : ", ") << escaped(option.choices[n]);
  }
  std::cout << '\n';
}

/// Lines as they are: examples.
void print_verbatim(const std::string& text) {
  if (text.empty()) return;
  std::cout << ".PP\n.nf\n" << escaped(text) << "\n.fi\n";
}

void print_command(const CommandWords& command) {
  std::cout << ".SS engine " << escaped(command.name);
  for (const OptionWords& option : command.options) {
    if (option.is_positional) std::cout << ' ' << italic(option.names.front());
  }
  std::cout << " [options]\n" << escaped(command.sentence) << ".\n";
  for (const OptionWords& option : command.options) {
    const bool is_help = !option.names.empty() && option.names.back() == "--help";
    if (!is_help) print_option(option);
  }
  print_verbatim(command.footer);
}

void print_man_page(const CLI::App& app) {
  const CommandWords program = words_of(app);
  // No date: the same sources give the same page.
  std::cout
      << ".TH ENGINE 1 \"\" \"dust " DUST_VERSION
         "\" \"User Commands\"\n"
         ".SH NAME\nengine \\- bulk solids, the air around them and the dust that gets loose\n"
         ".SH SYNOPSIS\n.B engine\n.I SCENARIO.yaml\n.br\n.B engine\n.I COMMAND\n[options]\n"
         ".SH DESCRIPTION\n"
      << escaped(program.sentence)
      << "\n.PP\nA scenario alone is run: 'engine SCENARIO.yaml' means "
         "'engine run SCENARIO.yaml'.\n";
  for (const OptionWords& option : program.options) print_option(option);
  std::cout << ".SH COMMANDS\n";
  for (const CommandWords& command : words_of_commands(app)) print_command(command);
  std::cout << ".SH EXAMPLES AND EXIT STATUS\n";
  print_verbatim(program.footer);
  std::cout << ".SH ENVIRONMENT\n.TP\n.B DUST_PLUGIN_PATH\n"
               "Folders to look for plugins in, separated by colons, after those of "
               "\\-\\-plugin\\-path.\n";
}

}  // namespace

void add_man(CLI::App& app, int&) {
  CLI::App* command = app.add_subcommand("man", "Print the manual page of all commands");
  command->footer("Example:\n  engine man | man -l -");
  command->callback([&app] { print_man_page(app); });
}

}  // namespace dust::engine
