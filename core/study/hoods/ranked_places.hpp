// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "setup/dust_setup.hpp"
#include "setup/setup.hpp"
#include "study/hoods/hood_scene.hpp"

#include <optional>
#include <span>
#include <string>
#include <vector>

namespace dust::study {

/// An opening by which a hood of the run draws already.
struct ExistingHood {
  std::string name;  ///< of the body or side
  sdk::Vec3 min;     ///< [m] box round the opening, flat or nearly so, in `frame` or the domain's
  sdk::Vec3 max;
  std::optional<scenario::FrameSpec> frame = std::nullopt;
};

/// Those of a scenario.
[[nodiscard]] std::vector<ExistingHood> existing_hoods(const scenario::Setup& setup,
                                                       const scenario::DustSetup& dust);

/// Whether a point lies where a hood draws air already: not farther from its opening than the root
/// of the opening's area, where the speed has fallen to a tenth of that in the opening
/// (v / v0 = 1 / (1 + 10 x^2 / A), Dalla Valle, in ACGIH, Industrial Ventilation).
[[nodiscard]] bool is_within_reach(sdk::Vec3 point, const ExistingHood& hood);

/// A place left out, for a hood draws there already.
struct ReachedPlace {
  int place = 0;     ///< its number
  std::string hood;  ///< of the run
};

/// The places that are worth a hood.
struct RankedPlaces {
  std::vector<LowPressurePlace> places;  ///< those with most dust near them first
  std::vector<ReachedPlace> reached;     ///< by hoods that draw already
};

/// Ranks places by the concentration of dust within one `opening` [m] of them, to each side: all
/// are tried with the same flows, so that what a hood draws at first goes by it. Where it is the
/// same, as where there is no dust, the deeper place comes first.
[[nodiscard]] RankedPlaces ranked_places(std::span<const LowPressurePlace> places,
                                         std::span<const ExistingHood> hoods, double opening,
                                         const HoodScene& scene);

}  // namespace dust::study
