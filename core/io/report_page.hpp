// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dust::io {

/// A page complete in itself: style, plotting library, scripts and data inside, nothing fetched.
///
/// `data` is what the scripts find as `Dust.data`. Every page draws, without a script of its own,
/// the plots under `data["plots"]`:
///   {"NAME": [{"title", "x_label", "y_label", "unit", "note",
///              "lines": [{"name", "x": [..], "y": [..], "low": [..], "high": [..],
///                         "kind": "line" | "points" | "reference", "width": px}]}]}
/// into the element `<div class="grid" data-plots="NAME"></div>`; numbers are in `unit` and shown
/// in the multiple of it that reads best (kg as mg), `low` and `high` (a band or error bars),
/// `note`, `unit`, `kind` and `width` may be missing, null is a gap.
struct Page {
  std::string title;  ///< plain text
  std::string kind;   ///< "run report": stands behind the title in the browser's tab
  std::string body;   ///< HTML inside <main>
  nlohmann::json data = nlohmann::json::object();
  std::vector<std::string> scripts;  ///< files embedded at build time, after those every page has
};

[[nodiscard]] std::string page_html(const Page& page);

/// The top of a page: small line with the kind of page, the scenario and its status ("" = none),
/// the switch of the theme, and the title. All plain text.
[[nodiscard]] std::string heading_html(const std::string& kind, const std::string& scenario,
                                       const std::string& status, const std::string& title);

/// The closing line of a page.
[[nodiscard]] std::string footer_html(const std::string& version);

/// Replaces `target` by `text` as a whole; throws base::UserError when that is not possible.
void write_page(const std::filesystem::path& target, const std::string& text);

}  // namespace dust::io
