// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "io/hdf5_file.hpp"
#include "io/run_files.hpp"
#include "unit/io/synthetic_frame.hpp"

#include <doctest/doctest.h>
#include <sys/wait.h>
#include <unistd.h>

#include <csignal>
#include <cstdlib>

using namespace dust;
using test::SyntheticFrame;
using test::TemporaryFolder;
using test::text_of;
namespace fs = std::filesystem;

namespace {

const sdk::Vec3 k_min{0, 0, 0};
const sdk::Vec3 k_max{1, 1, 1};

/// A single triangle over the lower corner.
class Corner final : public bodies::OnePart<Corner> {
 public:
  [[nodiscard]] bodies::SurfacePoint nearest(sdk::Vec3) const override { return {}; }
  [[nodiscard]] bodies::Triangles triangles(sdk::Vec3, sdk::Vec3, double) const override {
    return {{0, 0, 0}, {1, 0, 0}, {0, 1, 0}, {1, 0, 0}, {1, 1, 0}, {0, 1, 0}};
  }
  [[nodiscard]] sdk::Vec3 lateral_axis() const override { return {0, 1, 0}; }
};

bodies::BodySet one_body() {
  bodies::BodySet bodies(1);
  bodies[0].name = "plate";
  bodies[0].shape = std::make_unique<Corner>();
  return bodies;
}

std::unique_ptr<io::ResultsFile> open_results(const fs::path& folder, std::int64_t resume,
                                              const bodies::BodySet& bodies = {}) {
  return std::make_unique<io::ResultsFile>(folder, resume, bodies,
                                           std::vector<std::string>{"sand", "belt"}, k_min, k_max);
}

int count_in(const std::string& text, const std::string& word) {
  int count = 0;
  for (std::size_t at = text.find(word); at != std::string::npos; at = text.find(word, at + 1)) {
    ++count;
  }
  return count;
}

/// Number of grains of a frame, read through results.h5.
std::int64_t grains_in(hid_t file, const std::string& frame) {
  return static_cast<std::int64_t>(io::extents_of(file, "particles/" + frame + "/id").at(0));
}

}  // namespace

TEST_CASE("every field of a frame shall be found in results.h5 under its documented name") {
  const TemporaryFolder folder;
  const auto results = open_results(folder.path(), -1, one_body());
  results->append(SyntheticFrame(0, 4, 3, 2, 5).frame());
  results->append(SyntheticFrame(1, 7, 3, 2, 5).frame());

  const io::Handle file = io::open_file(folder.path() / "results.h5");
  CHECK(io::read_attribute(file.get(), "format").at(0) == 1);
  const io::Handle frame = io::open_group(file.get(), "particles/000001");
  CHECK(io::read_attribute(frame.get(), "time").at(0) == 0.02);
  std::vector<float> velocity(3 * 7);
  io::read_array(frame.get(), "velocity", H5T_NATIVE_FLOAT, velocity.data());
  CHECK(velocity[3 * 2 + 1] == static_cast<float>(0.001 * 4 + 2 + 0.25));
  std::vector<std::int64_t> id(7);
  io::read_array(frame.get(), "id", H5T_NATIVE_INT64, id.data());
  CHECK(id[6] == 1006);
  for (const char* name :
       {"position", "angular_velocity", "force", "diameter", "weight", "mass", "material"}) {
    CHECK(io::extents_of(frame.get(), name).at(0) == 7);
  }

  const io::Handle fluid = io::open_group(file.get(), "fluid");
  CHECK(io::read_attribute(fluid.get(), "count") == std::vector<double>{3, 2, 5});
  CHECK(io::read_attribute(fluid.get(), "density").at(0) == 1.2);
  CHECK(io::extents_of(fluid.get(), "open_fraction") == std::vector<hsize_t>{5, 2, 3});
  CHECK(io::extents_of(fluid.get(), "000001/velocity") == std::vector<hsize_t>{5, 2, 3, 3});
  std::vector<float> pressure(30);
  io::read_array(fluid.get(), "000001/pressure", H5T_NATIVE_FLOAT, pressure.data());
  CHECK(pressure[(4 * 2 + 1) * 3 + 2] == SyntheticFrame::pressure_at(2, 1, 4));
  std::vector<float> exchange(90);
  io::read_array(fluid.get(), "000000/momentum_exchange", H5T_NATIVE_FLOAT, exchange.data());
  CHECK(exchange[3 * ((4 * 2 + 1) * 3 + 2) + 2] == SyntheticFrame::pressure_at(2, 1, 4) + 0.5f);

  // Two triangles that share an edge: four corners, not six.
  CHECK(io::extents_of(file.get(), "walls/000001/points") == std::vector<hsize_t>{4, 3});
  CHECK(io::extents_of(file.get(), "walls/000000/triangles") == std::vector<hsize_t>{2, 3});

  const io::Handle dataset(H5Dopen2(fluid.get(), "000000/pressure", H5P_DEFAULT), H5Dclose, "");
  CHECK(H5Aexists(dataset.get(), "units") > 0);
  CHECK(H5Aexists(dataset.get(), "long_name") > 0);
}

