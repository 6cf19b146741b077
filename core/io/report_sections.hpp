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

/// The figures of a run that a reader asks for first.
struct Highlights {
  std::vector<Figure> dust;        ///< grams per tonne, the loose dust first
  std::vector<StreamDrop> stream;  ///< ascending drops
};

[[nodiscard]] Highlights highlights_of(const std::vector<Figure>& figures);

/// The sections of the page that are text and tables; each is a complete HTML element, or empty
/// when the run has nothing to say.
[[nodiscard]] std::string header_html(const RunText& run, const Highlights& highlights);
[[nodiscard]] std::string result_html(const Highlights& highlights);
[[nodiscard]] std::string balance_html(const RunText& run);
[[nodiscard]] std::string cost_html(const RunText& run);
[[nodiscard]] std::string health_html(const RunText& run);
[[nodiscard]] std::string figures_html(const RunText& run);
[[nodiscard]] std::string provenance_html(const RunText& run);

}  // namespace dust::io
