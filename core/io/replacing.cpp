// SPDX-License-Identifier: Apache-2.0
#include "io/replacing.hpp"

#include "base/error.hpp"

#include <algorithm>
#include <system_error>

namespace dust::io {
namespace {

namespace fs = std::filesystem;

bool is_there(const fs::path& path) {
  std::error_code none;
  return fs::exists(path, none);
}

/// With links resolved as far as the path exists.
fs::path whole(const fs::path& path) {
  std::error_code problem;
  fs::path found = fs::weakly_canonical(path, problem);
  return problem ? fs::absolute(path).lexically_normal() : found;
}

/// Whether `path` is `top` or lies in it.
bool is_within(const fs::path& path, const fs::path& top) {
  const auto [at_top, at_path] = std::mismatch(top.begin(), top.end(), path.begin(), path.end());
  return at_top == top.end();
}

}  // namespace

void check_replaced(const Replaced& replaced, const std::vector<fs::path>& inputs) {
  const std::string error = "error: --force: " + replaced.folder.string();
  const auto found =
      std::find_if(replaced.files.begin(), replaced.files.end(),
                   [&](const char* name) { return is_there(replaced.folder / name); });
  if (is_there(replaced.folder / replaced.other_mark)) {
    throw base::UserError(error + " holds a " + replaced.other + ", which a " + replaced.kind +
                          " does not replace: give another -o");
  }
  if (found == replaced.files.end()) return;
  if (!is_there(replaced.folder / replaced.mark)) {
    throw base::UserError(error + " holds no " + replaced.kind + " (no " + replaced.mark +
                          "), but " + *found + ", which would be lost: give another -o");
  }
  const fs::path folder = whole(replaced.folder);
  for (const fs::path& given : inputs) {
    const fs::path input = whole(given);
    for (const char* name : replaced.files) {
      // A folder that is read is another run's: all of it.
      if (!is_within(input, folder / name) && input != folder) continue;
      throw base::UserError(error + " would lose " + given.string() + ", which this " +
                            replaced.kind + " reads: copy it elsewhere, or give another -o");
    }
  }
}

}  // namespace dust::io
