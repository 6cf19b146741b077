// SPDX-License-Identifier: Apache-2.0
#include "catalogue/catalogue.hpp"

#include "bodies/shape.hpp"
#include "scenario/text/units.hpp"
#include "scenario/text/values.hpp"

#include <algorithm>
#include <iomanip>

namespace dust::engine {
namespace {

/// "speed [m/s]", "profile (uniform | table)", with its default where it has one.
std::string parameter_text(const sdk::Parameter& p) {
  const std::string unit = scenario::si_unit(p.dimension);
  std::string text = p.name + (unit.empty() ? "" : " [" + unit + "]");
  for (const std::string& option : p.options) {
    text += (&option == &p.options.front() ? " (" : " | ") + option;
  }
  if (!p.options.empty()) text += ")";
  const std::string by_default = p.is_required ? "" : scenario::default_text(p);
  return text + (by_default.empty() ? "" : " = " + by_default);
}

}  // namespace

std::vector<Subject> subjects(const registry::Registry& registry) {
  std::vector<Subject> all;
  for (const auto& entry : registry.entries()) all.push_back({entry.info, entry.file.string()});
  for (const auto& shape : bodies::shape_catalogue()) {
    sdk::ModelInfo info;
    info.kind = "shape";
    info.name = shape.name;
    info.summary = shape.summary;
    info.parameters = shape.parameters;
    all.push_back({info, ""});
  }
  std::stable_sort(all.begin(), all.end(),
                   [](const Subject& a, const Subject& b) { return a.info.kind < b.info.kind; });
  return all;
}

std::vector<std::string> kinds_of(const std::vector<Subject>& all) {
  std::vector<std::string> kinds;
  for (const Subject& one : all) {
    if (kinds.empty() || kinds.back() != one.info.kind) kinds.push_back(one.info.kind);
  }
  return kinds;
}

void print_kind(std::ostream& out, const std::vector<Subject>& all, const std::string& kind,
                bool with_parameters) {
  std::size_t width = 0;
  for (const Subject& one : all) {
    if (one.info.kind == kind) width = std::max(width, one.info.name.size());
  }
  for (const Subject& one : all) {
    if (one.info.kind != kind) continue;
    out << "  " << std::left << std::setw(static_cast<int>(width) + 2) << one.info.name
        << one.info.summary << '\n';
    if (!with_parameters || one.info.parameters.empty()) continue;
    out << "  " << std::string(width + 2, ' ');
    const char* comma = "";
    for (const sdk::Parameter& p : one.info.parameters) {
      out << comma << parameter_text(p);
      comma = ", ";
    }
    out << '\n';
  }
}

}  // namespace dust::engine