TEST_CASE("the XDMF files shall name every frame with its time and number of grains") {
  const TemporaryFolder folder;
  const auto results = open_results(folder.path(), -1, one_body());
  for (int n = 0; n < 3; ++n) results->append(SyntheticFrame(n, n, 3, 2, 5).frame());
  const std::string particles = text_of(folder.path() / "particles.xdmf");
  CHECK(count_in(particles, "<Time Value=") == 3);
  CHECK(count_in(particles, "NumberOfElements=\"2\"") == 1);
  CHECK(count_in(particles, "frames/000002.h5:/particles/position") == 1);
  // The frame without grains names no file: the reader fails on datasets of no extent.
  CHECK(count_in(particles, "frames/000000.h5") == 0);
  const std::string fluid = text_of(folder.path() / "fluid.xdmf");
  CHECK(count_in(fluid, "TopologyType=\"3DCoRectMesh\" Dimensions=\"6 3 4\"") == 3);
  CHECK(count_in(fluid, ">0.3 0.2 0.1</DataItem>") == 3);
  CHECK(count_in(fluid, "Center=\"Cell\"") == 3 * 5);
  CHECK(count_in(text_of(folder.path() / "walls.xdmf"), "TopologyType=\"Triangle\"") == 3);
}

TEST_CASE("the script for ParaView shall stand beside the files it opens and know its folder") {
  const TemporaryFolder folder;
  open_results(folder.path(), -1, one_body());
  const std::string state = text_of(folder.path() / "paraview_state.py");
  CHECK(count_in(state, "\nFOLDER = \"" + folder.path().string() + "\"\n") == 1);
  CHECK(count_in(state, "\nMIN, MAX = [") == 1);
}

TEST_CASE("sets that are empty shall still give one valid grid") {
  const TemporaryFolder folder;
  const auto results = open_results(folder.path(), -1);
  for (const char* name : {"particles.xdmf", "fluid.xdmf", "walls.xdmf"}) {
    CHECK(count_in(text_of(folder.path() / name), "GridType=\"Uniform\"") == 1);
  }
  results->append(SyntheticFrame(0, 0, 0, 0, 0).frame());
  results->append(SyntheticFrame(1, 0, 0, 0, 0).frame());
  for (const char* name : {"particles.xdmf", "fluid.xdmf", "walls.xdmf"}) {
    CHECK(count_in(text_of(folder.path() / name), "GridType=\"Uniform\"") == 2);
  }
  const io::Handle file = io::open_file(folder.path() / "results.h5");
  CHECK(grains_in(file.get(), "000001") == 0);
  CHECK(H5Lexists(file.get(), "fluid", H5P_DEFAULT) > 0);
}

TEST_CASE("a resumed run shall drop later frames and write on") {
  const TemporaryFolder folder;
  {
    const auto results = open_results(folder.path(), -1);
    for (int n = 0; n < 5; ++n) results->append(SyntheticFrame(n, 10 + n, 3, 2, 5).frame());
  }
  {
    const auto results = open_results(folder.path(), 3);
    CHECK(!fs::exists(folder.path() / "frames" / "000003.h5"));
    CHECK(count_in(text_of(folder.path() / "fluid.xdmf"), "<Time Value=") == 3);
    CHECK_THROWS_AS(results->append(SyntheticFrame(2, 1, 3, 2, 5).frame()), base::RunError);
    results->append(SyntheticFrame(3, 99, 3, 2, 5).frame());
  }
  const io::Handle file = io::open_file(folder.path() / "results.h5");
  CHECK(grains_in(file.get(), "000002") == 12);
  CHECK(grains_in(file.get(), "000003") == 99);
  CHECK(H5Lexists(file.get(), "particles/000004", H5P_DEFAULT) == 0);
}

