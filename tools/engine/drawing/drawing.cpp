// SPDX-License-Identifier: Apache-2.0
#include "drawing/drawing.hpp"

#include "base/text.hpp"
#include "drawing/drawing_body.hpp"
#include "drawing/drawing_view.hpp"

#include <optional>
#include <sstream>
#include <utility>
#include <vector>

namespace dust::engine {
namespace {

using scenario::ModelChoice;
using scenario::Setup;
using sdk::Vec3;

constexpr const char* k_body = "#444";
constexpr const char* k_emitter = "#b03000";
constexpr const char* k_sensor = "#1769aa";
constexpr double k_line = 19.0;        ///< [px] between rows of text
constexpr double k_legend = 400.0;     ///< [px] width of the legend
constexpr double k_badge = 8.0;        ///< [px] radius of a number's disc
constexpr double k_min_width = 260.0;  ///< [px] for the head and the scale

/// The value of a parameter, by its name and type; null if the model has none, or none was given.
template <class Type>
const Type* value_of(const registry::Registry& registry, const ModelChoice& choice,
                     const std::string& name) {
  const auto* entry = registry.find(choice.kind, choice.name);
  if (entry == nullptr) return nullptr;
  for (std::size_t n = 0; n < choice.values.size(); ++n) {
    if (entry->info.parameters[n].name == name) return std::get_if<Type>(&choice.values[n]);
  }
  return nullptr;
}

bool is_finite(Vec3 v) { return std::isfinite(v.x + v.y + v.z); }

class Drawing {
 public:
  Drawing(const Setup& setup, const registry::Registry& registry)
      : setup_(setup), registry_(registry), view_(setup) {}

  std::string text() {
    draw_regions();
    out_ << "<g clip-path=\"url(#domain)\">\n";
    for (const auto& body : setup_.bodies) draw(body);
    out_ << "</g>\n";
    draw_sides();
    for (const auto& emitter : setup_.emitters) draw(emitter);
    for (const auto& sensor : setup_.sensors) draw(sensor);
    draw_scale();
    draw_head();
    draw_legend();
    const double picture = std::max(view_.width(), k_min_width) + 2.0 * SideView::k_margin;
    const double height =
        std::max(view_.bottom() + 60.0, SideView::k_top + k_line * legend_rows_ + 20.0);
    std::ostringstream svg;
    svg << "<svg xmlns=\"http://www.w3.org/2000/svg\" width=\"" << px(picture + k_legend)
        << "\" height=\"" << px(height) << "\" viewBox=\"0 0 " << px(picture + k_legend) << ' '
        << px(height) << "\" font-family=\"sans-serif\" font-size=\"13\">\n"
        << "<rect width=\"100%\" height=\"100%\" fill=\"white\"/>\n"
        << "<clipPath id=\"domain\"><rect x=\"" << px(view_.left()) << "\" y=\"" << px(view_.top())
        << "\" width=\"" << px(view_.width()) << "\" height=\"" << px(view_.height())
        << "\"/></clipPath>\n"
        << out_.str() << "</svg>\n";
    return svg.str();
  }

 private:
  struct Item {
    const char* colour;
    std::string name;
    std::string what;
    bool has_badge = false;
    int number = 0;
  };
  using Place = std::optional<std::pair<double, double>>;

  void words(double x, double y, const char* colour, const std::string& text,
             const char* more = "") {
    out_ << "<text x=\"" << px(x) << "\" y=\"" << px(y) << "\" fill=\"" << colour << "\"" << more
         << '>' << text << "</text>\n";
  }
  /// A line of the legend; its number stands at `place` in the picture, if it has one.
  void enter(const char* colour, const std::string& name, const std::string& what, Place place) {
    Item item{colour, name, what, place.has_value(), static_cast<int>(items_.size()) + 1};
    if (place) badge(free_place(*place), colour, item.number);
    items_.push_back(std::move(item));
  }
  void badge(std::pair<double, double> at, const char* colour, int number) {
    out_ << "<circle cx=\"" << px(at.first) << "\" cy=\"" << px(at.second) << "\" r=\""
         << px(k_badge) << "\" fill=\"" << colour << "\"/>\n";
    words(at.first, at.second + 4.0, "white", std::to_string(number),
          " font-size=\"11\" text-anchor=\"middle\"");
  }
  /// The place, or the nearest one beside it where no number stands yet.
  std::pair<double, double> free_place(std::pair<double, double> wanted) {
    const double step = 2.0 * k_badge + 2.0;
    wanted.first = std::clamp(wanted.first, view_.left() + k_badge, view_.right() - k_badge);
    wanted.second = std::clamp(wanted.second, view_.top() + k_badge, view_.bottom() - k_badge);
    std::pair<double, double> best = wanted;
    for (int n = 0; n < 40; ++n) {
      // Rows below each other when the picture ends at the right.
      const double x = wanted.first + step * n;
      const int per_row = std::max(1, static_cast<int>((view_.right() - wanted.first) / step));
      best = x < view_.right() ? std::pair{x, wanted.second}
                               : std::pair{wanted.first + step * (n % per_row),
                                           wanted.second + step * (n / per_row)};
      bool is_free = true;
      for (const auto& [bx, by] : badges_) {
        is_free = is_free && std::hypot(bx - best.first, by - best.second) >= step - 1.0;
      }
      if (is_free) break;
    }
    badges_.push_back(best);
    return best;
  }

