// SPDX-License-Identifier: Apache-2.0
#include "run/run_times.hpp"

#include <sys/resource.h>

namespace dust::run {

double cpu_seconds() {
  rusage u{};
  getrusage(RUSAGE_SELF, &u);
  const auto seconds = [](const timeval& t) {
    return static_cast<double>(t.tv_sec) + 1e-6 * static_cast<double>(t.tv_usec);
  };
  return seconds(u.ru_utime) + seconds(u.ru_stime);
}

void RunTimes::start() {
  start_ = Clock::now();
  cpu_start_ = cpu_seconds();
}

void RunTimes::add_output(Clock::time_point begin) {
  output_s_ += std::chrono::duration<double>(Clock::now() - begin).count();
}

double RunTimes::wall() const {
  return wall_before_ + std::chrono::duration<double>(Clock::now() - start_).count();
}

double RunTimes::cpu() const { return cpu_before_ + cpu_seconds() - cpu_start_; }

void RunTimes::save(sdk::ArchiveWriter& archive, const std::vector<double>& nodes) const {
  archive.numbers("node_seconds", nodes);
  archive.number("output_s", output_s_);
  archive.number("wall_s", wall());
  archive.number("cpu_s", cpu());
}

void RunTimes::load(sdk::ArchiveReader& archive) {
  nodes_before_ = archive.numbers("node_seconds");
  output_s_ = archive.number("output_s");
  wall_before_ = archive.number("wall_s");
  cpu_before_ = archive.number("cpu_s");
}

}  // namespace dust::run
