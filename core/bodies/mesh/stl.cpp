// SPDX-License-Identifier: Apache-2.0
#include "base/finite.hpp"
#include "bodies/mesh/mesh.hpp"
#include "dust/sdk/error.hpp"

#include <cmath>
#include <cstdint>
#include <cstring>
#include <fstream>
#include <iterator>
#include <sstream>

namespace dust::bodies {
namespace {

using sdk::ParameterError;
using sdk::Vec3;

constexpr std::size_t k_header = 84;    ///< 80 bytes of anything, a count of 4
constexpr std::size_t k_triangle = 50;  ///< normal, three corners in floats, two bytes

std::vector<Vec3> read_binary(const std::string& bytes, std::size_t count) {
  std::vector<Vec3> corners;
  corners.reserve(3 * count);
  for (std::size_t n = 0; n < count; ++n) {
    float value[12];
    std::memcpy(value, bytes.data() + k_header + k_triangle * n, sizeof value);
    for (int k = 1; k < 4; ++k) {
      corners.push_back({value[3 * k], value[3 * k + 1], value[3 * k + 2]});
    }
  }
  return corners;
}

std::vector<Vec3> read_text(const std::string& text, const std::string& file) {
  std::istringstream in(text);
  std::vector<Vec3> corners;
  std::string line;
  for (int number = 1; std::getline(in, line); ++number) {
    std::istringstream words(line);
    std::string word;
    if (!(words >> word) || word != "vertex") continue;
    Vec3 p;
    if (!(words >> p.x >> p.y >> p.z)) {
      throw ParameterError(file + ", line " + std::to_string(number) +
                           ": three numbers are expected after 'vertex'");
    }
    corners.push_back(p);
  }
  if (corners.size() % 3 != 0) {
    throw ParameterError(file + ": the last triangle has no three corners: the file is cut short");
  }
  return corners;
}

}  // namespace

std::vector<Vec3> read_stl(const std::string& file) {
  std::ifstream in(file, std::ios::binary);
  if (!in) throw ParameterError("cannot read the mesh " + file);
  const std::string bytes{std::istreambuf_iterator<char>(in), std::istreambuf_iterator<char>()};
  // A binary file may begin with "solid" too: its length tells.
  std::uint32_t count = 0;
  if (bytes.size() >= k_header) std::memcpy(&count, bytes.data() + 80, sizeof count);
  const std::size_t needed = k_header + k_triangle * static_cast<std::size_t>(count);
  std::vector<Vec3> corners;
  if (bytes.size() >= k_header && bytes.size() == needed) {
    corners = read_binary(bytes, count);
  } else if (bytes.compare(0, 5, "solid") == 0 && bytes.find('\0') == std::string::npos) {
    corners = read_text(bytes, file);
  } else if (bytes.size() >= k_header && count > 0 && count < 100'000'000) {
    throw ParameterError(file + ": " + std::to_string(count) + " triangles are announced, which " +
                         "takes " + std::to_string(needed) + " bytes, but the file has " +
                         std::to_string(bytes.size()) + ": it is damaged");
  } else {
    throw ParameterError(file + " is not an STL file (neither binary nor text)");
  }
  if (corners.empty()) throw ParameterError(file + " holds no triangles");
  for (const Vec3& p : corners) {
    if (base::is_finite(p)) continue;
    throw ParameterError(file + " holds a corner that is not a number");
  }
  return corners;
}

}  // namespace dust::bodies