  void rectangle(Vec3 a, Vec3 b, const std::string& style) {
    const double left = std::min(view_.x(a), view_.x(b));
    const double top = std::min(view_.y(a), view_.y(b));
    out_ << "<rect x=\"" << px(left) << "\" y=\"" << px(top) << "\" width=\""
         << px(std::abs(view_.x(a) - view_.x(b))) << "\" height=\""
         << px(std::abs(view_.y(a) - view_.y(b))) << "\" " << style << "/>\n";
  }
  /// A frustum from the side: its two ends and the lines between them.
  void frustum(Vec3 from, Vec3 to, double radius, double end_radius, const std::string& style) {
    const double x = view_.x(to) - view_.x(from);
    const double y = view_.y(to) - view_.y(from);
    const double length = std::max(std::hypot(x, y), 1e-9);
    out_ << "<polygon points=\"";
    const std::pair<Vec3, double> corners[] = {
        {from, radius}, {to, end_radius}, {to, -end_radius}, {from, -radius}};
    for (const auto& [at, side] : corners) {
      const double reach = side * view_.scale() / length;
      out_ << px(view_.x(at) + y * reach) << ',' << px(view_.y(at) - x * reach) << ' ';
    }
    out_ << "\" " << style << "/>\n";
  }
  void cross(Vec3 at, const char* colour) {
    constexpr double k_arm = 6.0;
    out_ << "<path fill=\"none\" stroke=\"" << colour << "\" stroke-width=\"1.5\" d=\"M"
         << px(view_.x(at) - k_arm) << ' ' << px(view_.y(at)) << "h" << px(2 * k_arm) << "M"
         << px(view_.x(at)) << ' ' << px(view_.y(at) - k_arm) << "v" << px(2 * k_arm) << "\"/>\n";
  }
  /// Beside the upper left corner of what is drawn at `a` ... `b`.
  [[nodiscard]] Place corner(Vec3 a, Vec3 b) const {
    return std::pair{std::min(view_.x(a), view_.x(b)) + k_badge + 2.0,
                     std::min(view_.y(a), view_.y(b)) + k_badge + 2.0};
  }

