// SPDX-License-Identifier: Apache-2.0
// Where dust comes off and where it is in the air, seen from the side and in three dimensions, and
// what sensors keep by place, from a results.h5 written by hand.
#include "fake_run.hpp"
#include "report/pictures/pictures.hpp"
#include "report/space/space.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>
#include <hdf5.h>

#include <array>
#include <cmath>
#include <vector>

using namespace dust;
using test::RunFolder;

namespace {

/// 3 x 2 x 2 cells of 10 x 10 x 20 mm.
constexpr std::array<hsize_t, 3> k_shape = {2, 2, 3};  // z, y, x

class Results {
 public:
  explicit Results(const RunFolder& folder)
      : file_(H5Fcreate((folder.path() / "results.h5").c_str(), H5F_ACC_TRUNC, H5P_DEFAULT,
                        H5P_DEFAULT)) {
    const hid_t fluid = H5Gcreate2(file_, "/fluid", H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT);
    put(fluid, "origin", {-0.01, 0.0, 0.5});
    put(fluid, "spacing", {0.01, 0.01, 0.02});
    put(fluid, "count", {3.0, 2.0, 2.0});
    H5Gclose(fluid);
  }
  ~Results() { H5Fclose(file_); }
  Results(const Results&) = delete;
  Results& operator=(const Results&) = delete;

