// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "io/run_files.hpp"

#include <filesystem>
#include <string>
#include <vector>

namespace dust::test {

/// A frame that owns its columns; every number is a function of its place, so that a reader can
/// tell a mixed-up order.
struct SyntheticFrame {
  /// `cells` all 0: without fluid.
  SyntheticFrame(std::int64_t number, int grains, int nx, int ny, int nz);
  [[nodiscard]] const io::Frame& frame() const { return frame_; }

  static float pressure_at(int i, int j, int k);

 private:
  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
  std::vector<double> columns_[15];
  std::vector<float> fluid_[6];
  std::vector<float> exchange_;
  io::Frame frame_;
};

/// An empty folder that is removed with the object.
class TemporaryFolder {
 public:
  TemporaryFolder();
  ~TemporaryFolder();
  TemporaryFolder(const TemporaryFolder&) = delete;
  TemporaryFolder& operator=(const TemporaryFolder&) = delete;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

std::string text_of(const std::filesystem::path& file);

}  // namespace dust::test
