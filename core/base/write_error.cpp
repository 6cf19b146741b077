// SPDX-License-Identifier: Apache-2.0
#include "base/write_error.hpp"

#include <cerrno>
#include <cstring>

namespace dust::base {
namespace {

std::string remedy(int reason) {
  switch (reason) {
    case ENOSPC:
      return "make room on that disk";
    case EDQUOT:
      return "your quota is used up: make room, or ask for more";
    case EFBIG:
      return "a limit on the size of files stops it: raise it (ulimit -f)";
    case EROFS:
    case EACCES:
    case EPERM:
      return "name a folder that you may write to with -o";
    case ENOENT:
    case ENOTDIR:
      return "the folder is not there: has it been moved or removed?";
    case EMFILE:
    case ENFILE:
      return "too many files are open: raise the limit (ulimit -n)";
    default:
      return "look whether the disk is well and reachable";
  }
}

}  // namespace

WriteError::WriteError(const std::filesystem::path& file, int reason)
    : RunError("cannot write " + file.string() + ": " + std::strerror(reason) + "; " +
               remedy(reason)) {}

}  // namespace dust::base
