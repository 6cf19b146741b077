// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <filesystem>
#include <string>

namespace dust::io {

/// Name of the script in a run's folder. Not paraview.py: Python would take that for ParaView.
inline constexpr const char* k_paraview_state = "paraview_state.py";

/// A script that opens the XDMF files of a run's `folder` in ParaView: grains as spheres of their
/// size, bodies, a slice of the fluid. Python and not .pvsm: a state file names the proxies of one
/// version of ParaView, paraview.simple is kept from version to version. `min` and `max` [m] are
/// the corners of the domain.
std::string paraview_state(const std::filesystem::path& folder, sdk::Vec3 min, sdk::Vec3 max);

}  // namespace dust::io
