// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "study/hoods/hood_site.hpp"
#include "study/hoods/ranked_places.hpp"

#include <cstddef>
#include <filesystem>
#include <string>
#include <vector>

namespace dust::study {

/// The body that a study of hoods adds to every point but the plain one; its group names the place.
inline constexpr const char* k_hood_body = "suggested_hood";
/// Of the time of a point: as long as the flow of the hood comes about, nothing is counted.
inline constexpr double k_settling = 1.0 / 3.0;

/// A flow as it was written.
struct HoodFlow {
  double value = 0.0;  ///< [m3/s]
  std::string text;    ///< "60 l/min"
};

/// "20, 60, 120 l/min": a unit on the last holds for all. Throws base::UserError, which names the
/// option.
[[nodiscard]] std::vector<HoodFlow> flows_of(const std::string& text);

/// Flows that draw air in at 0.5, 1, 2 and 4 m/s through an opening of `area` [m2], rounded to two
/// digits: the range of capture velocities at which hoods are laid out (ACGIH, Industrial
/// Ventilation, for dust of conveyors and crushers 0.5 to 2.5 m/s).
[[nodiscard]] std::vector<HoodFlow> usual_flows(double area);

/// What a study of hoods is to hold.
struct HoodStudyOptions {
  std::vector<HoodFlow> flows;  ///< empty: usual_flows
  std::size_t places = 3;       ///< of those with most dust near them (ranked_places)
  double opening = 0.0;         ///< [m] 0: usual_opening
  double duration = 0.0;        ///< [s] of each point; 0: half of what the run took
  std::size_t replicates = 1;   ///< of each point, with other seeds
  std::filesystem::path file;   ///< that it will be written to: paths are seen from there
};

/// A study of hoods as text, and what it tries.
struct HoodStudy {
  std::string text;
  std::vector<HoodSite> sites;
  std::vector<HoodFlow> flows;
  std::vector<int> without_room;      ///< numbers of places where no hood fits
  std::vector<SharedSite> shared;     ///< places whose site one before has taken
  std::vector<ReachedPlace> reached;  ///< places where a hood draws already
  double opening = 0.0;               ///< [m]
  double duration = 0.0;              ///< [s] of each point
  std::size_t replicates = 1;         ///< of each point
  [[nodiscard]] std::size_t points() const {
    return replicates * (1 + sites.size() * flows.size());
  }
};

/// Writes a study of hoods for a finished run: each point goes on from the run's last state with a
/// hood at a place of low pressure, one of them without; at the places with most dust near them
/// that no hood reaches already. Throws base::UserError with the place and
/// a remedy where the run has no dust, no places, no checkpoint or is not finished.
[[nodiscard]] HoodStudy hood_study(const std::filesystem::path& run,
                                   const HoodStudyOptions& options,
                                   const registry::Registry& registry);

}  // namespace dust::study
