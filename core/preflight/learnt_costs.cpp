// SPDX-License-Identifier: Apache-2.0
#include "preflight/learnt_costs.hpp"

#include <time.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>
#include <system_error>

namespace dust::preflight {
namespace {

namespace fs = std::filesystem;

constexpr std::size_t k_max_runs = 200;
/// Of one scenario: the newest, for the engine and the machine change.
constexpr std::size_t k_recent = 5;

double median(std::vector<double> values) {
  std::sort(values.begin(), values.end());
  const std::size_t middle = values.size() / 2;
  return values.size() % 2 == 1 ? values[middle] : 0.5 * (values[middle - 1] + values[middle]);
}

double processor_seconds() {
  timespec now{};
  clock_gettime(CLOCK_PROCESS_CPUTIME_ID, &now);
  return static_cast<double>(now.tv_sec) + 1e-9 * static_cast<double>(now.tv_nsec);
}

/// Forces along a chain of overlapping spheres, over and over: roots, quotients and products of
/// what lies in the cache, as in a contact law.
double chain_of_contacts() {
  constexpr std::size_t k_spheres = 2000;
  constexpr int k_rounds = 600;
  std::vector<double> x(k_spheres);
  std::vector<double> force(k_spheres);
  for (std::size_t n = 0; n < k_spheres; ++n) x[n] = 0.99 * static_cast<double>(n);
  for (int round = 0; round < k_rounds; ++round) {
    for (std::size_t n = 1; n < k_spheres; ++n) {
      const double overlap = std::max(0.0, 1.0 - (x[n] - x[n - 1]));
      const double push = overlap * std::sqrt(overlap) / (1.0 + overlap);
      force[n] += push;
      force[n - 1] -= push;
    }
    for (std::size_t n = 0; n < k_spheres; ++n) x[n] += 1e-6 * force[n];
  }
  return force.back();
}

}  // namespace

fs::path LearntCosts::default_file() {
  const auto folder = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value == nullptr ? "" : value);
  };
  fs::path cache = folder("XDG_CACHE_HOME");
  if (!cache.is_absolute()) cache = folder("HOME").is_absolute() ? folder("HOME") / ".cache" : "";
  return cache.empty() ? fs::path() : cache / "dust" / "costs";
}

LearntCosts::LearntCosts(fs::path file) : file_(std::move(file)) {
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Run run;
    if (!(words >> run.factor >> std::ws) || !std::getline(words, run.scenario)) continue;
    if (std::isfinite(run.factor) && run.factor > 0.0) runs_.push_back(std::move(run));
  }
}

LearntCosts::Factor LearntCosts::factor_for(const std::string& scenario) const {
  std::vector<double> same;
  std::vector<double> all;
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
    if (run->scenario == scenario && same.size() < k_recent) same.push_back(run->factor);
    all.push_back(run->factor);
  }
  if (!same.empty()) return {median(same), static_cast<int>(same.size()), true};
  if (!all.empty()) return {median(all), static_cast<int>(all.size()), false};
  return {measured_slowness(), 0, false};
}

void LearntCosts::add(const std::string& scenario, double estimated_seconds,
                      double processor_seconds) {
  if (!(estimated_seconds > 0.0 && processor_seconds > 0.0)) return;
  runs_.push_back({scenario, processor_seconds / estimated_seconds});
  if (file_.empty()) return;
  std::error_code ignored;
  fs::create_directories(file_.parent_path(), ignored);
  const fs::path part = file_.string() + ".part";
  {
    std::ofstream out(part);
    const std::size_t first = runs_.size() > k_max_runs ? runs_.size() - k_max_runs : 0;
    for (std::size_t n = first; n < runs_.size(); ++n) {
      out << runs_[n].factor << ' ' << runs_[n].scenario << '\n';
    }
    out.close();
    if (!out) return;
  }
  fs::rename(part, file_, ignored);
}

double measured_slowness() {
  // Of the machine that cost.cpp's constants belong to, idle.
  constexpr double k_there = 0.0052;
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (int trial = 0; trial < 3; ++trial) {
    const double begin = processor_seconds();
    sum += chain_of_contacts();
    least = std::min(least, processor_seconds() - begin);
  }
  // Keeps the work from being left out.
  return sum == std::numeric_limits<double>::infinity() ? 1.0
                                                        : std::clamp(least / k_there, 0.2, 10.0);
}

}  // namespace dust::preflight
