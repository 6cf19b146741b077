// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "dust/sdk/archive.hpp"

#include <cstdint>
#include <functional>
#include <string_view>
#include <utility>
#include <vector>

namespace dust::run {

/// Reads a part as if its numbers had another name or length.
class ChangedArchive final : public sdk::ArchiveReader {
 public:
  template <class Value>
  using Change = std::function<void(std::string_view name, std::vector<Value>& values)>;
  ChangedArchive(sdk::ArchiveReader& from, Change<double> change,
                 Change<std::int64_t> integers = {})
      : from_(from), change_(std::move(change)), change_integers_(std::move(integers)) {}
  std::vector<double> numbers(std::string_view name) override {
    auto values = from_.numbers(name);
    change_(name, values);
    return values;
  }
  std::vector<std::int64_t> integers(std::string_view name) override {
    auto values = from_.integers(name);
    if (change_integers_) change_integers_(name, values);
    return values;
  }

 private:
  sdk::ArchiveReader& from_;
  Change<double> change_;
  Change<std::int64_t> change_integers_;
};

}  // namespace dust::run
