// SPDX-License-Identifier: Apache-2.0
#include "memory/huge_pages.hpp"

#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <string>

namespace dust::engine {

void ask_for_huge_pages(char** argv) {
#ifdef __SANITIZE_ADDRESS__
  return;  // which brings an allocator of its own
#endif
  // Elsewhere everybody has them, or nobody.
  std::ifstream file("/sys/kernel/mm/transparent_hugepage/enabled");
  const std::string said{std::istreambuf_iterator<char>(file), {}};
  if (said.find("[madvise]") == std::string::npos) return;

  static constexpr const char* k_variable = "GLIBC_TUNABLES";
  static constexpr const char* k_tunable = "glibc.malloc.hugetlb";
  const char* set = std::getenv(k_variable);
  std::string tunables = set == nullptr ? "" : set;
  if (tunables.find(k_tunable) != std::string::npos) return;
  if (!tunables.empty()) tunables += ':';
  tunables += std::string(k_tunable) + "=1";

  // By its own name: ps and top show the last part of what was started.
  std::error_code code;
  const auto program = std::filesystem::read_symlink("/proc/self/exe", code);
  if (code || setenv(k_variable, tunables.c_str(), 1) != 0) return;
  execv(program.c_str(), argv);
}

}  // namespace dust::engine
