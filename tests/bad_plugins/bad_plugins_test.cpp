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

/// The library in the folder of this name is refused with exactly this line.
void check_one_line(const std::string& name, const std::string& expected) {
  const auto lines = refusal(name);
  REQUIRE(lines.size() == 1);
  CHECK(lines[0] == (k_folder / name / (name + ".so")).string() + ": error: " + expected);
}

const std::string k_ours = std::to_string(dust::sdk::k_interface_version);

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
  check_one_line("older", "built against interface version " +
                              std::to_string(dust::sdk::k_interface_version - 1) +
                              ", this engine has " + k_ours +
                              ": the plugin is older, rebuild it with this engine's headers");
}
TEST_CASE("a plugin of a newer interface version shall be refused, the engine being older") {
  check_one_line("newer", "built against interface version " +
                              std::to_string(dust::sdk::k_interface_version + 1) +
                              ", this engine has " + k_ours +
                              ": the engine is older, use the one the plugin was built for");
}
TEST_CASE("a plugin of another compiler shall be refused with both versions") {
  const std::string ours = std::to_string(__GNUC__);
  check_one_line("other_compiler", "built with g++ 9, this engine with g++ " + ours +
                                       ": build both with the same compiler");
}
TEST_CASE("a plugin with other struct sizes shall be refused") {
  check_one_line("other_sizes",
                 "its structs have other sizes than this engine's: rebuild it with this engine's "
                 "headers and flags");
}
TEST_CASE("a library without handshake shall be refused by the symbol it lacks") {
  check_one_line("no_handshake",
                 "not a plugin of this engine: it lacks 'dust_handshake' (DUST_PLUGIN defines it)");
}
TEST_CASE("a library without entry point shall be refused by the symbol it lacks") {
  check_one_line("no_register",
                 "not a plugin of this engine: it lacks 'dust_register' (DUST_PLUGIN defines it)");
}
TEST_CASE("a library with a missing symbol shall be refused with the loader's words") {
  check_one_line("missing_symbol",
                 "cannot be loaded: " + (k_folder / "missing_symbol/missing_symbol.so").string() +
                     ": undefined symbol: _Z21an_undefined_functionv: it uses a function that "
                     "neither it nor a library it was linked with has; link it with the one that "
                     "does (target_link_libraries), and write every function that it declares");
}
TEST_CASE("a library whose own library is not found shall be refused with what helps") {
  check_one_line("missing_library",
                 "cannot be loaded: libbad_absent.so: cannot open shared object file: No such file "
                 "or directory: it was linked with that library, which is not on this machine or "
                 "not where libraries are looked for; install it, or name its folder in "
                 "LD_LIBRARY_PATH");
}
TEST_CASE("a plugin that throws while it registers shall be refused with what it said") {
  check_one_line("throws_on_register",
                 "throws while it registers its models: the table of coefficients is missing");
  check_one_line("throws_a_number", "throws while it registers its models");
}
TEST_CASE("a plugin without models shall be refused") {
  check_one_line("no_models", "registers no model");
}

TEST_CASE("a library that registers one model twice shall be refused") {
  check_one_line("registers_twice", "registers drag/constant twice: remove or rename one");
}

TEST_CASE("a file that is no library shall be refused with the loader's words") {
  const fs::path folder = k_folder / "no_library";
  fs::create_directories(folder);
  std::ofstream(folder / "no_library.so") << "not a library\n";
  check_one_line("no_library",
                 "cannot be loaded: " + (folder / "no_library.so").string() + ": file too short");
}

TEST_CASE("every fault of a description shall be told") {
  const std::string start = (k_folder / "bad_names/bad_names.so").string() + ": error: ";
  CHECK(refusal("bad_names") ==
        std::vector<std::string>{
            start + "the name 'Camel' is not snake_case", start + "drag/Camel has no summary",
            start + "drag/Camel: the parameter 'WrongName' is not snake_case",
            start + "drag/Camel: the parameter 'silent' has no sentence that explains it",
            start + "drag/Camel: the parameter 'none': its range, from 3 to 1, holds no number",
            start + "drag/Camel: the parameter 'outside': its default, 0, lies outside its own "
                    "range",
            start + "drag/Camel: the parameter 'unusual': its usual range, from 10 to 1, holds no "
                    "number",
            start + "drag/Camel: the parameter 'kind': its default, 'other', is none of its "
                    "options",
            start + "motion/mover: the parameter 'material' could never be given: the scenario has "
                    "a key 'material' of its own beside it; choose another name",
            start + "motion/mover: the parameter 'radius' is declared twice"});
}

TEST_CASE("two plugins of one name shall be refused with both files") {
  Registry registry;
  try {
    registry.load({k_folder / "good", k_folder / "twice"});
    FAIL("accepted");
  } catch (const dust::base::PluginError& problem) {
    CHECK(problem.lines() == std::vector<std::string>{(k_folder / "twice/twice.so").string() +
                                                      ": error: offers drag/constant, which " +
                                                      (k_folder / "good/good.so").string() +
                                                      " offers already: take one of the two "
                                                      "libraries out of the folders where plugins "
                                                      "are looked for, or choose another name for "
                                                      "one of the models"});
  }
}

TEST_CASE("a library given in place of its folder shall be answered with the folder") {
  const fs::path file = k_folder / "good" / "good.so";
  Registry registry;
  try {
    registry.load({file});
    FAIL("accepted");
  } catch (const dust::base::PluginError& problem) {
    CHECK(problem.lines() ==
          std::vector<std::string>{file.string() +
                                   ": error: cannot look for plugins here: Not a directory: name "
                                   "the folder that holds the library, not the file"});
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
    REQUIRE(problem.lines().size() == 3);
    CHECK(problem.lines()[2] == (k_folder / "not_there").string() +
                                    ": error: cannot look for plugins here: No such file or "
                                    "directory");
  }
}

TEST_CASE("many libraries of one folder with the same fault shall make one line") {
  const fs::path folder = k_folder / "many";
  fs::create_directories(folder);
  const auto put = [&](const std::string& kind, const std::string& name) {
    fs::copy_file(k_folder / kind / (kind + ".so"), folder / (name + ".so"),
                  fs::copy_options::overwrite_existing);
  };
  for (const std::string name : {"a", "b", "c"}) put("older", name);
  put("no_models", "n");
  CHECK(refusal("many").size() == 4);
  for (const std::string name : {"d", "z"}) put("older", name);
  const auto lines = refusal("many");
  REQUIRE(lines.size() == 2);
  CHECK(lines[0].starts_with(folder.string() +
                             ": error: 5 libraries, a.so the first: built against interface"));
  CHECK(lines[1] == (folder / "n.so").string() + ": error: registers no model");
  fs::remove_all(folder);
}
