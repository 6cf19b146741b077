// SPDX-License-Identifier: Apache-2.0
#pragma once

#include <filesystem>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace dust::test {

/// What an invented run folder holds.
struct FakeRun {
  int frames = 3;
  int coarse_grains = 40;  ///< per frame
  int dust_grains = 5;     ///< per frame
  bool has_fluid = true;
  bool has_h5 = true;
};

/// A grain of a frame.
struct FakeGrain {
  std::int64_t id = 0;
  double diameter = 0.0, x = 0.0, z = 0.0;  ///< [m]
  double speed = 0.0;                       ///< [m/s] along x
  double y = 0.0;                           ///< [m]
};

/// Surfaces of a frame: corners x, y, z [m], three of them a triangle, the body of each triangle.
struct FakeSurface {
  std::vector<float> points;
  std::vector<int> triangles, body;
};

/// A figure of summary.json.
[[nodiscard]] nlohmann::json fake_figure(double value, const char* unit, double error = -1.0);

/// `figure` with a role; of one size class where `diameter` [m] is positive.
[[nodiscard]] nlohmann::json with_role(nlohmann::json figure, const char* role,
                                       const char* quantity, const char* direction = "",
                                       double diameter = 0.0);

/// The summary of a finished run with two sensors.
[[nodiscard]] nlohmann::json fake_summary();

/// A folder of its own, removed with the object.
class RunFolder {
 public:
  RunFolder();
  ~RunFolder();
  RunFolder(const RunFolder&) = delete;
  RunFolder& operator=(const RunFolder&) = delete;

  void write(const std::string& name, const std::string& text) const;
  void write_h5(const FakeRun& run) const;
  /// Frames of these grains, 0.1 s apart.
  void write_tracks(const std::vector<std::vector<FakeGrain>>& frames) const;
  /// Frames of these surfaces, 0.1 s apart, without grains.
  void write_surfaces(const std::vector<FakeSurface>& frames,
                      const std::vector<std::string>& names) const;
  [[nodiscard]] std::string read(const std::string& name) const;
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

/// The data the page carries for its script, parsed.
[[nodiscard]] nlohmann::json page_data(const std::string& page);

/// The bytes of a blob of the page.
[[nodiscard]] std::string unpacked(const std::string& base64);

}  // namespace dust::test
