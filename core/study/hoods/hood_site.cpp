// SPDX-License-Identifier: Apache-2.0
#include "study/hoods/hood_site.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <tuple>

namespace dust::study {
namespace {

/// A domain narrower than this many openings is spanned by the hood.
constexpr double k_spanned = 1.5;
/// Cells that stay clear beside the duct and before its opening.
constexpr double k_beside = 1.0;
constexpr double k_before = 2.0;

/// A duct with its open end at `middle`, which it leaves along `sign` times `axis`.
struct Duct {
  sdk::Vec3 middle;  ///< [m] of the opening
  int axis = 0;
  double sign = 1.0;
};

class DuctSites {
 public:
  /// `also_spanned`: a direction that is spanned however wide the domain is; -1: none.
  DuctSites(double opening, const HoodScene& scene, int also_spanned = -1)
      : opening_(opening), scene_(scene), clearance_(scene.periodic_clearance()) {
    const auto& spacing = scene.grid().spacing;
    for (int d = 0; d < 3; ++d) {
      spacing_[d] = spacing[static_cast<std::size_t>(d)];
      is_spanned_[static_cast<std::size_t>(d)] =
          d == also_spanned || scene.max()[d] - scene.min()[d] < k_spanned * opening;
    }
    stream_ = scene.middle_of_taken();
  }
  [[nodiscard]] bool is_spanned(int axis) const {
    return is_spanned_[static_cast<std::size_t>(axis)];
  }
  [[nodiscard]] double spacing(int axis) const { return spacing_[axis]; }

  [[nodiscard]] HoodSite site_of(const Duct& duct) const {
    HoodSite site{.axis = duct.axis};
    for (int d = 0; d < 3; ++d) {
      if (d == duct.axis) continue;
      const double half = 0.5 * opening_;
      site.body_min[d] = is_spanned(d) ? scene_.min()[d] : duct.middle[d] - half;
      site.body_max[d] = is_spanned(d) ? scene_.max()[d] : duct.middle[d] + half;
    }
    site.opening_min = site.body_min;
    site.opening_max = site.body_max;
    // Beyond the sides, so that grains that pass through periodic ones meet it all the way.
    for (int d = 0; d < 3; ++d) {
      if (d == duct.axis || !is_spanned(d)) continue;
      const double overhang = std::max(0.5 * opening_, clearance_[d]);
      site.body_min[d] -= overhang;
      site.body_max[d] += overhang;
    }
    const double face = duct.middle[duct.axis];
    const double length = std::max(0.5 * opening_, 2.0 * spacing_[duct.axis]);
    site.opening_min[duct.axis] = site.opening_max[duct.axis] = face;
    site.body_min[duct.axis] = duct.sign > 0.0 ? face : face - length;
    site.body_max[duct.axis] = duct.sign > 0.0 ? face + length : face;
    return site;
  }

  [[nodiscard]] bool fits(const Duct& duct) const {
    const HoodSite site = site_of(duct);
    sdk::Vec3 low = site.body_min, high = site.body_max;
    for (int d = 0; d < 3; ++d) {
      if (is_spanned(d)) {
        low[d] = scene_.min()[d];
        high[d] = scene_.max()[d];
        continue;
      }
      if (low[d] < scene_.min()[d] + clearance_[d]) return false;
      if (high[d] > scene_.max()[d] - clearance_[d]) return false;
      const bool is_axis = d == duct.axis;
      low[d] -= (is_axis && duct.sign > 0.0 ? k_before : k_beside) * spacing_[d];
      high[d] += (is_axis && duct.sign < 0.0 ? k_before : k_beside) * spacing_[d];
    }
    const double face = duct.middle[duct.axis];
    const double front = face - duct.sign * k_before * spacing_[duct.axis];
    if (front < scene_.min()[duct.axis] || front > scene_.max()[duct.axis]) return false;
    return scene_.is_clear(low, high);
  }

  /// [kg] of dust within two openings before the open end, and how far it looks to the stream [m].
  [[nodiscard]] std::pair<double, double> worth_of(const Duct& duct) const {
    const HoodSite site = site_of(duct);
    sdk::Vec3 low = site.opening_min, high = site.opening_max;
    (duct.sign > 0.0 ? low : high)[duct.axis] -= duct.sign * 2.0 * opening_;
    return {scene_.dust_in(low, high), duct.sign * (duct.middle - stream_)[duct.axis]};
  }

