// SPDX-License-Identifier: Apache-2.0
#include "study/svg_plot.hpp"

#include "base/text.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <cmath>
#include <limits>

namespace dust::study {
namespace {

constexpr double k_width = 460.0;
constexpr double k_left = 62.0;
constexpr double k_right = 14.0;
constexpr double k_top = 12.0;
constexpr double k_bottom = 46.0;

std::string number(double value) { return base::fixed_text(value, 1); }

std::string label(double value) {
  std::string shown = base::digits_text(std::abs(value) < 1e-300 ? 0.0 : value, 6);
  if (shown.starts_with('-')) shown.replace(0, 1, "\u2212");
  return shown;
}

/// A direction of a plot: values and where they lie on the page.
struct Scale {
  double low = 0.0, high = 1.0;
  double from = 0.0, to = 1.0;
  [[nodiscard]] double at(double v) const { return from + (v - low) / (high - low) * (to - from); }
  /// Round steps, about `wanted` of them.
  [[nodiscard]] std::vector<double> ticks(double wanted) const {
    const double rough = (high - low) / wanted;
    const double power = std::pow(10.0, std::floor(std::log10(rough)));
    double step = 10.0 * power;
    for (const double k : {5.0, 2.0, 1.0}) {
      if (k * power >= 0.999 * rough) step = k * power;
    }
    std::vector<double> all;
    for (double v = std::ceil(low / step - 1e-9) * step; v <= high + 1e-9 * step; v += step) {
      all.push_back(std::abs(v) < 1e-9 * step ? 0.0 : v);
    }
    return all;
  }
};

/// The range of values with room around them.
Scale scale_of(double low, double high, double from, double to) {
  if (!(high > low)) {
    const double half = low == 0.0 ? 1.0 : 0.05 * std::abs(low);
    low -= half;
    high += half;
  }
  const double room = 0.06 * (high - low);
  return {low - room, high + room, from, to};
}

std::string line(double x1, double y1, double x2, double y2, const std::string& style) {
  return "<line x1=\"" + number(x1) + "\" y1=\"" + number(y1) + "\" x2=\"" + number(x2) +
         "\" y2=\"" + number(y2) + "\" style=\"" + style + "\"/>";
}

std::string text(double x, double y, const std::string& what, const char* anchor,
                 const std::string& extra = {}) {
  return "<text x=\"" + number(x) + "\" y=\"" + number(y) + "\" text-anchor=\"" + anchor + "\"" +
         extra + ">" + io::escape_html(what) + "</text>";
}

std::string dot(double x, double y, double radius, const std::string& colour) {
  return "<circle cx=\"" + number(x) + "\" cy=\"" + number(y) + "\" r=\"" + number(radius) +
         "\" style=\"fill:var(" + colour + ")\"/>";
}

std::string open_svg(double height, const std::string& what) {
  return "<svg viewBox=\"0 0 " + number(k_width) + " " + number(height) +
         "\" role=\"img\" aria-label=\"" + io::escape_html(what) +
         "\" style=\"width:100%;height:auto\">";
}

/// Frame, ticks and labels of a plot with two scales.
std::string axes(const Scale& x, const Scale& y, const std::string& x_label,
                 const std::string& y_label) {
  std::string out;
  for (const double v : y.ticks(5.0)) {
    out += line(x.from, y.at(v), x.to, y.at(v), "stroke:var(--faint)");
    out += text(x.from - 7.0, y.at(v) + 4.0, label(v), "end");
  }
  for (const double v : x.ticks(6.0)) {
    out += line(x.at(v), y.from, x.at(v), y.from + 5.0, "stroke:var(--line)");
    out += text(x.at(v), y.from + 18.0, label(v), "middle");
  }
  out += line(x.from, y.from, x.to, y.from, "stroke:var(--soft)");
  out += text(0.5 * (x.from + x.to), y.from + 38.0, x_label, "middle");
  const std::string turn = " transform=\"rotate(-90 12 " + number(0.5 * (y.from + y.to)) + ")\"";
  out += text(12.0, 0.5 * (y.from + y.to), y_label, "middle", turn);
  return out;
}

void widen(double value, double& low, double& high) {
  if (!std::isfinite(value)) return;
  low = std::min(low, value);
  high = std::max(high, value);
}

/// Pieces of the line where a field has a level, by marching through triangles of its cells (no
/// ambiguous cases), each as four page coordinates.
std::vector<std::array<double, 4>> level_line(const GridField& f, double level, const Scale& x,
                                              const Scale& y) {
  struct Corner {
    double x, y, v;
  };
  std::vector<std::array<double, 4>> pieces;
  const auto corner = [&](std::size_t i, std::size_t j) {
    const double share_x = static_cast<double>(i) / static_cast<double>(f.nx - 1);
    const double share_y = static_cast<double>(j) / static_cast<double>(f.ny - 1);
    return Corner{x.at(f.low[0] + share_x * (f.high[0] - f.low[0])),
                  y.at(f.low[1] + share_y * (f.high[1] - f.low[1])),
                  f.values[j * f.nx + i] - level};
  };
  const auto cross = [&](const Corner& a, const Corner& b, const Corner& c) {
    const Corner* three[3] = {&a, &b, &c};
    std::array<double, 4> piece{};
    std::size_t found = 0;
    for (std::size_t k = 0; k < 3; ++k) {
      const Corner& p = *three[k];
      const Corner& q = *three[(k + 1) % 3];
      if ((p.v > 0.0) == (q.v > 0.0) || found == 4) continue;
      const double share = p.v / (p.v - q.v);
      piece[found++] = p.x + share * (q.x - p.x);
      piece[found++] = p.y + share * (q.y - p.y);
    }
    if (found == 4) pieces.push_back(piece);
  };
  for (std::size_t j = 0; j + 1 < f.ny; ++j) {
    for (std::size_t i = 0; i + 1 < f.nx; ++i) {
      cross(corner(i, j), corner(i + 1, j), corner(i, j + 1));
      cross(corner(i + 1, j), corner(i + 1, j + 1), corner(i, j + 1));
    }
  }
  return pieces;
}

}  // namespace

std::string svg_xy(const XyPlot& plot) {
  constexpr double k_height = 260.0;
  double x_low = std::numeric_limits<double>::infinity();
  double x_high = -x_low;
  double y_low = x_low;
  double y_high = -x_low;
  for (const Marks& m : plot.marks) {
    for (std::size_t n = 0; n < m.x.size(); ++n) {
      const double e = n < m.error.size() ? std::max(0.0, m.error[n]) : 0.0;
      widen(m.x[n], x_low, x_high);
      widen(m.y[n] - e, y_low, y_high);
      widen(m.y[n] + e, y_low, y_high);
    }
  }
  if (!(x_high >= x_low) || !(y_high >= y_low)) return {};
  const Scale x = scale_of(x_low, x_high, k_left, k_width - k_right);
  const Scale y = scale_of(y_low, y_high, k_height - k_bottom, k_top);
  std::string out = open_svg(k_height, plot.y_label + " against " + plot.x_label);
  out += axes(x, y, plot.x_label, plot.y_label);
  for (const Marks& m : plot.marks) {
    std::string path;
    for (std::size_t n = 0; n < m.x.size(); ++n) {
      path += (n == 0 ? "M" : "L") + number(x.at(m.x[n])) + " " + number(y.at(m.y[n]));
    }
    if (m.has_line) {
      out += "<path d=\"" + path + "\" style=\"fill:none;stroke:var(" + m.colour +
             ");stroke-width:1.6\"/>";
    }
    for (std::size_t n = 0; n < m.x.size(); ++n) {
      if (n < m.error.size() && m.error[n] > 0.0) {
        out += line(x.at(m.x[n]), y.at(m.y[n] - m.error[n]), x.at(m.x[n]),
                    y.at(m.y[n] + m.error[n]), "stroke:var(" + m.colour + ")");
      }
      out += dot(x.at(m.x[n]), y.at(m.y[n]), m.radius, m.colour);
    }
  }
  return out + "</svg>";
}

std::string svg_rows(const RowPlot& plot) {
  constexpr double k_row = 26.0;
  constexpr double k_letter = 6.6;  ///< mean width of a letter of 12 px
  double low = std::numeric_limits<double>::infinity();
  double high = -low;
  std::size_t longest = 0;
  for (std::size_t n = 0; n < plot.values.size(); ++n) {
    const double e = std::max(0.0, plot.errors[n]);
    widen(plot.values[n] - e, low, high);
    widen(plot.values[n] + e, low, high);
    longest = std::max(longest, plot.names[n].size());
  }
  if (!(high >= low)) return {};
  const double left = std::clamp(k_letter * static_cast<double>(longest) + 12.0, 40.0, 220.0);
  const double bottom = k_top + k_row * static_cast<double>(plot.values.size());
  const Scale x = scale_of(low, high, left, k_width - k_right);
  std::string out = open_svg(bottom + k_bottom, plot.x_label);
  for (const double v : x.ticks(4.0)) {
    out += line(x.at(v), k_top, x.at(v), bottom + 4.0, "stroke:var(--faint)");
    out += text(x.at(v), bottom + 18.0, label(v), "middle");
  }
  for (std::size_t n = 0; n < plot.values.size(); ++n) {
    const double y = k_top + k_row * (static_cast<double>(n) + 0.5);
    out += text(left - 8.0, y + 4.0, plot.names[n], "end");
    if (plot.errors[n] > 0.0) {
      out += line(x.at(plot.values[n] - plot.errors[n]), y, x.at(plot.values[n] + plot.errors[n]),
                  y, "stroke:var(--plot1)");
    }
    out += dot(x.at(plot.values[n]), y, 4.0, "--plot1");
  }
  out += text(0.5 * (left + k_width - k_right), bottom + 38.0, plot.x_label, "middle");
  return out + "</svg>";
}

std::string svg_contours(const ContourPlot& plot) {
  constexpr double k_height = 420.0;
  const GridField& any = *plot.lines.front().field;
  const Scale x{any.low[0], any.high[0], k_left, k_width - k_right};
  const Scale y{any.low[1], any.high[1], k_height - k_bottom, k_top};
  std::string out = open_svg(k_height, plot.y_label + " against " + plot.x_label);
  if (plot.region != nullptr) {
    const GridField& f = *plot.region;
    const double dx = (x.to - x.from) / static_cast<double>(f.nx - 1);
    const double dy = (y.from - y.to) / static_cast<double>(f.ny - 1);
    out += "<g style=\"fill:var(--plot1);opacity:.22\" shape-rendering=\"crispEdges\">";
    for (std::size_t j = 0; j < f.ny; ++j) {
      for (std::size_t i = 0; i < f.nx; ++i) {
        if (f.values[j * f.nx + i] > plot.region_level) continue;
        std::size_t end = i;  // one strip for neighbours in a row
        while (end < f.nx && f.values[j * f.nx + end] <= plot.region_level) ++end;
        const double left = std::max(x.from, x.from + dx * (static_cast<double>(i) - 0.5));
        const double right = std::min(x.to, x.from + dx * (static_cast<double>(end) - 0.5));
        const double middle = y.from - dy * static_cast<double>(j);
        const double above = std::max(y.to, middle - 0.5 * dy);
        const double below = std::min(y.from, middle + 0.5 * dy);
        out += "<rect x=\"" + number(left) + "\" y=\"" + number(above) + "\" width=\"" +
               number(right - left) + "\" height=\"" + number(below - above) + "\"/>";
        i = end;
      }
    }
    out += "</g>";
  }
  out += axes(x, y, plot.x_label, plot.y_label);
  double key = k_top + 14.0;
  for (const ContourLine& l : plot.lines) {
    std::string path;
    for (const auto& p : level_line(*l.field, l.level, x, y)) {
      path += "M" + number(p[0]) + " " + number(p[1]) + "L" + number(p[2]) + " " + number(p[3]);
    }
    const std::string style = "fill:none;stroke:var(" + l.colour +
                              ");stroke-width:" + (l.is_dashed ? "1;stroke-dasharray:4 3" : "2");
    if (!path.empty()) out += "<path d=\"" + path + "\" style=\"" + style + "\"/>";
    if (l.name.empty()) continue;
    out += line(x.to - 28.0, key - 4.0, x.to - 8.0, key - 4.0, style);
    out += text(x.to - 34.0, key, l.name, "end");
    key += 16.0;
  }
  for (const auto& p : plot.points) out += dot(x.at(p[0]), y.at(p[1]), 2.6, "--soft");
  const double bx = x.at(plot.best[0]);
  const double by = y.at(plot.best[1]);
  out += line(bx - 8.0, by, bx + 8.0, by, "stroke:var(--ink);stroke-width:2");
  out += line(bx, by - 8.0, bx, by + 8.0, "stroke:var(--ink);stroke-width:2");
  return out + "</svg>";
}

}  // namespace dust::study
