// SPDX-License-Identifier: Apache-2.0
#include "about/command_words.hpp"
#include "commands.hpp"

#include <iostream>
#include <set>

namespace dust::engine {
namespace {

/// The names of options, separated by blanks.
std::string option_names(const CommandWords& command) {
  std::string text;
  for (const OptionWords& option : command.options) {
    if (option.is_positional) continue;
    for (const std::string& name : option.names) text += (text.empty() ? "" : " ") + name;
  }
  return text;
}

/// What the shell offers for a value: its choices, models, or files.
std::string offer(const OptionWords& option) {
  std::string choices;
  for (const std::string& word : option.choices) choices += (choices.empty() ? "" : " ") + word;
  if (!choices.empty()) return "COMPREPLY=($(compgen -W '" + choices + "' -- \"$current\"))";
  if (option.names.front() == "KIND/NAME") {
    return "COMPREPLY=($(compgen -W \"$(\"$1\" plugins 2>/dev/null | awk '{print $1 \"/\" $2}')\" "
           "-- "
           "\"$current\"))";
  }
  if (option.value == "DIR") return "COMPREPLY=($(compgen -d -- \"$current\"))";
  return "COMPREPLY=($(compgen -f -- \"$current\"))";
}

/// `case` of one command: behind an option that takes a value its values, behind a dash the
/// options, otherwise what its first positional argument takes.
void print_case(const CommandWords& command) {
  std::cout << "    " << command.name << ")\n      case $previous in\n";
  const OptionWords* positional = nullptr;
  for (const OptionWords& option : command.options) {
    if (option.is_positional) {
      if (positional == nullptr) positional = &option;
      continue;
    }
    if (option.value.empty()) continue;
    std::string pattern;
    for (const std::string& name : option.names) pattern += (pattern.empty() ? "" : "|") + name;
    std::cout << "        " << pattern << ")\n          " << offer(option)
              << "\n          return ;;\n";
  }
  std::cout << "      esac\n      if [[ $current == -* ]]; then\n        COMPREPLY=($(compgen -W '"
            << option_names(command) << "' -- \"$current\"))\n      else\n        "
            << (positional != nullptr ? offer(*positional) : ":") << "\n      fi ;;\n";
}

void print_completion(const CLI::App& app) {
  const auto commands = words_of_commands(app);
  std::string names;
  std::string patterns;
  for (const CommandWords& command : commands) {
    names += command.name + " ";
    patterns += (patterns.empty() ? "" : "|") + command.name;
  }
  std::cout << "# Completion of engine for bash; written by `engine completion`.\n"
               "_engine() {\n"
               "  local current=${COMP_WORDS[COMP_CWORD]} previous=${COMP_WORDS[COMP_CWORD-1]}\n"
               "  local command=\n"
               "  COMPREPLY=()\n"
               "  [[ $COMP_CWORD -gt 1 ]] && command=${COMP_WORDS[1]}\n"
               "  case $command in\n"
               "    '')\n"
               "      COMPREPLY=($(compgen -W '"
            << names << option_names(words_of(app))
            << "' -- \"$current\") $(compgen -f -- \"$current\")) ;;\n";
  for (const CommandWords& command : commands) print_case(command);
  std::cout << "  esac\n}\ncomplete -o filenames -F _engine engine\n";
}

}  // namespace

void add_completion(CLI::App& app, int&) {
  CLI::App* command =
      app.add_subcommand("completion", "Print what makes the shell complete commands and options");
  command->footer(
      "Examples:\n"
      "  source <(engine completion)                             # bash, this shell\n"
      "  autoload -U bashcompinit && bashcompinit && source <(engine completion)    # zsh\n"
      "An installed engine brings it for bash in share/bash-completion/completions.");
  command->callback([&app] { print_completion(app); });
}

}  // namespace dust::engine
