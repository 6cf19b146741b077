// SPDX-License-Identifier: Apache-2.0
#include "io/result_folder.hpp"

#include "base/error.hpp"
#include "base/utf8.hpp"
#include "base/write_error.hpp"

#include <cerrno>
#include <system_error>

namespace dust::io {
namespace {

namespace fs = std::filesystem;

[[noreturn]] void refuse(const fs::path& folder, const std::string& why) {
  throw base::UserError("error: -o " + folder.string() + " " + why + ": give another -o");
}

/// A disk that is full, broken or read-only may be well tomorrow; another name helps with these.
bool is_of_name(int reason) {
  switch (reason) {
    case EACCES:
    case EPERM:
    case EEXIST:
    case EINVAL:
    case ELOOP:
    case ENAMETOOLONG:
    case ENOENT:
    case ENOTDIR:
      return true;
    default:
      return false;
  }
}

}  // namespace

void check_result_folder(const fs::path& folder) {
  if (!base::is_utf8(fs::absolute(folder).string())) {
    refuse(folder, "has bytes in its name, or in that of a folder above it, that are not UTF-8");
  }
  std::error_code problem;
  const fs::file_status status = fs::status(folder, problem);
  if (fs::is_directory(status)) return;
  if (fs::exists(status)) refuse(folder, "is a file, results go to a folder");
  if (std::error_code none; fs::is_symlink(folder, none)) {
    refuse(folder,
           "is a link to " + fs::read_symlink(folder, none).string() + ", which is not there");
  }
  if (status.type() == fs::file_type::none) {
    refuse(folder, "cannot be looked at: " + problem.message());
  }
}

void make_result_folder(const fs::path& folder) {
  std::error_code problem;
  fs::create_directories(folder, problem);
  if (!problem) return;
  if (is_of_name(problem.value())) refuse(folder, "cannot be made: " + problem.message());
  throw base::WriteError(folder, problem.value());
}

}  // namespace dust::io
