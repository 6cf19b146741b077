// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "preflight/air/side_faces.hpp"
#include "scenario/diagnostics.hpp"
#include "setup/dust_setup.hpp"

#include <array>
#include <vector>

namespace dust::preflight {

/// [m3/s] That a body's opening sucks at `time` [s]; negative: blows.
double suction_at(const scenario::SuctionSpec& suction, double time);

/// Warns of openings and sides that drive the fluid faster than what its equations hold for, a
/// third of the speed of sound in air, and of hoods that draw faster than any plant's: mostly a
/// wrong unit.
void check_driven_speed(const scenario::Setup& setup, const SideModels& sides,
                        const std::vector<scenario::SideOpeningSpec>& openings,
                        scenario::Diagnostics& diagnostics);

/// [m3/s] Into the domain, of each side that drives the fluid at a given rate, where it is largest;
/// 0 of the others and of those that a check has no memory for.
std::array<double, 6> side_flows(const scenario::Setup& setup, const SideModels& sides);

/// [m/s] Largest speed at which sides and openings of bodies drive the fluid, at some times of the
/// run; 0 without any. A side that a check has no memory for counts as none.
double driven_speed(const scenario::Setup& setup, const SideModels& sides);

/// [m/s] The same of what is driven through whole sides: it is the speed of the fluid in much of
/// the domain, unlike that at the edges of an opening.
double wind_speed(const scenario::Setup& setup, const SideModels& sides);

}  // namespace dust::preflight
