// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/report_highlights.hpp"
#include "io/report_run.hpp"

#include <string>

namespace dust::io {

/// Dust within this distance of a place counts as being there [m].
constexpr double k_reach = 0.02;

/// Side of the squares that tell where dust parted from the load [m].
constexpr double k_parting_side = 0.02;

/// The sections of the page that are text and tables; each is a complete HTML element, or empty
/// when the run has nothing to say.
[[nodiscard]] std::string header_html(const RunText& run, const Highlights& highlights);
[[nodiscard]] std::string result_html(const Highlights& highlights);
[[nodiscard]] std::string extraction_html(const Highlights& highlights, bool has_air,
                                          bool has_dust_map);
[[nodiscard]] std::string setting_html(const RunText& run, const nlohmann::json& bodies);
[[nodiscard]] std::string stream_html(const Highlights& highlights);
[[nodiscard]] std::string references_html(const RunText& run);
[[nodiscard]] std::string balance_html(const RunText& run);
[[nodiscard]] std::string cost_html(const RunText& run);
[[nodiscard]] std::string health_html(const RunText& run, const std::string& explanation);
[[nodiscard]] std::string figures_html(const RunText& run);
[[nodiscard]] std::string provenance_html(const RunText& run);
/// What sensors head themselves; the page's script draws their curves into it.
[[nodiscard]] std::string own_sections_html(const RunText& run);

/// Parts that several sections use.
[[nodiscard]] std::string run_title(const RunText& run);
[[nodiscard]] std::string share_html(double value, double whole);
/// "of that 69 % inhalable, ..."; empty where no dust gets out or its density is not known.
[[nodiscard]] std::string fractions_html(const Highlights& highlights);
/// The mean pressure of a place; three digits where no error tells how many count.
[[nodiscard]] std::string depth_html(const LowPlace& place);
[[nodiscard]] bool has_own_section(const RunText& run, const std::string& sensor);
/// A table of report.json.
[[nodiscard]] std::string plain_table_html(const nlohmann::json& table);
/// How many limits of validity the run went beyond.
[[nodiscard]] int limits_touched(const RunText& run);

}  // namespace dust::io
