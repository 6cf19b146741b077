// SPDX-License-Identifier: Apache-2.0
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

#include <regex>

namespace {

/// "file:line:column: error: text" or "--set path: error: text".
bool is_diagnostic(const std::string& line) {
  static const std::regex form(R"([^:\n]+\.yaml:[1-9][0-9]*:[1-9][0-9]*: error: [^\n]+)");
  return std::regex_match(line, form);
}

std::vector<std::string> lines_of(const std::string& text) {
  std::vector<std::string> lines;
  std::istringstream stream(text);
  for (std::string line; std::getline(stream, line);) lines.push_back(line);
  return lines;
}

std::string with_line(std::vector<std::string> lines, std::size_t n, const std::string& line) {
  lines[n] = line;
  return joined(lines);
}

/// A key of the user's own: renaming it is no mistake unless something refers to it.
bool names_a_thing(const std::string& block) {
  return block == "materials" || block == "bodies" || block == "emitters" || block == "sensors" ||
         block == "frames";
}

}  // namespace

TEST_CASE("every key written wrong and every value replaced by nonsense shall be explained") {
  const Folder folder;
  const auto lines = lines_of(text_of(transfer_point()));
  const std::regex key(R"((\s*(?:- )?)([A-Za-z_]+):(.*))");
  std::string block;
  int checked = 0;
  for (std::size_t n = 0; n < lines.size(); ++n) {
    std::smatch match;
    if (!std::regex_match(lines[n], match, key)) continue;
    const std::string indent = match[1];
    const std::string name = match[2];
    if (indent.empty()) block = name;
    std::vector<std::string> mutants;
    if (!(indent.size() == 2 && names_a_thing(block))) {
      mutants.push_back(indent + name + "x:" + std::string(match[3]));
    }
    if (name != "name") mutants.push_back(indent + name + ": '@@nonsense@@'");
    mutants.push_back(indent + name + ": [[{a: [b]}]]");
    for (const std::string& mutant : mutants) {
      const auto reported = problems(folder.write("m.yaml", with_line(lines, n, mutant)));
      CHECK_MESSAGE(!reported.empty(), mutant);
      for (const std::string& line : reported) CHECK_MESSAGE(is_diagnostic(line), line);
      ++checked;
    }
  }
  CHECK(checked > 120);
}

TEST_CASE("every number with a unit of another dimension shall be explained") {
  const Folder folder;
  const std::string text = text_of(transfer_point());
  const std::regex quantity(R"([0-9] (mm|um|ms|m/s|g/s|MPa|Pa|deg|s)(?=[\],}\s]))");
  int checked = 0;
  for (auto at = std::sregex_iterator(text.begin(), text.end(), quantity);
       at != std::sregex_iterator(); ++at) {
    // Comments hold quantities too.
    const auto begin = static_cast<std::size_t>(at->position(1));
    const std::size_t line = text.rfind('\n', begin);
    if (text.substr(line + 1, begin - line).find('#') != std::string::npos) continue;
    std::string mutant = text;
    mutant.replace(begin, static_cast<std::size_t>(at->length(1)), "K");
    const auto reported = problems(folder.write("m.yaml", mutant));
    CHECK_MESSAGE(!reported.empty(), at->str());
    for (const std::string& one : reported) {
      CHECK_MESSAGE(is_diagnostic(one), one);
      CHECK_MESSAGE(one.find("'K' is the unit of a temperature") != std::string::npos, one);
    }
    ++checked;
  }
  CHECK(checked > 25);
}

TEST_CASE("a scenario cut off anywhere shall be explained or read, never end the program") {
  const Folder folder;
  const std::string text = text_of(transfer_point());
  constexpr std::size_t k_stride = 61;
  for (std::size_t size = 0; size < text.size(); size += k_stride) {
    const auto reported = problems(folder.write("m.yaml", text.substr(0, size)));
    for (const std::string& one : reported) CHECK_MESSAGE(is_diagnostic(one), one);
  }
}
