// SPDX-License-Identifier: Apache-2.0
#include "drawing.hpp"

#include "bodies/body_set.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdio>
#include <optional>
#include <sstream>

namespace dust::engine {
namespace {

using scenario::ModelChoice;
using scenario::Setup;
using sdk::Vec3;

/// Looks along one axis of the domain; gravity points down where it follows an axis.
class SideView {
 public:
  explicit SideView(const Setup& setup) : min_(setup.domain.min), max_(setup.domain.max) {
    up_ = 2;
    for (int d = 0; d < 3; ++d) {
      if (std::abs(setup.gravity[d]) > std::abs(setup.gravity[up_])) up_ = d;
    }
    is_flipped_ = setup.gravity[up_] > 0.0;
    across_ = up_ == 0 ? 1 : 0;
    for (int d = 0; d < 3; ++d) {
      if (d != up_ && max_[d] - min_[d] > max_[across_] - min_[across_]) across_ = d;
    }
    scale_ = k_picture / std::max(max_[across_] - min_[across_], max_[up_] - min_[up_]);
  }
  [[nodiscard]] double x(Vec3 p) const { return k_margin + scale_ * (p[across_] - min_[across_]); }
  [[nodiscard]] double y(Vec3 p) const {
    return k_margin + scale_ * (is_flipped_ ? p[up_] - min_[up_] : max_[up_] - p[up_]);
  }
  [[nodiscard]] double width() const { return scale_ * (max_[across_] - min_[across_]); }
  [[nodiscard]] double height() const { return scale_ * (max_[up_] - min_[up_]); }
  [[nodiscard]] double scale() const { return scale_; }
  [[nodiscard]] char across_name() const { return "xyz"[across_]; }
  [[nodiscard]] char up_name() const { return "xyz"[up_]; }

  static constexpr double k_picture = 720.0;  ///< longer side [px]
  static constexpr double k_margin = 60.0;    ///< [px]

 private:
  Vec3 min_;
  Vec3 max_;
  int up_ = 2;
  int across_ = 0;
  bool is_flipped_ = false;
  double scale_ = 1.0;
};

std::string number(double value) {
  std::array<char, 32> buffer{};
  std::snprintf(buffer.data(), buffer.size(), "%.2f", value);
  return buffer.data();
}

/// A parameter of a model that is a point, if it has one of that name.
std::optional<Vec3> point(const registry::Registry& registry, const ModelChoice& choice,
                          const std::string& name) {
  const auto* entry = registry.find(choice.kind, choice.name);
  if (entry == nullptr) return std::nullopt;
  for (std::size_t n = 0; n < choice.values.size(); ++n) {
    const auto& p = entry->info.parameters[n];
    if (p.name != name || !(p.dimension == sdk::dimension::length)) continue;
    const auto* v = std::get_if<Vec3>(&choice.values[n]);
    if (v != nullptr && std::isfinite(v->x + v->y + v->z)) return *v;
  }
  return std::nullopt;
}

class Drawing {
 public:
  Drawing(const Setup& setup, const registry::Registry& registry)
      : setup_(setup), registry_(registry), view_(setup) {}

  std::string text() {
    const double width = view_.width() + 2 * SideView::k_margin;
    const double height = view_.height() + 2 * SideView::k_margin;
    out_ << "<svg xmlns=\"http://www.w3.org/2000/svg\" viewBox=\"0 0 " << number(width) << ' '
         << number(height) << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
         << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
         << "<clipPath id=\"domain\"><rect x=\"" << number(SideView::k_margin) << "\" y=\""
         << number(SideView::k_margin) << "\" width=\"" << number(view_.width()) << "\" height=\""
         << number(view_.height()) << "\"/></clipPath>\n"
         << "<g clip-path=\"url(#domain)\">\n";
    for (const auto& body : setup_.bodies) draw_body(body);
    out_ << "</g>\n";
    box(setup_.domain.min, setup_.domain.max, "#444", "none", "", 0.0);
    for (const auto& emitter : setup_.emitters) draw_emitter(emitter);
    double row = 0.0;
    for (const auto& sensor : setup_.sensors) {
      const auto min = point(registry_, sensor.model, "min");
      const auto max = point(registry_, sensor.model, "max");
      if (min && max && !(*min == *max)) {
        box(*min, *max, "#1769aa", "4 3", sensor.name, row++);
      } else if (const auto at = place(sensor.model)) {
        cross(*at, "#1769aa", sensor.name);
      }
    }
    scale_bar();
    out_ << "</svg>\n";
    return out_.str();
  }

