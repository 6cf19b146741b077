// SPDX-License-Identifier: Apache-2.0
#include "live/bulletin.hpp"

#include "report/page.hpp"
#include "report/run_document.hpp"

#include <chrono>
#include <utility>

namespace dust::live {

namespace {

double now() {
  return std::chrono::duration<double>(std::chrono::steady_clock::now().time_since_epoch()).count();
}

constexpr double k_rest = 5.0;  ///< rest between two pages, in times that one takes

}  // namespace

void Bulletin::publish_progress(nlohmann::json progress) {
  const std::lock_guard lock(mutex_);
  progress["states"] = state_;
  progress_ = std::move(progress);
}

void Bulletin::publish_state(nlohmann::json summary, nlohmann::json report) {
  const std::lock_guard lock(mutex_);
  summary_ = std::move(summary);
  report_ = std::move(report);
  progress_["states"] = ++state_;
}

nlohmann::json Bulletin::progress() const {
  const std::lock_guard lock(mutex_);
  return progress_;
}

std::string Bulletin::page() {
  const std::lock_guard lock(making_);
  renew();
  return made_.page;
}

std::string Bulletin::document() {
  const std::lock_guard lock(making_);
  renew();
  return made_.document;
}

void Bulletin::renew() {
  std::unique_lock lock(mutex_);
  if (state_ == 0 || state_ == made_.state) return;
  const bool is_first = made_.state == 0;
  if (!is_first && now() - made_.at < k_rest * made_.seconds) return;
  const nlohmann::json summary = summary_, report = report_;
  const std::int64_t state = state_;
  lock.unlock();  // the run shall not wait for a page
  const double begin = now();
  const nlohmann::json document = report::run_document(folder_, summary, report);
  made_.page = report::page_of(report::Templates(), "run.html", document);
  made_.document = document.dump(-1, ' ', false, nlohmann::json::error_handler_t::replace) + "\n";
  made_.state = state;
  made_.at = now();
  made_.seconds = made_.at - begin;
}

}  // namespace dust::live
