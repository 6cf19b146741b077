// SPDX-License-Identifier: Apache-2.0
#include "emitter/file/grain_table.hpp"
#include "support/approx.hpp"
#include "support/engine.hpp"
#include "unit/emitter/emitter_bench.hpp"

#include <doctest/doctest.h>
#include <hdf5.h>

#include <fstream>
#include <sstream>

using namespace dust;
using namespace dust::test;
namespace table = dust::model::file;
using sdk::Vec3;

namespace {

table::GrainTable read(const std::string& text) {
  std::istringstream in(text);
  return table::read_csv(in, "bed.csv");
}

std::string complaint(const std::string& text) {
  try {
    read(text);
  } catch (const table::TableError& e) {
    return e.what();
  }
  return "not refused";
}

std::string write(const TemporaryFolder& folder, const std::string& name, const std::string& text) {
  const std::string file = (folder / name).string();
  std::ofstream(file) << text;
  return file;
}

/// A frame as a run writes it, two of them.
std::string write_results(const TemporaryFolder& folder) {
  const std::string path = (folder / "results.h5").string();
  const hid_t file = H5Fcreate(path.c_str(), H5F_ACC_TRUNC, H5P_DEFAULT, H5P_DEFAULT);
  const hid_t all = H5Gcreate2(file, "particles", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
  for (const char* frame : {"000000", "000001"}) {
    const hid_t group = H5Gcreate2(all, frame, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    const float shift = frame[5] == '1' ? 1.0f : 0.0f;
    const float position[6] = {1, 2, 3, 4, 5, 6 + shift};
    const float velocity[6] = {0, 0, -1, 0, 0, -2};
    const float diameter[2] = {0.5f, 0.25f};
    const float weight[2] = {1, 0.25f};
    const int material[2] = {1, 0};
    const auto add = [&](const char* name, hid_t type, const void* data, int rank) {
      const hsize_t extents[2] = {2, 3};
      const hid_t space = H5Screate_simple(rank, extents, nullptr);
      const hid_t set = H5Dcreate2(group, name, type, space, H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
      H5Dwrite(set, type, H5S_ALL, H5S_ALL, H5P_DEFAULT, data);
      H5Dclose(set);
      H5Sclose(space);
    };
    add("position", H5T_NATIVE_FLOAT, position, 2);
    add("velocity", H5T_NATIVE_FLOAT, velocity, 2);
    add("diameter", H5T_NATIVE_FLOAT, diameter, 1);
    add("weight", H5T_NATIVE_FLOAT, weight, 1);
    add("material", H5T_NATIVE_INT, material, 1);
    H5Gclose(group);
  }
  const hid_t type = H5Tcopy(H5T_C_S1);
  H5Tset_size(type, H5T_VARIABLE);
  const hsize_t two = 2;
  const hid_t space = H5Screate_simple(1, &two, nullptr);
  const hid_t names = H5Acreate2(file, "material_names", type, space, H5P_DEFAULT, H5P_DEFAULT);
  const char* texts[2] = {"sand", "dust"};
  H5Awrite(names, type, texts);
  H5Aclose(names);
  H5Sclose(space);
  H5Tclose(type);
  H5Gclose(all);
  H5Fclose(file);
  return path;
}

}  // namespace

TEST_CASE("columns shall be found by their names, in any order, with or without SI units") {
  const auto t = read(
      "# a comment\nx [m], y,z , velocity_z [m/s],velocity_x,velocity_y,diameter\n\n"
      "1,2,3, -4, 5,6, 7e-4\n0.1,0.2,0.3,0,0,0,1e-3\r\n");
  REQUIRE(t.diameter.size() == 2);
  CHECK(t.diameter[0] == 7e-4);
  CHECK(t.centre[2][0] == 3.0);
  CHECK(t.velocity[2][0] == -4.0);
  CHECK(t.velocity[1][0] == 6.0);
  CHECK(t.rotation[0].empty());
  CHECK(t.line == std::vector<std::int64_t>{4, 5});
}

TEST_CASE("bad rows shall be told with their lines, a handful at once") {
  const std::string head = "diameter,x,y,z\n1e-3,0,0,0\n";
  CHECK(complaint(head + "1e-3,0,zero,0\n") == "bed.csv:3: y: a number is expected, not 'zero'");
  CHECK(complaint(head + "1e-3,0,0\n") == "bed.csv:3: 3 values for 4 columns");
  CHECK(complaint(head + "-1e-3,0,0,0\n") == "bed.csv:3: diameter: -1e-3 is not above 0");
  CHECK(complaint(head + "nan,0,0,0\n") == "bed.csv:3: diameter: a number is expected, not 'nan'");
  CHECK(complaint(head + "1e-3,0,0,0 m\n,0,0,0\n") ==
        "bed.csv:3: z: a number is expected, not '0 m'; bed.csv:4: diameter: a number is expected, "
        "not ''");
  std::string many = head;
  for (int n = 0; n < 9; ++n) many += "x\n";
  const auto text = complaint(many);
  CHECK(text.find("bed.csv:7: 1 values for 4 columns; and 4 more") != std::string::npos);
}

TEST_CASE("a head line that does not fit shall be told") {
  CHECK(complaint("") == "bed.csv is empty: a head line with the columns is expected");
  CHECK(complaint("diameter,x,y,z\n") == "bed.csv lists no grains");
  CHECK(complaint("diameter,x,y\n") ==
        "bed.csv:1: the column 'z' is missing; diameter, x, y and z must be there");
  CHECK(complaint("diameter,x,y,z,z\n") == "bed.csv:1: the column 'z' is there twice");
  CHECK(complaint("diameter,x,y,z,weight\n1e-3,0,0,0,0\n") ==
        "bed.csv:2: weight: 0 is not above 0");
  CHECK(complaint("diameter [mm],x,y,z\n") ==
        "bed.csv:1: the column 'diameter' is in mm; m is expected");
  CHECK(complaint("radius,x,y,z\n")
            .find("bed.csv:1: unknown column 'radius'; the columns are: diameter, x") == 0);
  CHECK(complaint("diameter,x,y,z,velocity_x\n") ==
        "bed.csv:1: give all of velocity_x, velocity_y and velocity_z, or none");
}

TEST_CASE("the emitter shall give the grains of a file with their lines, shifted") {
  const TemporaryFolder folder;
  const auto file = write(folder, "bed.csv", "diameter,x,y,z\n4e-4,0,0,1e-3\n3e-4,0,0,2e-3\n");
  const auto e = emitter("file", {{"file", file}, {"offset", Vec3{0, 0, 1e-2}}});
  const auto requests = requests_of(*e);
  REQUIRE(requests.size() == 2);
  CHECK(requests[1].position.z == test::approx(12e-3).epsilon(1e-14));
  CHECK(requests[1].line == 3);
  CHECK(e->diameters() == std::vector<double>{3e-4, 4e-4});
  CHECK(e->insertion_rule().allowed_overlap == 0.005);
}

TEST_CASE("a grain of a file shall stand for as many real ones as the file says") {
  const TemporaryFolder folder;
  const auto rows =
      write(folder, "bed.csv", "diameter,x,y,z,weight\n4e-4,0,0,0,1\n1e-5,0,0,1,0.05\n");
  const auto table = emitter("file", {{"file", rows}});
  const auto listed = requests_of(*table);
  REQUIRE(listed.size() == 2);
  CHECK(listed[0].weight == 1.0);
  CHECK(listed[1].weight == 0.05);
  const auto results = emitter("file", {{"file", write_results(folder)}});
  const auto frame = requests_of(*results);
  REQUIRE(frame.size() == 2);
  CHECK(frame[0].weight == 1.0);
  CHECK(frame[1].weight == 0.25);
}

TEST_CASE("many different sizes shall be gathered in classes that hold both ends") {
  const TemporaryFolder folder;
  std::string text = "diameter,x,y,z\n";
  for (int n = 0; n < 100; ++n) text += std::to_string(1e-3 + 1e-5 * n) + ",0,0,0\n";
  const auto e = emitter("file", {{"file", write(folder, "bed.csv", text)}});
  const auto d = e->diameters();
  CHECK(d.size() == 24);
  CHECK(d.front() == test::approx(1e-3));
  CHECK(d.back() == test::approx(1.99e-3));
}

TEST_CASE("the last frame of a run shall be read, or the group that is named, with materials") {
  const TemporaryFolder folder;
  const auto path = write_results(folder);
  const auto e = emitter("file", {{"file", path}, {"materials", std::vector<std::string>{"dust"}}});
  const auto requests = requests_of(*e);
  REQUIRE(requests.size() == 2);
  CHECK(requests[1].position == Vec3{4, 5, 7});
  CHECK(requests[1].velocity == Vec3{0, 0, -2});
  CHECK(requests[0].diameter == 0.5);
  CHECK(requests[0].material == 0);   // dust
  CHECK(requests[1].material == -1);  // the other one is the emitter's own
  const auto first = emitter(
      "file",
      {{"file", path}, {"group", std::string("particles/000000")}, {"with_velocities", false}});
  const auto at_rest = requests_of(*first);
  CHECK(at_rest[1].position == Vec3{4, 5, 6});
  CHECK(at_rest[1].velocity == Vec3{0, 0, 0});
  CHECK(at_rest[0].material == -1);
  CHECK(refusal([&] {
          emitter("file", {{"file", path}, {"group", std::string("walls")}});
        }) == "results.h5:/walls: there is no such group");
  CHECK(refusal([&] {
          emitter("file", {{"file", write(folder, "a.h5", "text")}});
        }) == "a.h5 is not an HDF5 file that can be read");
  CHECK(refusal([&] {
          emitter("file", {{"file", write(folder, "a.txt", "text")}});
        }) == "a.txt: a file that ends in .csv, .h5 or .hdf5 is expected");
}
