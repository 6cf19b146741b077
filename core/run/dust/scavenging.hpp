// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "airborne/dust_class.hpp"
#include "fluid/grid.hpp"
#include "particles/dem.hpp"
#include "setup/setup.hpp"

#include <cstdint>
#include <vector>

namespace dust::run {

class DustStage;

/// Grains catch the dust that they meet: out of each cell, over a fluid step, the share
///   1 - exp(-step sum(cleared flow) / gas in the cell)
/// of a class, which goes to its grains by the gas that each has cleared (airborne::cleared_flow);
/// docs/theory/dust.md, eq. (18). Sums stand in the order of rows: the same on any number of
/// threads.
class Scavenging {
 public:
  /// `cells` is the length of a CellField.
  Scavenging(const scenario::Setup& setup, std::size_t cells);

  /// Where the grains are after a fluid step of `step` [s].
  void advance(double step, DustStage& dust, particles::Dem& particles);

 private:
  void find_meetings(const DustStage& dust, const particles::GrainRows& grains);
  void find_flows(const airborne::DustClass& dust, const particles::GrainRows& grains);
  void catch_class(std::size_t n, double step, DustStage& dust, particles::Dem& particles);

  std::vector<double> coarse_graining_;  ///< [-] by material
  std::vector<std::int32_t> cell_;       ///< of each row; -1: no gas near it
  std::vector<double> speed_;            ///< [m/s] of each row relative to the gas
  std::vector<double> flow_;             ///< [m3/s] that each row clears of a class
  fluid::CellField in_cell_;             ///< [m3/s] sum of these; then [kg s/m3] caught over it
  std::vector<std::int32_t> touched_;    ///< cells where there is any
};

}  // namespace dust::run
