// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"
#include "io/input_files.hpp"

#include <filesystem>
#include <functional>
#include <memory>
#include <string>
#include <utility>
#include <vector>

namespace dust::io {

/// A checkpoint on disk, for whoever starts from it. It stays open: a run that goes on and replaces
/// its checkpoint does not change what is read here.
class StoredState {
 public:
  using Parts = std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>;

  /// Throws base::UserError where it is damaged or of another version; `remedy` ends the message.
  StoredState(std::filesystem::path file, std::string remedy);
  ~StoredState();
  StoredState(const StoredState&) = delete;
  StoredState& operator=(const StoredState&) = delete;

  [[nodiscard]] const std::filesystem::path& file() const { return file_; }
  /// The scenario of the run that wrote it.
  [[nodiscard]] const std::string& resolved_yaml() const { return scenario_.resolved_yaml; }
  /// What stood in the files that it read; nothing in checkpoints from before that was kept.
  [[nodiscard]] const std::vector<InputFile>& inputs() const { return scenario_.inputs; }
  /// Whether the part was written with this column.
  [[nodiscard]] bool has(const std::string& part, const std::string& column) const;
  /// Gives each part to whoever wants it, in this order. Throws base::UserError.
  void read(const Parts& parts) const;

 private:
  [[noreturn]] void refuse(const std::string& problem) const;

  struct Open;
  std::unique_ptr<Open> open_;
  std::filesystem::path file_;
  std::string remedy_;
  ScenarioIdentity scenario_;
};

/// Keeps the checkpoint `file` under another name, too; replaces what has that name. Throws
/// base::WriteError.
void keep_checkpoint(const std::filesystem::path& file, const std::filesystem::path& as);

}  // namespace dust::io
