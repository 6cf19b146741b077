// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/run_files.hpp"
#include "io/xdmf.hpp"

#include <string>
#include <vector>

namespace dust::io {

/// Datasets of a frame, shared by the writer and the XDMF text.
struct FieldInfo {
  const char* name;
  int components;    ///< 1 or 3
  const char* type;  ///< XDMF's word: Float or Int
  int bytes;         ///< of one number
  const char* units;
  const char* long_name;
};
const std::vector<FieldInfo>& particle_fields();  ///< the first one is the position
const std::vector<FieldInfo>& fluid_fields();

/// Folder of the frame files below the run's folder.
inline constexpr const char* k_frame_folder = "frames";
/// "frames/000012.h5" and the like, relative to the run's folder.
std::string frame_path(std::int64_t number);
std::string six_digits(std::int64_t number);
inline constexpr const char* k_walls_path = "frames/walls.h5";
inline constexpr const char* k_open_fraction_path = "frames/open_fraction.h5";

/// Writes one frame to its own file, complete or not at all: `/particles`, with fluid `/fluid`,
/// `/walls` if they change, and `/sensors` if any writes fields.
FrameEntry write_frame(const std::filesystem::path& folder, const Frame& frame);
/// What is known of a frame from its file; throws base::RunError when it cannot be read.
FrameEntry read_frame_entry(const std::filesystem::path& folder, std::int64_t number);

/// The fluid's layout, which does not change during a run, and the open fraction; where bodies move
/// or go, each frame has its own as well.
void write_open_fraction(const std::filesystem::path& folder, const sdk::FluidColumns& fluid);
/// The layout as attributes of an open HDF5 group.
void write_layout(std::int64_t group, const FluidLayout& layout);
FluidLayout layout_of(const sdk::FluidColumns& fluid);
FluidLayout read_fluid_layout(const std::filesystem::path& folder);

/// The bodies' surfaces inside the domain as the scenario puts them, welded at equal corners.
WallLayout write_walls(const std::filesystem::path& folder, const bodies::BodySet& bodies,
                       sdk::Vec3 min, sdk::Vec3 max);

}  // namespace dust::io
