// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/random.hpp"
#include "unit/scenario/support.hpp"

#include <doctest/doctest.h>

namespace {

void check_refused(const std::string& text) {
  const Folder folder;
  const auto reported = problems(folder.write("g.yaml", text));
  REQUIRE_FALSE(reported.empty());
  for (const std::string& line : reported) {
    CHECK(line.starts_with("g.yaml:"));
    CHECK(line.find("error: ") != std::string::npos);
    CHECK(line.find('\n') == std::string::npos);
  }
}

std::string repeated(const std::string& piece, int count) {
  std::string text;
  for (int n = 0; n < count; ++n) text += piece;
  return text;
}

}  // namespace

TEST_CASE("files that are no scenario shall be refused with a line each") {
  for (const std::string text : {"",
                                 "\n\n",
                                 "# only a comment\n",
                                 "---\n",
                                 "just words\n",
                                 "[1, 2]\n",
                                 "42\n",
                                 "~\n",
                                 "time: {\n",
                                 "a: b: c\n",
                                 "\t- x\n",
                                 "? [a]\n: b\n",
                                 "{a: 1, a: 2}\n",
                                 "*unknown\n",
                                 "&a [*a]\n",
                                 "a: &x {b: *x}\n",
                                 "!!binary abc\n",
                                 "a: !tag 1\n",
                                 "%YAML 9.9\n---\na: 1\n",
                                 "a: 1\n---\nb: 2\n",
                                 "\"unclosed\n",
                                 "'\n",
                                 "key\n  : 1\n",
                                 "- - - a\n",
                                 "<<: {a: 1}\n",
                                 "a: |\n  text\n b\n",
                                 "include: 1\n",
                                 "include: {a: b}\n",
                                 "include: [[x]]\n",
                                 "include: .\n",
                                 "include: ''\n",
                                 "domain: {boundaries: [1]}\n",
                                 "interactions: {a: b}\n",
                                 "interactions: [1, [2], {between: 3}]\n",
                                 "bodies: [1]\n",
                                 "bodies: {a: 1, b: [], c: {}}\n",
                                 "sensors: {1: {model: x}}\n",
                                 "emitters: {'': {}}\n",
                                 "fluid: [none]\n",
                                 "fluid: 'none '\n",
                                 "materials: {sand: ~}\n",
                                 "name: {a: b}\n",
                                 "seed: 1.5\n",
                                 "seed: -1\n",
                                 "seed: 99999999999999999999\n",
                                 "time: ~\n",
                                 "gravity: [.nan, 0, 0]\n"}) {
    CAPTURE(text);
    check_refused(text);
  }
}

TEST_CASE("bytes that are no text shall be refused with their place") {
  check_refused(std::string("a: 1\nb: \0\n", 10));
  check_refused("a: \xff\xfe\n");
  check_refused(
      "\xff\xfe"
      "a\0:\0");
  check_refused("a: \xc3\n");
  check_refused(std::string(2000, '\0'));
  check_refused(
      "\x7f"
      "ELF\x02\x01\x01");
}

TEST_CASE("deep nesting and multiplying aliases shall be refused") {
  check_refused(repeated("[", 100000));
  check_refused(repeated("{a: ", 20000));
  check_refused(repeated("- ", 50000));
  std::string text = "a0: &a0 [x, x, x, x, x, x, x, x, x, x]\n";
  for (int n = 1; n < 12; ++n) {
    const std::string last = "*a" + std::to_string(n - 1);
    text += "a" + std::to_string(n) + ": &a" + std::to_string(n) + " [" + repeated(last + ", ", 9) +
            last + "]\n";
  }
  check_refused(text);
}

TEST_CASE("files that cannot be read shall be refused") {
  const Folder folder;
  CHECK(joined(problems(folder.path() / "not_there.yaml")) ==
        "not_there.yaml: error: cannot be read: No such file or directory\n");
  CHECK(joined(problems(folder.path())).find("is a folder, not a file") != std::string::npos);
  CHECK(joined(problems(folder.write("big.yaml", std::string(5u << 20, '#')))) ==
        "big.yaml: error: is larger than 4 MB: not a scenario\n");
}

TEST_CASE("random changes of a scenario shall never end the program") {
  const Folder folder;
  const std::string text = text_of(transfer_point());
  const dust::sdk::Random random(11, 1);
  const std::string pieces[] = {"{",  "}",  "[", "]",  ":",  "\n", " ",  "&a ",
                                "*a", "- ", "'", "\"", "1",  "-",  "#",  "!",
                                "|",  ">",  "%", "@",  "\t", ",",  "? ", "none"};
  constexpr int k_mutants = 300;
  for (int n = 0; n < k_mutants; ++n) {
    std::string mutant = text;
    for (std::uint32_t change = 0; change < 3; ++change) {
      const auto draw = [&](std::uint32_t slot, std::size_t count) {
        return static_cast<std::size_t>(
            random.uniform(static_cast<std::uint64_t>(n), change, slot) *
            static_cast<double>(count));
      };
      mutant.replace(draw(0, mutant.size()), draw(1, 4), pieces[draw(2, std::size(pieces))]);
    }
    const auto reported = problems(folder.write("r.yaml", mutant));
    for (const std::string& line : reported) CHECK(line.find("error: ") != std::string::npos);
  }
}
