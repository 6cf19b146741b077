// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "base/error.hpp"
#include "preflight/reader.hpp"
#include "unit/scenario/fake_models.hpp"

#include <unistd.h>
#include <filesystem>
#include <fstream>
#include <sstream>
#include <string>
#include <vector>

/// Files of one test, removed at its end.
class Folder {
 public:
  Folder()
      : path_(std::filesystem::temp_directory_path() /
              ("dust_scenario_" + std::to_string(::getpid()))) {
    std::filesystem::create_directories(path_);
  }
  ~Folder() {
    std::error_code code;
    std::filesystem::remove_all(path_, code);
  }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;
  std::filesystem::path write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name, std::ios::binary) << text;
    return path_ / name;
  }
  [[nodiscard]] const std::filesystem::path& path() const { return path_; }

 private:
  std::filesystem::path path_;
};

inline std::string text_of(const std::filesystem::path& file) {
  std::ifstream stream(file, std::ios::binary);
  std::ostringstream text;
  text << stream.rdbuf();
  return text.str();
}

inline const dust::registry::Registry& fakes() {
  static const auto registry = fake::registry();
  return *registry;
}

inline std::filesystem::path transfer_point() {
  return std::filesystem::path(DUST_SOURCE) / "tests" / "unit" / "scenario" / "transfer_point.yaml";
}

inline dust::scenario::ReadResult read(const std::filesystem::path& file,
                                       const std::vector<dust::scenario::Override>& set = {},
                                       const std::vector<std::filesystem::path>& set_files = {}) {
  return dust::preflight::read_scenario(file, set, fakes(), set_files);
}

/// What the reader says to a file, the folder cut off; empty if it is well.
inline std::vector<std::string> problems(const std::filesystem::path& file,
                                         const std::vector<dust::scenario::Override>& set = {},
                                         const std::vector<std::filesystem::path>& set_files = {}) {
  try {
    read(file, set, set_files);
  } catch (const dust::base::UserError& problem) {
    std::vector<std::string> lines = problem.lines();
    const std::string folder = file.parent_path().string() + "/";
    for (std::string& line : lines) {
      if (line.starts_with(folder)) line.erase(0, folder.size());
    }
    return lines;
  }
  return {};
}

inline std::string joined(const std::vector<std::string>& lines) {
  std::string text;
  for (const std::string& line : lines) text += line + "\n";
  return text;
}

/// A small scenario that is well; `from` is replaced by `to`, which shall be found.
inline std::string changed(std::string text, const std::string& from, const std::string& to) {
  const std::size_t at = text.find(from);
  if (at == std::string::npos) throw std::logic_error("not in the scenario: " + from);
  return text.replace(at, from.size(), to);
}

inline const std::string k_small = R"(name: small
time: {end: 1 s, fluid_step: 1 ms, output_every: 20 ms}
gravity: [0, 0, -9.81]
domain:
  min: [0, 0, 0]
  max: [100, 10, 50 mm]
  boundaries:
    left: {grains: periodic}
    right: {grains: periodic, air: periodic}
    front: {grains: wall, material: glass, air: {model: slip}}
    back: {grains: wall, material: glass, air: {model: slip}}
    bottom: {grains: wall, material: glass, air: {model: no_slip}}
    top: {grains: open, air: {model: total_pressure}}
materials:
  sand: {density: 2650, young_modulus: 50 MPa, poisson_ratio: 0.3}
  glass: {density: 2.5 g/cm3, young_modulus: 5e7, poisson_ratio: 0.3}
interactions:
  - between: [sand, sand]
    contact: {model: hertz_mindlin, restitution: 0.9, friction: 0.5}
    rolling: {model: epsd2, friction: 0.1}
  - between: [glass, sand]
    contact: {model: hertz_mindlin, restitution: 0.9, friction: 0}
bodies:
  plate: {enabled: false, shape: plate, material: glass, hinge: [10, 0, 40 mm], length: 5 mm, thickness: 1 mm, angle: 16 deg}
emitters:
  feed:
    model: feed
    material: sand
    mass_flow: 6 g/s
    min: [1, 1, 40 mm]
    max: [9, 9, 45 mm]
    diameters: [300, 500 um]
    number_fractions: [0.5, 0.5]
fluid:
  cells: [20, 2, 10]
  density: 1.2 kg/m3
  viscosity: 18 uPa s
drag: {model: gidaspow}
voidage: {model: divided}
sensors:
  stream: {model: trajectory, from: [1, 0, 40 mm], drops: [5, 10 mm]}
)";
