// SPDX-License-Identifier: Apache-2.0
#include "base/error.hpp"
#include "dust/sdk/error.hpp"
#include "io/run_files.hpp"
#include "unit/io/synthetic_frame.hpp"

#include <doctest/doctest.h>

#include <cstring>
#include <fstream>
#include <limits>

using namespace dust;
using test::TemporaryFolder;

namespace {

const std::string k_scenario =
    "name: belt\ntime:\n  end: 0.7\n  fluid_step: 0.001\nbodies:\n  belt:\n    speed: 0.8\n";

void write(const std::filesystem::path& file, const std::string& yaml,
           const std::vector<double>& values, const std::vector<io::InputFile>& inputs = {}) {
  io::write_checkpoint(file, {yaml, inputs},
                       {{"run", [](sdk::ArchiveWriter& a) { a.integer("frames", 17); }},
                        {"sensors/lip", [&](sdk::ArchiveWriter& a) {
                           a.numbers("values", values);
                           a.numbers("none", {});
                           a.integers("no_integers", {});
                         }}});
}

std::vector<double> read(const std::filesystem::path& file, const std::string& yaml) {
  std::vector<double> values;
  io::read_checkpoint(file, {yaml, {}},
                      {{"run", [](sdk::ArchiveReader& a) { CHECK(a.integer("frames") == 17); }},
                       {"sensors/lip", [&](sdk::ArchiveReader& a) {
                          values = a.numbers("values");
                          CHECK(a.numbers("none").empty());
                          CHECK(a.integers("no_integers").empty());
                        }}});
  return values;
}

std::string message_of(const std::filesystem::path& file, const std::string& yaml) {
  try {
    read(file, yaml);
  } catch (const base::UserError& e) {
    return e.what();
  }
  return "";
}

std::string replaced(std::string text, const std::string& from, const std::string& to) {
  return text.replace(text.find(from), from.size(), to);
}

}  // namespace

TEST_CASE("a checkpoint shall give back every bit and empty arrays") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  const std::vector<double> values = {0.1, -0.0, 5e-324, std::numeric_limits<double>::infinity(),
                                      3};
  write(file, k_scenario, values);
  write(file, k_scenario, values);
  const std::vector<double> back = read(file, k_scenario);
  REQUIRE(back.size() == values.size());
  CHECK(std::memcmp(back.data(), values.data(), sizeof(double) * values.size()) == 0);
  CHECK(!std::filesystem::exists(folder.path() / "checkpoint.h5.part"));
}

TEST_CASE("a checkpoint shall be read with another end of time and nothing else changed") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  write(file, k_scenario, {1});
  CHECK(read(file, replaced(k_scenario, "end: 0.7", "end: 1.5")).size() == 1);
  const std::string other = message_of(file, replaced(k_scenario, "speed: 0.8", "speed: 0.4"));
  CHECK(other.find("bodies.belt.speed: 0.8") != std::string::npos);
  CHECK(other.find("bodies.belt.speed: 0.4") != std::string::npos);
  CHECK(message_of(file, replaced(k_scenario, "fluid_step: 0.001", "fluid_step: 0.002")) != "");
  CHECK(message_of(file, k_scenario + "fluid: none\n").find("fluid: none") != std::string::npos);
  CHECK(message_of(file, replaced(k_scenario, "name: belt\n", "")) != "");
}

TEST_CASE("the layout of the scenario's text shall not matter, its values shall") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  const std::string block = "name: a\ntime:\n  end: 0.75 s\n  fluid_step: 0.001\nlist: [1, 2]\n";
  const std::string flow = "name: 'a'\ntime: {end: 1, fluid_step: 0.001}\nlist:\n  - 1\n  - 2\n";
  write(file, block, {1});
  CHECK(read(file, flow).size() == 1);
  CHECK(message_of(file, replaced(flow, "0.001", "0.002")).find("time.fluid_step: 0.002") !=
        std::string::npos);
  CHECK(message_of(file, replaced(flow, "  - 2", "  - 3")).find("list[1]: 3") != std::string::npos);
}

TEST_CASE("an `end` elsewhere than in the time block shall count") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  const std::string scenario = "time:\n  end: 1\nemitters:\n  feed:\n    end: 1\n";
  write(file, scenario, {1});
  CHECK(message_of(file, replaced(scenario, "    end: 1", "    end: 2")) != "");
}

