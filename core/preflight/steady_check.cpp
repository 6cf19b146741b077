// SPDX-License-Identifier: Apache-2.0
#include "preflight/steady_check.hpp"

#include "base/text.hpp"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <utility>
#include <variant>
#include <vector>

namespace dust::preflight {
namespace {

/// [-] Of the estimate of a stay: means that begin a little sooner are none to speak of.
constexpr double k_slack = 0.1;

/// [s] When the last of the streams that begin before `begin` [s] has come through the domain; 0
/// where none does.
double filled_at(const Derived& derived, double begin) {
  double filled = 0.0;
  for (const EmissionNumbers& e : derived.emissions) {
    if (!(e.mass_flow > 0.0 && e.begin < begin)) continue;
    double sum = 0.0;
    std::size_t passing = 0;
    for (const double stay : e.stays) {
      if (!std::isfinite(stay)) continue;
      sum += stay;
      ++passing;
    }
    // Streams that mostly stay never come to an even flow by passing.
    if (2 * passing <= e.stays.size()) continue;
    filled = std::max(filled, e.begin + sum / static_cast<double>(passing));
  }
  return filled;
}

/// Means that begin at a time, by the key that says so.
struct Means {
  std::string path;
  scenario::Mark where;
  double begin = 0.0;   ///< [s] 0: not given
  double filled = 0.0;  ///< [s] before which they should not begin
};

/// As a sensor is told; 0 for one that is not.
Means means_of(const scenario::SensorSpec& spec, const registry::Registry& registry) {
  const registry::Entry* entry = registry.find(spec.model.kind, spec.model.name);
  if (entry == nullptr) return {};
  const sdk::ParameterSchema& parameters = entry->info.parameters;
  for (std::size_t n = 0; n < parameters.size() && n < spec.model.values.size(); ++n) {
    const std::string& name = parameters[n].name;
    if (name != "steady_after" && name != "averaging_after") continue;
    const auto* begin = std::get_if<double>(&spec.model.values[n]);
    if (begin != nullptr) return {spec.model.path + "." + name, spec.model.where, *begin};
  }
  return {};
}

}  // namespace

void check_steady(const scenario::Setup& setup, const scenario::DustSetup& dust,
                  const registry::Registry& registry, const Derived& derived,
                  scenario::Diagnostics& diagnostics) {
  std::vector<Means> early;
  const auto look = [&](Means means) {
    means.filled = filled_at(derived, means.begin);
    if (means.begin < (1.0 - k_slack) * means.filled) early.push_back(std::move(means));
  };
  for (const scenario::SensorSpec& spec : setup.sensors) look(means_of(spec, registry));
  if (dust.given && dust.field) {
    look({"dust.steady_after", dust.field->where, dust.given->steady_after});
  }
  if (early.empty()) return;
  const auto first = std::min_element(
      early.begin(), early.end(), [](const auto& a, const auto& b) { return a.begin < b.begin; });
  const std::size_t more = early.size() - 1;
  diagnostics.warning(first->where,
                      first->path + ": means begin at " + base::duration_text(first->begin) +
                          ", before the stream has come through the domain, at about " +
                          base::duration_text(first->filled) + ": they hold its beginning" +
                          (more > 0 ? " (so do those of " + std::to_string(more) + " more)" : "") +
                          "; begin them then, and let time.end leave as long again");
}

}  // namespace dust::preflight
