// SPDX-License-Identifier: Apache-2.0
#include "preflight/learnt_costs.hpp"

#include "base/process/memory.hpp"

#include <fcntl.h>
#include <sys/file.h>
#include <time.h>
#include <unistd.h>

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
/// Of one scenario; among those about as long the newest, for the engine and the machine change.
constexpr std::size_t k_runs_that_count = 5;
/// [s] A term that took less says nothing of its rate.
constexpr double k_enough = 0.5;

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

/// A file's line of a run: for each term what was told and taken, amount and seconds; memory and
/// disk alike; then its name.
void write_numbers(const RunCost& cost, std::ostream& out) {
  for (std::size_t n = 0; n < k_cost_terms; ++n) {
    const Spent& term = cost.terms[n];
    out << term.amount << ' ' << term.seconds << ' ';
  }
  out << cost.memory_bytes << ' ' << cost.disk_bytes << ' ';
}

bool read_numbers(std::istream& in, RunCost& cost) {
  const auto read = [&in](double& value) {
    return static_cast<bool>(in >> value) && std::isfinite(value) && value >= 0.0;
  };
  for (std::size_t n = 0; n < k_cost_terms; ++n) {
    Spent& term = cost.terms[n];
    if (!read(term.amount) || !read(term.seconds)) return false;
  }
  return read(cost.memory_bytes) && read(cost.disk_bytes);
}

/// Whether there is something to compare.
bool is_whole(const RunCost& estimated, const RunCost& taken) {
  return estimated.terms.seconds() > 0.0 && taken.terms.seconds() > 0.0;
}

/// How far two times are apart, in doublings.
double doublings_apart(double a, double b) { return std::abs(std::log2(a / b)); }

/// Collects quotients, each with a weight; those of nothing by something are none.
class Quotients {
 public:
  void add(double taken, double estimated, double weight = 1.0) {
    if (taken > 0.0 && estimated > 0.0) all_.push_back({taken / estimated, weight});
  }
  /// Half of the weight is on either side of it: the median where all weigh the same.
  [[nodiscard]] double middle(double otherwise) {
    if (all_.empty()) return otherwise;
    std::sort(all_.begin(), all_.end(),
              [](const Weighed& a, const Weighed& b) { return a.value < b.value; });
    double half = 0.0;
    for (const Weighed& w : all_) half += 0.5 * w.weight;
    std::size_t n = 0;
    double below = all_[0].weight;
    while (below < half && n + 1 < all_.size()) below += all_[++n].weight;
    const bool is_between_two = below == half && n + 1 < all_.size();
    return is_between_two ? 0.5 * (all_[n].value + all_[n + 1].value) : all_[n].value;
  }

 private:
  struct Weighed {
    double value, weight;
  };
  std::vector<Weighed> all_;
};

/// Runs that end together write one after the other, each with what the one before has learnt.
class WriterLock {
 public:
  explicit WriterLock(const fs::path& file)
      : descriptor_(::open((file.string() + ".lock").c_str(), O_RDWR | O_CREAT | O_CLOEXEC, 0666)) {
    if (descriptor_ >= 0) ::flock(descriptor_, LOCK_EX);
  }
  ~WriterLock() {
    if (descriptor_ >= 0) ::close(descriptor_);
  }
  WriterLock(const WriterLock&) = delete;
  WriterLock& operator=(const WriterLock&) = delete;

 private:
  int descriptor_;
};

}  // namespace

fs::path LearntCosts::default_file() {
  const auto folder = [](const char* name) {
    const char* value = std::getenv(name);
    return fs::path(value == nullptr ? "" : value);
  };
  fs::path cache = folder("XDG_CACHE_HOME");
  if (!cache.is_absolute()) cache = folder("HOME").is_absolute() ? folder("HOME") / ".cache" : "";
  return cache.empty() ? fs::path() : cache / "dust" / "costs_by_term";
}

LearntCosts::LearntCosts(fs::path file, std::function<double()> slowness)
    : file_(std::move(file)), slowness_(std::move(slowness)) {
  read();
}

void LearntCosts::read() {
  runs_.clear();
  std::ifstream in(file_);
  for (std::string line; std::getline(in, line);) {
    std::istringstream words(line);
    Run run;
    if (!read_numbers(words, run.estimated) || !read_numbers(words, run.taken)) continue;
    if (!std::getline(words >> std::ws, run.scenario) || !is_whole(run.estimated, run.taken)) {
      continue;
    }
    runs_.push_back(std::move(run));
  }
}

LearntCosts::Expected LearntCosts::expect(const std::string& scenario,
                                          const RunCost& estimated) const {
  const std::vector<const Run*> same = most_alike(scenario, estimated.terms.seconds());
  return same.empty() ? from_others(estimated) : from_same(same, estimated);
}

