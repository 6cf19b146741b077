// SPDX-License-Identifier: Apache-2.0
#include "run/progress/live_report.hpp"

#include <algorithm>

namespace dust::run {

void LiveReport::begin(const std::filesystem::path& folder) {
  folder_ = folder;
  bulletin_ = std::make_unique<live::Bulletin>(folder);
  server_.begin(*bulletin_);
}

std::string LiveReport::address() const {
  return "http://127.0.0.1:" + std::to_string(server_.port()) + "/";
}

void LiveReport::publish_state(const Simulation& simulation, const RunFacts& facts) {
  const RunRecord record = record_of(simulation, facts);
  bulletin_->publish_state(record.summary, record.report);
}

void LiveReport::publish_progress(const Simulation& simulation, const RunFacts& facts,
                                  const Pace& pace) {
  const auto now = Pace::Clock::now();
  constexpr auto k_pause = std::chrono::milliseconds(500);
  if (now - last_ < k_pause && facts.status == last_status_) return;
  last_ = now;
  last_status_ = facts.status;
  const double end = simulation.setup().time.end;
  nlohmann::json progress = {{"scenario", simulation.setup().name},
                             {"folder", folder_.string()},
                             {"status", facts.status},
                             {"reason", facts.reason},
                             {"time_s", simulation.time()},
                             {"end_s", end},
                             {"particles", simulation.dem().balance().in_domain},
                             {"frames", facts.frames},
                             {"warnings", facts.warnings},
                             {"pace", nullptr},
                             {"left_s", nullptr}};
  if (pace.is_known()) {
    progress["pace"] = pace.seconds_per_second();
    progress["left_s"] = pace.seconds_per_second() * std::max(0.0, end - simulation.time());
  }
  bulletin_->publish_progress(std::move(progress));
}

}  // namespace dust::run
