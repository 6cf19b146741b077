// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <vector>

namespace dust::model::low_pressure {

/// Cells of a box-shaped grid, x fastest.
struct Cells {
  std::array<int, 3> count{0, 0, 0};
  [[nodiscard]] std::size_t size() const {
    return static_cast<std::size_t>(count[0]) * count[1] * count[2];
  }
  [[nodiscard]] std::size_t index(int i, int j, int k) const {
    return static_cast<std::size_t>(i) +
           static_cast<std::size_t>(count[0]) * (j + static_cast<std::size_t>(count[1]) * k);
  }
  /// Calls visit(index) for the cell and its up to 26 neighbours inside the grid.
  template <class Visit>
  void for_neighbourhood(int i, int j, int k, Visit visit) const {
    for (int c = std::max(k - 1, 0); c <= std::min(k + 1, count[2] - 1); ++c) {
      for (int b = std::max(j - 1, 0); b <= std::min(j + 1, count[1] - 1); ++b) {
        for (int a = std::max(i - 1, 0); a <= std::min(i + 1, count[0] - 1); ++a) {
          visit(index(a, b, c));
        }
      }
    }
  }
};

/// Mean over the open cells among each open cell and its 26 neighbours; 0 in closed ones. Takes out
/// what a single cell's noise adds to a minimum.
/// @param field    one number per cell, any unit
/// @param is_open  1 where fluid is
inline std::vector<double> smoothed(const Cells& cells, const std::vector<double>& field,
                                    const std::vector<char>& is_open) {
  std::vector<double> result(cells.size(), 0.0);
  for (int k = 0; k < cells.count[2]; ++k) {
    for (int j = 0; j < cells.count[1]; ++j) {
      for (int i = 0; i < cells.count[0]; ++i) {
        const std::size_t c = cells.index(i, j, k);
        if (is_open[c] == 0) continue;
        double sum = 0.0;
        int open = 0;
        cells.for_neighbourhood(i, j, k, [&](std::size_t n) {
          if (is_open[n] == 0) return;
          sum += field[n];
          ++open;
        });
        result[c] = sum / open;
      }
    }
  }
  return result;
}

/// The grid that is left when a direction (0, 1, 2) is averaged out: one cell deep along it.
inline Cells collapsed(Cells cells, int direction) {
  cells.count[direction] = 1;
  return cells;
}

/// Mean over the open cells of each row along a direction, by `collapsed` cell; 0 in rows without
/// one, which are closed.
struct RowMeans {
  std::vector<double> mean;
  std::vector<char> is_open;
};
inline RowMeans averaged_along(const Cells& cells, int direction, const std::vector<double>& field,
                               const std::vector<char>& is_open) {
  const Cells rows = collapsed(cells, direction);
  RowMeans result{std::vector<double>(rows.size(), 0.0), std::vector<char>(rows.size(), 0)};
  std::vector<int> open(rows.size(), 0);
  for (int k = 0; k < cells.count[2]; ++k) {
    for (int j = 0; j < cells.count[1]; ++j) {
      for (int i = 0; i < cells.count[0]; ++i) {
        const std::size_t c = cells.index(i, j, k);
        if (is_open[c] == 0) continue;
        std::array<int, 3> cell{i, j, k};
        cell[static_cast<std::size_t>(direction)] = 0;
        const std::size_t row = rows.index(cell[0], cell[1], cell[2]);
        result.mean[row] += field[c];
        ++open[row];
      }
    }
  }
  for (std::size_t row = 0; row < rows.size(); ++row) {
    if (open[row] == 0) continue;
    result.mean[row] /= open[row];
    result.is_open[row] = 1;
  }
  return result;
}

/// How many cells [cell widths `spacing`, m] a distance [m] reaches along each direction: at least
/// one where it is above 0. A distance that is a whole number of cells but for rounding takes
/// these.
inline std::array<int, 3> cells_within(double distance, std::array<double, 3> spacing) {
  constexpr double k_rounding = 1e-6;
  std::array<int, 3> reach{0, 0, 0};
  if (distance <= 0.0) return reach;
  for (std::size_t d = 0; d < 3; ++d) {
    reach[d] = std::max(1, static_cast<int>(std::ceil(distance / spacing[d] - k_rounding)));
  }
  return reach;
}

/// Marks every cell that lies at most `reach` cells from a marked one along each direction, the
/// corners of that box included. Three passes, one per direction.
inline std::vector<char> grown(const Cells& cells, std::vector<char> marked,
                               std::array<int, 3> reach) {
  const std::array<std::size_t, 3> stride{
      1, static_cast<std::size_t>(cells.count[0]),
      static_cast<std::size_t>(cells.count[0]) * static_cast<std::size_t>(cells.count[1])};
  for (std::size_t d = 0; d < 3; ++d) {
    if (reach[d] == 0) continue;
    const std::vector<char> before = marked;
    const auto length = static_cast<std::size_t>(cells.count[d]);
    const auto far = static_cast<std::size_t>(reach[d]);
    for (std::size_t c = 0; c < marked.size(); ++c) {
      if (before[c] == 0) continue;
      const std::size_t at = c / stride[d] % length;
      const std::size_t first = c - std::min(at, far) * stride[d];
      const std::size_t last = c + std::min(length - 1 - at, far) * stride[d];
      for (std::size_t n = first; n <= last; n += stride[d]) marked[n] = 1;
    }
  }
  return marked;
}

/// Rows along a direction with a marked cell, by `collapsed` cell.
inline std::vector<char> any_along(const Cells& cells, int direction,
                                   const std::vector<char>& marked) {
  const Cells rows = collapsed(cells, direction);
  std::vector<char> result(rows.size(), 0);
  for (int k = 0; k < cells.count[2]; ++k) {
    for (int j = 0; j < cells.count[1]; ++j) {
      for (int i = 0; i < cells.count[0]; ++i) {
        if (marked[cells.index(i, j, k)] == 0) continue;
        std::array<int, 3> cell{i, j, k};
        cell[static_cast<std::size_t>(direction)] = 0;
        result[rows.index(cell[0], cell[1], cell[2])] = 1;
      }
    }
  }
  return result;
}

struct Minimum {
  std::array<int, 3> cell{0, 0, 0};
  double value = 0.0;
};

/// The deepest local minima below zero of a field, at most `count`, at least `separation` apart.
///
/// A cell is a local minimum when no eligible neighbour of its 26 is lower (of equals, the first
/// one counts). They are taken from the deepest up; one nearer than `separation` [m] to a deeper
/// one belongs to the same place.
/// @param is_eligible  1 where a minimum may lie
/// @param spacing      [m] of the cells per direction
inline std::vector<Minimum> deepest_minima(const Cells& cells, const std::vector<double>& field,
                                           const std::vector<char>& is_eligible,
                                           std::array<double, 3> spacing, double separation,
                                           std::size_t count) {
  std::vector<Minimum> found;
  for (int k = 0; k < cells.count[2]; ++k) {
    for (int j = 0; j < cells.count[1]; ++j) {
      for (int i = 0; i < cells.count[0]; ++i) {
        const std::size_t c = cells.index(i, j, k);
        if (is_eligible[c] == 0 || !(field[c] < 0.0)) continue;
        bool is_lowest = true;
        cells.for_neighbourhood(i, j, k, [&](std::size_t n) {
          if (is_eligible[n] == 0 || n == c) return;
          if (field[n] < field[c] || (field[n] == field[c] && n < c)) is_lowest = false;
        });
        if (is_lowest) found.push_back({{i, j, k}, field[c]});
      }
    }
  }
  std::stable_sort(found.begin(), found.end(),
                   [](const Minimum& a, const Minimum& b) { return a.value < b.value; });
  std::vector<Minimum> chosen;
  for (const Minimum& candidate : found) {
    if (chosen.size() == count) break;
    const bool is_apart = std::all_of(chosen.begin(), chosen.end(), [&](const Minimum& deeper) {
      double squares = 0.0;
      for (int d = 0; d < 3; ++d) {
        const double step = (candidate.cell[d] - deeper.cell[d]) * spacing[d];
        squares += step * step;
      }
      return squares >= separation * separation;
    });
    if (is_apart) chosen.push_back(candidate);
  }
  return chosen;
}

}  // namespace dust::model::low_pressure