std::vector<const LearntCosts::Run*> LearntCosts::most_alike(const std::string& scenario,
                                                             double seconds) const {
  std::vector<const Run*> same;
  for (auto run = runs_.rbegin(); run != runs_.rend(); ++run) {
    if (run->scenario == scenario) same.push_back(&*run);
  }
  const auto whole_doublings = [seconds](const Run* run) {
    return std::floor(doublings_apart(run->estimated.terms.seconds(), seconds));
  };
  std::stable_sort(same.begin(), same.end(), [&](const Run* a, const Run* b) {
    return whole_doublings(a) < whole_doublings(b);
  });
  same.resize(std::min(same.size(), k_runs_that_count));
  return same;
}

LearntCosts::Expected LearntCosts::from_same(const std::vector<const Run*>& runs,
                                             const RunCost& estimated) {
  Expected expected{estimated, static_cast<int>(runs.size()), true};
  const auto weight_of = [&](const Run& run) {
    return std::exp2(-doublings_apart(run.estimated.terms.seconds(), estimated.terms.seconds()));
  };
  for (std::size_t n = 0; n < k_cost_terms; ++n) {
    Quotients work;
    Quotients time;
    for (const Run* run : runs) {
      const double weight = weight_of(*run);
      work.add(run->taken.terms[n].amount, run->estimated.terms[n].amount, weight);
      time.add(run->taken.terms[n].seconds, run->estimated.terms[n].seconds, weight);
    }
    expected.cost.terms[n].amount *= work.middle(1.0);
    expected.cost.terms[n].seconds *= time.middle(1.0);
  }
  Quotients memory;
  Quotients disk;
  for (const Run* run : runs) {
    memory.add(run->taken.memory_bytes, run->estimated.memory_bytes, weight_of(*run));
    disk.add(run->taken.disk_bytes, run->estimated.disk_bytes, weight_of(*run));
  }
  expected.cost.memory_bytes *= memory.middle(1.0);
  expected.cost.disk_bytes *= disk.middle(1.0);
  return expected;
}

LearntCosts::Expected LearntCosts::from_others(const RunCost& estimated) const {
  Expected expected{estimated, static_cast<int>(runs_.size()), false};
  const double slowness = slowness_();
  for (std::size_t n = 0; n < k_cost_terms; ++n) {
    // The measurement counts as one run: a single one of another kind says little.
    Quotients rate;
    rate.add(slowness, 1.0);
    for (const Run& run : runs_) {
      const Spent& said = run.estimated.terms[n];
      const Spent& was = run.taken.terms[n];
      if (was.seconds < k_enough || !(said.amount > 0.0 && was.amount > 0.0)) continue;
      rate.add(was.seconds / was.amount, said.seconds / said.amount);
    }
    expected.cost.terms[n].seconds *= rate.middle(slowness);
  }
  return expected;
}

void LearntCosts::add(const std::string& scenario, const RunCost& estimated, const RunCost& taken) {
  if (!is_whole(estimated, taken)) return;
  if (file_.empty()) {
    runs_.push_back({scenario, estimated, taken});
    return;
  }
  std::error_code ignored;
  fs::create_directories(file_.parent_path(), ignored);
  const WriterLock lock(file_);
  read();
  runs_.push_back({scenario, estimated, taken});
  write();
}

void LearntCosts::write() const {
  std::error_code ignored;
  const fs::path part = file_.string() + ".part";
  {
    std::ofstream out(part);
    const std::size_t first = runs_.size() > k_max_runs ? runs_.size() - k_max_runs : 0;
    for (std::size_t n = first; n < runs_.size(); ++n) {
      write_numbers(runs_[n].estimated, out);
      write_numbers(runs_[n].taken, out);
      out << runs_[n].scenario << '\n';
    }
    out.close();
    if (!out) return;
  }
  fs::rename(part, file_, ignored);
}

std::string memory_shortage(const RunCost& expected) {
  const double needed = expected.memory_bytes;
  return base::shortage_text(needed, base::free_memory().value_or(needed));
}

double measured_slowness() {
  // Of the machine that cost.cpp's constants belong to, idle.
  constexpr double k_there = 0.0045;
  double least = std::numeric_limits<double>::infinity();
  double sum = 0.0;
  for (int trial = 0; trial < 8; ++trial) {
    const double begin = processor_seconds();
    sum += chain_of_contacts();
    least = std::min(least, processor_seconds() - begin);
  }
  // Keeps the work from being left out.
  return sum == std::numeric_limits<double>::infinity() ? 1.0
                                                        : std::clamp(least / k_there, 0.2, 10.0);
}

}  // namespace dust::preflight
