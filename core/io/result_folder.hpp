// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>

namespace dust::io {

/// Refuses a folder for results that cannot be one: a file, a link to nothing, a name that is not
/// UTF-8 (the files in it tell where they lie). Makes nothing; throws base::UserError.
void check_result_folder(const std::filesystem::path& folder);

/// Makes `folder` and those above it. Throws base::UserError where the name is what is wrong, and
/// base::WriteError where the disk is.
void make_result_folder(const std::filesystem::path& folder);

}  // namespace dust::io
