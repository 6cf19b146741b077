// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/input_files.hpp"

#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::io {

/// The settings of a resolved scenario, one by one in the order of the document: however they are
/// broken into lines. Files that the scenario reads are the same where the same stands in them,
/// whatever their names; where that is not known, their names count.
class ScenarioLeaves {
 public:
  /// Throws base::RunError where the text is no scenario.
  explicit ScenarioLeaves(const std::string& resolved_yaml,
                          const std::vector<InputFile>& inputs = {});

  /// "'time.end: 2' in the checkpoint, 'time.end: 3' now"; empty where both say the same but for
  /// `ignored` paths and what is below them.
  [[nodiscard]] std::string first_difference(const ScenarioLeaves& now,
                                             std::span<const std::string_view> ignored) const;
  /// The same of up to five settings, separated by ';', and how many more there are.
  [[nodiscard]] std::string differences(const ScenarioLeaves& now,
                                        std::span<const std::string_view> ignored) const;
  /// Whether both say the same below `path`, but for `ignored` paths.
  [[nodiscard]] bool is_same_below(const std::string& path, const ScenarioLeaves& other,
                                   std::span<const std::string_view> ignored = {}) const;
  /// What has become of a file since `then`.
  struct FileChange {
    std::string path;  ///< of its setting
    std::string then;  ///< its name
    std::string now;
    std::string content_then;  ///< SHA-256; empty: not known
    std::string content_now;
    [[nodiscard]] bool is_known() const { return !content_then.empty() && !content_now.empty(); }
    [[nodiscard]] bool is_other() const { return is_known() && content_then != content_now; }
    [[nodiscard]] bool is_moved() const { return is_known() && !is_other() && then != now; }
  };
  /// Of each setting that names a file here and there.
  [[nodiscard]] std::vector<FileChange> files_since(const ScenarioLeaves& then) const;
  /// SHA-256 of all settings, with the content of files in place of their names.
  [[nodiscard]] std::string sha256() const;
  /// What is set, without where.
  [[nodiscard]] std::vector<std::string> values() const;

 private:
  struct Leaf {
    std::string path;
    std::string value;
    std::string content;  ///< of the file that it names; empty: it names none
    [[nodiscard]] bool means_same(const Leaf& other) const {
      const bool are_files = !content.empty() && !other.content.empty();
      return path == other.path && (are_files ? content == other.content : value == other.value);
    }
  };
  template <class Takes>
  [[nodiscard]] std::vector<Leaf> chosen(const Takes& takes) const;

  std::vector<Leaf> leaves_;
};

}  // namespace dust::io
