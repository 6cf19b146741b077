// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/flow.hpp"
#include "fluid/geometry/body_field.hpp"
#include "run/dust/dust_sides.hpp"
#include "run/dust/wall_shear.hpp"
#include "run/fluid_stage.hpp"
#include "run/models.hpp"
#include "setup/setup.hpp"

#include <array>
#include <cstdint>
#include <optional>
#include <unordered_map>
#include <vector>

namespace dust::run {

/// The surfaces that dust meets, cell by cell: sides that it settles on, and bodies.
class DustWalls {
 public:
  /// All are kept by reference; `has_shear`: somebody asks for the friction velocity.
  DustWalls(const scenario::Setup& setup, const Models& models, const FluidStage& fluid,
            const DustSides& sides, bool has_shear);

  /// Where they are at `time` [s], and which of them run. `is_anew`: not only bodies that move may
  /// have changed.
  void find(double time, bool is_anew, airborne::Flow& flow);
  /// Fills in what dust is told of them since find(), their velocities at `time` [s].
  void fill(double time, airborne::Flow& flow);
  /// [-] Share of each face that gas can pass.
  [[nodiscard]] const fluid::FaceField& passable_area() const { return passable_area_; }

 private:
  using Cell = std::array<int, 3>;

  [[nodiscard]] std::uint8_t sides_passed(const Cell& cell, int body, double time) const;
  /// The pieces of sides in a cell.
  void add_sides(const Cell& cell);
  /// The pieces of bodies' surfaces in a cell.
  void add_bodies(const Cell& cell, const fluid::BodyField& bodies);
  void add_body(const Cell& cell, const fluid::BodyField::Hit& hit, sdk::Vec3 area,
                double cancelled);
  /// See cancelled_area.
  [[nodiscard]] double cancelled_in(const Cell& cell, const fluid::BodyField& bodies);
  void find_running(double time, std::vector<airborne::SurfaceMotion>& motions) const;

  const scenario::Setup& setup_;
  const Models& models_;
  const FluidStage& fluid_;
  const DustSides& sides_;
  fluid::FaceField passable_area_;
  std::vector<airborne::WallPiece> pieces_;  ///< with all of their areas, whatever is before them
  /// A piece of a body that moves.
  struct RunningPiece {
    std::size_t piece;
    Cell cell;
    int body;
    sdk::Vec3 normal;
    sdk::Vec3 point;  ///< [m] of the surface
  };
  std::vector<RunningPiece> running_;
  std::optional<WallShear> shear_;  ///< of pieces_; where somebody asks
  /// [1/m] What has been found of cells that nothing which moves comes near.
  std::unordered_map<std::int32_t, double> cancelled_;
};

}  // namespace dust::run
