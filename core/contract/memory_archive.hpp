// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <cstdint>
#include <map>
#include <span>
#include <string>
#include <string_view>
#include <vector>

namespace dust::contract {

/// State kept in memory; throws on a name used twice or missing.
class MemoryArchive final : public sdk::ArchiveWriter, public sdk::ArchiveReader {
 public:
  void numbers(std::string_view name, std::span<const double> values) override;
  void integers(std::string_view name, std::span<const std::int64_t> values) override;
  std::vector<double> numbers(std::string_view name) override;
  std::vector<std::int64_t> integers(std::string_view name) override;
  using sdk::ArchiveReader::integer;
  using sdk::ArchiveReader::number;
  using sdk::ArchiveWriter::integer;
  using sdk::ArchiveWriter::number;

 private:
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};

}  // namespace dust::contract
