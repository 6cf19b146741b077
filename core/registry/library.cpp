// SPDX-License-Identifier: Apache-2.0
#include "registry/library.hpp"

#include "base/error.hpp"
#include "base/text.hpp"
#include "registry/crash_notice.hpp"
#include "registry/exit_notice.hpp"

#include <boost/dll/shared_library.hpp>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
#include <set>
#include <utility>
#include <variant>

namespace dust::registry {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& file, const std::string& why) {
  throw base::PluginError(file.string() + ": error: " + why);
}

/// Libraries opened so far. Never destroyed: code of a plugin may run until the very end (models,
/// exceptions), so nothing is ever unloaded.
std::vector<boost::dll::shared_library>& open_libraries() {
  static auto* libraries = new std::vector<boost::dll::shared_library>;
  return *libraries;
}

/// Keeps what the loader of the system said, without what Boost.DLL says around it.
std::string loader_message(std::string text) {
  const std::string begin = "dlerror system message: ";
  const std::size_t at = text.find(begin);
  if (at != std::string::npos) {
    text.erase(0, at + begin.size());
    const std::size_t end = text.rfind(')');
    if (end != std::string::npos) text.erase(end);
  }
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text;
}

/// What helps against what the loader of the system said; empty where that says it.
std::string loader_remedy(const std::string& message) {
  if (message.find("undefined symbol") != std::string::npos) {
    return ": it uses a function that neither it nor a library it was linked with has; link it "
           "with the one that does (target_link_libraries), and write every function that it "
           "declares";
  }
  if (message.find("cannot open shared object file") != std::string::npos) {
    return ": it was linked with that library, which is not on this machine or not where libraries "
           "are looked for; install it, or name its folder in LD_LIBRARY_PATH";
  }
  return {};
}

/// Notes the library; the caller withdraws one that is the engine's own.
boost::dll::shared_library open(const fs::path& file) {
  const std::string name = file.string();
  const Asking asking(name.c_str(), " was loaded");
  note_foreign_library(file);
  try {
    // All symbols now: a missing one is told here and not in the middle of a run.
    boost::dll::shared_library library(file, boost::dll::load_mode::rtld_now);
    renew_exit_report();
    return library;
  } catch (const boost::dll::fs::system_error& problem) {
    withdraw_noted_library();
    const std::string message = loader_message(problem.what());
    refuse(file, "cannot be loaded: " + message + loader_remedy(message));
  } catch (const std::exception& problem) {
    refuse(file, std::string("throws while it is loaded: ") + problem.what());
  } catch (...) {
    refuse(file, "throws while it is loaded");
  }
}

/// Compares the handshakes; the interface version first, since all else may be laid out anew.
void compare(const fs::path& file, const sdk::Handshake& theirs) {
  const sdk::Handshake ours = sdk::make_handshake();
  if (theirs.interface_version != ours.interface_version) {
    const bool is_plugin_older = theirs.interface_version < ours.interface_version;
    refuse(file, "built against interface version " + std::to_string(theirs.interface_version) +
                     ", this engine has " + std::to_string(ours.interface_version) + ": the " +
                     (is_plugin_older ? "plugin is older, rebuild it with this engine's headers"
                                      : "engine is older, use the one the plugin was built for"));
  }
  if (theirs.compiler_major != ours.compiler_major) {
    refuse(file, "built with g++ " + std::to_string(theirs.compiler_major) +
                     ", this engine with g++ " + std::to_string(ours.compiler_major) +
                     ": build both with the same compiler");
  }
  if (theirs.standard_library_abi != ours.standard_library_abi) {
    refuse(file, "built with another ABI of the standard library (_GLIBCXX_USE_CXX11_ABI=" +
                     std::to_string(theirs.standard_library_abi) + ", this engine has " +
                     std::to_string(ours.standard_library_abi) + ")");
  }
  if (std::memcmp(theirs.size_of, ours.size_of, sizeof ours.size_of) != 0 ||
      std::memcmp(theirs.alignment_of, ours.alignment_of, sizeof ours.alignment_of) != 0) {
    refuse(file,
           "its structs have other sizes than this engine's: rebuild it with this engine's "
           "headers and flags");
  }
}

/// Collects what one library registers; nothing reaches the registry unless all is well.
class Collector final : public sdk::Registrar {
 public:
  Collector(const fs::path& file, bool is_shipped) : file_(file), is_shipped_(is_shipped) {}
  using sdk::Registrar::add;
  void add(sdk::ModelInfo info, sdk::ModelFactory factory) override {
    entries_.push_back({std::move(info), std::move(factory), file_, is_shipped_});
  }
  std::vector<Entry> take() { return std::move(entries_); }

 private:
  fs::path file_;
  bool is_shipped_;
  std::vector<Entry> entries_;
};

