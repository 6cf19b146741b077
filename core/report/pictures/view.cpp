// SPDX-License-Identifier: Apache-2.0
#include "report/fluid_grid.hpp"
#include "report/pictures/pictures.hpp"
#include "report/run_text.hpp"

#include <yaml-cpp/yaml.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <limits>

namespace dust::report {

namespace {

using nlohmann::json;

constexpr std::size_t k_triangles = 20000;

bool is_point(const json& value) {
  return value.is_array() && value.size() == 2 && value[0].is_number() && value[1].is_number();
}

/// [[x, z], ...] or a list of such lists: always the latter comes back.
json rings_of(const json& value) {
  json rings = json::array();
  if (value.empty()) return rings;
  if (is_point(value[0])) {
    if (std::all_of(value.begin(), value.end(), is_point)) rings.push_back(value);
    return rings;
  }
  for (const json& ring : value) {
    if (ring.is_array() && std::all_of(ring.begin(), ring.end(), is_point)) rings.push_back(ring);
  }
  return rings;
}

/// [x, z, x, z] or [[x, z], [x, z]] each, or one chain of points: flat quadruples come back.
json segments_of(const json& value) {
  json segments = json::array();
  const auto is_number = [](const json& v) { return v.is_number(); };
  for (std::size_t k = 0; k < value.size(); ++k) {
    const json& part = value[k];
    if (is_point(part)) {
      if (k + 1 < value.size() && is_point(value[k + 1])) {
        segments.push_back({part[0], part[1], value[k + 1][0], value[k + 1][1]});
      }
    } else if (part.is_array() && part.size() == 2 && is_point(part[0]) && is_point(part[1])) {
      segments.push_back({part[0][0], part[0][1], part[1][0], part[1][1]});
    } else if (part.is_array() && part.size() == 4 &&
               std::all_of(part.begin(), part.end(), is_number)) {
      segments.push_back(part);
    }
  }
  return segments;
}

/// A length as scenarios write it, in m: "0.35" or "350 mm"; NaN when it is neither.
double length_of(const std::string& text) {
  char* end = nullptr;
  const double value = std::strtod(text.c_str(), &end);
  std::string unit(end);
  unit.erase(0, unit.find_first_not_of(' '));
  for (const auto& [name, factor] :
       {std::pair{"", 1.0}, {"m", 1.0}, {"cm", 1e-2}, {"mm", 1e-3}, {"um", 1e-6}}) {
    if (end != text.c_str() && unit == name) return value * factor;
  }
  return std::nan("");
}

/// [x, y, z] in m; a unit on the last component alone holds for all. Empty when it is anything
/// else.
std::vector<double> corner_of(const YAML::Node& node) {
  if (!node.IsSequence() || node.size() != 3) return {};
  std::vector<std::string> texts;
  for (const YAML::Node& part : node) {
    if (!part.IsScalar()) return {};
    texts.push_back(part.Scalar());
  }
  const auto at = texts[2].find_first_of("mcu");
  for (std::size_t k = 0; k < 2 && at != std::string::npos; ++k) {
    if (texts[k].find_first_of("mcu") == std::string::npos) texts[k] += " " + texts[2].substr(at);
  }
  std::vector<double> corner;
  corner.reserve(texts.size());
  for (const std::string& text : texts) corner.push_back(length_of(text));
  return corner;
}

/// The domain of scenario.yaml; empty when it cannot be read.
Box domain_of(const std::string& scenario) {
  try {
    const YAML::Node domain = YAML::Load(scenario)["domain"];
    const auto low = corner_of(domain["min"]), high = corner_of(domain["max"]);
    if (low.size() == 3 && high.size() == 3) {
      return {{low[0], low[1], low[2]}, {high[0], high[1], high[2]}};
    }
  } catch (const YAML::Exception&) {
    // A report of a damaged scenario file shows what the grains span.
  }
  return {};
}

/// The grid of the fluid; empty without one.
Box grid_of(const H5Source& source) {
  const auto grid = fluid_grid_of(source);
  if (!grid) return {};
  Box box;
  for (std::size_t d = 0; d < 3; ++d) {
    box.min[d] = grid->origin[d];
    box.max[d] = grid->origin[d] + grid->spacing[d] * static_cast<double>(grid->count[d]);
  }
  return box;
}

void widen(Box& box, const std::vector<float>& points) {
  for (std::size_t k = 0; k < points.size(); ++k) {
    const double value = points[k];
    if (!std::isfinite(value)) continue;
    box.min[k % 3] = std::min(box.min[k % 3], value);
    box.max[k % 3] = std::max(box.max[k % 3], value);
  }
}

/// The newest wall surfaces seen along y: their triangles, projected, cover the silhouette.
json walls_of(const H5Source& source) {
  const auto names = source.frames("/walls");
  if (names.empty()) return json::array();
  const std::string frame = "/walls/" + names.back();
  const auto points = source.floats(frame + "/points");
  const auto corners = source.integers(frame + "/triangles");
  json flat = json::array();
  for (std::size_t k = 0; k + 2 < corners.size() && k < 3 * k_triangles; k += 3) {
    for (std::size_t c = 0; c < 3; ++c) {
      const auto at = static_cast<std::size_t>(corners[k + c]);
      if (corners[k + c] < 0 || 3 * at + 2 >= points.size()) return json::array();
      flat.push_back(points[3 * at]);
      flat.push_back(points[3 * at + 2]);
    }
  }
  if (flat.empty()) return json::array();
  return json::array({{{"name", "walls"},
                       {"polygons", json::array()},
                       {"segments", json::array()},
                       {"triangles", flat}}});
}

}  // namespace

View View::with(double x, double z) const {
  if (!std::isfinite(x) || !std::isfinite(z)) return *this;
  if (min_x == 0.0 && max_x == 0.0 && min_z == 0.0 && max_z == 0.0) return {x, z, x, z};
  return {std::min(min_x, x), std::min(min_z, z), std::max(max_x, x), std::max(max_z, z)};
}

Box box_of(const H5Source& source, const std::string& scenario) {
  for (const Box& box : {grid_of(source), domain_of(scenario)}) {
    if (!box.is_empty()) return box;
  }
  constexpr double k_far = std::numeric_limits<double>::infinity();
  Box box{{k_far, k_far, k_far}, {-k_far, -k_far, -k_far}};
  for (const char* group : {"/particles", "/walls"}) {
    const char* points = group == std::string("/walls") ? "/points" : "/position";
    for (const auto& name : source.frames(group)) {
      widen(box, source.floats(std::string(group) + "/" + name + points));
    }
  }
  if (!(box.max[0] >= box.min[0])) return {};
  // A margin, and some depth for a single grain.
  double size = 1e-3;
  for (std::size_t d = 0; d < 3; ++d) size = std::max(size, box.max[d] - box.min[d]);
  for (std::size_t d = 0; d < 3; ++d) {
    box.min[d] -= 0.04 * size;
    box.max[d] += 0.04 * size;
  }
  return box;
}

View view_of(const H5Source& source, const json& bodies, const std::string& scenario) {
  for (const Box& box : {grid_of(source), domain_of(scenario)}) {
    const View view{box.min[0], box.min[2], box.max[0], box.max[2]};
    if (!view.is_empty()) return view;
  }
  View view;
  for (const auto& name : source.frames("/particles")) {
    const auto position = source.floats("/particles/" + name + "/position");
    for (std::size_t k = 0; k + 2 < position.size(); k += 3) {
      view = view.with(position[k], position[k + 2]);
    }
  }
  for (const json& body : bodies) {
    for (const json& ring : list_at(body, "polygons")) {
      for (const json& point : ring) {
        view = view.with(point[0].get<double>(), point[1].get<double>());
      }
    }
    for (const json& part : list_at(body, "segments")) {
      view = view.with(part[0].get<double>(), part[1].get<double>());
      view = view.with(part[2].get<double>(), part[3].get<double>());
    }
  }
  // A margin, and some width for a single grain.
  const double size = std::max({view.max_x - view.min_x, view.max_z - view.min_z, 1e-3});
  if (view.max_x - view.min_x == 0.0 && view.max_z - view.min_z == 0.0 && view.max_x == 0.0)
    return {};
  return {view.min_x - 0.04 * size, view.min_z - 0.04 * size, view.max_x + 0.04 * size,
          view.max_z + 0.04 * size};
}

json bodies_of(const json& report, const H5Source& source) {
  json bodies = json::array();
  for (const json& part : list_at(report, "outline")) {
    json polygons = rings_of(list_at(part, "polygons"));
    json segments = segments_of(list_at(part, "segments"));
    if (polygons.empty() && segments.empty()) continue;
    bodies.push_back({{"name", text_at(part, "body")},
                      {"polygons", std::move(polygons)},
                      {"segments", std::move(segments)},
                      {"triangles", json::array()}});
  }
  return bodies.empty() ? walls_of(source) : bodies;
}

}  // namespace dust::report
