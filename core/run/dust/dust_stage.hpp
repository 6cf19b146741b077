// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_field.hpp"
#include "airborne/dust_weight.hpp"
#include "io/run_files.hpp"
#include "particles/openings/opening.hpp"
#include "run/archive_parts.hpp"
#include "run/dust/dust_sides.hpp"
#include "run/dust/dust_table.hpp"
#include "run/dust/dust_walls.hpp"
#include "run/dust/scavenging.hpp"
#include "run/fluid_stage.hpp"
#include "run/models.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace dust::run {

/// Does the surface of any body run, or go to other places?
[[nodiscard]] bool has_running_surfaces(const scenario::Setup& setup);

/// The airborne dust of a run: what it is told of the fluid, and what files are told of it.
class DustStage {
 public:
  /// `setup` has a fluid; it, models and fluid are kept by reference. `openings`: see openings_of.
  DustStage(const scenario::Setup& setup, const scenario::DustFieldSpec& spec, const Models& models,
            FluidStage& fluid, std::vector<particles::Opening> openings);

  /// What is there at the start.
  void start();
  /// A field from another run, among the bodies of this one.
  void adapt_to_bodies();
  /// Goes with the fluid through the step from `time` [s] on, after the fluid.
  void advance(double time);
  /// Do grains catch dust?
  [[nodiscard]] bool has_scavenging() const { return scavenging_.has_value(); }
  /// Grains catch dust, where they are after a fluid step.
  void scavenge(particles::Dem& particles);
  /// Bodies were taken away.
  void bodies_changed() { must_find_walls_ = true; }
  /// The cell at a place that a grain takes, or the nearest of those around it with gas; -1: none.
  [[nodiscard]] std::int32_t cell_with_gas(sdk::Vec3 place) const;
  /// [-] of the cell at a place that a grain takes.
  [[nodiscard]] double void_fraction_at(sdk::Vec3 place) const;
  /// The image of a place that lies between periodic sides.
  [[nodiscard]] sdk::Vec3 inside(sdk::Vec3 place) const { return fluid_.grid().inside(place); }
  /// [m/s] mean over the faces of a cell.
  [[nodiscard]] sdk::Vec3 gas_velocity(std::int32_t cell) const;
  /// [m3] of gas in a cell.
  [[nodiscard]] double gas_volume(std::int32_t cell) const;
  /// See airborne::DustField.
  double catch_in(std::size_t n, std::int32_t cell, double share) {
    return field_.catch_in(n, cell, share);
  }
  /// Dust set free in a cell at once [kg]; of the class `n`.
  void release(std::size_t n, std::int32_t cell, double mass) { field_.release(n, cell, mass); }
  [[nodiscard]] const airborne::DustField& field() const { return field_; }
  /// Force [N/m3] of the dust that is there on the fluid, before its step; null where there has
  /// been none yet.
  [[nodiscard]] const fluid::FaceField* weigh() {
    return field_.is_empty() ? nullptr : &weight_.find(field_, flow_.volume_after);
  }
  /// "10_um": a class in names of figures and fields.
  [[nodiscard]] const std::vector<std::string>& class_names() const { return names_; }
  /// Names of the surfaces of DustBalance::surfaces.
  [[nodiscard]] std::vector<std::string> surface_names() const;
  [[nodiscard]] const std::vector<particles::Opening>& openings() const { return openings_; }
  /// See DustSides.
  [[nodiscard]] bool lets_dust_out(std::size_t side) const { return sides_.lets_dust_out(side); }

  /// Copies what sensors of dust see.
  void take_columns() { table_.take(field_, flow_.volume_after); }
  [[nodiscard]] sdk::DustColumns columns() const { return table_.columns(); }

  /// Of the grid, with its ghosts: the length of a CellField.
  [[nodiscard]] std::size_t cells() const { return fluid_.grid().size; }
  /// Numbers of cells for a frame.
  [[nodiscard]] io::SensorField cell_field(const std::string& name, const char* unit,
                                           const fluid::CellField& values) const;
  /// Concentrations and deposits for a frame.
  [[nodiscard]] std::vector<io::SensorField> fields() const;

  void add_parts(SaveParts& parts) const;
  void add_parts(LoadParts& parts);

 private:
  void find_volume(fluid::CellField& volume) const;
  void find_passage();
  void find_outflows();

  const scenario::Setup& setup_;
  const Models& models_;
  FluidStage& fluid_;
  std::vector<particles::Opening> openings_;
  DustSides sides_;
  airborne::Flow flow_;
  bool must_find_walls_ = true;
  DustWalls walls_;
  airborne::DustField field_;
  airborne::DustWeight weight_;
  DustTable table_;
  std::optional<Scavenging> scavenging_;
  std::vector<std::string> names_;
};

}  // namespace dust::run
