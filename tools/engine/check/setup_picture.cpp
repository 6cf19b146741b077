// SPDX-License-Identifier: Apache-2.0
#include "check/setup_picture.hpp"

#include "base/text.hpp"
#include "bodies/body_set.hpp"
#include "check/picture_frame.hpp"
#include "check/picture_labels.hpp"
#include "check/setup_marks.hpp"
#include "io/atomic_file.hpp"
#include "report/pictures/outline.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <array>
#include <cmath>
#include <filesystem>

namespace dust::engine {
namespace {

using Frame = PictureFrame;
using Kind = SetupMark::Kind;

constexpr const char* k_maker = "<!-- set-up drawn by engine check -->";
/// Of belts, feeds, openings and the names of bodies, as in SetupMark::Kind.
constexpr std::array<const char*, 4> k_colours = {"#0a6b50", "#c2410c", "#1d4ed8", "#556"};
constexpr double k_arrow = 64.0;
constexpr double k_thinnest = 5.0;
/// Openings larger than that let names stand in them.
constexpr double k_large = 400.0;
/// [-] Of a way in the picture's plane: a smaller one goes along the line of sight.
constexpr double k_across = 0.3;
/// More names than this hide the picture: those of bodies at rest are left out then.
constexpr std::size_t k_max_names = 30;

const char* colour_of(const SetupMark& mark) {
  return k_colours[static_cast<std::size_t>(mark.kind)];
}

std::string body_group(const Frame& frame, const std::string& name, const nlohmann::json& segments,
                       const nlohmann::json& section) {
  std::string text = "<g><title>" + xml_text(name) + "</title>\n";
  for (const auto& r : section) {
    const double low_x = r[0], low_z = r[1], high_x = r[2], high_z = r[3];
    text += R"(<rect fill="#c6ccd6" shape-rendering="crispEdges" x=")" +
            Frame::text(frame.x(low_x)) + "\" y=\"" + Frame::text(frame.y(high_z)) + "\" width=\"" +
            Frame::text(frame.length(high_x - low_x)) + "\" height=\"" +
            Frame::text(frame.length(high_z - low_z)) + "\"/>\n";
  }
  std::string path;
  for (const auto& s : segments) {
    path += "M" + Frame::text(frame.x(s[0][0])) + " " + Frame::text(frame.y(s[0][1])) + "L" +
            Frame::text(frame.x(s[1][0])) + " " + Frame::text(frame.y(s[1][1]));
  }
  return text + "<path fill=\"none\" stroke=\"#223\" stroke-width=\"1.1\" d=\"" + path +
         "\"/></g>\n";
}

/// An arrow with its tail at a point, as long as the way lies in the picture; one that goes along
/// the line of sight is a ring with a dot (towards the eye) or a cross.
std::string arrow(double x, double y, sdk::Vec3 way, const char* colour) {
  const std::string stroke = std::string("stroke=\"") + colour + "\" stroke-width=\"2.6\"";
  const double flat = std::hypot(way.x, way.z);
  if (flat < k_across) {
    if (way.y == 0.0) return {};
    const std::string at = "cx=\"" + Frame::text(x) + "\" cy=\"" + Frame::text(y) + "\"";
    std::string text = "<circle fill=\"#fff\" " + stroke + " " + at + " r=\"10\"/>\n";
    if (way.y < 0.0) {
      return text + "<circle fill=\"" + colour + "\" " + at + " r=\"3.5\"/>\n";
    }
    return text + "<path " + stroke + " d=\"M" + Frame::text(x - 7.0) + " " + Frame::text(y - 7.0) +
           "l14 14m0 -14l-14 14\"/>\n";
  }
  const double dx = way.x / flat;
  const double dy = -way.z / flat;
  const double tip_x = x + k_arrow * dx;
  const double tip_y = y + k_arrow * dy;
  const auto point = [&](double back, double aside) {
    return Frame::text(tip_x - back * dx - aside * dy) + "," +
           Frame::text(tip_y - back * dy + aside * dx);
  };
  return "<path fill=\"none\" " + stroke + " d=\"M" + Frame::text(x) + " " + Frame::text(y) + "L" +
         point(10.0, 0.0) + "\"/>\n<polygon fill=\"" + colour + "\" points=\"" + point(0.0, 0.0) +
         " " + point(15.0, 6.5) + " " + point(15.0, -6.5) + "\"/>\n";
}

/// Belts: an arrow beside the belt. Others: their box, and an arrow out of its middle or to it.
std::string drawn(const Frame& frame, const SetupMark& mark, PictureLabels& labels) {
  const char* colour = colour_of(mark);
  const double x = frame.x(0.5 * (mark.low.x + mark.high.x));
  double y = frame.y(0.5 * (mark.low.z + mark.high.z));
  const double flat = std::hypot(mark.way.x, mark.way.z);
  const double before = mark.kind == Kind::belt ? 0.5 : mark.is_end ? 1.0 : 0.0;
  const double back = flat < k_across ? 0.0 : before * k_arrow / flat;
  std::string text;
  if (mark.kind == Kind::belt) {
    y -= 16.0;
    text = arrow(x - back * mark.way.x, y + back * mark.way.z, mark.way, colour);
  } else {
    const double width = std::max(frame.length(mark.high.x - mark.low.x), k_thinnest);
    const double height = std::max(frame.length(mark.high.z - mark.low.z), k_thinnest);
    text = "<rect fill=\"" + std::string(colour) + "\" fill-opacity=\"0.25\" stroke=\"" + colour +
           "\" stroke-width=\"1.4\" x=\"" + Frame::text(x - 0.5 * width) + "\" y=\"" +
           Frame::text(y - 0.5 * height) + "\" width=\"" + Frame::text(width) + "\" height=\"" +
           Frame::text(height) + "\"/>\n" +
           arrow(x - back * mark.way.x, y + back * mark.way.z, mark.way, colour);
    if (width + height < k_large) {
      labels.keep_free(x - 0.5 * width, y - 0.5 * height, x + 0.5 * width, y + 0.5 * height);
    }
  }
  const double far = mark.is_end ? -k_arrow : k_arrow;
  const double tip_x = x + far * mark.way.x;
  const double tip_y = y - far * mark.way.z;
  const bool is_belt = mark.kind == Kind::belt;
  labels.keep_free(std::min(is_belt ? x - 0.5 * k_arrow : x, tip_x) - 8.0, std::min(y, tip_y) - 8.0,
                   std::max(x, tip_x) + 8.0, std::max(y, tip_y) + 8.0);
  return "<g><title>" + xml_text(mark.text) + "</title>\n" + text + "</g>\n";
}

/// Walls are full lines, open sides dashed, periodic ones dotted.
std::string borders(const Frame& frame, const scenario::Setup& setup) {
  const std::string w = Frame::text(frame.width());
  const std::string h = Frame::text(frame.height());
  struct Border {
    std::size_t side;
    std::string path;
  };
  const Border all[] = {
      {0, "M0 0V" + h}, {1, "M" + w + " 0V" + h}, {4, "M0 " + h + "H" + w}, {5, "M0 0H" + w}};
  std::string text;
  for (const Border& b : all) {
    const auto grains = setup.domain.sides[b.side].grains;
    const char* dash = grains == scenario::GrainSide::wall   ? "\" stroke-width=\"2.6"
                       : grains == scenario::GrainSide::open ? "\" stroke-dasharray=\"9 6"
                                                             : "\" stroke-dasharray=\"2 4";
    text += "<path fill=\"none\" stroke=\"#223" + std::string(dash) + "\" d=\"" + b.path + "\"/>\n";
  }
  return text;
}

std::string legend(const Frame& frame) {
  constexpr std::array<const char*, 3> k_words = {"belt and its way", "feed", "opening for air"};
  std::string text;
  double x = 0.0;
  const double y = frame.height() + 62.0;
  for (std::size_t n = 0; n < k_words.size(); ++n) {
    text += "<rect fill=\"" + std::string(k_colours[n]) + "\" x=\"" + Frame::text(x) + "\" y=\"" +
            Frame::text(y - 10.0) + "\" width=\"12\" height=\"12\"/>\n" +
            label_text(x + 18.0, y + 1.0, k_words[n], "#223", "start", 14.0);
    x += 46.0 + 7.6 * std::string(k_words[n]).size();
  }
  return text + label_text(0.0, y + 24.0, "sides: full line wall, dashed open, dotted periodic",
                           "#667", "start", 14.0);
}

}  // namespace

std::string setup_picture(const scenario::Setup& setup, const scenario::DustSetup& dust,
                          const registry::Registry& registry, const preflight::Derived& derived) {
  bodies::BodySet bodies;
  for (const auto& spec : setup.bodies) bodies.push_back(bodies::make_body(setup, spec, nullptr));
  const Frame frame(setup.domain);
  const std::string size =
      "width=\"" + Frame::text(frame.width()) + "\" height=\"" + Frame::text(frame.height()) + "\"";
  std::string text = frame.head() + k_maker + "\n<title>" + xml_text(setup.name) +
                     "</title>\n<rect fill=\"#fff\" x=\"-5000\" y=\"-5000\" width=\"20000\" "
                     "height=\"20000\"/>\n<clipPath id=\"domain\"><rect " +
                     size + "/></clipPath>\n" + frame.axes() + "<g clip-path=\"url(#domain)\">\n";
  const auto outline = report::outline_of(setup.domain, bodies);
  for (std::size_t b = 0; b < bodies.size(); ++b) {
    text += body_group(frame, bodies[b].name, outline[b]["segments"],
                       report::section_of(setup.domain, bodies[b]));
  }
  text += "</g>\n" + borders(frame, setup);
  const std::vector<SetupMark> marks = setup_marks(setup, dust, registry, derived);
  PictureLabels labels(frame);
  for (const SetupMark& mark : marks) {
    if (mark.kind != Kind::body) text += drawn(frame, mark, labels);
  }
  for (const SetupMark& mark : marks) {
    if (mark.text.empty() || (mark.kind == Kind::body && marks.size() > k_max_names)) continue;
    const double middle_y = frame.y(0.5 * (mark.low.z + mark.high.z));
    text += labels.put(frame.x(0.5 * (mark.low.x + mark.high.x)),
                       mark.kind == Kind::belt ? middle_y - 16.0 : middle_y, mark.text,
                       colour_of(mark));
  }
  const sdk::Vec3 edges = setup.domain.max - setup.domain.min;
  return text + label_text(0.0, -26.0, setup.name, "#111", "start", 20.0) +
         label_text(
             0.0, -8.0,
             "from the side, along y; domain " + base::extent_text({edges.x, edges.y, edges.z}),
             "#667", "start", 14.0) +
         frame.scale_bar() + legend(frame) + "</svg>\n";
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
