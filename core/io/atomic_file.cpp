// SPDX-License-Identifier: Apache-2.0
#include "io/atomic_file.hpp"

#include "base/write_error.hpp"

#include <fcntl.h>
#include <unistd.h>

#include <cerrno>
#include <cstdio>
#include <fstream>
#include <iterator>
#include <string>
#include <system_error>

namespace dust::io {
namespace {

/// `file`: whose data or entry it is, for the message.
void sync_to_disk(const std::filesystem::path& path, int flags, const std::filesystem::path& file) {
  const int descriptor = ::open(path.c_str(), flags);
  const bool is_synced = descriptor >= 0 && ::fsync(descriptor) == 0;
  const int reason = errno;
  if (descriptor >= 0) ::close(descriptor);
  if (!is_synced) {
    throw base::WriteError(file, reason);
  }
}

}  // namespace

std::filesystem::path temporary_name(const std::filesystem::path& file) {
  std::filesystem::path temporary = file;
  temporary += ".part";
  return temporary;
}

void sync_file(const std::filesystem::path& file) { sync_to_disk(file, O_RDWR, file); }

void sync_folder(const std::filesystem::path& folder) {
  sync_to_disk(folder, O_RDONLY | O_DIRECTORY, folder);
}

void move_into_place(const std::filesystem::path& file, bool is_synced) {
  const std::filesystem::path temporary = temporary_name(file);
  if (is_synced) sync_to_disk(temporary, O_RDWR, file);
  if (std::rename(temporary.c_str(), file.c_str()) != 0) {
    throw base::WriteError(file, errno);
  }
  if (is_synced) {
    const std::filesystem::path folder = file.parent_path();
    sync_to_disk(folder.empty() ? "." : folder, O_RDONLY | O_DIRECTORY, file);
  }
}

void discard(const std::filesystem::path& file) noexcept {
  std::error_code ignored;
  std::filesystem::remove(temporary_name(file), ignored);
}

void make_folder(const std::filesystem::path& folder) {
  std::error_code problem;
  std::filesystem::create_directories(folder, problem);
  if (problem) throw base::WriteError(folder, problem.value());
}

std::string read_text(const std::filesystem::path& file) {
  std::ifstream in(file, std::ios::binary);
  return {std::istreambuf_iterator<char>(in), {}};
}

void write_text(const std::filesystem::path& file, const std::string& text) {
  const std::filesystem::path temporary = temporary_name(file);
  std::ofstream out(temporary, std::ios::binary | std::ios::trunc);
  out.write(text.data(), static_cast<std::streamsize>(text.size()));
  out.close();
  if (!out) {
    const int reason = errno;
    discard(file);
    throw base::WriteError(file, reason);
  }
  move_into_place(file, false);
}

}  // namespace dust::io
