// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "report/run_text.hpp"

#include <string>
#include <vector>

namespace dust::report {

/// One drop below the start of the stream: quantiles of x over the grains that cross it [m].
struct StreamDrop {
  double drop = 0.0;
  Figure low, median, high;  ///< 5, 50 and 95 %; an empty name means that the run has none
};

/// A place of low mean pressure.
struct LowPlace {
  std::string name;
  Figure x, y, z, depth;     ///< [m], [m], [m], [Pa]
  double dust_share = -1.0;  ///< of the dust in the domain, within k_reach; negative: not known
};

/// A place where dust parted from the load.
struct Parting {
  double x = 0.0, z = 0.0;  ///< [m] middle of a square
  Figure amount;            ///< [g/t] of the load released until the end; empty unit: not known
  double share = 0.0, share_error = 0.0;  ///< of all dust that parted
};

/// A size class of dust.
struct DustClass {
  double diameter = 0.0;  ///< [m]
  double density = -1.0;  ///< [kg/m3] of its grains; negative: not known
  double fed = -1.0;      ///< [g/t] in the load; negative: not known
  Figure out;             ///< [g/t] over all openings; an empty unit: no opening is watched
};

/// The figures of a run that a reader asks for first.
struct Highlights {
  std::vector<Figure> openings;  ///< dust that gets out, grams per tonne, the largest first
  std::vector<Figure> leaving;   ///< the same per time [kg/s], also where nothing was fed
  std::vector<Figure> dust;      ///< other passages of dust, grams per tonne, the largest first
  std::vector<Figure> held;      ///< dust present at the end, per tonne emitted until then
  double fed = -1.0;             ///< [g/t] dust in the load; negative: not known
  double observed_time = -1.0;   ///< [s] how long the openings were watched; negative: not known
  double counted = -1.0;         ///< real grains of dust seen to get out in that time
  double later_over_earlier = -1.0;  ///< flux out, second half of that time over the first
  std::vector<DustClass> classes;    ///< those that are dust, ascending
  std::vector<Parting> partings;     ///< the largest first
  std::vector<StreamDrop> stream;    ///< ascending drops
  std::vector<LowPlace> places;      ///< the deepest first

  [[nodiscard]] bool has_dust() const {
    return !openings.empty() || !dust.empty() || !held.empty();
  }
};

[[nodiscard]] Highlights highlights_of(const RunText& run);

/// Sums of what independent sensors count; errors add in squares. A figure that counted nothing has
/// no error and adds none; where one says that it has none for a reason, the sum has none either.
[[nodiscard]] Figure sum_of(const std::vector<Figure>& figures);

/// The place to extract first: of those with some dust near by and a pressure surely below zero,
/// the one with most; else the deepest. -1 without places.
[[nodiscard]] int first_place(const Highlights& highlights);

}  // namespace dust::report
