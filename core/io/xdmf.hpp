// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/vec3.hpp"

#include <cstdint>
#include <string>
#include <vector>

namespace dust::io {

struct WallLayout {
  std::int64_t points = 0;
  std::int64_t triangles = 0;
};

/// What the XDMF files need to know of a frame on disk.
struct FrameEntry {
  std::int64_t number = 0;
  double time = 0.0;
  std::int64_t grains = 0;
  bool has_walls = false;  ///< of its own
  WallLayout walls;
  bool has_fields = false;  ///< of sensors
};

/// Extents of the fluid fields; no cells without fluid.
struct FluidLayout {
  sdk::Vec3 origin;
  sdk::Vec3 spacing;
  int count[3] = {0, 0, 0};
  double density = 0.0;
  double viscosity = 0.0;
  [[nodiscard]] bool is_empty() const { return count[0] * count[1] * count[2] == 0; }
};

/// The text of the three XDMF files (version 2) for ParaView's "XDMF Reader" (Xdmf2 inside ParaView
/// 5.11). They name the frame files directly: that reader follows no external links.
///
/// Two limits of that reader shape the text: a collection without grids and a grid without points
/// crash it. A set that is empty therefore becomes one point without a cell at `corner`, the lower
/// corner of the domain, with all of the set's arrays being zero: nothing is drawn, nothing
/// counted.
std::string particles_xdmf(const std::vector<FrameEntry>& frames, sdk::Vec3 corner);
std::string fluid_xdmf(const std::vector<FrameEntry>& frames, const FluidLayout& layout,
                       sdk::Vec3 corner);
std::string walls_xdmf(const std::vector<FrameEntry>& frames, const WallLayout& layout,
                       sdk::Vec3 corner);

}  // namespace dust::io
