// SPDX-License-Identifier: Apache-2.0
#include "study/launchers/slurm_script.hpp"

#include <doctest/doctest.h>

#include <sys/wait.h>
#include <unistd.h>

#include <cstdlib>
#include <filesystem>
#include <fstream>
#include <iterator>

namespace {

namespace fs = std::filesystem;
using namespace dust::study;

/// A study's folder with three points, and a shell script in the engine's place.
class Folder {
 public:
  explicit Folder(const std::string& engine)
      : path_(fs::temp_directory_path() / ("dust slurm's " + std::to_string(::getpid()))) {
    fs::remove_all(path_);
    fs::create_directories(path_ / "points");
    fs::create_directories(path_ / "slurm");
    write("slurm/points", "one\ntwo\nthree\n");
    write("engine", "#!/bin/sh\n" + engine);
    fs::permissions(path_ / "engine", fs::perms::owner_all);
  }
  ~Folder() { fs::remove_all(path_); }
  Folder(const Folder&) = delete;
  Folder& operator=(const Folder&) = delete;

  void write(const std::string& name, const std::string& text) const {
    std::ofstream(path_ / name) << text;
  }
  [[nodiscard]] std::string read(const std::string& name) const {
    std::ifstream stream(path_ / name);
    return {std::istreambuf_iterator<char>(stream), {}};
  }
  [[nodiscard]] bool has(const std::string& name) const { return fs::exists(path_ / name); }
  [[nodiscard]] SlurmJob job() const {
    SlurmJob job;
    job.name = "speeds";
    job.store = path_;
    job.resources.engine = path_ / "engine";
    job.resources.threads = 2;
    job.points = 3;
    job.memory_bytes = 1024.0 * 1024.0 * 100.0;
    return job;
  }
  /// Runs the script of `job` as task `task` of its array; its exit status. `after` stands behind
  /// it.
  [[nodiscard]] int run(const SlurmJob& job, int task, const std::string& after = "") const {
    write("job.sh", slurm_script(job));
    const std::string command = "cd / && SLURM_ARRAY_TASK_ID=" + std::to_string(task) + " sh " +
                                shell_quoted((path_ / "job.sh").string()) + after;
    const int status = std::system(command.c_str());
    return WIFEXITED(status) ? WEXITSTATUS(status) : -1;
  }

 private:
  fs::path path_;
};

bool asks(const SlurmJob& job, const std::string& option) {
  return slurm_script(job).find("#SBATCH " + option + "\n") != std::string::npos;
}

}  // namespace

TEST_CASE("a job of the cluster shall run the point of its line and leave the exit status") {
  const Folder folder("echo \"$@\"\nexit 3\n");
  CHECK(folder.run(folder.job(), 1) == 1);
  CHECK(folder.read("slurm/two.exit") == "3\n");
  CHECK(folder.read("points/two.log") ==
        "run points/two.yaml -o points/two --quiet --threads 2 --force\n");
  CHECK_FALSE(folder.has("slurm/one.exit"));
  CHECK_FALSE(folder.has("slurm/three.exit"));
}

TEST_CASE("a job of the cluster shall go on from a checkpoint") {
  const Folder folder("echo \"$@\"\n");
  fs::create_directories(folder.job().store / "points/one");
  folder.write("points/one/checkpoint.h5", "");
  CHECK(folder.run(folder.job(), 0) == 0);
  CHECK(folder.read("points/one.log").find("--resume") != std::string::npos);
}

TEST_CASE("a job of several points shall run them side by side and ask for what all need") {
  // Each waits until the other has begun: one after the other they would never end.
  const Folder folder(
      "touch \"$4.begun\"\n"
      "n=0\n"
      "while [ $(ls points/*.begun | wc -l) -lt $TOGETHER ] && [ $n -lt 200 ]; do\n"
      "  sleep 0.02; n=$((n + 1))\n"
      "done\n"
      "[ $n -lt 200 ]\n");
  SlurmJob job = folder.job();
  job.slurm.points_per_job = 2;
  job.slurm.at_a_time = 4;
  CHECK(asks(job, "--array=0-1%2"));
  CHECK(asks(job, "--cpus-per-task=4"));
  CHECK(asks(job, "--mem=528M"));
  job.slurm.prologue = {"export TOGETHER=2"};
  CHECK(folder.run(job, 0) == 0);
  CHECK(folder.read("slurm/one.exit") == "0\n");
  CHECK(folder.read("slurm/two.exit") == "0\n");
  job.slurm.prologue = {"export TOGETHER=1"};
  CHECK(folder.run(job, 1) == 0);
  CHECK(folder.read("slurm/three.exit") == "0\n");
}

TEST_CASE("a job of the cluster shall hand a signal on to all its points and wait for them") {
  const Folder folder(
      "trap 'sleep 0.1; echo saved > \"$4.saved\"; exit 143' TERM\n"
      "touch \"$4.begun\"\n"
      "n=0\n"
      "while [ $n -lt 200 ]; do sleep 0.02; n=$((n + 1)); done\n");
  SlurmJob job = folder.job();
  job.slurm.points_per_job = 3;
  const std::string kill_when_all_run =
      " & job=$!; cd " + shell_quoted(job.store.string()) +
      "; n=0; while [ $(ls points/*.begun 2> /dev/null | wc -l) -lt 3 ] && [ $n -lt 200 ]; do "
      "sleep 0.02; n=$((n + 1)); done; kill -TERM $job; wait $job";
  CHECK(folder.run(job, 0, kill_when_all_run) == 1);
  for (const std::string point : {"one", "two", "three"}) {
    CHECK(folder.read("slurm/" + point + ".exit") == "143\n");
    CHECK(folder.read("points/" + point + ".saved") == "saved\n");
  }
}

TEST_CASE("what goes wrong around a run on the cluster shall be kept") {
  const Folder folder("exit 0\n");
  const SlurmJob job = folder.job();
  CHECK(asks(job, "--output=\"" + (job.store / "slurm" / "%A_%a.out").string() + "\""));
}
