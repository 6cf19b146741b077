// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "base/process/shell_word.hpp"
#include "commands.hpp"
#include "io/atomic_file.hpp"
#include "reserved_names.hpp"
#include "scenario/text/suggest.hpp"

#include <boost/dll/runtime_symbol_info.hpp>

#include <algorithm>
#include <cctype>
#include <iostream>

namespace dust::engine {
namespace {

namespace fs = std::filesystem;

/// <prefix>/share/dust/plugin_template beside the program, wherever the tree was moved.
fs::path template_folder() {
  std::error_code code;
  const fs::path program = boost::dll::program_location(code);
  const fs::path folder =
      (program.parent_path().parent_path() / "share" / "dust" / "plugin_template")
          .lexically_normal();
  if (code || !fs::is_directory(folder, code)) {
    throw base::UserError(folder.string() +
                          ": error: the templates are not installed here; install the package "
                          "dust-dev, or `cmake --install` with all components");
  }
  return folder;
}

std::vector<std::string> kinds_in(const fs::path& folder) {
  std::vector<std::string> kinds;
  for (const auto& entry : fs::directory_iterator(folder)) {
    if (entry.is_directory()) kinds.push_back(entry.path().filename().string());
  }
  std::sort(kinds.begin(), kinds.end());
  return kinds;
}

/// "stokes_oseen" becomes "StokesOseen".
std::string camel_case(const std::string& name) {
  std::string text;
  bool is_start = true;
  for (const char c : name) {
    if (c != '_') text += is_start ? static_cast<char>(std::toupper(c)) : c;
    is_start = c == '_';
  }
  return text;
}

void replace_all(std::string& text, const std::string& from, const std::string& to) {
  for (std::size_t at = 0; (at = text.find(from, at)) != std::string::npos; at += to.size()) {
    text.replace(at, from.size(), to);
  }
}

bool is_snake_case(const std::string& name) {
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// Copies the files of a template with the name filled in; returns what was written.
std::vector<std::string> copy_template(const fs::path& from, const fs::path& to,
                                       const std::string& old_name, const std::string& new_name) {
  fs::create_directories(to);
  std::vector<std::string> written;
  for (const auto& entry : fs::directory_iterator(from)) {
    std::string text = io::read_text(entry.path());
    std::string file = entry.path().filename().string();
    for (std::string* one : {&text, &file}) {
      replace_all(*one, old_name, new_name);
      replace_all(*one, camel_case(old_name), camel_case(new_name));
    }
    write_file(to / file, text);
    written.push_back(file);
  }
  std::sort(written.begin(), written.end());
  return written;
}

void check_name(const std::string& name) {
  if (!is_snake_case(name)) {
    throw base::UserError("engine new-plugin: error: the name '" + scenario::printable(name) +
                          "' is not snake_case: a to z, 0 to 9 and _, beginning with a letter");
  }
  if (const std::string why = why_reserved(name); !why.empty()) {
    throw base::UserError("engine new-plugin: error: the name '" + name + "' is " + why +
                          ", so the plugin would not build: choose another, like my_" + name);
  }
}

void make_plugin(const std::string& kind, const std::string& name, const fs::path& folder) {
  check_name(name);
  const fs::path templates = template_folder();
  const auto kinds = kinds_in(templates);
  if (std::find(kinds.begin(), kinds.end(), kind) == kinds.end()) {
    throw base::UserError("engine new-plugin: error: there is no kind '" +
                          scenario::printable(kind) + "'" +
                          scenario::suggestion(kind, kinds, "there are"));
  }
  if (load_plugins({})->find(kind, name) != nullptr) {
    throw base::UserError("engine new-plugin: error: there is a " + kind + "/" + name +
                          " already: choose another name");
  }
  std::error_code code;
  if (fs::exists(folder, code)) {
    throw base::UserError(folder.string() + ": error: exists already: choose another with -o DIR");
  }
  const auto files = copy_template(templates / kind, folder, "my_" + kind, name);
  std::cout << "wrote " << folder.string() << ":";
  for (const std::string& file : files) std::cout << ' ' << file;
  const std::string build = base::shell_word((folder / "build").string());
  const std::string prefix = templates.parent_path().parent_path().parent_path().string();
  std::cout << "\nnext:\n  cmake -S " << base::shell_word(folder.string()) << " -B " << build << ' '
            << base::shell_word("-DCMAKE_PREFIX_PATH=" + prefix) << "\n  cmake --build " << build
            << " && ctest --test-dir " << build << "\n  engine describe " << kind << '/' << name
            << " --plugin-path " << build << '\n';
}

}  // namespace

void add_new_plugin(CLI::App& app, int&) {
  struct Arguments {
    std::string kind;
    std::string name;
    std::string folder;
  };
  auto arguments = std::make_shared<Arguments>();
  CLI::App* command = app.add_subcommand(
      "new-plugin", "Write a plugin to start from: it builds and passes its tests");
  command->add_option("KIND", arguments->kind, "drag, contact, sensor, ...")->required();
  command->add_option("NAME", arguments->name, "How scenarios will name it, snake_case")
      ->required();
  command->add_option("-o,--output", arguments->folder, "Folder to write (default: NAME)")
      ->type_name("DIR");
  command->footer("Example:\n  engine new-plugin drag my_law");
  command->callback([arguments] {
    make_plugin(arguments->kind, arguments->name,
                arguments->folder.empty() ? arguments->name : arguments->folder);
  });
}

}  // namespace dust::engine
