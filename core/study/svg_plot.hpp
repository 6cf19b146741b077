// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <array>
#include <string>
#include <vector>

namespace dust::study {

/// Marks of one kind in a plot.
struct Marks {
  std::vector<double> x, y;
  std::vector<double> error;       ///< of y, one standard error; empty or negative: none
  std::string colour = "--plot1";  ///< a variable of the page's style
  double radius = 3.5;
  bool has_line = false;
};

/// A plot of numbers against numbers.
struct XyPlot {
  std::string x_label, y_label;
  std::vector<Marks> marks;
};
std::string svg_xy(const XyPlot& plot);

/// A plot of numbers beside names, one row each.
struct RowPlot {
  std::string x_label;
  std::vector<std::string> names;
  std::vector<double> values;
  std::vector<double> errors;  ///< negative: none
};
std::string svg_rows(const RowPlot& plot);

/// A field on a regular grid over a rectangle: values[j * nx + i] at x_i, y_j.
struct GridField {
  std::array<double, 2> low{}, high{};
  std::size_t nx = 0, ny = 0;
  std::vector<double> values;
};

/// One line of constant value of a field, with what it is called.
struct ContourLine {
  const GridField* field = nullptr;
  double level = 0.0;
  std::string name;
  std::string colour = "--plot1";
  bool is_dashed = false;
};

/// Contours over two parameters, with a shaded region where `region` is at most `region_level`.
struct ContourPlot {
  std::string x_label, y_label;
  std::vector<ContourLine> lines;
  const GridField* region = nullptr;
  double region_level = 0.0;
  std::vector<std::array<double, 2>> points;  ///< that were run
  std::array<double, 2> best{};
};
std::string svg_contours(const ContourPlot& plot);

}  // namespace dust::study
