// SPDX-License-Identifier: Apache-2.0
#include "support/engine.hpp"

#include <doctest/doctest.h>
#include <nlohmann/json.hpp>

#include <cstdlib>
#include <filesystem>
#include <fstream>

using dust::test::engine;
using dust::test::json_text;
using dust::test::read_file;
using dust::test::TemporaryFolder;
namespace fs = std::filesystem;

namespace {

const std::string k_scenario = DUST_SOURCE "/tests/scenario/small_transfer.yaml";
// Long enough for the first grains to lie on the belt.
const std::string k_short = "time.end=0.012 s";

/// What every summary holds, whatever takes part.
void check_contract(const fs::path& file) {
  const auto summary = nlohmann::json::parse(read_file(file));
  for (const char* key : {"scenario", "version", "status", "state_sha256"}) {
    CAPTURE(key);
    CHECK(summary[key].is_string());
  }
  for (const char* key :
       {"threads", "peak_rss_bytes", "dem_steps", "fluid_steps", "particle_steps"}) {
    CAPTURE(key);
    CHECK(summary[key].is_number_integer());
  }
  for (const char* key : {"wall_s", "cpu_s", "simulated_s"}) {
    CAPTURE(key);
    CHECK(summary[key].is_number());
  }
  for (const char* of : {"particles", "real_particles", "mass_kg"}) {
    for (const char* key : {"emitted", "in_domain", "left", "removed"}) {
      CAPTURE(of);
      CAPTURE(key);
      CHECK(summary[of][key].is_number());
    }
  }
  for (const char* of : {"particles", "real_particles"}) {
    CAPTURE(of);
    CHECK(summary[of]["max"] >= summary[of]["in_domain"]);
    CHECK(summary[of]["max"] <= summary[of]["emitted"]);
  }
  for (const char* key : {"contact", "neighbour", "integration", "voidage", "fluid", "output"}) {
    CAPTURE(key);
    CHECK(summary["timers_s"][key].is_number());
  }
  CHECK(summary["sensors"].is_object());
}

}  // namespace

