// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <CLI/CLI.hpp>

#include <string>
#include <vector>

namespace dust::engine {

/// What the declaration of a command says of one option or positional argument.
struct OptionWords {
  std::vector<std::string> names;    ///< "-o", "--output"; of a positional its name
  std::string value;                 ///< "DIR", "PATH=VALUE"; empty for a flag
  std::vector<std::string> choices;  ///< the allowed words, if they are a list
  std::string sentence;
  bool is_positional = false;
  bool is_required = false;
};

struct CommandWords {
  std::string name;
  std::string sentence;
  std::string footer;
  std::vector<OptionWords> options;
};

/// A declared program or command in words: man page and completion are written from these.
CommandWords words_of(const CLI::App& command);
/// All commands, in the order of `engine --help`.
std::vector<CommandWords> words_of_commands(const CLI::App& app);

}  // namespace dust::engine
