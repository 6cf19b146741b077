// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>
#include <string_view>

namespace dust::base {

/// The one facade over the logging library. Warnings and errors also go to stderr. A line is in the
/// file as soon as it is logged.
void log_to_file(const std::filesystem::path& file, bool append);
void log_to_terminal(bool is_verbose);
void log_info(std::string_view text);
void log_warning(std::string_view text);
/// One that the terminal has seen already: into the file alone.
void log_warning_to_file(std::string_view text);
void log_error(std::string_view text);

}  // namespace dust::base
