// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "registry/registry.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <optional>
#include <string>
#include <vector>

namespace dust::preflight {

/// A narrow place between two bodies.
struct GapNumbers {
  std::string first, second;
  scenario::Mark where;  ///< of the second: the later one in the scenario
  double width = 0.0;    ///< [m]
  sdk::Vec3 place;       ///< [m]
  bool is_whole = true;  ///< false: a narrower one may have been missed
};

/// Two bodies that touch or overlap.
struct TouchNumbers {
  std::string first, second;
  sdk::Vec3 place;  ///< [m] where that was found
  /// Where one of them is a belt that runs along the other there.
  struct Crossing {
    std::string belt, other;
    double speed = 0.0;    ///< [m/s]
    scenario::Mark where;  ///< of the other
  };
  std::optional<Crossing> crossing = std::nullopt;
};

/// What is known of a body drawn elsewhere.
struct MeshNumbers {
  std::string body;
  scenario::Mark where;
  std::vector<std::string> notes;  ///< triangles, shells, closed or not
  double thinnest = 0.0;           ///< [m] wall or sheet; 0 = none
};

/// Bodies beside the cells of the fluid and the grains, as the scenario puts them.
struct BodySurvey {
  double cell = 0.0;             ///< [m] smallest edge, 0 without a fluid
  double smallest_grain = 0.0;   ///< [m] 0 without grains
  double largest_grain = 0.0;    ///< [m]
  double limit = 0.0;            ///< [m] gaps below it are listed
  std::vector<GapNumbers> gaps;  ///< narrowest first; bodies that touch have none
  std::vector<TouchNumbers> touching;
  std::vector<MeshNumbers> meshes;
  std::vector<std::string> unseen;  ///< pairs of bodies that the work was not enough for
};

/// Looks for gaps narrower than two cells of the fluid or than the largest grain, and at meshes.
/// Its work is bounded, whatever the scenario: below a second.
BodySurvey survey_bodies(const scenario::Setup& setup, const registry::Registry& registry);

/// Warns of bodies that touch or cross a running belt.
void check_crossings(const BodySurvey& survey, scenario::Diagnostics& diagnostics);

}  // namespace dust::preflight