TEST_CASE("a run shall leave every file of the contract and balance its grains") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto run = engine({"run", k_scenario, "-o", out, "--set", k_short, "--quiet"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  for (const char* file :
       {"scenario.yaml", "summary.json", "series.csv", "results.h5", "particles.xdmf", "fluid.xdmf",
        "walls.xdmf", "checkpoint.h5", "run.log", "report.html"}) {
    CAPTURE(file);
    REQUIRE(fs::exists(out / file));
    CHECK(fs::file_size(out / file) > 0);
  }
  const fs::path summary = out / "summary.json";
  CHECK(json_text(summary, "status") == "finished");
  CHECK(json_text(summary, "removed") == "0");
  CHECK(std::stoll(json_text(summary, "emitted")) > 300);  // 12 ms of 39,000 grains per second
  CHECK(std::stoll(json_text(summary, "emitted")) ==
        std::stoll(json_text(summary, "in_domain")) + std::stoll(json_text(summary, "left")));
  CHECK(std::stod(json_text(summary, "largest_overlap_over_radius")) > 0.0);
  CHECK(std::stod(json_text(summary, "largest_momentum_imbalance")) < 1e-12);
  check_contract(summary);
}

TEST_CASE("the written scenario shall give the same bits on one and on two threads") {
  const TemporaryFolder folder;
  const fs::path first = folder / "first";
  REQUIRE(engine({"run", k_scenario, "-o", first, "--set", k_short, "--threads", "1", "--quiet"})
              .status == 0);
  const auto hash = json_text(first / "summary.json", "state_sha256");
  CHECK(hash.size() == 64);
  const fs::path second = folder / "second";
  REQUIRE(engine({"run", (first / "scenario.yaml"), "-o", second, "--threads", "2", "--quiet"})
              .status == 0);
  CHECK(json_text(second / "summary.json", "state_sha256") == hash);
  // Another seed is another stream: the comparison above can fail.
  const fs::path other = folder / "other";
  REQUIRE(engine({"run", k_scenario, "-o", other, "--set", k_short, "--set", "seed=2", "--quiet"})
              .status == 0);
  CHECK(json_text(other / "summary.json", "state_sha256") != hash);
}

TEST_CASE("pages of 2 MB shall be asked for where one has to ask, and change no bit") {
  const TemporaryFolder folder;
  const auto run = [&](const char* name) {
    const fs::path to = folder / name;
    REQUIRE(engine({"run", k_scenario, "-o", to, "--set", k_short, "--quiet"}).status == 0);
    return to / "summary.json";
  };
  const fs::path large = run("large");
  setenv("GLIBC_TUNABLES", "glibc.malloc.hugetlb=0", 1);
  const fs::path small = run("small");
  unsetenv("GLIBC_TUNABLES");
  CHECK(json_text(large, "state_sha256") == json_text(small, "state_sha256"));
// Sanitizers bring an allocator of their own.
#if !defined(__SANITIZE_ADDRESS__) && !defined(__SANITIZE_THREAD__)
  if (read_file("/sys/kernel/mm/transparent_hugepage/enabled").find("[madvise]") !=
      std::string::npos) {
    CHECK(std::stoll(json_text(large, "huge_page_bytes")) > 0);
    CHECK(std::stoll(json_text(small, "huge_page_bytes")) == 0);
  }
#endif
}

TEST_CASE("grains alone shall run from the same scenario") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto run =
      engine({"run", k_scenario, "-o", out, "--set", k_short, "--set", "fluid=none", "--quiet"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK(json_text(out / "summary.json", "fluid_steps") == "0");
  check_contract(out / "summary.json");
  CHECK(json_text(out / "summary.json", "voidage") == "0.0");
}

TEST_CASE("a fluid that diverges shall stop the run with place, time, cause and remedy") {
  const TemporaryFolder folder;
  const fs::path file = folder / "blast.yaml";
  const auto write = [&](const std::string& speed, const std::string& viscosity) {
    std::ofstream(file) << "time: {end: 0.2 s, fluid_step: 1 ms, output_every: 50 ms}\n"
                           "gravity: [0, 0, -9.81]\n"
                           "domain:\n"
                           "  min: [0, 0, 0]\n"
                           "  max: [80, 10, 80 mm]\n"
                           "  boundaries:\n"
                           "    left: {grains: open, air: {model: velocity_inlet, measure: "
                           "superficial, speed: "
                        << speed
                        << "}}\n"
                           "    right: {grains: open, air: {model: static_pressure, pressure: 0}}\n"
                           "    front: {grains: open, air: {model: slip}}\n"
                           "    back: {grains: open, air: {model: slip}}\n"
                           "    bottom: {grains: open, air: {model: no_slip}}\n"
                           "    top: {grains: open, air: {model: no_slip}}\n"
                           "fluid: {cells: [16, 1, 16], density: 1.2, viscosity: "
                        << viscosity << "}\n";
  };
  write("2e4 m/s", "18 uPa s");
  const fs::path out = folder / "out";
  const auto run = engine({"run", file, "-o", out, "--quiet"});
  INFO(run.err);
  CHECK(run.status == 1);
  CHECK(run.err.find("the fluid diverged: velocity component x beyond 1e4 m/s at [") !=
        std::string::npos);
  CHECK(run.err.find("] m, t = 0 s") != std::string::npos);
  CHECK(run.err.find("shorten time.fluid_step") != std::string::npos);
  CHECK(json_text(out / "summary.json", "status") == "failed");
  // A step that no number of sub-steps makes up for.
  write("5000 m/s", "18 uPa s");
  const auto fast = engine({"run", file, "-o", folder / "fast", "--quiet"});
  INFO(fast.err);
  CHECK(fast.status == 1);
  CHECK(fast.err.find("more than 200 sub-steps") != std::string::npos);
  CHECK(fast.err.find("time.fluid_step is far too long") != std::string::npos);
}

TEST_CASE("means over no time shall be null, and told before") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto run = engine({"run", k_scenario, "-o", out, "--set", k_short, "--set",
                           "sensors.lip.steady_after=8 s", "--quiet"});
  INFO(run.err);
  REQUIRE(run.status == 0);
  CHECK(run.err.find("sensors.lip.steady_after: 8 s is not before time.end, 0.012 s") !=
        std::string::npos);
  const auto lip = nlohmann::json::parse(read_file(out / "summary.json"))["sensors"]["lip"];
  CHECK(lip["observed_time"]["value"] == 0.0);
  CHECK(lip["net/mass_rate"]["value"].is_null());
  CHECK(lip["net/grams_per_tonne"]["value"].is_null());
  CHECK(lip["forward/mass"]["value"].is_number());
}

TEST_CASE("a used folder shall not be overwritten unless forced") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  fs::create_directories(out);
  { std::ofstream(out / "precious") << "data"; }
  const auto refused = engine({"run", k_scenario, "-o", out, "--set", k_short, "--quiet"});
  CHECK(refused.status == 2);
  CHECK(refused.err.find("--force") != std::string::npos);
  CHECK(refused.err.find("--resume") != std::string::npos);
  CHECK(read_file(out / "precious") == "data");
}

