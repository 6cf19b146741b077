// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "scenario/diagnostics.hpp"
#include "setup/setup.hpp"

#include <array>
#include <string>
#include <vector>

namespace dust::scenario {

/// A periodic side needs its opposite, for grains and air alike. `is_air_periodic`: as written.
void check_sides(const DomainSpec& domain, const std::array<bool, 6>& is_read,
                 const std::array<bool, 6>& has_air, const std::array<bool, 6>& is_air_periodic,
                 Diagnostics& diagnostics);

/// Steps that must divide each other. `where` are the places of fluid_step, output_every,
/// checkpoint_every, dem_step and end.
struct TimeMarks {
  Mark fluid_step, output_every, checkpoint_every, dem_step, end;
};
void check_time(const TimeSpec& time, const TimeMarks& where, Diagnostics& diagnostics);

/// A time between two things, if any, is a multiple of the fluid step.
void check_multiple(const char* path, double every, double fluid_step, const Mark& where,
                    Diagnostics& diagnostics);

/// Warns of means that begin at `begin` [s], when the run has ended.
void check_begin_of_means(const std::string& path, double begin, double end, const Mark& where,
                          Diagnostics& diagnostics);

/// Every pair of materials that can meet needs an interaction.
void check_pairs(const Setup& setup, const Mark& where, Diagnostics& diagnostics);

}  // namespace dust::scenario
