// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_class.hpp"
#include "airborne/flow.hpp"
#include "airborne/gas_acceleration.hpp"
#include "airborne/layers.hpp"
#include "airborne/resuspension.hpp"
#include "airborne/surface_transport.hpp"
#include "airborne/transport.hpp"
#include "base/exact_sum.hpp"
#include "dust/sdk/archive.hpp"
#include "fluid/grid.hpp"
#include "setup/dust_setup.hpp"

#include <array>
#include <cstddef>
#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace dust::airborne {

/// Names in a checkpoint of what a field saves, for those who bring it into another scenario.
namespace saved {
inline constexpr const char* k_released = "released";                    ///< [kg]
inline constexpr const char* k_surfaces = "surfaces";                    ///< [kg] by surface
inline constexpr const char* k_carried_out = "carried_out_on_surfaces";  ///< [kg] by surface
inline constexpr const char* k_outlets = "outlets";  ///< [kg/m3] of a cell, by opening
[[nodiscard]] inline std::string of_class(std::size_t size_class, const std::string& name) {
  return "class_" + std::to_string(size_class) + "_" + name;
}
}  // namespace saved

/// What became of the dust of a class since the start [kg]: released = airborne + deposited
/// + carried out + caught + left + drawn out, to rounding.
struct DustBalance {
  double released = 0.0;  ///< what was there at the start included
  double airborne = 0.0;
  std::array<double, 6> left{};     ///< out through the sides
  std::vector<double> outlets;      ///< by hood
  std::vector<double> surfaces;     ///< deposited, by surface: the six sides, then the bodies
  std::vector<double> carried_out;  ///< out of the domain on surfaces that run, by surface
  double caught = 0.0;              ///< by grains that pass through
  double resuspended = 0.0;         ///< of what had been deposited, airborne since
  /// (released - all others) / released; 0 where nothing was.
  [[nodiscard]] double error() const;
};

/// Dust as concentrations, one per size class, on the fluid's grid; docs/theory/dust.md.
class DustField {
 public:
  /// How many hoods and surfaces (sides and bodies) dust may end at, and whether any surface runs.
  struct Ends {
    std::size_t outlets = 0, surfaces = 0;
    bool run = false;
  };
  DustField(const fluid::Grid& grid, const scenario::DustFieldSpec& spec, const Gas& gas,
            sdk::Vec3 gravity, Ends ends);

  /// Puts the clouds of the start into the gas, `volume` [-] of each cell.
  void start(const fluid::CellField& volume);
  /// Bodies stand where none did: what hung in cells without gas goes to the nearest with some;
  /// `volume` [-] of gas in each cell.
  void leave_covered_cells(const fluid::CellField& volume);
  /// One fluid step from `time` [s], `step` [s] long. Throws sdk::ModelError for a source in no
  /// gas.
  void advance(const Flow& flow, double time, double step);
  /// Dust set free in a cell at once [kg]; of the class `n`.
  void release(std::size_t n, std::int32_t cell, double mass);
  /// Grains take this share [-] of what is airborne in a cell. Returns its mass [kg].
  double catch_in(std::size_t n, std::int32_t cell, double share);