TEST_CASE("force shall replace a run and nothing else") {
  const TemporaryFolder folder;
  const auto forced = [&](const fs::path& scenario, const fs::path& out,
                          const std::vector<std::string>& more = {}) {
    std::vector<std::string> arguments{"run",   scenario, "-o",      out,
                                       "--set", k_short,  "--quiet", "--force"};
    arguments.insert(arguments.end(), more.begin(), more.end());
    return engine(arguments);
  };
  // Somebody's own files under the names that a run's have.
  const fs::path own = folder / "own";
  fs::create_directories(own / "frames");
  { std::ofstream(own / "scenario.yaml") << "mine"; }
  { std::ofstream(own / "frames/notes.txt") << "data"; }
  const auto refused = forced(k_scenario, own);
  CHECK(refused.status == 2);
  CHECK(refused.err.ends_with("error: --force: " + own.string() +
                              " holds no run (no run.log), but scenario.yaml, which would be lost: "
                              "give another -o\n"));
  CHECK(read_file(own / "frames/notes.txt") == "data");
  CHECK(read_file(own / "scenario.yaml") == "mine");
  // A study.
  const fs::path study = folder / "study";
  fs::create_directories(study);
  { std::ofstream(study / "study.lock"); }
  CHECK(forced(k_scenario, study).err.find("holds a study, which a run does not replace") !=
        std::string::npos);
  // A run, but not the scenario or the state that it is made from.
  const fs::path out = folder / "out";
  REQUIRE(forced(k_scenario, out).status == 0);
  REQUIRE(forced(k_scenario, out).status == 0);
  const std::string before = read_file(out / "summary.json");
  for (const auto& again :
       {forced(out / "scenario.yaml", out),
        forced(k_scenario, out,
               {"--set", "start_from=" + out.string(), "--set", "time.end=1 s"})}) {
    INFO(again.err);
    CHECK(again.status == 2);
    CHECK(again.err.find(", which this run reads: copy it elsewhere, or give another -o") !=
          std::string::npos);
  }
  CHECK(read_file(out / "summary.json") == before);
}

TEST_CASE("force shall keep what the scenario includes and what is laid over it") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  REQUIRE(engine({"run", k_scenario, "-o", out, "--set", k_short, "--quiet"}).status == 0);
  const std::string kept = read_file(out / "scenario.yaml");
  { std::ofstream(folder / "over.yaml") << "include: out/scenario.yaml\nseed: 7\n"; }
  { std::ofstream(folder / "above.yaml") << "include: over.yaml\n"; }
  const std::string lost = (out / "scenario.yaml").string() + ", which this run reads";
  for (const std::vector<std::string>& how : std::vector<std::vector<std::string>>{
           {folder / "above.yaml"}, {k_scenario, "--set-file", folder / "over.yaml"}}) {
    std::vector<std::string> arguments{"run", "-o", out, "--force", "--quiet"};
    arguments.insert(arguments.end(), how.begin(), how.end());
    const auto refused = engine(arguments);
    INFO(refused.err);
    CHECK(refused.status == 2);
    CHECK(refused.err.find(lost) != std::string::npos);
    CHECK(read_file(out / "scenario.yaml") == kept);
  }
}

TEST_CASE("a comparison shall be written over no file but a page") {
  const TemporaryFolder folder;
  const fs::path run = folder / "run";
  REQUIRE(engine({"run", DUST_SOURCE "/tests/scenario/small_hourglass.yaml", "-o", run, "--set",
                  "time.end=2 ms", "--quiet"})
              .status == 0);
  const auto compare = [&](const fs::path& page) {
    return engine({"compare", run, run, "-o", page});
  };
  { std::ofstream(folder / "mine.yaml") << "name: mine"; }
  { std::ofstream(folder / "mine.html") << "<p>mine"; }
  CHECK(compare(folder / "mine.yaml").err ==
        "error: -o " + (folder / "mine.yaml").string() +
            ": a page is written; give it a name that ends with .html\n");
  CHECK(compare(folder / "mine.html")
            .err.ends_with("mine.html: exists and is no page of this engine; give another name\n"));
  CHECK(compare(run / "report.html").status == 2);
  CHECK(read_file(folder / "mine.yaml") == "name: mine");
  CHECK(read_file(folder / "mine.html") == "<p>mine");
  CHECK(compare(folder / "both.html").status == 0);
  CHECK(compare(folder / "both.html").status == 0);  // its own
}

