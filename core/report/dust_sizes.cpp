// SPDX-License-Identifier: Apache-2.0
#include "report/dust_sizes.hpp"

#include "report/run_text.hpp"
#include "setup/dust_rule.hpp"

#include <algorithm>
#include <cmath>

namespace dust::report {

namespace {

/// Diameters come as single and as double precision.
bool is_same(double a, double b) { return std::abs(a - b) <= 1e-5 * b; }

}  // namespace

DustSizes::DustSizes() : limit_(scenario::DustRule::k_usual_limit) {}

DustSizes::DustSizes(const nlohmann::json& rule) : DustSizes() {
  if (!rule.is_object() || rule.empty()) return;
  for (const auto& size : list_at(rule, "classes_m")) {
    if (size.is_number()) sizes_.push_back(size.get<double>());
  }
  double finest_other = 0.0, coarsest_dust = 0.0;
  for (const auto& entry : list_at(rule, "size_classes")) {
    const double diameter = number_at(entry, "diameter_m").value_or(0.0);
    const auto is_dust = entry.find("is_dust");
    if (!(diameter > 0.0) || is_dust == entry.end() || !is_dust->is_boolean()) continue;
    classes_.emplace_back(diameter, is_dust->get<bool>());
    if (classes_.back().second) {
      coarsest_dust = std::max(coarsest_dust, diameter);
    } else if (finest_other == 0.0 || diameter < finest_other) {
      finest_other = diameter;
    }
  }
  if (const auto finer = number_at(rule, "finer_than_m")) {
    limit_ = *finer;
  } else if (finest_other > coarsest_dust) {
    limit_ = finest_other;
  } else if (coarsest_dust > 0.0) {
    limit_ = std::nextafter(coarsest_dust, 1.0);
  }
}

bool DustSizes::is_dust(double diameter) const {
  for (const auto& [size, is_dust] : classes_) {
    if (is_same(diameter, size)) return is_dust;
  }
  return takes(diameter);
}

bool DustSizes::takes(double diameter) const {
  const bool is_listed =
      sizes_.empty() || std::any_of(sizes_.begin(), sizes_.end(),
                                    [&](double size) { return is_same(diameter, size); });
  return is_listed && diameter < limit_;
}

}  // namespace dust::report
