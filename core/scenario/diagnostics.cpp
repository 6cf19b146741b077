// SPDX-License-Identifier: Apache-2.0
#include "scenario/diagnostics.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <string_view>
#include <tuple>

namespace dust::scenario {

void Diagnostics::add_file(const std::string& file) {
  if (std::find(files_.begin(), files_.end(), file) == files_.end()) files_.push_back(file);
}

void Diagnostics::error(const Mark& where, std::string text) {
  errors_.push_back({where, std::move(text)});
}

void Diagnostics::warning(const Mark& where, std::string text) {
  warnings_.push_back({where, std::move(text)});
}

bool Diagnostics::has_error_below(const std::string& path) const {
  return std::any_of(errors_.begin(), errors_.end(), [&](const Problem& problem) {
    const std::string& text = problem.text;
    return text.starts_with(path) && text.size() > path.size() &&
           std::string_view(".:[").find(text[path.size()]) != std::string_view::npos;
  });
}

std::size_t Diagnostics::rank(const std::string& file) const {
  return static_cast<std::size_t>(std::find(files_.begin(), files_.end(), file) - files_.begin());
}

std::vector<std::string> Diagnostics::lines(std::vector<Problem> items, const char* word) const {
  std::stable_sort(items.begin(), items.end(), [this](const Problem& a, const Problem& b) {
    return std::tuple(rank(a.where.file), a.where.line, a.where.column) <
           std::tuple(rank(b.where.file), b.where.line, b.where.column);
  });
  std::vector<std::string> result;
  for (const Problem& item : items) {
    std::string line = place(item.where) + ": " + word + ": " + item.text;
    // Names of the user's own may hold anything; a problem is one line.
    std::replace_if(
        line.begin(), line.end(),
        [](char c) { return static_cast<unsigned char>(c) < 0x20 || c == 0x7f; }, ' ');
    // An alias or an include read twice tells the same problem twice.
    if (std::find(result.begin(), result.end(), line) == result.end()) {
      result.push_back(std::move(line));
    }
  }
  return result;
}

void Diagnostics::throw_errors() const {
  if (has_errors()) throw base::UserError(error_lines(), warning_lines());
}

}  // namespace dust::scenario
