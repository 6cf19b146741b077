// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "registry/registry.hpp"

#include <doctest/doctest.h>

#include <filesystem>
#include <fstream>
#include <string>

namespace {

namespace fs = std::filesystem;
using dust::registry::Registry;

const fs::path k_folder = BAD_PLUGINS;

/// The lines with which the library in a folder is refused; none if it was accepted.
std::vector<std::string> refusal(const std::string& name) {
  Registry registry;
  try {
    registry.load({k_folder / name});
  } catch (const dust::base::PluginError& problem) {
    CHECK(registry.entries().empty());
    return problem.lines();
  }
  return {};
}

void check_one_line(const std::string& name, const std::string& expected) {
  const auto lines = refusal(name);
  REQUIRE(lines.size() == 1);
  const std::string start = (k_folder / name / (name + ".so")).string() + ": error: ";
  CHECK(lines[0].starts_with(start));
  CHECK_MESSAGE(lines[0].find(expected) != std::string::npos, lines[0]);
  CHECK(lines[0].find('\n') == std::string::npos);
}

}  // namespace

TEST_CASE("a plugin library that is well shall be loaded") {
  Registry registry;
  registry.load({k_folder / "good"});
  REQUIRE(registry.entries().size() == 1);
  const auto* entry = registry.find("drag", "constant");
  REQUIRE(entry != nullptr);
  CHECK(entry->file == k_folder / "good" / "good.so");
  CHECK(registry.names("drag") == std::vector<std::string>{"constant"});
  CHECK(
      registry.create({.kind = "drag", .name = "constant", .values = {}, .path = {}, .where = {}}));
}

TEST_CASE("a plugin of an older interface version shall be refused as older") {
  check_one_line("older", "the plugin is older");
}
TEST_CASE("a plugin of a newer interface version shall be refused, the engine being older") {
  check_one_line("newer", "the engine is older");
}
TEST_CASE("a plugin of another compiler shall be refused with both versions") {
  check_one_line("other_compiler", "built with g++ 9, this engine with g++ ");
}
TEST_CASE("a plugin with other struct sizes shall be refused") {
  check_one_line("other_sizes", "structs have other sizes");
}
TEST_CASE("a library without handshake shall be refused by the symbol it lacks") {
  check_one_line("no_handshake", "lacks 'dust_handshake'");
}
TEST_CASE("a library without entry point shall be refused by the symbol it lacks") {
  check_one_line("no_register", "lacks 'dust_register'");
}
TEST_CASE("a library with a missing symbol shall be refused with the loader's words") {
  check_one_line("missing_symbol", "a_function_nobody_defines");
}
TEST_CASE("a plugin that throws while it registers shall be refused with what it said") {
  check_one_line("throws_on_register", "the table of coefficients is missing");
}
TEST_CASE("a plugin without models shall be refused") { check_one_line("no_models", "no model"); }

TEST_CASE("a file that is no library shall be refused with the loader's words") {
  const fs::path folder = k_folder / "no_library";
  fs::create_directories(folder);
  std::ofstream(folder / "no_library.so") << "not a library\n";
  check_one_line("no_library", "cannot be loaded: ");
}

TEST_CASE("every fault of a description shall be told") {
  const auto lines = refusal("bad_names");
  std::string all;
  for (const std::string& line : lines) all += line + "\n";
  CHECK(lines.size() == 4);
  CHECK(all.find("the name 'Camel' is not snake_case") != std::string::npos);
  CHECK(all.find("has no summary") != std::string::npos);
  CHECK(all.find("'WrongName' is not snake_case") != std::string::npos);
  CHECK(all.find("'silent' has no sentence") != std::string::npos);
}

TEST_CASE("two plugins of one name shall be refused with both files") {
  Registry registry;
  try {
    registry.load({k_folder / "good", k_folder / "twice"});
    FAIL("accepted");
  } catch (const dust::base::PluginError& problem) {
    REQUIRE(problem.lines().size() == 1);
    CHECK(problem.lines()[0].find("good.so") != std::string::npos);
    CHECK(problem.lines()[0].find("twice.so") != std::string::npos);
    CHECK(problem.lines()[0].find("drag/constant") != std::string::npos);
  }
}

TEST_CASE("a library reached through two folders shall be loaded once") {
  Registry registry;
  registry.load({k_folder / "good", k_folder / "twice" / ".." / "good"});
  CHECK(registry.entries().size() == 1);
}

TEST_CASE("all wrong libraries shall be told at once") {
  Registry registry;
  try {
    registry.load({k_folder / "older", k_folder / "no_models", k_folder / "not_there"});
    FAIL("accepted");
  } catch (const dust::base::PluginError& problem) {
    CHECK(problem.lines().size() == 3);
  }
}
