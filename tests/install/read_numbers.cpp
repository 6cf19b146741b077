// SPDX-License-Identifier: Apache-2.0
// usage: read_numbers FILE.h5 GROUP DATASET: its extents, its attributes origin, spacing and count
// (an empty line for one that it lacks), and its numbers, one line each; links into other files are
// followed as a user's program follows them.
#include "io/hdf5_file.hpp"

#include <functional>
#include <iostream>
#include <numeric>
#include <vector>

int main(int argc, char** argv) {
  if (argc != 4) return 2;
  try {
    using namespace dust::io;
    const QuietHdf5 quiet;
    const Handle file = open_file(argv[1]);
    const Handle group = open_group(file.get(), argv[2]);
    const auto extents = extents_of(group.get(), argv[3]);
    std::size_t size = 1;
    for (const hsize_t e : extents) {
      std::cout << e << ' ';
      size *= e;
    }
    const Handle set(H5Dopen2(group.get(), argv[3], H5P_DEFAULT), H5Dclose, "no such dataset");
    std::cout << '\n';
    for (const char* name : {"origin", "spacing", "count"}) {
      if (H5Aexists(set.get(), name) > 0) {
        for (const double v : read_attribute(set.get(), name)) std::cout << v << ' ';
      }
      std::cout << '\n';
    }
    std::vector<double> values(size);
    read_array(group.get(), argv[3], H5T_NATIVE_DOUBLE, values.data());
    for (const double v : values) std::cout << v << ' ';
    std::cout << '\n';
  } catch (const std::exception& problem) {
    std::cerr << problem.what() << '\n';
    return 1;
  }
  return 0;
}