TEST_CASE("a file given as output folder shall be refused as one, also with force") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  { std::ofstream(out) << "data"; }
  for (const std::string how : {"--quiet", "--force", "--resume"}) {
    CAPTURE(how);
    const auto refused = engine({"run", k_scenario, "-o", out, "--set", k_short, how});
    CHECK(refused.status == 2);
    CHECK(refused.err.ends_with("error: -o " + out.string() +
                                " is a file, results go to a folder: give another -o\n"));
  }
  CHECK(read_file(out) == "data");
}

TEST_CASE("a folder that cannot be made shall be refused as a wrong -o") {
  const TemporaryFolder folder;
  { std::ofstream(folder / "file") << "data"; }
  fs::create_symlink(folder / "nowhere", folder / "link");
  const auto message_of = [&](const std::string& out, const char* how) {
    const auto refused = engine({"run", k_scenario, "-o", out, "--set", k_short, how});
    CHECK(refused.status == 2);
    return refused.err;
  };
  CHECK(message_of(folder / "file/out", "--quiet").find("cannot be made") != std::string::npos);
  CHECK(message_of(folder / "link", "--quiet").find("nowhere, which is not there") !=
        std::string::npos);
  CHECK(message_of(folder / std::string(300, 'a'), "--quiet").find("File name too long") !=
        std::string::npos);
  const std::string latin = folder / "caf\xE9";
  CHECK(message_of(latin, "--quiet").find("not UTF-8") != std::string::npos);
  CHECK_FALSE(fs::exists(latin));
}

TEST_CASE("a broken scenario shall exit with 2, say where, and leave no folder") {
  const TemporaryFolder folder;
  const fs::path out = folder / "out";
  const auto run = engine({"run", k_scenario, "-o", out, "--set", "fluid.viscocity=1"});
  CHECK(run.status == 2);
  CHECK(run.err.find("viscosity") != std::string::npos);
  CHECK_FALSE(fs::exists(out));
}

TEST_CASE("a flow that its opening cannot pass shall be refused before anything is written") {
  const TemporaryFolder folder;
  for (const char* command : {"run", "check"}) {
    const fs::path out = folder / (command + std::string(".html"));  // what check writes is a page
    const auto run = engine({command, k_scenario, "-o", out, "--set", "emitters.feed.mass_flow=1"});
    CAPTURE(run.err);
    CHECK(run.status == 2);
    CHECK(run.err.find("transfer_point.yaml:") != std::string::npos);
    CHECK(run.err.find("emitters.feed: the opening cannot pass the flow") != std::string::npos);
    CHECK_FALSE(fs::exists(out));
  }
}

TEST_CASE("the graph shall be printed as DOT with the nodes of the cycle") {
  const auto run = engine({"graph", k_scenario});
  REQUIRE(run.status == 0);
  for (const char* name : {"voidage", "fluid", "dem_cycle", "contact", "force", "integration"}) {
    CHECK(run.out.find(name) != std::string::npos);
  }
}

TEST_CASE(
    "a feed shall be told to fall short where it is blocked, not where its last grains wait") {
  const TemporaryFolder folder;
  const auto run = [&](const std::string& name, const std::string& gravity) {
    return engine({"run", k_scenario, "-o", folder / name, "--set", "time.end=0.03 s", "--set",
                   "gravity=" + gravity, "--set", "fluid=none", "--quiet"});
  };
  const auto falling = run("falling", "[0, 0, -9.81]");
  CHECK(falling.status == 0);
  CHECK(falling.err.find("falls short") == std::string::npos);
  CHECK(json_text(folder / "falling" / "summary.json", "waiting") != "0");
  // What comes back upwards is in the way of what follows.
  const auto rising = run("rising", "[0, 0, 20]");
  CHECK(rising.err.find("'feed' falls short") != std::string::npos);
}

TEST_CASE("the load of a scenario written by engine new shall leave its feed free") {
  const TemporaryFolder folder;
  const auto file = folder / "mine.yaml";
  REQUIRE(engine({"new", "transfer", "-o", file}).status == 0);
  const auto run = engine({"run", file, "-o", folder / "out", "--quiet", "--set", "time.end=0.2 s",
                           "--set", "fluid.cells=[30, 1, 16]"});
  INFO(run.err);
  CHECK(run.status == 0);
  CHECK(run.err.find("falls short") == std::string::npos);
}

