// SPDX-License-Identifier: Apache-2.0
#include "registry/checked_sinks.hpp"

#include <algorithm>

namespace dust::registry {
namespace {

/// Columns of a table, "name [unit]", and keys of JSON are made of it.
bool is_fit_for_files(std::string_view text) {
  constexpr std::string_view k_marks = ",;\"'[]\\";
  return std::none_of(text.begin(), text.end(), [&](char c) {
    const auto code = static_cast<unsigned char>(c);
    return code <= ' ' || code == 0x7f || k_marks.find(c) != std::string_view::npos;
  });
}

/// The text on one line.
std::string quoted(std::string_view text) {
  std::string out = "'";
  for (const char c : text) out += static_cast<unsigned char>(c) < ' ' ? '?' : c;
  return out + "'";
}

}  // namespace

void SinkFaults::check_name(const char* what, std::string_view name, bool has_words) {
  const std::string given = std::string("gives a ") + what + " " + quoted(name);
  const bool has_empty_word = name.empty() || name.front() == '/' || name.back() == '/' ||
                              name.find("//") != std::string_view::npos;
  check(!has_empty_word && is_fit_for_files(name) &&
            (has_words || name.find('/') == std::string_view::npos),
        given + (has_words ? "; expected: a name of snake_case words with '/' between them"
                           : "; expected: a name of one snake_case word"));
  const bool is_new = names_.emplace(name).second;
  check(is_new, given + " twice; expected: every name once");
}

void SinkFaults::check_unit(const char* what, std::string_view name, std::string_view unit) {
  const bool is_fit = std::all_of(unit.begin(), unit.end(), [](char c) {
    return c == ' ' || is_fit_for_files({&c, 1});  // "kg m2"
  });
  check(!unit.empty() && is_fit, std::string("gives the ") + what + " " + quoted(name) +
                                     " the unit " + quoted(unit) +
                                     "; expected: a unit, for a bare number \"1\"");
}

void CheckedFigures::figure(std::string_view name, double value, std::string_view unit,
                            double uncertainty, const sdk::FigureRole& role) {
  check_name("figure", name, true);
  check_unit("figure", name, unit);
  if (is_well()) sink_.figure(name, value, unit, uncertainty, role);
}

void CheckedFields::field(std::string_view name, std::string_view unit, const sdk::GridShape& grid,
                          std::span<const double> values, const sdk::FigureRole& role) {
  check_name("field", name, false);
  check_unit("field", name, unit);
  const auto cells = static_cast<std::size_t>(grid.count[0]) *
                     static_cast<std::size_t>(grid.count[1]) *
                     static_cast<std::size_t>(grid.count[2]);
  check(values.size() == cells,
        "gives " + std::to_string(values.size()) + " numbers for its field " + quoted(name) +
            "; expected: one for each of its " + std::to_string(cells) + " cells");
  if (is_well()) sink_.field(name, unit, grid, values, role);
}

void CheckedReport::section(std::string_view heading, std::string_view text) {
  if (is_well()) sink_.section(heading, text);
}

void CheckedReport::curve(std::string_view title, std::string_view x_label,
                          std::string_view y_label, std::string_view series,
                          std::span<const double> x, std::span<const double> y) {
  check(x.size() == y.size(), "gives the curve " + quoted(title) + " " + std::to_string(x.size()) +
                                  " numbers for x and " + std::to_string(y.size()) +
                                  " for y; expected: as many");
  if (is_well()) sink_.curve(title, x_label, y_label, series, x, y);
}

void CheckedReport::row(std::string_view title, std::span<const std::string> columns,
                        std::span<const double> values) {
  check(columns.size() == values.size(),
        "gives the table " + quoted(title) + " a row of " + std::to_string(values.size()) +
            " numbers for its " + std::to_string(columns.size()) + " columns; expected: as many");
  if (is_well()) sink_.row(title, columns, values);
}

}  // namespace dust::registry
