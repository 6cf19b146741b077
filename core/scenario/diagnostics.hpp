// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/setup.hpp"

#include <string>
#include <vector>

namespace dust::scenario {

/// Collects every problem of a scenario, so that all are told at once in the order of the files.
class Diagnostics {
 public:
  /// Files in the order in which their problems are told.
  void add_file(const std::string& file);
  void error(const Mark& where, std::string text);
  void warning(const Mark& where, std::string text);

  [[nodiscard]] bool has_errors() const { return !errors_.empty(); }
  [[nodiscard]] std::size_t error_count() const { return errors_.size(); }
  [[nodiscard]] std::vector<std::string> error_lines() const { return lines(errors_, "error"); }
  [[nodiscard]] std::vector<std::string> warning_lines() const {
    return lines(warnings_, "warning");
  }
  /// Throws a UserError with all errors, if there are any.
  void throw_errors() const;

 private:
  struct Item {
    Mark where;
    std::string text;
  };
  [[nodiscard]] std::vector<std::string> lines(std::vector<Item> items, const char* word) const;
  [[nodiscard]] std::size_t rank(const std::string& file) const;

  std::vector<std::string> files_;
  std::vector<Item> errors_;
  std::vector<Item> warnings_;
};

/// "file:line:column", or "file" alone for places without lines (the command line).
std::string place(const Mark& where);

}  // namespace dust::scenario