TEST_CASE("a scenario written by engine new shall be valid whatever its file is called") {
  const TemporaryFolder folder;
  for (const char* name : {"2nd belt.yaml", "my.first-belt.yaml"}) {
    CAPTURE(name);
    const auto file = folder / name;
    REQUIRE(engine({"new", "transfer", "-o", file}).status == 0);
    const auto check = engine({"check", file});
    INFO(check.err);
    CHECK(check.status == 0);
  }
}

TEST_CASE("a scenario written by engine new shall be valid in any sizes, without a warning") {
  const TemporaryFolder folder;
  const std::vector<std::vector<std::string>> all = {
      {"transfer"},
      {"transfer", "--speed", "3 m/s", "--drop", "3 ft", "--flow", "2 t/h", "--grain", "5 mm",
       "--width", "60 mm"},
      {"hopper"},
      {"hopper", "--outlet", "1 in", "--diameter", "100 mm", "--mass", "1 lb", "--grain", "3 mm"}};
  for (std::size_t n = 0; n < all.size(); ++n) {
    const auto file = folder / ("mine" + std::to_string(n) + ".yaml");
    std::vector<std::string> arguments{"new"};
    arguments.insert(arguments.end(), all[n].begin(), all[n].end());
    arguments.insert(arguments.end(), {"-o", file});
    CAPTURE(n);
    const auto made = engine(arguments);
    INFO(made.err);
    REQUIRE(made.status == 0);
    const auto checked = engine({"check", file});
    INFO(checked.err);
    CHECK(checked.status == 0);
    CHECK(checked.err.empty());
    // Soft for quick steps, and the file says how soft and what it means.
    const std::string text = read_file(file);
    CHECK(text.find("so that a run takes minutes: after a fall of") != std::string::npos);
    CHECK(text.find("# For some 5 %: young_modulus: ") != std::string::npos);
    // Never over a file that is there.
    CHECK(engine(arguments).status == 2);
  }
  // The commands of its first lines are of the file as it is called.
  const auto named = folder / "9 hoppers.yml";
  REQUIRE(engine({"new", "hopper", "--outlet", "5 mm", "-o", named}).status == 0);
  CHECK(read_file(named).find("engine check '9 hoppers.yml'; engine run '9 hoppers.yml'\n") !=
        std::string::npos);
  // Of an outlet of a few grains a check tells what it will do.
  CHECK(engine({"check", named})
            .err.find("its hole of 5 mm is 2.5 times as wide as the largest grains (2 mm)") !=
        std::string::npos);
  // Sizes that do not go together are told by their options; nothing is written.
  const auto refused = [&](std::vector<std::string> arguments) {
    arguments.insert(arguments.begin(), "new");
    arguments.insert(arguments.end(), {"-o", folder / "x.yaml"});
    const auto run = engine(arguments);
    CHECK(run.status == 2);
    CHECK(!fs::exists(folder / "x.yaml"));
    return run.err;
  };
  CHECK(refused({"hopper", "--outlet", "300 mm"}) ==
        "engine new: error: --outlet 300 mm in a hopper of --diameter 60 mm: it has to be two "
        "grains wider; give a wider one\n");
  CHECK(refused({"transfer", "--grain", "50 mm"})
            .starts_with("engine new: error: --grain 50 mm in a slice of --width 20 mm: "));
  CHECK(refused({"transfer", "--flow", "300 t/h"}).find("of the slice") != std::string::npos);
  CHECK(refused({"transfer", "--drop", "1300"}) ==
        "engine new: error: --drop: 1300 has no unit and would be 1300 m: write '1300 mm' or "
        "'1300 m'\n");
  const auto wrong = engine({"new", "hopper", "--mass", "3 mm", "-o", folder / "x.yaml"});
  CHECK(wrong.status == 2);
  CHECK(wrong.err.find("--mass: 'mm' is the unit of a length: a mass is expected") !=
        std::string::npos);
  CHECK(engine({"new", "belt"}).err ==
        "engine new: error: there is no scenario 'belt' to start from; there are: transfer, "
        "hopper\n");
  CHECK(engine({"new", "hoper"}).err.find("did you mean 'hopper'?") != std::string::npos);
  CHECK(engine({"new"}).err == "engine new: error: which scenario? There are: transfer, hopper\n");
  const auto more = engine({"new", "hopper", "belt", "-o", folder / "y.yaml"});
  CHECK(more.status == 2);
  CHECK(more.err.find("not expected: belt") != std::string::npos);
  CHECK_FALSE(fs::exists(folder / "y.yaml"));
}
