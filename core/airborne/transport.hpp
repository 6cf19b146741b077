// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/cells/small_cells.hpp"
#include "airborne/dust_class.hpp"
#include "airborne/flow.hpp"
#include "airborne/gas_acceleration.hpp"
#include "fluid/grid.hpp"

#include <array>
#include <vector>

namespace dust::airborne {

/// Where dust of one class has gone, besides being in the air [kg/m3 of cells, times their volume
/// [m3] a mass]; each entry only grows.
struct Losses {
  std::array<double, 6> sides{};  ///< out through the sides of the domain
  std::vector<double> outlets;    ///< by hood
  std::vector<double> walls;      ///< by Flow::walls
};

/// Carries one class of dust through a fluid step by finite volumes on the cut grid
/// (docs/theory/dust.md, eq. (1)),
///   d(v c)/dt + div(G c) = div(p D grad c) - (sinks + deposition) c,
/// with v the gas-filled share of a cell, G the volume flow of the gas plus the drift through what
/// the gas fills, p that share of a face. Upwind with van Leer's slopes in space, two stages in
/// time (Shu and Osher 1988): second order where smooth, no value below zero, and none above the
/// largest at the start where G closes up to the change of v. What leaves is counted to the last
/// digit.
class Transport {
 public:
  explicit Transport(const fluid::Grid& grid);

  /// After the flow has changed: what all classes share.
  void prepare(const Flow& flow, const GasAcceleration* acceleration = nullptr);
  /// `mass` [kg/m3 of whole cells] over `step` [s]; `source` [kg/(m3 s)], empty = none. Returns the
  /// sub-steps made.
  int advance(const Flow& flow, const DustClass& dust, double turbulent_share,
              const std::vector<double>& source, double step, fluid::CellField& mass,
              Losses& losses);
  /// 1 in cells at any of whose faces the drift by inertia of the last class was limited, 0 in
  /// others.
  [[nodiscard]] const std::vector<float>& limited() const { return inertia_.limited; }
  /// [kg/m3 of gas] where there is gas.
  static void concentration(const fluid::Grid& grid, const fluid::CellField& mass,
                            const fluid::CellField& volume, fluid::CellField& c);

 private:
  struct Inertia {
    const GasAcceleration* gas = nullptr;  ///< null: dust turns with the gas
    std::vector<float> limited;            ///< see limited()
    std::vector<float> is_held;  ///< 1 in faces, along one direction, that it was limited in
  };
  void set_volume(const Flow& flow, double share);
  void find_drive(const Flow& flow, const DustClass& dust);
  [[nodiscard]] double largest_rate(const Flow& flow, const DustClass& dust);
  void find_fluxes(const Flow& flow, const DustClass& dust);
  void flux_row(const Flow& flow, const DustClass& dust, int d, int j, int k);
  void euler(const Flow& flow, const std::vector<double>& source, double dt, double weight,
             fluid::CellField& mass, Losses& losses);
  [[nodiscard]] double inflow_at(const Flow& flow, const WallPiece& piece) const;
  void take_from_sides(double amount, Losses& losses, const Flow& flow) const;
  void fill_halo();
  void wrap_faces(std::size_t d, std::vector<double>& values) const;
  [[nodiscard]] std::array<int, 3> faces(int d) const {
    std::array<int, 3> n = grid_.count;
    n[static_cast<std::size_t>(d)] += 1;
    return n;
  }
  /// Has no neighbours along d: one cell, periodic or between walls.
  [[nodiscard]] bool is_still(int d) const { return is_still_[static_cast<std::size_t>(d)]; }

  fluid::Grid grid_;
  SmallCells small_cells_;
  std::array<bool, 3> is_still_{};
  Inertia inertia_;
  double turbulent_share_ = 0.0;  ///< of the eddy diffusivity
  fluid::CellField c_, first_, volume_, scratch_;
  fluid::CellField deposition_;    ///< [1/s] per whole cell, of the class at hand
  std::vector<double> wall_rate_;  ///< the same by piece of wall
  fluid::FaceField drive_;         ///< [m/s] G
  fluid::FaceField flux_;          ///< [kg/(m2 s)]
  fluid::FaceField is_open_;       ///< 1 where the cells of a face see each other
  std::vector<double> partial_;
};

}  // namespace dust::airborne