  /// Liquids and layers, pale.
  void draw_regions() {
    if (!setup_.fluid) return;
    for (const auto& region : setup_.fluid->regions) {
      Vec3 low = region.min;
      Vec3 high = region.max;
      for (int d = 0; d < 3; ++d) {
        low[d] = std::max(low[d], setup_.domain.min[d]);
        high[d] = std::min(high[d], setup_.domain.max[d]);
      }
      rectangle(low, high, "fill=\"#dcecf7\" stroke=\"none\"");
    }
  }
  void draw(const scenario::BodySpec& spec) {
    const auto body = bodies::make_body(setup_, spec, nullptr);
    const BodyPicture picture = draw_body(body, setup_.domain, view_);
    out_ << picture.svg;
    std::string what = "body: " + spec.shape.name;
    for (const auto& motion : spec.motions) what += ", " + motion.name;
    enter(k_body, spec.name, what, picture.mark);
  }
  void draw(const scenario::EmitterSpec& spec) {
    const auto turned = [&](Vec3 at) {
      if (spec.frame < 0) return at;
      const auto& frame = setup_.frames[static_cast<std::size_t>(spec.frame)];
      return frame.origin + rotate(at - frame.origin, frame.axis / norm(frame.axis), frame.angle);
    };
    const std::string what = "emitter: " + spec.model.name;
    const auto* min = value_of<Vec3>(registry_, spec.model, "min");
    const auto* max = value_of<Vec3>(registry_, spec.model, "max");
    const std::string style = std::string("fill=\"") + k_emitter +
                              "\" fill-opacity=\"0.08\" stroke=\"" + k_emitter +
                              "\" stroke-width=\"1.5\"";
    const auto* from = value_of<Vec3>(registry_, spec.model, "from");
    const auto* to = value_of<Vec3>(registry_, spec.model, "to");
    const auto* radius = value_of<double>(registry_, spec.model, "radius");
    if (from != nullptr && to != nullptr && radius != nullptr && is_finite(*from) &&
        is_finite(*to) && *radius > 0.0) {
      const auto* end = value_of<double>(registry_, spec.model, "end_radius");
      frustum(turned(*from), turned(*to), *radius, end != nullptr && *end > 0.0 ? *end : *radius,
              style);
      enter(k_emitter, spec.name, what, corner(turned(*from), turned(*to)));
      return;
    }
    if (min != nullptr && max != nullptr && is_finite(*min) && is_finite(*max) && !(*min == *max)) {
      rectangle(turned(*min), turned(*max), style);
      enter(k_emitter, spec.name, what, corner(turned(*min), turned(*max)));
      return;
    }
    Place place;
    const auto* positions = value_of<std::vector<Vec3>>(registry_, spec.model, "positions");
    const auto* diameters = value_of<std::vector<double>>(registry_, spec.model, "diameters");
    for (std::size_t n = 0; positions != nullptr && n < positions->size(); ++n) {
      const Vec3 at = turned((*positions)[n]);
      const double diameter = diameters != nullptr && n < diameters->size() ? (*diameters)[n] : 0.0;
      constexpr double k_seen = 2.0;  // [px]
      out_ << "<circle cx=\"" << px(view_.x(at)) << "\" cy=\"" << px(view_.y(at)) << "\" r=\""
           << px(std::max(k_seen, 0.5 * diameter * view_.scale())) << "\" fill=\"" << k_emitter
           << "\" fill-opacity=\"0.3\" stroke=\"" << k_emitter << "\"/>\n";
      if (!place) {
        place = {view_.x(at) + 0.5 * diameter * view_.scale() + k_badge + 3.0, view_.y(at)};
      }
    }
    if (!place) {
      if (const auto at = point_of(spec.model)) {
        cross(turned(*at), k_emitter);
        place = {view_.x(turned(*at)) + k_badge + 3.0, view_.y(turned(*at)) - k_badge};
      }
    }
    enter(k_emitter, spec.name, what, place);
  }
  void draw(const scenario::SensorSpec& spec) {
    const std::string what = "sensor: " + spec.model.name;
    const auto* min = value_of<Vec3>(registry_, spec.model, "min");
    const auto* max = value_of<Vec3>(registry_, spec.model, "max");
    if (min != nullptr && max != nullptr && is_finite(*min) && is_finite(*max) && !(*min == *max)) {
      rectangle(*min, *max,
                std::string("fill=\"none\" stroke=\"") + k_sensor +
                    "\" stroke-width=\"1.5\" stroke-dasharray=\"5 3\"");
      enter(k_sensor, spec.name, what, corner(*min, *max));
      return;
    }
    const auto at = point_of(spec.model);
    if (at) cross(*at, k_sensor);
    enter(k_sensor, spec.name, what,
          at ? Place{{view_.x(*at) + k_badge + 3.0, view_.y(*at) - k_badge - 3.0}} : Place{});
  }
  /// Where a model without a box is, if one of its parameters tells.
  std::optional<Vec3> point_of(const ModelChoice& choice) const {
    for (const char* name : {"from", "point", "position", "origin", "center"}) {
      const auto* at = value_of<Vec3>(registry_, choice, name);
      if (at != nullptr && is_finite(*at)) return *at;
    }
    return std::nullopt;
  }

