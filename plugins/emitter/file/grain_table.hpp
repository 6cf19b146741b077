// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <cctype>
#include <charconv>
#include <cmath>
#include <cstddef>
#include <cstdint>
#include <istream>
#include <optional>
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
  std::vector<double> weight;  ///< real grains for each
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
inline constexpr std::array<ColumnName, 12> k_columns = {{{"diameter", "m"},
                                                          {"x", "m"},
                                                          {"y", "m"},
                                                          {"z", "m"},
                                                          {"velocity_x", "m/s"},
                                                          {"velocity_y", "m/s"},
                                                          {"velocity_z", "m/s"},
                                                          {"rotation_x", "rad/s"},
                                                          {"rotation_y", "rad/s"},
                                                          {"rotation_z", "rad/s"},
                                                          {"weight", "1"},
                                                          {"material", ""}}};
inline constexpr std::size_t k_velocity = 4, k_rotation = 7;  ///< their first components
inline constexpr std::size_t k_weight = 10;
inline constexpr std::size_t k_numbers = 11;
inline constexpr std::size_t k_material = 11;

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

/// The columns of a file, in its order and by their number in k_columns.
class Columns {
 public:
  /// Of the cells of the head line, which stands at `place` for messages.
  Columns(const std::vector<std::string_view>& cells, const std::string& place) {
    place_of_.fill(-1);
    for (const auto cell : cells) {
      const std::size_t column = column_of(cell, place);
      if (has(column)) {
        throw TableError(place + "the column '" + std::string(cell) + "' is there twice");
      }
      place_of_[column] = static_cast<std::ptrdiff_t>(order_.size());
      order_.push_back(column);
    }
    for (std::size_t c = 0; c < 4; ++c) {
      if (!has(c)) {
        throw TableError(place + "the column '" + k_columns[c].name +
                         "' is missing; diameter, x, y and z must be there");
      }
    }
    for (const std::size_t group : {k_velocity, k_rotation}) {
      const int given = has(group) + has(group + 1) + has(group + 2);
      if (given == 1 || given == 2) {
        throw TableError(place + "give all of " + k_columns[group].name + ", " +
                         k_columns[group + 1].name + " and " + k_columns[group + 2].name +
                         ", or none");
      }
    }
  }
  [[nodiscard]] bool has(std::size_t column) const { return place_of_[column] >= 0; }
  [[nodiscard]] std::size_t size() const { return order_.size(); }
  /// Number of the n-th column of the file.
  [[nodiscard]] std::size_t operator[](std::size_t n) const { return order_[n]; }
  /// What a line has in a column that the file has.
  [[nodiscard]] std::string_view cell(const std::vector<std::string_view>& cells,
                                      std::size_t column) const {
    return cells[static_cast<std::size_t>(place_of_[column])];
  }

 private:
  std::vector<std::size_t> order_;
  std::array<std::ptrdiff_t, k_columns.size()> place_of_{};
};

/// The numbers of a line by column; nothing where something is wrong with them, which is added to
/// `complaints`.
inline std::optional<std::array<double, k_numbers>> numbers_of(
    const Columns& columns, const std::vector<std::string_view>& cells, const std::string& place,
    Complaints& complaints) {
  if (cells.size() != columns.size()) {
    complaints.add(place + std::to_string(cells.size()) + " values for " +
                   std::to_string(columns.size()) + " columns");
    return std::nullopt;
  }
  std::array<double, k_numbers> values{};
  bool is_good = true;
  for (std::size_t n = 0; n < cells.size(); ++n) {
    if (columns[n] == k_material) continue;
    double& v = values[columns[n]];
    const char* end = cells[n].data() + cells[n].size();
    const auto read = std::from_chars(cells[n].data(), end, v);
    const bool is_number = read.ec == std::errc{} && read.ptr == end && std::isfinite(v);
    if (!is_number) {
      complaints.add(place + k_columns[columns[n]].name + ": a number is expected, not '" +
                     std::string(cells[n]) + "'");
      is_good = false;
    }
  }
  for (const std::size_t column : {std::size_t{0}, k_weight}) {
    if (!is_good || !columns.has(column) || values[column] > 0.0) continue;
    complaints.add(place + k_columns[column].name + ": " +
                   std::string(columns.cell(cells, column)) + " is not above 0");
    is_good = false;
  }
  if (!is_good) return std::nullopt;
  return values;
}

}  // namespace detail

/// Reads grains from comma-separated values: a head line with the names of the columns, then one
/// grain a line. `diameter`, `x`, `y`, `z` must be there; velocities, rotations, `weight` and
/// `material` may.
/// Empty lines and lines that begin with '#' are skipped. `name` stands in messages:
/// "bed.csv:17: ...". Throws TableError.
inline GrainTable read_csv(std::istream& in, const std::string& name) {
  GrainTable table;
  std::optional<detail::Columns> columns;
  detail::Complaints complaints;
  std::string line;
  std::int64_t number = 0;
  while (std::getline(in, line)) {
    ++number;
    const std::string_view text = detail::trimmed(line);
    if (text.empty() || text.front() == '#') continue;
    const std::string place = name + ":" + std::to_string(number) + ": ";
    const auto cells = detail::cells_of(text);
    if (!columns) {
      columns.emplace(cells, place);
      continue;
    }
    const auto values = detail::numbers_of(*columns, cells, place, complaints);
    if (!values) continue;
    table.line.push_back(number);
    table.diameter.push_back((*values)[0]);
    for (std::size_t d = 0; d < 3; ++d) {
      table.centre[d].push_back((*values)[1 + d]);
      if (columns->has(detail::k_velocity)) {
        table.velocity[d].push_back((*values)[detail::k_velocity + d]);
      }
      if (columns->has(detail::k_rotation)) {
        table.rotation[d].push_back((*values)[detail::k_rotation + d]);
      }
    }
    if (columns->has(detail::k_weight)) table.weight.push_back((*values)[detail::k_weight]);
    if (columns->has(detail::k_material)) {
      table.material.emplace_back(columns->cell(cells, detail::k_material));
    }
  }
  complaints.throw_if_any();
  if (!columns) throw TableError(name + " is empty: a head line with the columns is expected");
  if (table.diameter.empty()) throw TableError(name + " lists no grains");
  return table;
}

}  // namespace dust::model::file