bool is_snake_case(const std::string& name) {
  return !name.empty() && name.front() >= 'a' && name.front() <= 'z' &&
         std::all_of(name.begin(), name.end(), [](char c) {
           return (c >= 'a' && c <= 'z') || (c >= '0' && c <= '9') || c == '_';
         });
}

/// Keys of a scenario that stand beside the parameters of a model of this kind.
std::set<std::string> taken_keys(const std::string& kind) {
  if (kind == "emitter") return {"model", "enabled", "frame", "material"};
  if (kind == "motion") {
    return {"model", "shape",    "motion", "motions", "enabled",
            "frame", "material", "group",  "remove",  "suction"};
  }
  return {"model", "enabled"};
}

}  // namespace

/// What a declaration says against itself.
void add_contradictions(const sdk::Parameter& p, const std::string& parameter,
                        std::vector<std::string>& problems) {
  for (const auto& [range, name] :
       {std::pair{&p.range, "range"}, std::pair{&p.usual, "usual range"}}) {
    if (std::isnan(range->low) || std::isnan(range->high) || range->low > range->high) {
      problems.push_back(parameter + ": its " + name + ", from " +
                         base::digits_text(range->low, 6) + " to " +
                         base::digits_text(range->high, 6) + ", holds no number");
    }
  }
  if (p.is_required) return;
  const auto refuse_number = [&](double value) {
    if (p.range.contains(value)) return;
    problems.push_back(parameter + ": its default, " + base::digits_text(value, 6) +
                       ", lies outside its own range");
  };
  if (const auto* number = std::get_if<double>(&p.default_value)) refuse_number(*number);
  if (const auto* whole = std::get_if<std::int64_t>(&p.default_value)) {
    refuse_number(static_cast<double>(*whole));
  }
  const auto* text = std::get_if<std::string>(&p.default_value);
  if (text != nullptr && !p.options.empty() &&
      std::find(p.options.begin(), p.options.end(), *text) == p.options.end()) {
    problems.push_back(parameter + ": its default, '" + *text + "', is none of its options");
  }
}

std::vector<std::string> description_problems(const sdk::ModelInfo& info) {
  std::vector<std::string> problems;
  const std::string model = info.kind + "/" + info.name;
  if (!is_snake_case(info.kind))
    problems.push_back("the kind '" + info.kind + "' is not snake_case");
  if (!is_snake_case(info.name))
    problems.push_back("the name '" + info.name + "' is not snake_case");
  if (info.summary.empty()) problems.push_back(model + " has no summary");
  const std::set<std::string> taken = taken_keys(info.kind);
  std::set<std::string> seen;
  for (const sdk::Parameter& p : info.parameters) {
    const std::string parameter = model + ": the parameter '" + p.name + "'";
    if (!is_snake_case(p.name)) problems.push_back(parameter + " is not snake_case");
    if (p.sentence.empty()) problems.push_back(parameter + " has no sentence that explains it");
    if (!seen.insert(p.name).second) problems.push_back(parameter + " is declared twice");
    add_contradictions(p, parameter, problems);
    if (taken.contains(p.name)) {
      problems.push_back(parameter + " could never be given: the scenario has a key '" + p.name +
                         "' of its own beside it; choose another name");
    }
  }
  return problems;
}

std::vector<Entry> load_library(const fs::path& file) {
  boost::dll::shared_library library = open(file);
  for (const char* symbol : {"dust_handshake", "dust_register"}) {
    if (library.has(symbol)) continue;
    refuse(file, std::string("not a plugin of this engine: it lacks '") + symbol +
                     "' (DUST_PLUGIN defines it)");
  }
  open_libraries().push_back(library);
  const bool is_shipped = library.has("dust_shipped");
  if (is_shipped) withdraw_noted_library();
  compare(file, library.get<const sdk::Handshake>("dust_handshake"));
  Collector collector(file, is_shipped);
  const std::string name = file.string();
  const Asking asking(name.c_str(), " registered its models");
  try {
    library.get<void(sdk::Registrar&)>("dust_register")(collector);
  } catch (const std::exception& problem) {
    refuse(file, std::string("throws while it registers its models: ") + problem.what());
  } catch (...) {
    refuse(file, "throws while it registers its models");
  }
  std::vector<Entry> entries = collector.take();
  if (entries.empty()) refuse(file, "registers no model");
  std::vector<std::string> lines;
  std::set<std::string> models;
  for (const Entry& entry : entries) {
    const std::string model = entry.info.kind + "/" + entry.info.name;
    if (!models.insert(model).second) {
      lines.push_back(file.string() + ": error: registers " + model +
                      " twice: remove or rename one");
    }
    for (const std::string& problem : description_problems(entry.info)) {
      lines.push_back(file.string() + ": error: " + problem);
    }
  }
  if (!lines.empty()) throw base::PluginError(lines);
  return entries;
}

}  // namespace dust::registry
