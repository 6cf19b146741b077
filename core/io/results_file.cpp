// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "io/atomic_file.hpp"
#include "io/frame_file.hpp"
#include "io/hdf5_file.hpp"
#include "io/paraview/paraview_state.hpp"
#include "io/run_files.hpp"
#include "io/way_on.hpp"
#include "io/xdmf.hpp"

namespace dust::io {
namespace {

namespace fs = std::filesystem;

void link(hid_t file, const std::string& name, const std::string& target, const char* object) {
  const std::string what = "cannot link '" + name + "'";
  const Handle links(H5Pcreate(H5P_LINK_CREATE), H5Pclose, what);
  H5Pset_create_intermediate_group(links.get(), 1);
  if (H5Lcreate_external(target.c_str(), object, file, name.c_str(), links.get(), H5P_DEFAULT) <
      0) {
    throw base::RunError(what);
  }
}

}  // namespace

/// Why one file per frame: HDF5 1.10 has no journal, so a process killed while it writes can leave
/// a file that nobody can open. Here every file is written beside its place and renamed into it,
/// and results.h5 holds nothing but links and attributes, rewritten whole with each frame. A kill
/// loses the frame in progress and nothing else.
struct ResultsFile::Impl {
  fs::path folder;
  std::vector<std::string> material_names;
  std::vector<std::string> body_names;
  sdk::Vec3 domain_min;
  std::vector<FrameEntry> frames;
  FluidLayout fluid;
  WallLayout walls;
  std::vector<fs::path> unsynced;  ///< may still be in the disk's cache alone

  /// Removes frames from `first` on, and whatever a killed run left half-written.
  void drop_frames(std::int64_t first) const {
    for (const fs::directory_entry& entry : fs::directory_iterator(folder / k_frame_folder)) {
      const std::string name = entry.path().filename().string();
      const bool is_frame = entry.path().extension() == ".h5" &&
                            name.find_first_not_of("0123456789") == name.size() - 3;
      const bool is_partial = entry.path().extension() == ".part";
      if (is_partial || (is_frame && std::stoll(name) >= first)) fs::remove(entry.path());
    }
    if (first == 0) fs::remove(folder / k_open_fraction_path);
  }

  void read_frames(std::int64_t count) {
    for (std::int64_t number = 0; number < count; ++number) {
      try {
        frames.push_back(read_frame_entry(folder, number));
      } catch (const base::RunError& e) {
        throw base::UserError("error: " + folder.string() + ": frame " + std::to_string(number) +
                              " of the " + std::to_string(count) +
                              " before the checkpoint is missing: " + e.what() + "; " +
                              way_on_from_checkpoint(folder));
      }
    }
    fluid = read_fluid_layout(folder);
  }

  void write_fluid_attributes(hid_t file) const {
    const Handle group = create_group(file, "fluid");
    if (fluid.is_empty()) return;
    write_layout(group.get(), fluid);
    link(file, "fluid/open_fraction", k_open_fraction_path, "/fluid/open_fraction");
  }

  void write_links() const {
    const fs::path file = folder / "results.h5";
    Handle out = create_file(temporary_name(file));
    write_attribute(out.get(), "format", std::int64_t{1});
    write_attribute(out.get(), "material_names", material_names);
    create_group(out.get(), "particles");
    write_fluid_attributes(out.get());
    write_attribute(create_group(out.get(), "walls").get(), "names", body_names);
    for (const FrameEntry& frame : frames) {
      const std::string number = six_digits(frame.number);
      link(out.get(), "particles/" + number, frame_path(frame.number), "/particles");
      if (!fluid.is_empty()) {
        link(out.get(), "fluid/" + number, frame_path(frame.number), "/fluid");
      }
      link(out.get(), "walls/" + number,
           frame.has_walls ? frame_path(frame.number) : std::string(k_walls_path), "/walls");
      if (frame.has_fields) {
        link(out.get(), "sensors/" + number, frame_path(frame.number), "/sensors");
      }
    }
    out.close("cannot write " + file.string());
    move_into_place(file, false);
  }

  void write_index() const {
    write_links();
    write_text(folder / "particles.xdmf", particles_xdmf(frames, domain_min));
    write_text(folder / "fluid.xdmf", fluid_xdmf(frames, fluid, domain_min));
    write_text(folder / "walls.xdmf", walls_xdmf(frames, walls, domain_min));
  }
};

ResultsFile::ResultsFile(fs::path folder, std::int64_t resume_frames, const bodies::BodySet& bodies,
                         const std::vector<std::string>& material_names, sdk::Vec3 domain_min,
                         sdk::Vec3 domain_max)
    : impl_(std::make_unique<Impl>()) {
  const QuietHdf5 quiet;
  impl_->folder = std::move(folder);
  impl_->material_names = material_names;
  for (const bodies::Body& body : bodies) impl_->body_names.push_back(body.name);
  impl_->domain_min = domain_min;
  make_folder(impl_->folder / k_frame_folder);
  const std::int64_t kept = resume_frames < 0 ? 0 : resume_frames;
  impl_->read_frames(kept);
  if (kept == 0) impl_->fluid = {};
  impl_->walls = write_walls(impl_->folder, bodies, domain_min, domain_max);
  impl_->unsynced.emplace_back(impl_->folder / k_walls_path);
  write_text(impl_->folder / k_paraview_state,
             paraview_state(impl_->folder, domain_min, domain_max));
  // The index first: it never names a frame that is gone.
  impl_->write_index();
  impl_->drop_frames(kept);
}

ResultsFile::~ResultsFile() = default;

void ResultsFile::append(const Frame& frame) {
  const QuietHdf5 quiet;
  if (!impl_->frames.empty() && frame.number <= impl_->frames.back().number) {
    throw base::RunError("frame " + std::to_string(frame.number) + " is written already");
  }
  const FluidLayout layout = layout_of(frame.world.fluid);
  if (impl_->fluid.is_empty() && !layout.is_empty()) {
    write_open_fraction(impl_->folder, frame.world.fluid);
    impl_->unsynced.emplace_back(impl_->folder / k_open_fraction_path);
    impl_->fluid = layout;
  }
  impl_->frames.push_back(write_frame(impl_->folder, frame));
  impl_->unsynced.emplace_back(impl_->folder / frame_path(frame.number));
  impl_->write_index();
}

void ResultsFile::sync() {
  if (impl_->unsynced.empty()) return;
  for (const fs::path& file : impl_->unsynced) sync_file(file);
  sync_folder(impl_->folder / k_frame_folder);
  impl_->unsynced.clear();
}

}  // namespace dust::io
