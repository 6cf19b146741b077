// SPDX-License-Identifier: Apache-2.0
#include "contract/memory_archive.hpp"

#include <stdexcept>

namespace dust::contract {

void MemoryArchive::numbers(std::string_view name, std::span<const double> values) {
  if (!numbers_.emplace(name, std::vector<double>(values.begin(), values.end())).second) {
    throw std::runtime_error("saved twice: " + std::string(name));
  }
}
void MemoryArchive::integers(std::string_view name, std::span<const std::int64_t> values) {
  if (!integers_.emplace(name, std::vector<std::int64_t>(values.begin(), values.end())).second) {
    throw std::runtime_error("saved twice: " + std::string(name));
  }
}
std::vector<double> MemoryArchive::numbers(std::string_view name) {
  const auto found = numbers_.find(std::string(name));
  if (found == numbers_.end()) throw std::runtime_error("never saved: " + std::string(name));
  return found->second;
}
std::vector<std::int64_t> MemoryArchive::integers(std::string_view name) {
  const auto found = integers_.find(std::string(name));
  if (found == integers_.end()) throw std::runtime_error("never saved: " + std::string(name));
  return found->second;
}

}  // namespace dust::contract
