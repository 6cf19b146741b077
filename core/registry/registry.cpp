// SPDX-License-Identifier: Apache-2.0
#include "registry/registry.hpp"

#include "base/error.hpp"
#include "registry/crash_notice.hpp"
#include "registry/guard.hpp"
#include "registry/guard_report.hpp"
#include "registry/library.hpp"
#include "setup/mark.hpp"

#include <boost/dll/runtime_symbol_info.hpp>

#include <algorithm>
#include <cstdlib>
#include <map>
#include <set>
#include <tuple>

namespace dust::registry {
namespace {

namespace fs = std::filesystem;

bool is_before(const Entry& a, const Entry& b) {
  return std::tie(a.info.kind, a.info.name) < std::tie(b.info.kind, b.info.name);
}

std::string file_text(const fs::path& file) {
  return file.empty() ? "the program itself" : file.string();
}

/// Shared libraries of a folder, in the order of their names.
std::vector<fs::path> libraries_in(const fs::path& folder) {
  std::error_code code;
  std::vector<fs::path> files;
  fs::directory_iterator entries(folder, code);
  if (code) {
    std::error_code none;
    const std::string remedy = fs::is_regular_file(folder, none)
                                   ? ": name the folder that holds the library, not the file"
                                   : "";
    throw base::PluginError(folder.string() +
                            ": error: cannot look for plugins here: " + code.message() + remedy);
  }
  for (const auto& entry : entries) {
    if (entry.path().extension() == ".so") files.push_back(entry.path());
  }
  std::sort(files.begin(), files.end());
  return files;
}

/// `lib/dust/plugins` relative to the program; empty if nobody knows where that is.
fs::path own_folder() {
  std::error_code code;
  const fs::path program = boost::dll::program_location(code);
  if (code) return {};
  return (program.parent_path().parent_path() / "lib" / "dust" / "plugins").lexically_normal();
}

/// Many libraries of a folder that are refused for the same reason (an engine beside a newer folder
/// of plugins) make one line.
std::vector<std::string> gathered(const std::vector<std::string>& problems) {
  constexpr std::size_t k_few = 4;
  const std::string mark = ": error: ";
  const auto fault_of = [&](const std::string& line) {
    const std::size_t at = std::min(line.find(mark), line.size());
    return std::pair(fs::path(line.substr(0, at)).parent_path().string(), line.substr(at));
  };
  std::map<std::pair<std::string, std::string>, std::size_t> number;
  for (const std::string& line : problems) ++number[fault_of(line)];
  std::vector<std::string> lines;
  for (const std::string& line : problems) {
    const auto fault = fault_of(line);
    std::size_t& times = number[fault];
    if (times < k_few) {
      if (times > 0) lines.push_back(line);
      continue;
    }
    const std::string first = fs::path(line.substr(0, line.find(mark))).filename().string();
    lines.push_back(fault.first + mark + std::to_string(times) + " libraries, " + first +
                    " the first" + ": " + fault.second.substr(mark.size()));
    times = 0;  // said
  }
  return lines;
}

/// Where the scenario chooses the model.
std::string prefix_of(const scenario::ModelChoice& choice) {
  return error_prefix(choice.where, choice.path.empty() ? choice.kind : choice.path);
}

}  // namespace

struct Registry::Impl {
  std::vector<Entry> entries;
  std::set<fs::path> files;
  std::vector<fs::path> folders;
};

Registry::Registry() : impl_(std::make_unique<Impl>()) {}
Registry::~Registry() = default;

void Registry::load(const std::vector<fs::path>& folders) {
  std::vector<std::string> problems;
  for (const fs::path& folder : folders) {
    impl_->folders.push_back(folder);
    std::vector<fs::path> files;
    try {
      files = libraries_in(folder);
    } catch (const base::PluginError& problem) {
      problems.insert(problems.end(), problem.lines().begin(), problem.lines().end());
    }
    for (const fs::path& file : files) {
      // One library reached in two ways is one library.
      std::error_code code;
      const fs::path same = fs::weakly_canonical(file, code);
      if (!impl_->files.insert(code ? file : same).second) continue;
      try {
        for (Entry& entry : load_library(file)) add(std::move(entry));
      } catch (const base::PluginError& problem) {
        problems.insert(problems.end(), problem.lines().begin(), problem.lines().end());
      }
    }
  }
  if (!problems.empty()) throw base::PluginError(gathered(problems));
}

std::vector<fs::path> Registry::search_path(const std::vector<fs::path>& from_command_line) {
  std::vector<fs::path> folders = from_command_line;
  if (const char* variable = std::getenv("DUST_PLUGIN_PATH")) {
    const std::string text = variable;
    for (std::size_t begin = 0; begin <= text.size();) {
      const std::size_t end = std::min(text.find(':', begin), text.size());
      if (end > begin) folders.emplace_back(text.substr(begin, end - begin));
      begin = end + 1;
    }
  }
  const fs::path own = own_folder();
  std::error_code code;
  if (!own.empty() && fs::is_directory(own, code)) folders.push_back(own);
  return folders;
}

void Registry::add(Entry entry) {
  const auto at = std::lower_bound(impl_->entries.begin(), impl_->entries.end(), entry, is_before);
  if (at != impl_->entries.end() && !is_before(entry, *at)) {
    throw base::PluginError(taken_name_line(entry, *at));
  }
  impl_->entries.insert(at, std::move(entry));
}

const Entry* Registry::find(std::string_view kind, std::string_view name) const {
  for (const Entry& entry : impl_->entries) {
    if (entry.info.kind == kind && entry.info.name == name) return &entry;
  }
  return nullptr;
}

const std::vector<Entry>& Registry::entries() const { return impl_->entries; }

const std::vector<fs::path>& Registry::folders() const { return impl_->folders; }

std::vector<std::string> Registry::names(std::string_view kind) const {
  std::vector<std::string> result;
  for (const Entry& entry : impl_->entries) {
    if (entry.info.kind == kind) result.push_back(entry.info.name);
  }
  return result;
}

std::unique_ptr<sdk::Model> Registry::create(const scenario::ModelChoice& choice) const {
  const Entry* entry = find(choice.kind, choice.name);
  const std::string prefix = prefix_of(choice);
  if (entry == nullptr) {
    throw base::UserError(prefix + "unknown " + choice.kind + " model '" + choice.name + "'");
  }
  try {
    return make_model(*entry, choice.values, prefix);
  } catch (const std::exception& problem) {
    throw base::UserError(prefix + problem.what());
  } catch (...) {
    throw base::UserError(prefix + file_text(entry->file) + " throws something that is no " +
                          "std::exception while it makes " + choice.kind + "/" + choice.name);
  }
}

std::unique_ptr<sdk::Model> make_model(const Entry& entry, std::span<const sdk::Value> values,
                                       const std::string& place) {
  const std::string who = identity_of(entry);
  const Asking asking(who.c_str(), " was made");
  auto model = entry.factory(values);
  const bool is_tested = entry.file.empty() || entry.is_shipped;
  return is_tested ? std::move(model) : guarded(std::move(model), entry, place);
}

std::string error_prefix(const scenario::Mark& where, const std::string& path) {
  const std::string place = scenario::place(where);
  return (place.empty() ? "" : place + ": ") + "error: " + path + ": ";
}

std::string taken_name_line(const Entry& entry, const Entry& other) {
  // The engine's own is not the one to change.
  const bool is_other_wrong = entry.is_shipped && !other.is_shipped;
  const Entry& wrong = is_other_wrong ? other : entry;
  const Entry& kept = is_other_wrong ? entry : other;
  const std::string offers =
      file_text(wrong.file) + ": error: offers " + entry.info.kind + "/" + entry.info.name;
  if (kept.is_shipped && !wrong.is_shipped) {
    return offers + ", which the engine has already (" + file_text(kept.file) +
           "): choose another name for the model";
  }
  return offers + ", which " + file_text(kept.file) +
         " offers already: take one of the two libraries out of the folders where plugins are "
         "looked for, or choose another name for one of the models";
}

void ask_at_place(const scenario::ModelChoice& choice, const std::function<void()>& question) {
  try {
    question();
  } catch (const std::exception& problem) {
    throw base::UserError(prefix_of(choice) + problem.what());
  }
}

}  // namespace dust::registry
