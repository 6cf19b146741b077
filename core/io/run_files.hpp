// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "bodies/body_set.hpp"
#include "dust/sdk/archive.hpp"
#include "dust/sdk/sensor.hpp"
#include "io/input_files.hpp"

#include <cstdint>
#include <filesystem>
#include <functional>
#include <memory>
#include <span>
#include <string>
#include <vector>

namespace dust::io {

/// Whether files may be read in one thread while another writes (HDF5 built thread-safe, as Debian
/// does).
[[nodiscard]] bool may_read_while_writing();

/// To be called before anything else of this room: at the end of the program HDF5 leaves its
/// objects to the system. Every file is closed by then; of a damaged one it cannot close what it
/// has read, and says so for ever.
void leave_hdf5_open_at_exit();

/// A field of a sensor, as it is written with a frame.
struct SensorField {
  std::string sensor;
  std::string name;
  std::string unit;
  sdk::GridShape grid;
  std::vector<double> values;  ///< one per cell, x fastest
  std::string role;            ///< what the field is, as summary.json names it
  std::string quantity;        ///< "" = not said
};

/// One frame's data: copies, so that the writer may work while the run goes on. The spans of
/// `world` point into columns kept alive by the caller for the duration of the call.
struct Frame {
  std::int64_t number = 0;
  double time = 0.0;
  sdk::WorldView world;
  std::span<const float> momentum_exchange;  ///< [N/m3] 3 per cell; empty without fluid
  /// Bodies that are not always where they were, to be written with the frame; null: they are.
  const bodies::BodySet* bodies = nullptr;
  std::vector<SensorField> fields;
  std::vector<SensorField> fluid_fields;  ///< more of the fluid's cells, beside its own: no sensor
};

/// results.h5, the three XDMF files and a script that opens them in ParaView. Every frame is
/// complete when append() returns: the HDF5 file is closed and the XDMF files are renamed into
/// place, so that a kill loses none. A power cut may, until sync().
///
/// Layout, as seen through results.h5; n grains, cells (nz, ny, nx), m points, t triangles; every
/// dataset has the attributes `units` and `long_name`; <frame> has six digits:
///
///   /                    attributes format (1), material_names
///   /particles/<frame>   attribute time [s]; position, velocity, angular_velocity, force (n, 3)
///   f32,
///                        diameter, weight, mass (n) f32, material (n) i32, id (n) i64
///   /fluid               attributes origin, spacing, count (x, y, z), density, viscosity;
///                        open_fraction (nz, ny, nx) f32; none of them in runs without fluid
///   /fluid/<frame>       attribute time [s]; velocity, momentum_exchange (nz, ny, nx, 3) f32,
///                        pressure, void_fraction (nz, ny, nx) f32; with a dust field
///                        dust_<class> [kg/m3 of fluid], dust_deposit_<class> [kg] (nz, ny, nx) f32
///   /walls               attribute names, of the bodies
///   /walls/<frame>       points (m, 3) f32, triangles (t, 3) i32, body (t) i32
///   /sensors/<frame>     only where a sensor writes fields: <sensor>/<field> (nz, ny, nx) f32 with
///                        the attributes origin, spacing, count (x, y, z) of the sensor's own grid,
///                        role and quantity (figure_role.hpp)
///
/// Walls that move or go are written with each frame, others once.
///
/// results.h5 holds links into the folder `frames` beside it (one file per frame, one for the
/// walls, one for the open fraction): copy or move both together.
class ResultsFile {
 public:
  /// `resume_frames` < 0 starts a new file; otherwise frames from that number on are dropped.
  ResultsFile(std::filesystem::path folder, std::int64_t resume_frames,
              const bodies::BodySet& bodies, const std::vector<std::string>& material_names,
              sdk::Vec3 domain_min, sdk::Vec3 domain_max);
  ~ResultsFile();
  void append(const Frame& frame);
  /// Waits until the frames are on the disk. Before a checkpoint, which counts on them.
  void sync();

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// series.csv: a header with `name [unit]`, one row per sample, flushed with every row.
class SeriesFile {
 public:
  /// `resume_rows` < 0 starts a new file; otherwise it is cut back to that many rows.
  SeriesFile(std::filesystem::path file, std::int64_t resume_rows);
  ~SeriesFile();
  void append(std::span<const std::string> names_with_units, std::span<const double> values);
  /// Waits until the rows are on the disk. Before a checkpoint, which counts on them.
  void sync();
  [[nodiscard]] std::int64_t rows() const;

 private:
  struct Impl;
  std::unique_ptr<Impl> impl_;
};

/// Writes a checkpoint to a temporary file, syncs it and renames it into place. `parts` are
/// (group name, save function).
void write_checkpoint(
    const std::filesystem::path& file, const ScenarioIdentity& scenario,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveWriter&)>>>& parts);

/// Reads a checkpoint; throws base::UserError when it is missing, damaged or of another scenario
/// (`scenario` differs in anything but time.end and how often is written, or other things stand in
/// the files that it reads; the message shows the first difference). The state that the run began
/// with is no such file: it is not read again.
Resumption read_checkpoint(
    const std::filesystem::path& file, const ScenarioIdentity& scenario,
    const std::vector<std::pair<std::string, std::function<void(sdk::ArchiveReader&)>>>& parts);

/// SHA-256, streaming.
class Sha256 {
 public:
  Sha256();
  void update(const void* data, std::size_t bytes);
  [[nodiscard]] std::string hex_digest();

 private:
  std::uint32_t state_[8];
  std::uint8_t block_[64];
  std::size_t used_ = 0;
  std::uint64_t total_ = 0;
  void compress(const std::uint8_t* block);
};

}  // namespace dust::io