  /// "wall of glass, air: slip"
  [[nodiscard]] std::string side_text(int side) const {
    const auto& s = setup_.domain.sides[static_cast<std::size_t>(side)];
    std::string text = "open";
    if (s.grains == scenario::GrainSide::periodic) text = "periodic";
    if (s.grains == scenario::GrainSide::wall) {
      text = "wall of " + setup_.materials[static_cast<std::size_t>(s.material)].name;
    }
    return s.air ? text + ", air: " + s.air->name : text;
  }
  void draw_sides() {
    for (const int d : {view_.across(), view_.up()}) {
      for (int high = 0; high < 2; ++high) {
        const auto& side = setup_.domain.sides[static_cast<std::size_t>(2 * d + high)];
        Vec3 from = setup_.domain.min;
        Vec3 to = setup_.domain.max;
        from[d] = to[d] = high != 0 ? setup_.domain.max[d] : setup_.domain.min[d];
        const char* style = side.grains == scenario::GrainSide::wall ? "stroke-width=\"4\""
                            : side.grains == scenario::GrainSide::periodic
                                ? "stroke-width=\"1.5\" stroke-dasharray=\"2 4\""
                                : "stroke-width=\"1\"";
        out_ << "<path fill=\"none\" stroke=\"#222\" " << style << " d=\"M" << px(view_.x(from))
             << ' ' << px(view_.y(from)) << "L" << px(view_.x(to)) << ' ' << px(view_.y(to))
             << "\"/>\n";
      }
    }
  }

  /// A bar of 1, 2 or 5 times a power of ten, about a fifth of the picture.
  void draw_scale() {
    const double wanted = 0.2 * std::max(view_.width(), k_min_width) / view_.scale();
    const double decade = std::pow(10.0, std::floor(std::log10(wanted)));
    const double lead = wanted / decade;
    const double length = decade * (lead >= 5.0 ? 5.0 : lead >= 2.0 ? 2.0 : 1.0);
    const double y = view_.bottom() + 22.0;
    const double x = SideView::k_margin;
    out_ << "<path fill=\"none\" stroke=\"black\" stroke-width=\"2\" d=\"M" << px(x) << ' '
         << px(y - 4) << "v8M" << px(x) << ' ' << px(y) << "h" << px(view_.scale() * length)
         << "m0 -4v8\"/>\n";
    std::ostringstream text;
    text << base::length_text(length) << " ("
         << "xyz"[view_.across()] << " to the right, "
         << "xyz"[view_.up()] << (view_.is_flipped() ? " down)" : " up)");
    words(x, y + 20, "black", text.str());
  }
  void draw_head() {
    const Vec3 size = setup_.domain.max - setup_.domain.min;
    std::ostringstream text;
    text << base::extent_text({size.x, size.y, size.z}) << ", " << setup_.time.end << " s";
    words(SideView::k_margin, 34.0, "black", setup_.name, " font-size=\"18\" font-weight=\"bold\"");
    words(SideView::k_margin, 56.0, "#555", text.str());
    if (setup_.fluid) {
      const auto& n = setup_.fluid->cells;
      std::ostringstream cells;
      cells << n[0] << " x " << n[1] << " x " << n[2] << " cells";
      words(SideView::k_margin, 74.0, "#555", cells.str());
    }
  }
  void legend_row(double x, double& y, const char* colour, const std::string& name,
                  const std::string& what) {
    out_ << "<text x=\"" << px(x) << "\" y=\"" << px(y + 4.0) << "\"><tspan fill=\"" << colour
         << "\" font-weight=\"bold\">" << name << "</tspan><tspan fill=\"#555\"> " << what
         << "</tspan></text>\n";
    y += k_line;
    legend_rows_ += 1.0;
  }
  void draw_legend() {
    const double x = std::max(view_.width(), k_min_width) + 2.0 * SideView::k_margin - 10.0;
    double y = SideView::k_top + k_badge;
    for (const Item& item : items_) {
      if (item.has_badge) badge({x + k_badge, y}, item.colour, item.number);
      legend_row(x + 2 * k_badge + 6.0, y, item.colour, item.name, item.what);
    }
    y += 0.5 * k_line;
    legend_rows_ += 0.5;
    for (int side = 0; side < 6; ++side) {
      legend_row(x, y, "#222", scenario::k_side_names[static_cast<std::size_t>(side)],
                 side_text(side));
    }
  }

  const Setup& setup_;
  const registry::Registry& registry_;
  SideView view_;
  std::ostringstream out_;
  std::vector<Item> items_;
  std::vector<std::pair<double, double>> badges_;
  double legend_rows_ = 0.0;
};

}  // namespace

std::string draw_setup(const Setup& setup, const registry::Registry& registry) {
  return Drawing(setup, registry).text();
}

}  // namespace dust::engine