 private:
  double opening_;
  const HoodScene& scene_;
  sdk::Vec3 clearance_;  ///< [m] from periodic sides
  sdk::Vec3 spacing_;
  sdk::Vec3 stream_;
  std::array<bool, 3> is_spanned_{};
};

/// Steps of whole cells to every point within `reach` [m] of a place, the nearest first.
std::vector<sdk::Vec3> steps_within(double reach, const DuctSites& sites) {
  std::array<int, 3> most{};
  for (int d = 0; d < 3; ++d) {
    most[static_cast<std::size_t>(d)] =
        sites.is_spanned(d) ? 0 : static_cast<int>(reach / sites.spacing(d));
  }
  std::vector<sdk::Vec3> steps;
  for (int k = -most[2]; k <= most[2]; ++k) {
    for (int j = -most[1]; j <= most[1]; ++j) {
      for (int i = -most[0]; i <= most[0]; ++i) {
        const sdk::Vec3 step{i * sites.spacing(0), j * sites.spacing(1), k * sites.spacing(2)};
        if (norm(step) <= reach) steps.push_back(step);
      }
    }
  }
  std::stable_sort(steps.begin(), steps.end(),
                   [](const sdk::Vec3& a, const sdk::Vec3& b) { return norm(a) < norm(b); });
  return steps;
}

/// Of the volume of a duct, the part that another one takes as well.
double shared_part(const HoodSite& site, const HoodSite& other) {
  double part = 1.0;
  for (int d = 0; d < 3; ++d) {
    const double low = std::max(site.body_min[d], other.body_min[d]);
    const double high = std::min(site.body_max[d], other.body_max[d]);
    part *= std::max(0.0, high - low) / (site.body_max[d] - site.body_min[d]);
  }
  return part;
}

/// The best of the ducts nearest to the place, of those that are asked about.
std::optional<HoodSite> nearest_site(const LowPressurePlace& place, double opening,
                                     const DuctSites& sites, const HoodScene& scene) {
  sdk::Vec3 start = place.position;
  for (int d = 0; d < 3; ++d) {
    if (sites.is_spanned(d)) start[d] = 0.5 * (scene.min()[d] + scene.max()[d]);
  }
  std::optional<Duct> best;
  std::pair<double, double> worth;
  double distance = 0.0;
  for (const sdk::Vec3& step : steps_within(opening, sites)) {
    // Equal but for rounding counts as the same distance.
    if (best && norm(step) > distance * (1.0 + 1e-9)) break;
    for (int axis = 0; axis < 3; ++axis) {
      if (sites.is_spanned(axis)) continue;
      for (const double sign : {1.0, -1.0}) {
        const Duct duct{start + step, axis, sign};
        if (!sites.fits(duct)) continue;
        const auto its = sites.worth_of(duct);
        if (best && its <= worth) continue;
        best = duct;
        worth = its;
        distance = norm(step);
      }
    }
  }
  if (!best) return std::nullopt;
  HoodSite site = sites.site_of(*best);
  site.place = place.number;
  site.dust_near = place.dust_near;
  site.moved = distance;
  return site;
}

}  // namespace

double HoodSite::area() const {
  double area = 1.0;
  for (int d = 0; d < 3; ++d) {
    if (d != axis) area *= opening_max[d] - opening_min[d];
  }
  return area;
}

double usual_opening(const HoodScene& scene) {
  constexpr double k_cells = 4.0;
  constexpr double k_part_of_domain = 1.0 / 16.0;
  double cell = 0.0, longest = 0.0;
  for (int d = 0; d < 3; ++d) {
    const double extent = scene.max()[d] - scene.min()[d];
    if (extent <= longest) continue;
    longest = extent;
    cell = scene.grid().spacing[static_cast<std::size_t>(d)];
  }
  return cell * std::max(k_cells, std::ceil(k_part_of_domain * longest / cell - 1e-6));
}

std::optional<HoodSite> site_at(const LowPressurePlace& place, double opening,
                                const HoodScene& scene) {
  if (const auto site = nearest_site(place, opening, DuctSites(opening, scene), scene)) return site;
  for (int d = 0; d < 3; ++d) {
    if (!(scene.periodic_clearance()[d] > 0.0)) continue;
    const DuctSites spanning(opening, scene, d);
    if (const auto site = nearest_site(place, opening, spanning, scene)) return site;
  }
  return std::nullopt;
}

HoodSites sites_at(std::span<const LowPressurePlace> places, std::size_t count, double opening,
                   const HoodScene& scene) {
  constexpr double k_taken = 0.5;
  HoodSites found;
  for (const LowPressurePlace& place : places) {
    if (found.sites.size() == count) break;
    const auto site = site_at(place, opening, scene);
    if (!site) {
      found.without_room.push_back(place.number);
      continue;
    }
    const auto taken =
        std::find_if(found.sites.begin(), found.sites.end(),
                     [&](const HoodSite& other) { return shared_part(*site, other) > k_taken; });
    if (taken == found.sites.end()) {
      found.sites.push_back(*site);
    } else {
      found.shared.push_back({place.number, taken->place});
    }
  }
  return found;
}

}  // namespace dust::study
