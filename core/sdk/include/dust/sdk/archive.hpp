// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstdint>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::sdk {

/// Where a stateful model writes what a resumed run needs. Names are unique within the model.
class ArchiveWriter {
 public:
  virtual ~ArchiveWriter() = default;
  virtual void numbers(std::string_view name, std::span<const double> values) = 0;
  virtual void integers(std::string_view name, std::span<const std::int64_t> values) = 0;

  void number(std::string_view name, double value) { numbers(name, {&value, 1}); }
  void integer(std::string_view name, std::int64_t value) { integers(name, {&value, 1}); }
};

/// The other direction; throws ModelError when a name is missing.
class ArchiveReader {
 public:
  virtual ~ArchiveReader() = default;
  virtual std::vector<double> numbers(std::string_view name) = 0;
  virtual std::vector<std::int64_t> integers(std::string_view name) = 0;

  double number(std::string_view name) { return numbers(name).at(0); }
  std::int64_t integer(std::string_view name) { return integers(name).at(0); }
};

}  // namespace dust::sdk
