// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/model.hpp"
#include "dust/sdk/plugin.hpp"
#include "setup/setup.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::registry {

/// A model that a plugin library offers.
struct Entry {
  sdk::ModelInfo info;
  sdk::ModelFactory factory;
  std::filesystem::path file;  ///< empty: registered from code (tests)
  bool is_shipped = false;     ///< of a library that came with the engine
};

/// All models found. Libraries stay loaded until the process ends.
class Registry {
 public:
  Registry();
  ~Registry();
  Registry(const Registry&) = delete;
  Registry& operator=(const Registry&) = delete;

  /// Loads every library of every folder, in this order; throws base::PluginError naming the file.
  void load(const std::vector<std::filesystem::path>& folders);
  /// `--plugin-path`, `$DUST_PLUGIN_PATH`, then `lib/dust/plugins` relative to the program.
  static std::vector<std::filesystem::path> search_path(
      const std::vector<std::filesystem::path>& from_command_line);

  void add(Entry entry);
  [[nodiscard]] const Entry* find(std::string_view kind, std::string_view name) const;
  /// Sorted by kind and name.
  [[nodiscard]] const std::vector<Entry>& entries() const;
  [[nodiscard]] std::vector<std::string> names(std::string_view kind) const;
  /// The folders looked into so far.
  [[nodiscard]] const std::vector<std::filesystem::path>& folders() const;

  /// Makes the chosen model; a ParameterError becomes a base::UserError at the model's place.
  /// Models of libraries that are not shipped are guarded.
  [[nodiscard]] std::unique_ptr<sdk::Model> create(const scenario::ModelChoice& choice) const;
  template <class Kind>
  [[nodiscard]] std::unique_ptr<Kind> create_as(const scenario::ModelChoice& choice) const {
    return std::unique_ptr<Kind>(static_cast<Kind*>(create(choice).release()));
  }

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Makes a model; one of a library that is not shipped is guarded. `place` begins its faults that
/// are reported before the run (error_prefix).
std::unique_ptr<sdk::Model> make_model(const Entry& entry, std::span<const sdk::Value> values,
                                       const std::string& place);

/// "file:line:column: error: path: ", as far as they are known.
std::string error_prefix(const scenario::Mark& where, const std::string& path);

/// The line for a model whose name another one has; asks to change what is the user's to change.
std::string taken_name_line(const Entry& entry, const Entry& other);

/// Asks something of the chosen model before the run; what it throws becomes a base::UserError at
/// the model's place, as in Registry::create.
void ask_at_place(const scenario::ModelChoice& choice, const std::function<void()>& question);

}  // namespace dust::registry