  [[nodiscard]] std::size_t classes() const { return classes_.size(); }
  /// Has no dust been released yet?
  [[nodiscard]] bool is_empty() const;
  [[nodiscard]] const DustClass& dust_class(std::size_t n) const { return classes_[n].dust; }
  /// [kg/m3] of gas, in cells filled to `volume`.
  void concentration(std::size_t n, const fluid::CellField& volume, fluid::CellField& c) const;
  /// [kg/m3] of whole cells.
  [[nodiscard]] const fluid::CellField& mass(std::size_t n) const { return classes_[n].mass; }
  /// [kg] on surfaces in each cell.
  [[nodiscard]] fluid::CellField deposit(std::size_t n) const;
  [[nodiscard]] DustBalance balance(std::size_t n) const;
  /// The same without what is airborne, which would take a sum over all cells: for each step.
  [[nodiscard]] DustBalance gone(std::size_t n) const;
  [[nodiscard]] std::int64_t sub_steps() const { return sub_steps_; }
  [[nodiscard]] bool has_sources() const { return !spec_.sources.empty(); }
  /// [kg] of a class that its sources give until `time` [s].
  [[nodiscard]] double given_by_sources(std::size_t n, double time) const;
  /// Do grains catch dust in this run?
  [[nodiscard]] bool has_scavenging() const { return spec_.scavenging; }
  /// Do surfaces carry along what lies on them?
  [[nodiscard]] bool has_running_surfaces() const { return do_surfaces_run_; }
  /// Does the gas take dust off surfaces again?
  [[nodiscard]] bool has_resuspension() const { return resuspension_.has_value(); }

  /// Does dust drift off where the gas turns?
  [[nodiscard]] bool has_inertia() const { return acceleration_.has_value(); }
  /// Share [-] of the airborne dust, in the mean over time, whose drift by inertia was limited, for
  /// the gas turned faster than the expansion for short response times allows.
  [[nodiscard]] double limited_share(std::size_t n) const;

  void save(sdk::ArchiveWriter& archive) const;
  void load(sdk::ArchiveReader& archive);

 private:
  struct Class {
    DustClass dust;
    fluid::CellField mass;            ///< [kg/m3] of whole cells
    fluid::CellField deposit;         ///< [kg]; empty where there are layers, which know it
    base::ExactSum released;          ///< [kg], grain by grain
    base::ExactSum caught;            ///< [kg], cell by cell
    base::ExactSum resuspended;       ///< [kg], piece by piece
    Losses losses;                    ///< of sides and hoods since the start; of walls in this step
    std::vector<double> surfaces;     ///< [kg]
    std::vector<double> carried_out;  ///< [kg] by surface
    double airborne_time = 0.0;       ///< [kg s] airborne dust over time
    double limited_time = 0.0;        ///< [kg s] of it, where its drift by inertia was limited
  };
  /// A cell with what a box has of its gas, as a share of the cell; of sources, of the box's gas.
  struct Part {
    std::size_t cell;
    double gas;
  };
  [[nodiscard]] std::vector<Part> parts_of(sdk::Vec3 min, sdk::Vec3 max,
                                           const fluid::CellField& volume) const;
  /// The layer of cells along d that a flat box at x lies in; -1 outside the domain.
  [[nodiscard]] int layer_of(int d, double x) const;
  /// Of the sources that are active in a step; anew in each, for what gas a cell has changes with
  /// the grains in it.
  void find_sources(const fluid::CellField& volume, double time, double step);
  [[nodiscard]] bool add_sources(std::size_t n, double time, double step);
  void add_deposits(std::size_t of_class, const Flow& flow);
  /// Before transport: what the gas takes off surfaces in the step is in it from its beginning.
  void resuspend(const Flow& flow, double step);
  void count_limited(Class& c, double step) const;
  /// What lies on surfaces that run goes with them.
  void carry(const Flow& flow, double step);
  [[nodiscard]] bool keeps_layers() const { return resuspension_ || do_surfaces_run_; }

  fluid::Grid grid_;
  scenario::DustFieldSpec spec_;
  Transport transport_;
  std::vector<Class> classes_;
  std::vector<std::vector<Part>> sources_;  ///< by source, of this step
  fluid::CellField source_;                 ///< [kg/(m3 s)]
  std::optional<Resuspension> resuspension_;
  std::optional<GasAcceleration> acceleration_;
  Layers layers_;  ///< see keeps_layers()
  SurfaceTransport surface_transport_;
  bool do_surfaces_run_ = false;
  std::int64_t walls_found_ = -1;  ///< Flow::walls_found of layers_
  std::int64_t sub_steps_ = 0;
};

}  // namespace dust::airborne
