// SPDX-License-Identifier: Apache-2.0
#include "check/setup_picture.hpp"

#include "base/text.hpp"
#include "bodies/body_set.hpp"
#include "io/atomic_file.hpp"
#include "report/pictures/outline.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <filesystem>

namespace dust::engine {
namespace {

constexpr const char* k_maker = "<!-- set-up drawn by engine check -->";
constexpr double k_longer_side = 1000.0;  ///< units of the picture
constexpr double k_margin = 20.0;

std::string xml_text(const std::string& text) {
  std::string out;
  for (const char c : text) {
    if (c == '&') {
      out += "&amp;";
    } else if (c == '<') {
      out += "&lt;";
    } else {
      out += c;
    }
  }
  return out;
}

/// From x and z of the domain to the picture, where what is below has the larger number.
class Side {
 public:
  explicit Side(const scenario::DomainSpec& domain)
      : domain_(domain), scale_(k_longer_side / std::max(size().x, size().z)) {}

  [[nodiscard]] double width() const { return scale_ * size().x; }
  [[nodiscard]] double height() const { return scale_ * size().z; }
  [[nodiscard]] std::string x(double at) const { return text(scale_ * (at - domain_.min.x)); }
  [[nodiscard]] std::string y(double at) const { return text(scale_ * (domain_.max.z - at)); }
  [[nodiscard]] std::string length(double of) const { return text(scale_ * of); }
  [[nodiscard]] std::string frame() const {
    return "viewBox=\"" + text(-k_margin) + " " + text(-k_margin) + " " +
           text(width() + 2 * k_margin) + " " + text(height() + 2 * k_margin) + "\"";
  }
  [[nodiscard]] static std::string text(double value) { return base::digits_text(value, 6); }

 private:
  [[nodiscard]] sdk::Vec3 size() const { return domain_.max - domain_.min; }

  const scenario::DomainSpec& domain_;
  double scale_;
};

std::string body_group(const Side& side, const std::string& name, const nlohmann::json& segments,
                       const nlohmann::json& section) {
  std::string text = "<g><title>" + xml_text(name) + "</title>\n";
  for (const auto& r : section) {
    const double low_x = r[0], low_z = r[1], high_x = r[2], high_z = r[3];
    text += R"(<rect fill="#bbb" shape-rendering="crispEdges" x=")" + side.x(low_x) + "\" y=\"" +
            side.y(high_z) + "\" width=\"" + side.length(high_x - low_x) + "\" height=\"" +
            side.length(high_z - low_z) + "\"/>\n";
  }
  std::string path;
  for (const auto& s : segments) {
    path += "M" + side.x(s[0][0]) + " " + side.y(s[0][1]) + "L" + side.x(s[1][0]) + " " +
            side.y(s[1][1]);
  }
  return text + "<path fill=\"none\" stroke=\"#000\" d=\"" + path + "\"/></g>\n";
}

}  // namespace

std::string setup_picture(const scenario::Setup& setup) {
  bodies::BodySet bodies;
  for (const auto& spec : setup.bodies) bodies.push_back(bodies::make_body(setup, spec, nullptr));
  const Side side(setup.domain);
  const std::string size =
      "width=\"" + Side::text(side.width()) + "\" height=\"" + Side::text(side.height()) + "\"";
  std::string text = "<svg xmlns=\"http://www.w3.org/2000/svg\" " + side.frame() + ">\n" + k_maker +
                     "\n<title>" + xml_text(setup.name) +
                     "</title>\n<clipPath id=\"domain\"><rect " + size +
                     "/></clipPath>\n<g clip-path=\"url(#domain)\">\n";
  const auto outline = report::outline_of(setup.domain, bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    text += body_group(side, bodies[b].name, outline[b]["segments"],
                       report::section_of(setup.domain, bodies[b]));
  }
  return text + "</g>\n<rect fill=\"none\" stroke=\"#888\" " + size + "/>\n</svg>\n";
}

std::string picture_name_problem(const std::string& name) {
  std::error_code none;
  if (!std::filesystem::exists(name, none)) return {};
  constexpr std::size_t k_head = 400;
  const bool is_own = std::filesystem::is_regular_file(name, none) &&
                      io::read_text(name).substr(0, k_head).find(k_maker) != std::string::npos;
  return is_own ? "" : name + ": exists and is no picture of this engine; give another name";
}

}  // namespace dust::engine
