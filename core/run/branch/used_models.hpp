// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/stored_state.hpp"
#include "registry/registry.hpp"
#include "scenario/reader.hpp"

#include <cstdint>
#include <filesystem>
#include <string>
#include <string_view>
#include <vector>

namespace dust::run {

/// A model that a run uses, with what has to be the same for its state to mean the same.
struct UsedModel {
  std::string kind;
  std::string name;
  std::string version;
  std::int64_t history_size = 0;  ///< numbers that a law keeps per contact
  std::filesystem::path file;     ///< of the plugin; not kept
  std::string sha256;             ///< of the file; empty where it came with the engine
};

/// The models of a scenario, each once.
std::vector<UsedModel> used_models(const scenario::ReadResult& read,
                                   const registry::Registry& registry);

/// Notes them in a checkpoint; its part is `k_models_part`.
inline constexpr const char* k_models_part = "models";
void save_models(const std::vector<UsedModel>& models, sdk::ArchiveWriter& archive);

/// A model that has become another one since a state was kept.
struct ChangedModel {
  UsedModel then;
  UsedModel now;
  [[nodiscard]] bool keeps_other_numbers() const { return then.history_size != now.history_size; }
  /// "contact/NAME was of version 1.0, with 4 numbers per contact, and is of version 2.0, ... now".
  [[nodiscard]] std::string text() const;
  /// The same of one whose library is another one, though its version is the same.
  [[nodiscard]] std::string rebuilt_text() const;
};

/// Those of `now` that a state was kept by with another version, or other numbers per contact.
/// States from before checkpoints noted them tell of none.
std::vector<ChangedModel> changed_models(const io::StoredState& state,
                                         const std::vector<UsedModel>& now);

/// Those of `now` whose version is the same, but whose library is not the one of then. What comes
/// with the engine is the engine's.
std::vector<ChangedModel> rebuilt_models(const io::StoredState& state,
                                         const std::vector<UsedModel>& now);

/// Throws base::UserError where a run that is resumed from `checkpoint` would go on with other
/// models; nothing where there is no such file.
void refuse_changed_models(const std::filesystem::path& checkpoint,
                           const std::vector<UsedModel>& now);

}  // namespace dust::run
