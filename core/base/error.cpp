// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"

namespace dust::base {
namespace {

std::string join(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += (text.empty() ? "" : "\n") + line;
  return text;
}

}  // namespace

UserError::UserError(std::vector<std::string> lines) : UserError(std::move(lines), {}) {}

UserError::UserError(std::vector<std::string> lines, std::vector<std::string> warnings)
    : std::runtime_error(join(lines)), lines_(std::move(lines)), warnings_(std::move(warnings)) {}

}  // namespace dust::base
