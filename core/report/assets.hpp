// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <string_view>

namespace dust::report {

/// The text of a file embedded at build time, by its bare name; empty when there is none.
[[nodiscard]] std::string_view report_asset(std::string_view name);

}  // namespace dust::report