  void frame(const std::string& name) const {
    H5Gclose(H5Gcreate2(file_, ("/fluid/" + name).c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  void group(const std::string& path) const {
    H5Gclose(H5Gcreate2(file_, path.c_str(), H5P_DEFAULT, H5P_DEFAULT, H5P_DEFAULT));
  }
  /// A field of a sensor on a grid of its own: (nz, ny, nx) cells of 50 mm from `origin` on.
  void sensor_field(const std::string& path, std::array<hsize_t, 3> shape,
                    const std::vector<double>& origin, const std::vector<float>& values) const {
    field(path, values, shape);
    const hid_t set = H5Dopen2(file_, path.c_str(), H5P_DEFAULT);
    put(set, "origin", origin);
    put(set, "spacing", {0.05, 0.05, 0.05});
    const hid_t type = H5Tcopy(H5T_C_S1);
    H5Tset_size(type, 4);
    const hid_t space = H5Screate(H5S_SCALAR);
    const hid_t units = H5Acreate2(set, "units", type, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(units, type, "m/s");
    H5Aclose(units);
    H5Sclose(space);
    H5Tclose(type);
    H5Dclose(set);
  }
  void field(const std::string& path, const std::vector<float>& values,
             std::array<hsize_t, 3> shape = k_shape) const {
    const hid_t space = H5Screate_simple(3, shape.data(), nullptr);
    const hid_t set = H5Dcreate2(file_, path.c_str(), H5T_NATIVE_FLOAT, space, H5P_DEFAULT,
                                 H5P_DEFAULT, H5P_DEFAULT);
    H5Dwrite(set, H5T_NATIVE_FLOAT, H5S_ALL, H5S_ALL, H5P_DEFAULT, values.data());
    H5Dclose(set);
    H5Sclose(space);
  }

 private:
  static void put(hid_t object, const char* name, const std::vector<double>& values) {
    const std::array<hsize_t, 1> n = {values.size()};
    const hid_t space = H5Screate_simple(1, n.data(), nullptr);
    const hid_t attribute =
        H5Acreate2(object, name, H5T_NATIVE_DOUBLE, space, H5P_DEFAULT, H5P_DEFAULT);
    H5Awrite(attribute, H5T_NATIVE_DOUBLE, values.data());
    H5Aclose(attribute);
    H5Sclose(space);
  }

  hid_t file_;
};

}  // namespace

TEST_CASE("the map of where dust comes off shall sum over the depth, on one scale for all causes") {
  const RunFolder folder;
  {
    const Results results(folder);
    results.frame("000000");
    results.frame("000001");
    // x fastest, then y, then z: only the last frame counts.
    results.field("/fluid/000000/dust_set_free_by_walls", std::vector<float>(12, 9.0F));
    results.field("/fluid/000001/dust_set_free_by_walls",
                  {3e-6F, 0, 0, 7e-6F, 0, 0, 0, 1e-8F, 0, 0, 0, 0});
    results.field("/fluid/000001/dust_set_free_by_grains",
                  {0, 0, 0, 0, 0, 0, 0, 0, 1e-6F, 0, 0, 1e-12F});
  }
  const auto map = report::release_map_of(report::H5Source(folder.path() / "results.h5"));
  REQUIRE(map.is_object());
  CHECK(map["nx"] == 3);
  CHECK(map["nz"] == 2);
  CHECK(map["x0"] == -0.01);
  CHECK(map["z0"] == 0.5);
  // 10 mg in a column of 10 x 20 mm, so 5 mg in each square centimetre.
  CHECK(map["most"].get<double>() == test::approx(5e-6));
  const auto& kinds = map["kinds"];
  REQUIRE(kinds.size() == 2);  // no wind in this run
  CHECK(kinds[0]["kg"].get<double>() == test::approx(10.01e-6));
  CHECK(kinds[1]["kg"].get<double>() == test::approx(1e-6));
  const auto codes = [](const nlohmann::json& kind) {
    const std::string bytes = test::unpacked(kind["data"].get<std::string>());
    std::vector<int> numbers;
    for (const char byte : bytes) numbers.push_back(static_cast<unsigned char>(byte));
    return numbers;
  };
  // The most is 254; of the four decades one less is three quarters up, three less one quarter.
  CHECK(codes(kinds[0]) == std::vector<int>{254, 0, 0, 0, 64, 0});
  CHECK(codes(kinds[1]) == std::vector<int>{0, 0, 0, 0, 0, 191});
}

TEST_CASE("a run whose grains carry no dust shall have no map of where it comes off") {
  const RunFolder folder;
  {
    const Results results(folder);
    results.frame("000000");
  }
  CHECK(report::release_map_of(report::H5Source(folder.path() / "results.h5")).is_null());
}

TEST_CASE("what a sensor keeps by place shall be seen along the axis that shows most of it") {
  const RunFolder folder;
  {
    const Results results(folder);
    for (const char* name : {"/sensors", "/sensors/000000", "/sensors/000001"}) results.group(name);
    for (const char* name : {"/sensors/000001/floor", "/sensors/000001/idle"}) results.group(name);
    // A floor of 3 x 2 cells in two layers: from above six places are seen, from the side five.
    results.sensor_field("/sensors/000001/floor/depth_rate", {2, 2, 3}, {1.0, -0.05, 0.0},
                         {1e-8F, 1e-10F, 1e-11F, 1e-12F, 0, 1e-8F, 0, 0, 0, 0, 1e-7F, 5e-10F});
    results.sensor_field("/sensors/000001/idle/depth_rate", {2, 2, 3}, {0, 0, 0},
                         std::vector<float>(12, 0.0F));
  }
  const auto maps = report::sensor_maps_of(report::H5Source(folder.path() / "results.h5"));
  REQUIRE(maps.size() == 1);
  const auto& map = maps[0];
  CHECK(map["sensor"] == "floor");
  CHECK(map["name"] == "depth_rate");
  CHECK(map["unit"] == "m/s");
  CHECK(map["along"] == "z");
  CHECK(map["axes"] == nlohmann::json{"x", "y"});
  CHECK(map["nx"] == 3);
  CHECK(map["nz"] == 2);
  CHECK(map["x0"] == 1.0);
  CHECK(map["z0"] == -0.05);
  CHECK(map["most"].get<double>() == test::approx(1e-7).epsilon(1e-6));
  const std::string bytes = test::unpacked(map["data"].get<std::string>());
  std::vector<int> codes;
  for (const char byte : bytes) codes.push_back(static_cast<unsigned char>(byte));
  // Of four decades: the most 254, a tenth of it three quarters up; less than all four the least.
  CHECK(codes == std::vector<int>{191, 64, 1, 1, 254, 191});
}

TEST_CASE("dust in the air shall come back from the page in kg/m3, and where it came off") {
  const RunFolder folder;
  {
    const Results results(folder);
    results.frame("000000");
    // Two classes: 1e-3 kg/m3 in the third cell of the first row, a hundredth of it in the fourth
    // cell, a millionth in the fifth: less than four decades hold.
    results.field("/fluid/000000/dust_5_um", {0, 0, 4e-4F, 1e-5F, 1e-9F, 0, 0, 0, 0, 0, 0, 0});
    results.field("/fluid/000000/dust_50_um", {0, 0, 6e-4F, 0, 0, 0, 0, 0, 0, 0, 0, 0});
    results.field("/fluid/000000/dust_set_free_by_walls", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 3e-6F});
    results.field("/fluid/000000/dust_set_free_by_wind", {0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0, 1e-6F});
  }
  const report::H5Source source(folder.path() / "results.h5");
  const nlohmann::json air = {
      {"cells_per_block", {1, 1, 1}}, {"count", {3, 2, 2}}, {"frames", {nlohmann::json::object()}}};
  CHECK(report::dust_field_of(source, {}, air).is_null());
  CHECK(report::dust_field_of(source, {"5_um"}, nullptr).is_null());
  const nlohmann::json dust = report::dust_field_of(source, {"5_um", "50_um"}, air);
  REQUIRE(dust.is_object());
  CHECK(dust["most"].get<double>() == test::approx(1e-3));
  const auto codes = [](const nlohmann::json& data) {
    std::string bytes = test::unpacked(data);
    for (std::size_t k = 1; k < bytes.size(); ++k)
      bytes[k] = static_cast<char>(bytes[k] + bytes[k - 1]);
    return std::vector<unsigned char>(bytes.begin(), bytes.end());
  };
  const auto concentration = codes(dust["frames"][0]["data"]);
  REQUIRE(concentration.size() == 12);
  CHECK(concentration[2] == 254);
  CHECK(std::abs(concentration[3] - 127.5) < 1.0);  // two of four decades below
  CHECK(concentration[4] == 0);
  CHECK(concentration[0] == 0);
  const nlohmann::json& set_free = dust["set_free"];
  CHECK(set_free["kg"].get<double>() == test::approx(4e-6));
  CHECK(set_free["most"].get<double>() == test::approx(4e-6 / 2e-6));  // in 2 cm3
  CHECK(codes(set_free["data"])[11] == 254);
}

TEST_CASE(
    "blocks of several cells shall hold the mean over their air and the sum of what came off") {
  const RunFolder folder;
  {
    const Results results(folder);
    results.frame("000000");
    results.field("/fluid/open_fraction", {1, 1, 1, 0, 1, 1, 1, 1, 1, 1, 1, 1});
    results.field("/fluid/000000/dust_5_um", {3e-3F, 0, 0, 9, 0, 0, 0, 0, 0, 0, 0, 0});
    results.field("/fluid/000000/dust_set_free_by_grains",
                  {2e-6F, 2e-6F, 0, 0, 0, 0, 0, 0, 0, 0, 0, 0});
  }
  const report::H5Source source(folder.path() / "results.h5");
  const nlohmann::json air = {
      {"cells_per_block", {2, 2, 1}}, {"count", {2, 1, 2}}, {"frames", {nlohmann::json::object()}}};
  const nlohmann::json dust = report::dust_field_of(source, {"5_um"}, air);
  REQUIRE(dust.is_object());
  CHECK(dust["most"].get<double>() == test::approx(1e-3));  // three cells of air of four
  CHECK(dust["set_free"]["most"].get<double>() == test::approx(4e-6 / 8e-6));
}
