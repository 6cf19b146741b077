// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <string>

namespace dust::io {

/// The name under which `file` is written before it is renamed into place: in the same folder, so
/// that the rename is atomic, and always the same, so that leftovers of a killed run are
/// overwritten.
std::filesystem::path temporary_name(const std::filesystem::path& file);

/// Renames `temporary_name(file)` to `file`. With `is_synced` the data and the folder's entry are
/// on the disk, not in its cache, when this returns: they survive a power cut. A killed process
/// never leaves half a file either way.
void move_into_place(const std::filesystem::path& file, bool is_synced);

/// Waits until the data of `file` are on the disk; what was written to it through other descriptors
/// counts. Throws base::WriteError.
void sync_file(const std::filesystem::path& file);
/// The same of the names in `folder`.
void sync_folder(const std::filesystem::path& folder);

/// Removes `temporary_name(file)` if it is there: half a file takes room that a full disk needs.
void discard(const std::filesystem::path& file) noexcept;

/// Makes `folder` and those above it. Throws base::WriteError.
void make_folder(const std::filesystem::path& folder);

/// All of a file; empty where there is none.
std::string read_text(const std::filesystem::path& file);

/// Replaces `file` with `text` in one step. Throws base::WriteError.
void write_text(const std::filesystem::path& file, const std::string& text);

}  // namespace dust::io