TEST_CASE("a missing or damaged checkpoint shall be explained") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  CHECK(message_of(file, k_scenario).find("no checkpoint") != std::string::npos);

  std::vector<double> values(20000);
  for (std::size_t i = 0; i < values.size(); ++i) values[i] = static_cast<double>(i * i);
  write(file, k_scenario, values);
  const std::string whole = test::text_of(file);
  for (const double share : {0.0, 0.1, 0.5, 0.99}) {
    const auto length = static_cast<std::streamsize>(share * static_cast<double>(whole.size()));
    std::ofstream(file, std::ios::binary).write(whole.data(), length);
    CHECK(message_of(file, k_scenario).find("damaged") != std::string::npos);
  }
  // One flipped byte in the middle of the numbers: the checksum notices.
  std::string flipped = whole;
  flipped[whole.size() / 2] = static_cast<char>(flipped[whole.size() / 2] ^ 0x40);
  std::ofstream(file, std::ios::binary)
      .write(flipped.data(), static_cast<std::streamsize>(flipped.size()));
  CHECK(message_of(file, k_scenario).find("damaged") != std::string::npos);
  std::ofstream(file, std::ios::binary) << "no such format";
  CHECK(message_of(file, k_scenario).find("damaged") != std::string::npos);
}

TEST_CASE("a state that is not in the checkpoint shall be named") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  write(file, k_scenario, {1});
  try {
    io::read_checkpoint(
        file, {k_scenario, {}},
        {{"sensors/new", [](sdk::ArchiveReader& a) { (void)a.numbers("values"); }}});
    FAIL("no error");
  } catch (const base::UserError& e) {
    CHECK(std::string(e.what()).find("sensors/new") != std::string::npos);
  }
}

TEST_CASE("an error while saving shall leave the checkpoint before it in place") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  write(file, k_scenario, {1, 2});
  CHECK_THROWS(io::write_checkpoint(file, {k_scenario, {}}, {{"run", [](sdk::ArchiveWriter&) {
                                                                throw sdk::ModelError("not finite");
                                                              }}}));
  CHECK(read(file, k_scenario).size() == 2);
}

TEST_CASE("files of a scenario shall be the same by what stands in them, not by their names") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  const std::string then = "name: a\nbodies:\n  r:\n    file: /then/box.stl\n    unit: 0.001\n";
  const std::string now = replaced(then, "/then/", "/now/");
  const auto resumed = [&](const std::string& yaml, const std::string& name,
                           const std::string& sha256) {
    return io::read_checkpoint(file, {yaml, {{name, sha256}}}, {});
  };
  const auto message = [&](const std::string& yaml, const std::string& name,
                           const std::string& sha256) -> std::string {
    try {
      resumed(yaml, name, sha256);
    } catch (const base::UserError& e) {
      return e.what();
    }
    return "";
  };
  write(file, then, {1}, {{"/then/box.stl", "aaaa"}});
  const auto same = resumed(then, "/then/box.stl", "aaaa");
  CHECK(same.log_lines.empty());
  CHECK(same.inputs == std::vector<io::InputFile>{{"/then/box.stl", "aaaa"}});
  const auto moved = resumed(now, "/now/box.stl", "aaaa");
  REQUIRE(moved.log_lines.size() == 1);
  CHECK(moved.log_lines[0] ==
        "bodies.r.file: /now/box.stl in place of /then/box.stl, with the same content");
  CHECK(message(then, "/then/box.stl", "bbbb")
            .find("bodies.r.file: /then/box.stl is not the file that the run began with (sha256 "
                  "aaaa then, sha256 bbbb now)") != std::string::npos);
  CHECK(message(now, "/now/box.stl", "bbbb").find(", /then/box.stl (sha256 aaaa then") !=
        std::string::npos);
  CHECK(message(replaced(now, "0.001", "1"), "/now/box.stl", "bbbb").find("bodies.r.unit: 0.001") !=
        std::string::npos);

  // Of older checkpoints, which do not say, the names count.
  write(file, then, {1});
  const auto unknown = resumed(then, "/then/box.stl", "aaaa");
  REQUIRE(unknown.log_lines.size() == 1);
  CHECK(unknown.log_lines[0].find("does not say what stood in /then/box.stl") != std::string::npos);
  CHECK(message(now, "/now/box.stl", "aaaa").find("belongs to another scenario") !=
        std::string::npos);
}

TEST_CASE("the state that a run began with shall be kept as it was then") {
  const TemporaryFolder folder;
  const auto file = folder.path() / "checkpoint.h5";
  const std::string yaml = "name: a\nstart_from: /base\n";
  write(file, yaml, {1}, {{"/base", "aaaa"}});
  const auto changed = io::read_checkpoint(file, {yaml, {{"/base", "bbbb"}}}, {});
  REQUIRE(changed.warnings.size() == 1);
  CHECK(changed.inputs == std::vector<io::InputFile>{{"/base", "aaaa"}});
  // That run may be gone.
  const auto gone = io::read_checkpoint(file, {yaml, {}}, {});
  CHECK(gone.warnings.empty());
  CHECK(gone.inputs == std::vector<io::InputFile>{{"/base", "aaaa"}});
}
