// SPDX-License-Identifier: Apache-2.0
#include "base/text.hpp"
#include "io/report_sections.hpp"
#include "io/report_table.hpp"
#include "io/report_text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <optional>

namespace dust::io {

namespace {

using nlohmann::json;

constexpr double k_longer_side = 560.0;  ///< of the picture [px]
constexpr double k_margin = 34.0;        ///< [px]
constexpr double k_least_width = 240.0;  ///< [px]

struct Point {
  double x = 0.0, y = 0.0, z = 0.0;
};

std::optional<Point> point_at(const json& object, const char* key) {
  const json& list = list_at(object, key);
  if (list.size() != 3) return std::nullopt;
  for (const json& v : list) {
    if (!v.is_number()) return std::nullopt;
  }
  return Point{list[0].get<double>(), list[1].get<double>(), list[2].get<double>()};
}

std::string px(double value) { return base::fixed_text(value, 1); }

/// The x-z plane seen along y, in pixels.
class Side {
 public:
  Side(Point min, Point max)
      : min_(min), max_(max), scale_(k_longer_side / std::max(max.x - min.x, max.z - min.z)) {}
  [[nodiscard]] double x(double v) const { return k_margin + scale_ * (v - min_.x); }
  [[nodiscard]] double z(double v) const { return k_margin + scale_ * (max_.z - v); }
  [[nodiscard]] double width() const { return scale_ * (max_.x - min_.x); }
  [[nodiscard]] double height() const { return scale_ * (max_.z - min_.z); }
  [[nodiscard]] double scale() const { return scale_; }

