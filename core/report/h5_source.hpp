// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <cstddef>
#include <cstdint>
#include <filesystem>
#include <optional>
#include <string>
#include <vector>

namespace dust::report {

/// Reads results.h5. Everything that is missing or of another shape comes back empty: a report is
/// made of what a run left, also of one that was killed.
class H5Source {
 public:
  explicit H5Source(const std::filesystem::path& file);
  ~H5Source();
  H5Source(const H5Source&) = delete;
  H5Source& operator=(const H5Source&) = delete;

  [[nodiscard]] bool is_open() const { return file_ >= 0; }

  /// The frame numbers under a group, ascending: names of digits alone that can be opened.
  [[nodiscard]] std::vector<std::string> frames(const std::string& group) const;

  /// Frames that the group names but whose files are not there or cannot be read.
  [[nodiscard]] std::size_t missing_frames(const std::string& group) const;

  [[nodiscard]] std::vector<double> attribute(const std::string& object,
                                              const std::string& name) const;
  /// An attribute of texts.
  [[nodiscard]] std::vector<std::string> texts(const std::string& object,
                                               const std::string& name) const;
  /// An attribute of one text; empty where there is none.
  [[nodiscard]] std::string text(const std::string& object, const std::string& name) const;
  /// The names in a group, in alphabetical order.
  [[nodiscard]] std::vector<std::string> members(const std::string& group) const;
  [[nodiscard]] std::vector<std::size_t> shape(const std::string& dataset) const;
  [[nodiscard]] std::vector<float> floats(const std::string& dataset) const;
  [[nodiscard]] std::vector<std::int64_t> integers(const std::string& dataset) const;

  /// Of a dataset (z, y, x[, component]): the plane y = `row`, (z, x[, component]).
  [[nodiscard]] std::vector<float> plane(const std::string& dataset, std::size_t row) const;

 private:
  std::int64_t file_ = -1;
  int (*old_handler_)(std::int64_t,
                      void*) = nullptr;  ///< HDF5 prints errors itself unless told not to
  void* old_data_ = nullptr;
};

/// Of `written` frames at most `most`, by number: evenly over the run, the last one among them.
std::vector<std::size_t> spread_frames(std::size_t written, std::size_t most);

}  // namespace dust::report
