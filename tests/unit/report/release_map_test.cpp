// SPDX-License-Identifier: Apache-2.0
// The map of where dust comes off, from a results.h5 written by hand.
#include "fake_run.hpp"
#include "report/pictures/pictures.hpp"

#include <doctest/doctest.h>
#include <hdf5.h>

#include <array>
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
  void field(const std::string& path, const std::vector<float>& values) const {
    const hid_t space = H5Screate_simple(3, k_shape.data(), nullptr);
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
  CHECK(map["most"].get<double>() == doctest::Approx(5e-6));
  const auto& kinds = map["kinds"];
  REQUIRE(kinds.size() == 2);  // no wind in this run
  CHECK(kinds[0]["kg"].get<double>() == doctest::Approx(10.01e-6));
  CHECK(kinds[1]["kg"].get<double>() == doctest::Approx(1e-6));
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
