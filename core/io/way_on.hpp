// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace dust::io {

/// How the run in `folder` goes on where its checkpoint is whole but what was written before it is
/// not: its state in another folder first, since --force loses it.
std::string way_on_from_checkpoint(const std::filesystem::path& folder);

}  // namespace dust::io