 private:
  Point min_, max_;
  double scale_;
};

/// Outlines of the bodies, cut at the domain.
std::string bodies_svg(const Side& side, const json& bodies) {
  std::string path;
  const auto add = [&](const char* command, const json& x, const json& z) {
    if (!x.is_number() || !z.is_number()) return;
    path += command + px(side.x(x.get<double>())) + " " + px(side.z(z.get<double>()));
  };
  for (const json& body : bodies) {
    for (const json& ring : list_at(body, "polygons")) {
      for (std::size_t k = 0; k < ring.size(); ++k) add(k == 0 ? "M" : "L", ring[k][0], ring[k][1]);
      path += "Z";
    }
    for (const json& part : list_at(body, "segments")) {
      add("M", part[0], part[1]);
      add("L", part[2], part[3]);
    }
    const json& flat = list_at(body, "triangles");
    for (std::size_t k = 0; k + 5 < flat.size(); k += 6) {
      add("M", flat[k], flat[k + 1]);
      add("L", flat[k + 2], flat[k + 3]);
      add("L", flat[k + 4], flat[k + 5]);
      path += "Z";
    }
  }
  return "<path class=\"body\" d=\"" + path + "\"/>\n";
}

/// A box or a place with its number.
std::string mark_svg(const Side& side, const json& thing, const char* css_class, int number) {
  std::string text;
  double x = 0.0, z = 0.0;
  const auto min = point_at(thing, "min"), max = point_at(thing, "max");
  const auto at = point_at(thing, "at");
  if (min && max) {
    const double left = side.x(std::min(min->x, max->x)), top = side.z(std::max(min->z, max->z));
    const double width = side.scale() * std::abs(max->x - min->x);
    const double height = side.scale() * std::abs(max->z - min->z);
    text = std::string("<rect class=\"") + css_class + "\" x=\"" + px(left) + "\" y=\"" + px(top) +
           "\" width=\"" + px(width) + "\" height=\"" + px(height) + "\"/>";
    x = left + 0.5 * width;
    z = top + 0.5 * height;
  } else if (at) {
    x = side.x(at->x);
    z = side.z(at->z);
    text = std::string("<path class=\"") + css_class + "\" d=\"M" + px(x - 7) + " " + px(z) + "H" +
           px(x + 7) + "M" + px(x) + " " + px(z - 7) + "V" + px(z + 7) + "\"/>";
    x += 11;
    z -= 11;
  } else {
    return {};
  }
  return text + "<circle class=\"" + css_class + " badge\" cx=\"" + px(x) + "\" cy=\"" + px(z) +
         "\" r=\"9\"/><text class=\"badge\" x=\"" + px(x) + "\" y=\"" + px(z + 4) + "\">" +
         std::to_string(number) + "</text>\n";
}

/// A bar of 1, 2 or 5 times a power of ten, about a fifth of the picture.
std::string scale_svg(const Side& side) {
  const double wanted = 0.2 * k_longer_side / side.scale();
  const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
  const double lead = wanted / decade;
  const double length = decade * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
  const double y = k_margin + side.height() + 20.0;
  const std::string label = base::digits_text(1e3 * length, 6) + " mm";
  return "<path class=\"scale\" d=\"M" + px(k_margin) + " " + px(y - 4) + "v8m0 -4H" +
         px(k_margin + side.scale() * length) + "m0 -4v8\"/><text x=\"" +
         px(k_margin + side.scale() * length + 8) + "\" y=\"" + px(y + 4) + "\">" + label +
         "</text>\n";
}

std::string sides_html(const json& setting) {
  HtmlTable table({{"Side", false}, {"Grains", false}, {"Air", false}}, "tight");
  for (const json& side : list_at(setting, "sides")) {
    const std::string air = text_at(side, "air");
    table.row({escape_html(text_at(side, "name")), escape_html(words(text_at(side, "grains"))),
               air.empty() ? "\u2013" : escape_html(words(air))});
  }
  return table.html();
}

/// Of an emitter of coarse grains.
std::string stands_for_html(const json& thing) {
  const auto number = number_at(thing, "stands_for");
  if (!number) return {};
  return ", each grain for " + number_html(*number, 3) + " smaller ones in the air";
}

}  // namespace

std::string setting_html(const RunText& run, const json& bodies) {
  const json& setting = object_at(run.report, "setting");
  const auto min = point_at(object_at(setting, "domain"), "min");
  const auto max = point_at(object_at(setting, "domain"), "max");
  if (!min || !max || !(max->x > min->x && max->z > min->z)) return {};
  const Side side(*min, *max);
  // Narrow domains leave room for the scale beside them.
  const std::string width = px(std::max(side.width() + 2 * k_margin, k_least_width));
  std::string marks, key;
  int number = 0;
  const auto add = [&](const char* list, const char* css_class) {
    for (const json& thing : list_at(setting, list)) {
      const std::string mark = mark_svg(side, thing, css_class, number + 1);
      marks += mark;
      if (!mark.empty()) ++number;
      key += std::string("<li><span class=\"badge ") + css_class + "\">" +
             (mark.empty() ? std::string("\u2013") : std::to_string(number)) + "</span><span><b>" +
             escape_html(words(text_at(thing, "name"))) + "</b> " +
             escape_html(words(text_at(thing, "model"))) + stands_for_html(thing) +
             "</span></li>\n";
    }
  };
  add("emitters", "emitter");
  add("sensors", "sensor");
  const std::string frame = "x=\"" + px(k_margin) + "\" y=\"" + px(k_margin) + "\" width=\"" +
                            px(side.width()) + "\" height=\"" + px(side.height()) + "\"";
  std::string text =
      "<section id=\"setting\"><h2>The set-up</h2>\n<figure class=\"side\"><div><svg "
      "role=\"img\" aria-label=\"Side view of the set-up\" viewBox=\"0 0 " +
      width + " " + px(side.height() + 2 * k_margin) + "\" style=\"max-width:" + width +
      "px\"><clipPath id=\"domain\"><rect " + frame + "/></clipPath><rect class=\"domain\" " +
      frame + "/><g clip-path=\"url(#domain)\">" + bodies_svg(side, bodies) + "</g>\n" + marks +
      scale_svg(side) +
      "</svg></div>\n<div><figcaption><b>Seen along "
      "<i>y</i>.</b> Domain " +
      number_html((max->x - min->x) * 1e3, 4) + " \u00d7 " +
      number_html((max->y - min->y) * 1e3, 4) + " \u00d7 " +
      number_html((max->z - min->z) * 1e3, 4) + "\u202fmm.</figcaption>\n";
  if (!key.empty()) text += "<ul class=\"keys\">\n" + key + "</ul>\n";
  return text + sides_html(setting) + "</div></figure></section>\n";
}

}  // namespace dust::io
