// SPDX-License-Identifier: Apache-2.0
#include "base/process/memory.hpp"

#include "base/text.hpp"

#include <fstream>
#include <sstream>

namespace dust::base {

std::optional<double> free_memory() {
  std::ifstream stream("/proc/meminfo");
  std::string line;
  while (std::getline(stream, line)) {
    std::istringstream words(line);
    std::string name;
    double kilobytes = 0.0;
    if (words >> name >> kilobytes && name == "MemAvailable:") return 1024.0 * kilobytes;
  }
  return std::nullopt;
}

std::string shortage_text(double needed, double free) {
  constexpr double k_gigabyte = 1e9;
  if (!(needed > free)) return "";
  return "the run needs about " + digits_text(needed / k_gigabyte, 3) + " GB of memory, and " +
         digits_text(free / k_gigabyte, 3) +
         " GB of this machine's are free: it would be ended by the system or slow down to a "
         "crawl; take coarser cells of the fluid or fewer grains, or a larger machine";
}

}  // namespace dust::base
