// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "run/simulation.hpp"
#include "run/summary/summary.hpp"

#include <string>

namespace dust::run {

/// That of a run which becomes another plant now.
[[nodiscard]] PlantBegin plant_begin_now(const Simulation& s);
/// That of the plant which runs.
[[nodiscard]] PlantBegin plant_begin(const RunFacts& facts);
/// [kg] Of what is counted under a name (counted_as), by then.
[[nodiscard]] double counted_before(const PlantBegin& begin, const std::string& name);

/// Under what name is counted what `part` of a `way` has of a dust class; of grains and all classes
/// where `of_class` is empty.
[[nodiscard]] std::string counted_as(const std::string& way, const std::string& part,
                                     const std::string& of_class = {});
inline constexpr const char* k_by_hood = "hoods";      ///< grains and field, what is dust
inline constexpr const char* k_by_outlet = "outlets";  ///< of a field, by hood
inline constexpr const char* k_by_side = "sides";      ///< of a field, by side
inline constexpr const char* k_by_cause = "causes";    ///< off grains

}  // namespace dust::run