 private:
  /// Where a model without a box is, if one of its parameters tells.
  std::optional<Vec3> place(const ModelChoice& choice) const {
    for (const char* name : {"from", "point", "position", "origin"}) {
      if (const auto at = point(registry_, choice, name)) return at;
    }
    return std::nullopt;
  }
  void cross(Vec3 at, const char* colour, const std::string& name) {
    constexpr double k_arm = 6.0;
    const double x = view_.x(at);
    const double y = view_.y(at);
    out_ << "<path fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"1.5\" d=\"M"
         << number(x - k_arm) << ' ' << number(y) << "H" << number(x + k_arm) << "M" << number(x)
         << ' ' << number(y - k_arm) << "V" << number(y + k_arm) << "\"/>\n";
    label(x + k_arm, y - k_arm, colour, name);
  }
  /// A point of the emitter's frame in the domain's.
  Vec3 in_domain(Vec3 at, int frame_index) const {
    if (frame_index < 0) return at;
    const auto& frame = setup_.frames[static_cast<std::size_t>(frame_index)];
    return frame.origin + rotate(at - frame.origin, frame.axis / norm(frame.axis), frame.angle);
  }
  void label(double x, double y, const char* colour, const std::string& text) {
    out_ << "<text x=\"" << number(x) << "\" y=\"" << number(y) << "\" fill=\"" << colour << "\">"
         << text << "</text>\n";
  }
  void box(Vec3 a, Vec3 b, const char* colour, const char* dashes, const std::string& name,
           double row) {
    const double left = std::min(view_.x(a), view_.x(b));
    const double top = std::min(view_.y(a), view_.y(b));
    out_ << "<rect x=\"" << number(left) << "\" y=\"" << number(top) << "\" width=\""
         << number(std::abs(view_.x(a) - view_.x(b))) << "\" height=\""
         << number(std::abs(view_.y(a) - view_.y(b))) << "\" fill=\"none\" stroke=\"" << colour
         << "\" stroke-width=\"1.5\" stroke-dasharray=\"" << dashes << "\"/>\n";
    constexpr double k_line = 14.0;
    if (!name.empty()) label(left + 3, top + k_line * (1.0 + std::fmod(row, 3.0)), colour, name);
  }
  void draw_body(const scenario::BodySpec& spec) {
    const auto body = bodies::make_body(setup_, spec, nullptr);
    const Vec3 size = setup_.domain.max - setup_.domain.min;
    constexpr double k_pieces = 200.0;
    const double edge = std::max({size.x, size.y, size.z}) / k_pieces;
    // A turned body is cut in its own frame: a larger box, the picture clips.
    const Vec3 more = spec.frame >= 0 ? size : Vec3{};
    const auto corners = body.triangles(setup_.domain.min - more, setup_.domain.max + more, edge);
    out_ << "<path fill=\"#bbb\" stroke=\"#333\" stroke-width=\"1.5\" stroke-linejoin=\"round\" "
            "d=\"";
    double right = 0.0;
    double top = 1e9;
    for (std::size_t n = 0; n + 2 < corners.size(); n += 3) {
      for (std::size_t c = 0; c < 3; ++c) {
        const double x = view_.x(corners[n + c]);
        const double y = view_.y(corners[n + c]);
        out_ << (c == 0 ? "M" : "L") << number(x) << ' ' << number(y);
        if (y < top && x >= SideView::k_margin && x <= SideView::k_margin + view_.width()) {
          top = y;
          right = x;
        }
      }
      out_ << "Z";
    }
    out_ << "\"/>\n";
    constexpr double k_below = 16.0;
    if (!corners.empty()) {
      label(std::max(right, SideView::k_margin + 3), std::max(top, SideView::k_margin) + k_below,
            "#333", spec.name);
    }
  }
  void draw_emitter(const scenario::EmitterSpec& spec) {
    auto min = point(registry_, spec.model, "min");
    auto max = point(registry_, spec.model, "max");
    if (!min || !max) {
      const auto at = place(spec.model);
      if (at) cross(in_domain(*at, spec.frame), "#b03000", spec.name);
      return;
    }
    min = in_domain(*min, spec.frame);
    max = in_domain(*max, spec.frame);
    box(*min, *max, "#b03000", "none", "", 0.0);
    label(view_.x(*max) + 4, view_.y(*max), "#b03000", spec.name);
  }
  /// A bar of 1, 2 or 5 times a power of ten, about a fifth of the picture.
  void scale_bar() {
    const double wanted = 0.2 * SideView::k_picture / view_.scale();
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double lead = wanted / decade;
    const double length = decade * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
    const double y = SideView::k_margin + view_.height() + 22.0;
    const double x = SideView::k_margin;
    out_ << "<path fill=\"none\" stroke=\"black\" stroke-width=\"2\" d=\"M" << number(x) << ' '
         << number(y - 4) << "V" << number(y + 4) << "M" << number(x) << ' ' << number(y) << "H"
         << number(x + view_.scale() * length) << "M" << number(x + view_.scale() * length) << ' '
         << number(y - 4) << "V" << number(y + 4) << "\"/>\n";
    std::array<char, 64> buffer{};
    std::snprintf(buffer.data(), buffer.size(), "%g mm (%c to the right, %c up)", 1e3 * length,
                  view_.across_name(), view_.up_name());
    label(x, y + 20, "black", buffer.data());
    label(SideView::k_margin, SideView::k_margin - 16, "black", setup_.name);
  }

  const Setup& setup_;
  const registry::Registry& registry_;
  SideView view_;
  std::ostringstream out_;
};

}  // namespace

std::string draw_setup(const Setup& setup, const registry::Registry& registry) {
  return Drawing(setup, registry).text();
}

}  // namespace dust::engine
