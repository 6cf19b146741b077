// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/report_run.hpp"

#include <string>
#include <vector>

namespace dust::io {

/// One drop below the start of the stream: quantiles of x over the grains that cross it [m].
struct StreamDrop {
  double drop = 0.0;
  Figure low, median, high;  ///< 5, 50 and 95 %; an empty name means that the run has none
};

/// A place of low mean pressure.
struct LowPlace {
  std::string name;
  Figure x, z, depth;  ///< [m], [m], [Pa]
};

/// The figures of a run that a reader asks for first.
struct Highlights {
  std::vector<Figure> openings;  ///< dust that gets out, grams per tonne, the largest first
  std::vector<Figure> dust;      ///< other passages of dust, grams per tonne, the loose dust first
  std::vector<Figure> held;      ///< dust present at the end, per tonne emitted until then
  double fed = -1.0;             ///< [g/t] dust in the load; negative: not known
  std::vector<StreamDrop> stream;  ///< ascending drops
  std::vector<LowPlace> places;    ///< the deepest first

  [[nodiscard]] bool has_dust() const {
    return !openings.empty() || !dust.empty() || !held.empty();
  }
};

[[nodiscard]] Highlights highlights_of(const RunText& run);

/// The sections of the page that are text and tables; each is a complete HTML element, or empty
/// when the run has nothing to say.
[[nodiscard]] std::string header_html(const RunText& run, const Highlights& highlights);
[[nodiscard]] std::string result_html(const Highlights& highlights);
[[nodiscard]] std::string places_html(const Highlights& highlights);
[[nodiscard]] std::string stream_html(const Highlights& highlights);
[[nodiscard]] std::string balance_html(const RunText& run);
[[nodiscard]] std::string cost_html(const RunText& run);
[[nodiscard]] std::string health_html(const RunText& run);
[[nodiscard]] std::string figures_html(const RunText& run);
[[nodiscard]] std::string provenance_html(const RunText& run);

}  // namespace dust::io