TEST_CASE("a frame that is missing before the checkpoint shall be explained") {
  const TemporaryFolder folder;
  {
    const auto results = open_results(folder.path(), -1);
    for (int n = 0; n < 3; ++n) results->append(SyntheticFrame(n, 1, 0, 0, 0).frame());
  }
  fs::resize_file(folder.path() / "frames" / "000001.h5", 100);
  CHECK_THROWS_AS(open_results(folder.path(), 3), base::UserError);
  CHECK_THROWS_AS(open_results(folder.path(), 4), base::UserError);
  // The state is whole: it goes on elsewhere, and only then is it given up.
  std::string problem;
  try {
    open_results(folder.path(), 3);
  } catch (const base::UserError& e) {
    problem = e.what();
  }
  const auto way = problem.find("--set start_from=" + folder.path().string());
  CHECK_MESSAGE(way != std::string::npos, problem);
  CHECK(way < problem.find("--force"));
}

TEST_CASE("the results shall be moved to another folder as a whole") {
  const TemporaryFolder folder;
  const fs::path before = folder.path() / "a";
  fs::create_directory(before);
  open_results(before, -1)->append(SyntheticFrame(0, 5, 0, 0, 0).frame());
  fs::rename(before, folder.path() / "b");
  const io::Handle file = io::open_file(folder.path() / "b" / "results.h5");
  CHECK(grains_in(file.get(), "000000") == 5);
}

TEST_CASE("a writer that is killed at any moment shall leave readable results and resume") {
  const TemporaryFolder folder;
  const SyntheticFrame shape(0, 2000, 40, 4, 40);
  std::int64_t known = 0;
  int kills_during_writing = 0;
  constexpr int k_kills = 25;
  for (int attempt = 0; attempt < k_kills; ++attempt) {
    int pipe_ends[2];
    REQUIRE(::pipe(pipe_ends) == 0);
    const pid_t child = ::fork();
    if (child == 0) {
      const auto results = open_results(folder.path(), known == 0 ? -1 : known);
      const char ready = 'r';
      if (::write(pipe_ends[1], &ready, 1) != 1) ::_exit(1);
      for (std::int64_t n = known;; ++n) {
        io::Frame frame = shape.frame();
        frame.number = n;
        frame.time = 0.01 * static_cast<double>(n);
        results->append(frame);
      }
    }
    REQUIRE(child > 0);
    char ready = 0;
    REQUIRE(::read(pipe_ends[0], &ready, 1) == 1);
    ::usleep(3000 + 1777 * static_cast<useconds_t>(attempt));
    ::kill(child, SIGKILL);
    int status = 0;
    REQUIRE(::waitpid(child, &status, 0) == child);
    REQUIRE(WIFSIGNALED(status));
    ::close(pipe_ends[0]);
    ::close(pipe_ends[1]);
    for (const auto& entry : fs::recursive_directory_iterator(folder.path())) {
      if (entry.path().extension() == ".part") ++kills_during_writing;
    }

    const io::Handle file = io::open_file(folder.path() / "results.h5");
    const int listed = count_in(text_of(folder.path() / "particles.xdmf"), "<Topology");
    std::int64_t readable = 0;
    while (H5Lexists(file.get(),
                     ("particles/" + std::to_string(1000000 + readable).substr(1)).c_str(),
                     H5P_DEFAULT) > 0) {
      const std::string number = std::to_string(1000000 + readable).substr(1);
      REQUIRE(grains_in(file.get(), number) == 2000);
      std::vector<float> pressure(40 * 4 * 40);
      io::read_array(file.get(), "fluid/" + number + "/pressure", H5T_NATIVE_FLOAT,
                     pressure.data());
      REQUIRE(pressure.back() == SyntheticFrame::pressure_at(39, 3, 39));
      ++readable;
    }
    REQUIRE(readable >= known);
    // The frame in progress may be in one index and not yet in the other.
    if (readable > 0) CHECK(std::abs(listed - readable) <= 1);
    // As after a checkpoint that is some frames old.
    known = readable - readable / 3;
  }
  CHECK(known > 0);
  CHECK(kills_during_writing > 0);
}
