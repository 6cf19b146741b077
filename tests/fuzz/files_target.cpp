// SPDX-License-Identifier: Apache-2.0
// Any bytes as a mesh (STL, text or binary) and as a list of grains (CSV): read, or refused with a
// line; never a crash, a hang or a leak. Linked with libFuzzer (tools/dev/fuzz) or with
// generate.cpp (the tests).
#include "bodies/mesh/mesh.hpp"
#include "dust/sdk/error.hpp"
#include "emitter/file/grain_table.hpp"
#include "fuzz/patience.hpp"

#include <unistd.h>

#include <cmath>
#include <cstdint>
#include <cstdlib>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iostream>
#include <limits>
#include <sstream>
#include <string>
#include <vector>

namespace {

namespace fs = std::filesystem;
using dust::sdk::Vec3;

/// One file per process, in memory where the system offers that.
const fs::path& input_file() {
  static const fs::path file = [] {
    const fs::path memory = "/dev/shm";
    const fs::path folder = fs::is_directory(memory) ? memory : fs::temp_directory_path();
    return folder / ("dust_fuzz_" + std::to_string(::getpid()) + ".stl");
  }();
  return file;
}

[[noreturn]] void broken(const std::string& what) {
  std::cerr << "broken: " << what << '\n';
  std::abort();
}

void check_message(const std::string& text) {
  if (text.empty()) broken("refused without a word");
}

/// Looks at a mesh that was accepted as the engine does: distances are numbers.
void look_at(const std::vector<Vec3>& corners, dust::bodies::Mesh::Sides sides) {
  const dust::bodies::Mesh mesh(corners, sides);
  const Vec3 places[] = {{0.0, 0.0, 0.0}, corners.front(), {1e-3, -2e-3, 5e-4}};
  for (const Vec3& place : places) {
    if (std::isnan(mesh.nearest(place).distance)) broken("a distance that is no number");
    for (int part = 0; part < mesh.parts(); ++part) (void)mesh.contact(part, place, 1e-3);
  }
}

void read_mesh(const std::string& bytes) {
  std::ofstream(input_file(), std::ios::binary | std::ios::trunc) << bytes;
  try {
    const std::vector<Vec3> corners = dust::bodies::read_stl(input_file());
    for (const auto sides : {dust::bodies::Mesh::Sides::one, dust::bodies::Mesh::Sides::both}) {
      try {
        look_at(corners, sides);
      } catch (const dust::sdk::ParameterError& problem) {
        check_message(problem.what());
      }
    }
  } catch (const dust::sdk::ParameterError& problem) {
    check_message(problem.what());
  }
}

/// The bytes as the triangles of a binary file whose head is right: mutations of a whole file
/// seldom are.
std::string as_binary(const std::string& bytes) {
  constexpr std::size_t k_triangle = 50;
  const auto count = static_cast<std::uint32_t>(bytes.size() / k_triangle);
  std::string file(80, ' ');
  file.append(reinterpret_cast<const char*>(&count), sizeof count);
  return file + bytes.substr(0, count * k_triangle);
}

void read_grains(const std::string& bytes) {
  std::istringstream stream(bytes);
  try {
    const auto table = dust::model::file::read_csv(stream, "grains.csv");
    for (const double d : table.diameter) {
      if (!(d > 0.0 && d <= std::numeric_limits<double>::max())) broken("a diameter that is none");
    }
    if (table.diameter.size() != table.line.size()) broken("columns of different lengths");
  } catch (const dust::model::file::TableError& problem) {
    check_message(problem.what());
  }
}

}  // namespace

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  const dust::fuzz::Patience patience;
  const std::string bytes(reinterpret_cast<const char*>(data), size);
  read_mesh(bytes);
  if (size >= 50) read_mesh(as_binary(bytes));
  read_grains(bytes);
  fs::remove(input_file());
  return 0;
}
