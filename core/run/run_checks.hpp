// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/sensor.hpp"
#include "particles/dem.hpp"

#include <string>

namespace dust::run {

/// Throws ModelError, with likely causes, where a position or velocity is not a number.
void check_finite(const sdk::GrainColumns& particles);

/// What the largest overlaps of a run tell of it at its end, "" where they are small enough: above
/// 0.3 of the radius a warning, above 1 a strong one, each with the likely causes. `expected_speed`
/// [m/s]: that its steps are made for.
std::string overlap_warning(const particles::DemReport& report, double expected_speed);

/// What an account of energy that does not close tells of a run, "" where a tenth of what was
/// turned over holds the error.
std::string energy_warning(const particles::EnergyBalance& balance);

}  // namespace dust::run
