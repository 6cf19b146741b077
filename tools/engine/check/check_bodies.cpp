// SPDX-License-Identifier: Apache-2.0
#include "check/check_bodies.hpp"

#include "base/text.hpp"

#include <nlohmann/json.hpp>

#include <algorithm>
#include <sstream>

namespace dust::engine {
namespace {

using preflight::BodySurvey;
using preflight::GapNumbers;

constexpr std::size_t k_max_gaps = 8;

std::string two_digits(double value) { return base::digits_text(value, 2); }

std::string place_text(sdk::Vec3 p) {
  return "(" + base::digits_text(p.x, 3) + ", " + base::digits_text(p.y, 3) + ", " +
         base::digits_text(p.z, 3) + " m)";
}

/// "0.24 of a cell, 0.2 of the largest grain"
std::string ratios(double length, const BodySurvey& s) {
  std::string text;
  if (s.cell > 0.0) text = two_digits(length / s.cell) + " of a cell";
  if (s.largest_grain <= 0.0) return text;
  return text + (text.empty() ? "" : ", ") + two_digits(length / s.largest_grain) +
         " of the largest grain";
}

/// What a gap does to grains.
std::string consequence(double width, const BodySurvey& s) {
  if (s.largest_grain <= 0.0 || width >= s.largest_grain) return "";
  if (width < s.smallest_grain) return "; no grain goes through";
  return "; grains above " + base::length_text(width, 2) + " do not go through and may wedge";
}

void print_gaps(std::ostream& out, const BodySurvey& s) {
  const char* head = "  gaps       ";
  const std::size_t shown = std::min(s.gaps.size(), k_max_gaps);
  for (std::size_t n = 0; n < shown; ++n) {
    const GapNumbers& g = s.gaps[n];
    out << head << g.first << " - " << g.second << ": " << (g.is_whole ? "" : "at most ")
        << base::length_text(g.width, 3) << " at " << place_text(g.place) << ", "
        << ratios(g.width, s) << consequence(g.width, s) << " (" << scenario::place(g.where)
        << ")\n";
    head = "             ";
  }
  if (s.gaps.size() > shown) {
    out << head << "and " << s.gaps.size() - shown << " wider ones below "
        << base::length_text(s.limit, 3) << '\n';
  }
  if (s.cell > 0.0 && std::any_of(s.gaps.begin(), s.gaps.end(),
                                  [&](const GapNumbers& g) { return g.width < 2.0 * s.cell; })) {
    out << head << "the fluid in gaps below two cells is resolved coarsely\n";
  }
  if (!s.unseen.empty()) {
    out << head << "not looked at, too many bodies: " << s.unseen.front()
        << (s.unseen.size() > 1 ? " and " + std::to_string(s.unseen.size() - 1) + " more pairs"
                                : "")
        << '\n';
  }
}

void print_touching(std::ostream& out, const BodySurvey& s) {
  const std::size_t shown = std::min(s.touching.size(), k_max_gaps);
  for (std::size_t n = 0; n < shown; ++n) {
    const auto& t = s.touching[n];
    out << (n == 0 ? "  touching   " : "             ") << t.first << " - " << t.second << " at "
        << place_text(t.place) << '\n';
  }
  if (s.touching.size() > shown) {
    out << "             and " << s.touching.size() - shown << " more pairs\n";
  }
}

}  // namespace

std::string bodies_text(const BodySurvey& s) {
  std::ostringstream out;
  const char* head = "  shapes     ";
  for (const auto& mesh : s.meshes) {
    for (const std::string& note : mesh.notes) {
      out << head << mesh.body << ": " << note << '\n';
      head = "             ";
    }
    if (mesh.thinnest > 0.0) {
      out << head << "thinnest wall about " << base::length_text(mesh.thinnest, 3) << ", "
          << ratios(mesh.thinnest, s) << '\n';
    }
  }
  print_touching(out, s);
  print_gaps(out, s);
  return out.str();
}

void add_bodies_json(const BodySurvey& s, nlohmann::ordered_json& json) {
  if (!s.meshes.empty()) json["meshes"] = nlohmann::ordered_json::array();
  for (const auto& mesh : s.meshes) {
    json["meshes"].push_back(
        {{"body", mesh.body}, {"notes", mesh.notes}, {"thinnest_wall_m", mesh.thinnest}});
  }
  if (!s.touching.empty()) json["touching"] = nlohmann::ordered_json::array();
  for (const auto& t : s.touching) {
    json["touching"].push_back(
        {{"bodies", {t.first, t.second}}, {"place_m", {t.place.x, t.place.y, t.place.z}}});
  }
  if (!s.gaps.empty()) json["gaps"] = nlohmann::ordered_json::array();
  for (const GapNumbers& g : s.gaps) {
    json["gaps"].push_back({{"bodies", {g.first, g.second}},
                            {"width_m", g.width},
                            {"place_m", {g.place.x, g.place.y, g.place.z}},
                            {"is_upper_bound", !g.is_whole},
                            {"where", scenario::place(g.where)}});
  }
}

}  // namespace dust::engine
