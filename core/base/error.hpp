// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <stdexcept>
#include <string>
#include <vector>

namespace dust::base {

/// Wrong input, found before anything was written: exit status 2. Each line is one complete
/// diagnostic, "file:line:column: error: ..." or "error: ...".
class UserError : public std::runtime_error {
 public:
  explicit UserError(std::vector<std::string> lines);
  explicit UserError(std::string line) : UserError(std::vector<std::string>{std::move(line)}) {}
  /// With warnings that were found on the way: what one tells may be why the other is there.
  UserError(std::vector<std::string> lines, std::vector<std::string> warnings);
  [[nodiscard]] const std::vector<std::string>& lines() const { return lines_; }
  [[nodiscard]] const std::vector<std::string>& warnings() const { return warnings_; }

 private:
  std::vector<std::string> lines_;
  std::vector<std::string> warnings_;
};

/// A plugin library that cannot be used; exit status 2.
class PluginError : public UserError {
 public:
  using UserError::UserError;
};

/// A run that cannot go on; exit status 1.
class RunError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

}  // namespace dust::base
