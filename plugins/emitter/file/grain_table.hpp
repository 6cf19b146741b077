// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

namespace dust::model::file {

/// Grains as a file lists them, SI. Optional columns are empty where the file has none.
struct GrainTable {
  std::vector<double> diameter;
  std::array<std::vector<double>, 3> centre;
  std::array<std::vector<double>, 3> velocity;
  std::array<std::vector<double>, 3> rotation;
  std::vector<std::string> material;
  std::vector<std::int64_t> line;  ///< in the file, counted from 1; 0 where there are none
};

/// A file that cannot be understood; the message names every place, up to a handful.
class TableError : public std::runtime_error {
 public:
  using std::runtime_error::runtime_error;
};

namespace detail {

inline std::string_view trimmed(std::string_view text) {
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.front())))
    text.remove_prefix(1);
  while (!text.empty() && std::isspace(static_cast<unsigned char>(text.back())))
    text.remove_suffix(1);
  return text;
}

inline std::vector<std::string_view> cells_of(std::string_view line) {
  std::vector<std::string_view> cells;
  for (;;) {
    const std::size_t comma = line.find(',');
    cells.push_back(trimmed(line.substr(0, comma)));
    if (comma == std::string_view::npos) return cells;
    line.remove_prefix(comma + 1);
  }
}

struct ColumnName {
  const char* name;
  const char* unit;
};
inline constexpr std::array<ColumnName, 11> k_columns = {{{"diameter", "m"},
                                                          {"x", "m"},
                                                          {"y", "m"},
                                                          {"z", "m"},
                                                          {"velocity_x", "m/s"},
                                                          {"velocity_y", "m/s"},
                                                          {"velocity_z", "m/s"},
                                                          {"rotation_x", "rad/s"},
                                                          {"rotation_y", "rad/s"},
                                                          {"rotation_z", "rad/s"},
                                                          {"material", ""}}};
inline constexpr std::size_t k_numbers = 10;
inline constexpr std::size_t k_material = 10;

inline std::string known_columns() {
  std::string text;
  for (const ColumnName& c : k_columns) text += (text.empty() ? "" : ", ") + std::string(c.name);
  return text;
}

/// The column a head cell names, with or without its SI unit: `x`, `x [m]`.
inline std::size_t column_of(std::string_view cell, const std::string& place) {
  std::string_view name = cell;
  std::string_view unit;
  const std::size_t bracket = cell.find('[');
  if (bracket != std::string_view::npos) {
    name = trimmed(cell.substr(0, bracket));
    unit = trimmed(cell.substr(bracket + 1));
    if (!unit.empty() && unit.back() == ']') unit.remove_suffix(1);
  }
  for (std::size_t n = 0; n < k_columns.size(); ++n) {
    if (name != k_columns[n].name) continue;
    if (!unit.empty() && unit != k_columns[n].unit) {
      throw TableError(place + "the column '" + std::string(name) + "' is in " + std::string(unit) +
                       "; " + k_columns[n].unit + " is expected");
    }
    return n;
  }
  throw TableError(place + "unknown column '" + std::string(cell) +
                   "'; the columns are: " + known_columns());
}

/// Gathers what is wrong, so that the first few places are told at once.
class Complaints {
 public:
  void add(const std::string& text) {
    if (++count_ <= k_reported) text_ += (text_.empty() ? "" : "; ") + text;
  }
  void throw_if_any() const {
    if (count_ == 0) return;
    const std::size_t more = count_ > k_reported ? count_ - k_reported : 0;
    throw TableError(text_ + (more > 0 ? "; and " + std::to_string(more) + " more" : ""));
  }

 private:
  static constexpr std::size_t k_reported = 5;
  std::size_t count_ = 0;
  std::string text_;
};

}  // namespace detail

/// Reads grains from comma-separated values: a head line with the names of the columns, then one
/// grain a line. `diameter`, `x`, `y`, `z` must be there; velocities, rotations and `material` may.
/// Empty lines and lines that begin with '#' are skipped. `name` stands in messages:
/// "bed.csv:17: ...". Throws TableError.
inline GrainTable read_csv(std::istream& in, const std::string& name) {
  GrainTable table;
  std::vector<std::size_t> columns;
  std::array<std::ptrdiff_t, detail::k_columns.size()> place_of{};
  place_of.fill(-1);
  detail::Complaints complaints;
  std::string line;
  std::int64_t number = 0;
  while (std::getline(in, line)) {
    ++number;
    const std::string_view text = detail::trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::string place = name + ":" + std::to_string(number) + ": ";
    const auto cells = detail::cells_of(text);
    if (columns.empty()) {
      for (const auto cell : cells) {
        const std::size_t column = detail::column_of(cell, place);
        if (place_of[column] >= 0) {
          throw TableError(place + "the column '" + std::string(cell) + "' is there twice");
        }
        place_of[column] = static_cast<std::ptrdiff_t>(columns.size());
        columns.push_back(column);
      }
      for (std::size_t c = 0; c < 4; ++c) {
        if (place_of[c] < 0) {
          throw TableError(place + "the column '" + detail::k_columns[c].name +
                           "' is missing; diameter, x, y and z must be there");
        }
      }
      for (const std::size_t group : {std::size_t{4}, std::size_t{7}}) {
        const int given =
            (place_of[group] >= 0) + (place_of[group + 1] >= 0) + (place_of[group + 2] >= 0);
        if (given == 1 || given == 2) {
          throw TableError(place + "give all of " + detail::k_columns[group].name + ", " +
                           detail::k_columns[group + 1].name + " and " +
                           detail::k_columns[group + 2].name + ", or none");
        }
      }
      continue;
    }
    if (cells.size() != columns.size()) {
      complaints.add(place + std::to_string(cells.size()) + " values for " +
                     std::to_string(columns.size()) + " columns");
      continue;
    }
    std::array<double, detail::k_numbers> values{};
    bool is_good = true;
    for (std::size_t n = 0; n < cells.size(); ++n) {
      if (columns[n] == detail::k_material) continue;
      double& v = values[columns[n]];
      const char* end = cells[n].data() + cells[n].size();
      const auto read = std::from_chars(cells[n].data(), end, v);
      const bool is_number = read.ec == std::errc{} && read.ptr == end && std::isfinite(v);
      if (!is_number) {
        complaints.add(place + detail::k_columns[columns[n]].name +
                       ": a number is expected, not '" + std::string(cells[n]) + "'");
        is_good = false;
      }
    }
    if (is_good && !(values[0] > 0.0)) {
      complaints.add(place + "diameter: " +
                     std::string(cells[static_cast<std::size_t>(place_of[0])]) + " is not above 0");
      is_good = false;
    }
    if (!is_good) continue;
    table.line.push_back(number);
    table.diameter.push_back(values[0]);
    for (std::size_t d = 0; d < 3; ++d) {
      table.centre[d].push_back(values[1 + d]);
      if (place_of[4] >= 0) table.velocity[d].push_back(values[4 + d]);
      if (place_of[7] >= 0) table.rotation[d].push_back(values[7 + d]);
    }
    if (place_of[detail::k_material] >= 0) {
      table.material.emplace_back(cells[static_cast<std::size_t>(place_of[detail::k_material])]);
    }
  }
  complaints.throw_if_any();
  if (columns.empty())
    throw TableError(name + " is empty: a head line with the columns is expected");
  if (table.diameter.empty()) throw TableError(name + " lists no grains");
  return table;
}

}  // namespace dust::model::file
