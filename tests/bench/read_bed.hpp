// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "particles/dem.hpp"

#include <algorithm>
#include <fstream>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace dust::test {

/// Grains of a CSV file: a heading, then diameter, x, y, z [m] a line.
struct Bed {
  std::vector<particles::NewGrain> grains;
  std::vector<double> diameters;  ///< the different ones, rising
  sdk::Vec3 low{1e9, 1e9, 0.0};   ///< of the grains' surfaces; the floor is at z = 0
  sdk::Vec3 high{-1e9, -1e9, -1e9};
};

inline Bed read_bed(const std::string& file) {
  Bed bed;
  std::ifstream in(file);
  if (!in) throw std::runtime_error("cannot read " + file);
  std::string line;
  std::getline(in, line);
  while (std::getline(in, line)) {
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream text(line);
    particles::NewGrain g;
    if (!(text >> g.diameter >> g.position.x >> g.position.y >> g.position.z)) {
      throw std::runtime_error(file + ": line " + std::to_string(bed.grains.size() + 2) +
                               " is not diameter, x, y, z; unpack a packed file first");
    }
    for (int d = 0; d < 3; ++d) {
      if (d < 2) bed.low[d] = std::min(bed.low[d], g.position[d] - 0.5 * g.diameter);
      bed.high[d] = std::max(bed.high[d], g.position[d] + 0.5 * g.diameter);
    }
    if (std::find(bed.diameters.begin(), bed.diameters.end(), g.diameter) == bed.diameters.end()) {
      bed.diameters.push_back(g.diameter);
    }
    bed.grains.push_back(g);
  }
  std::sort(bed.diameters.begin(), bed.diameters.end());
  return bed;
}

}  // namespace dust::test
