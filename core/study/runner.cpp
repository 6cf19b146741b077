// SPDX-License-Identifier: Apache-2.0
#include "study/runner.hpp"

#include "base/text.hpp"
#include "study/noise.hpp"

#include <algorithm>
#include <cmath>
#include <cstdio>

namespace dust::study {

std::string short_number(double value) { return base::digits_text(value, 4); }

Runner::Runner(Plan& plan, const PointStore& store, Launcher& launcher, Settings settings)
    : plan_(plan), store_(store), launcher_(launcher), settings_(settings), results_{plan, {}} {}

void Runner::load_finished() {
  for (std::size_t n = results_.outcomes.size(); n < plan_.points.size(); ++n) {
    results_.outcomes.push_back(store_.read(plan_.points[n], plan_.outputs));
    has_run_.push_back(false);
    if (results_.outcomes.back().status == Status::finished) ++ended_;
  }
}

int Runner::run() {
  load_finished();
  std::vector<Point> pending;
  std::vector<std::size_t> place;
  for (std::size_t n = 0; n < plan_.points.size(); ++n) {
    if (results_.outcomes[n].status == Status::finished || has_run_[n]) continue;
    store_.discard_failure(plan_.points[n]);
    results_.outcomes[n] = {};
    pending.push_back(plan_.points[n]);
    place.push_back(n);
  }
  write_table();
  if (pending.empty()) return 0;
  return launcher_.run(pending, [&](const JobResult& result) {
    const std::size_t n = place[result.job];
    const Point& point = plan_.points[n];
    Outcome outcome = store_.read(point, plan_.outputs);
    if (!result.is_good || outcome.status != Status::finished) {
      store_.note_failure(point, result.reason.empty() ? "the run left no results" : result.reason);
      outcome = store_.read(point, plan_.outputs);
    }
    results_.outcomes[n] = std::move(outcome);
    has_run_[n] = true;
    ++ended_;
    estimate_done_ += point.core_seconds;
    write_table();
    print(n);
    const bool goes_on = !settings_.fail_fast || results_.outcomes[n].status == Status::finished;
    was_stopped_ = was_stopped_ || !goes_on;
    return goes_on;
  });
}

void Runner::write_table() const { write_csv(store_.folder() / "study.csv", results_); }

std::size_t Runner::failures() const {
  return static_cast<std::size_t>(
      std::count_if(results_.outcomes.begin(), results_.outcomes.end(),
                    [](const Outcome& o) { return o.status == Status::failed; }));
}

std::string Runner::described(std::size_t n) const {
  std::string text;
  const Point& point = plan_.points[n];
  for (std::size_t k = 0; k < plan_.inputs.size(); ++k) {
    const InputColumn& c = plan_.inputs[k];
    text += (text.empty() ? "" : ", ") + c.name + " = " + point.inputs[k].text +
            (c.unit.empty() ? "" : " " + c.unit);
  }
  const bool has_replicates = std::any_of(plan_.points.begin(), plan_.points.end(),
                                          [](const Point& p) { return p.replicate > 1; });
  if (has_replicates) {
    text +=
        (text.empty() ? "" : ", ") + std::string("replicate ") + std::to_string(point.replicate);
  }
  return text;
}

std::string Runner::remaining() const {
  double left = 0.0;
  for (std::size_t n = 0; n < plan_.points.size(); ++n) {
    if (results_.outcomes[n].status == Status::waiting) left += plan_.points[n].core_seconds;
  }
  if (settings_.expected_points > plan_.points.size() && !plan_.points.empty()) {
    left += static_cast<double>(settings_.expected_points - plan_.points.size()) *
            plan_.points.back().core_seconds;
  }
  if (!(estimate_done_ > 0.0) || !(left > 0.0)) return {};
  const double elapsed =
      std::chrono::duration<double>(std::chrono::steady_clock::now() - start_).count();
  return "; about " + base::estimated_duration_text(left * elapsed / estimate_done_) + " left";
}

void Runner::print(std::size_t n) {
  if (settings_.quiet) return;
  const Outcome& outcome = results_.outcomes[n];
  const std::size_t total = std::max(settings_.expected_points, plan_.points.size());
  std::string text;
  if (outcome.status == Status::failed) {
    text = "failed: " + outcome.reason;
  } else {
    text = "in " + base::duration_text(outcome.wall_s);
    for (std::size_t k = 0; k < plan_.outputs.size() && k < outcome.outputs.size(); ++k) {
      if (!outcome.outputs[k].value) continue;
      text += (k == 0 ? ": " : ", ") + plan_.outputs[k].name + " = " +
              short_number(*outcome.outputs[k].value) +
              (plan_.outputs[k].unit == "1" ? "" : " " + plan_.outputs[k].unit) +
              (is_unsteady(outcome.outputs[k]) ? " (not steady)" : "");
    }
  }
  std::printf("[%*zu/%zu] %s  %s  %s%s\n", static_cast<int>(std::to_string(total).size()), ended_,
              total, plan_.points[n].hash.c_str(), described(n).c_str(), text.c_str(),
              remaining().c_str());
  std::fflush(stdout);
}

}  // namespace dust::study
