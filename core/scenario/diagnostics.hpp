// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/dimension.hpp"
#include "setup/mark.hpp"

#include <map>
#include <set>
#include <string>
#include <vector>

namespace dust::scenario {

/// Collects every problem of a scenario, so that all are told at once in the order of the files.
class Diagnostics {
 public:
  struct Problem {
    Mark where;
    std::string text;
  };
  /// Files in the order in which their problems are told.
  void add_file(const std::string& file);
  /// A file that is part of the scenario or study: its own, one that it includes, one laid over it.
  void note_document(const std::string& file) { documents_.push_back(file); }
  [[nodiscard]] const std::vector<std::string>& documents() const { return documents_; }
  /// A file that an engine wrote, whose bare numbers are meant in SI.
  void note_resolved_file(const std::string& file) { resolved_files_.insert(file); }
  [[nodiscard]] bool is_resolved_file(const std::string& file) const {
    return resolved_files_.contains(file);
  }
  /// The same of files that another one has read.
  void note_resolved_files_of(const Diagnostics& other) {
    resolved_files_.insert(other.resolved_files_.begin(), other.resolved_files_.end());
  }
  void error(const Mark& where, std::string text);
  void warning(const Mark& where, std::string text);

  [[nodiscard]] bool has_errors() const { return !errors_.empty(); }
  /// Whether one tells of the key at `path` or of one below it.
  [[nodiscard]] bool has_error_below(const std::string& path) const;
  [[nodiscard]] std::size_t error_count() const { return errors_.size(); }
  /// In the order in which they were found.
  [[nodiscard]] const std::vector<Problem>& errors() const { return errors_; }
  [[nodiscard]] const std::vector<Problem>& warnings() const { return warnings_; }
  [[nodiscard]] std::vector<std::string> error_lines() const { return lines(errors_, "error"); }
  [[nodiscard]] std::vector<std::string> warning_lines() const {
    return lines(warnings_, "warning");
  }
  /// Throws a UserError with all errors, if there are any.
  void throw_errors() const;

  /// Notes what a key measures when it is read; studies name the units of what they vary.
  void note_dimension(const std::string& path, sdk::Dimension dimension) {
    dimensions_[path] = dimension;
  }
  /// By dotted path, of the keys that were given.
  [[nodiscard]] const std::map<std::string, sdk::Dimension>& dimensions() const {
    return dimensions_;
  }

 private:
  [[nodiscard]] std::vector<std::string> lines(std::vector<Problem> items, const char* word) const;
  [[nodiscard]] std::size_t rank(const std::string& file) const;

  std::vector<std::string> files_;
  std::vector<std::string> documents_;
  std::set<std::string> resolved_files_;
  std::vector<Problem> errors_;
  std::vector<Problem> warnings_;
  std::map<std::string, sdk::Dimension> dimensions_;
};

}  // namespace dust::scenario
