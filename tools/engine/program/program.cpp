// SPDX-License-Identifier: Apache-2.0
#include "program/program.hpp"

#include "about/version.hpp"
#include "base/process/shell_word.hpp"

namespace dust::engine {

std::string program_text() {
  std::string line;
  for (const char c : version_text()) line += c == '\n' ? std::string(", ") : std::string(1, c);
  return line;
}

std::string command_text(const std::vector<std::string>& words) {
  std::string text;
  for (const std::string& word : words) text += (text.empty() ? "" : " ") + base::shell_word(word);
  return text;
}

}  // namespace dust::engine
