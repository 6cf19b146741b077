// SPDX-License-Identifier: Apache-2.0
#include "run/dust/dust_rates.hpp"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace dust::run {
namespace {

constexpr const char* k_set_free = "set_free";
constexpr const char* k_released = "released";
constexpr const char* k_left = "left";
constexpr const char* k_drawn_out = "drawn_out";
constexpr const char* k_deposited = "deposited";
constexpr const char* k_carried_out = "carried_out";
constexpr const char* k_caught = "caught";
constexpr double k_hour = 3600.0;          // s
constexpr double k_grams_per_tonne = 1e6;  // per kg per kg
constexpr std::size_t k_material_column = 0;

}  // namespace

DustRates::DustRates(const scenario::Setup& setup, const DustStage& dust,
                     const LiberationStage* liberation, const particles::Dem& particles,
                     double steady_after)
    : dust_(dust),
      liberation_(liberation),
      particles_(particles),
      steady_(steady_after),
      balances_(dust.field().classes()) {
  find_parts(setup);
  const std::size_t columns = 1 + parts_.size() * (1 + balances_.size());
  before_.assign(columns, 0.0);
  now_ = before_;
  means_ = sdk::BatchMeans(columns);
}

void DustRates::find_parts(const scenario::Setup& setup) {
  const auto add = [&](const char* way, const std::string& name,
                       std::function<double(std::size_t)> total) {
    if (parts_.empty() || parts_.back().way != way) parts_.push_back({way, "all", nullptr});
    parts_.push_back({way, name, std::move(total)});
  };
  if (liberation_ != nullptr) {
    for (std::size_t c = 0; c < liberation_->causes().size(); ++c) {
      add(k_set_free, liberation_->causes()[c],
          [this, c](std::size_t n) { return liberation_->set_free(c, n); });
    }
  }
  if (liberation_ == nullptr || dust_.field().has_sources()) {
    add(k_released, "sources",
        [this](std::size_t n) { return dust_.field().given_by_sources(n, time_); });
  }
  for (std::size_t side = 0; side < 6; ++side) {
    if (!dust_.lets_dust_out(side)) continue;
    add(k_left, scenario::k_side_names[side],
        [this, side](std::size_t n) { return balances_[n].left[side]; });
  }
  for (std::size_t o = 0; o < dust_.openings().size(); ++o) {
    add(k_drawn_out, dust_.openings()[o].name,
        [this, o](std::size_t n) { return balances_[n].outlets[o]; });
  }
  const std::vector<std::string> surfaces = dust_.surface_names();
  for (std::size_t k = 0; k < surfaces.size(); ++k) {
    add(k_deposited, surfaces[k], [this, k](std::size_t n) { return balances_[n].surfaces[k]; });
  }
  if (dust_.field().has_running_surfaces()) {
    for (std::size_t k = 6; k < surfaces.size(); ++k) {
      if (setup.bodies[k - 6].motions.empty()) continue;
      add(k_carried_out, surfaces[k],
          [this, k](std::size_t n) { return balances_[n].carried_out[k]; });
    }
  }
  if (dust_.has_scavenging()) {
    add(k_caught, "grains", [this](std::size_t n) { return balances_[n].caught; });
  }
}

void DustRates::find_totals(std::vector<double>& totals) const {
  const std::size_t classes = balances_.size();
  std::fill(totals.begin(), totals.end(), 0.0);
  totals[k_material_column] = particles_.balance().mass_emitted;
  std::size_t all = 0;
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const std::size_t first = 1 + p * (1 + classes);
    if (!parts_[p].total) {
      all = first;
      continue;
    }
    for (std::size_t n = 0; n < classes; ++n) {
      const double mass = parts_[p].total(n);
      totals[first] += mass;
      totals[first + 1 + n] = mass;
      totals[all] += mass;
      totals[all + 1 + n] += mass;
    }
  }
}

void DustRates::begin_at(double time) {
  steady_ = SteadyWindow(time);
  means_ = sdk::BatchMeans(now_.size());
}

void DustRates::sample(double time, double step) {
  const double begin = time - step;
  if (!steady_.holds(time, step)) return;
  for (std::size_t n = 0; n < balances_.size(); ++n) balances_[n] = dust_.field().gone(n);
  time_ = time;
  find_totals(now_);
  const double since = std::abs(before_time_.value_or(begin) - begin);
  if (since < SteadyWindow::k_rounding * step && steady_.holds(begin, step)) {
    for (std::size_t c = 0; c < now_.size(); ++c) before_[c] = (now_[c] - before_[c]) / step;
    means_.add(before_, step);
  }
  before_ = now_;
  before_time_ = time;
}

void DustRates::report_part(sdk::FigureSink& sink, const std::string& name,
                            std::size_t column) const {
  const double rate = means_.mean(column);
  const double error = means_.error(column);
  sink.figure(name + "/rate", k_hour * rate, "kg/h", sdk::scaled_error(error, k_hour),
              sdk::detail(sdk::Quantity::mass_rate));
  const double material = means_.mean(k_material_column);
  if (!(material > 0.0)) return;
  const double per_load = k_grams_per_tonne / material;
  const bool is_even = means_.is_even(k_material_column);
  const double of_ratio = means_.ratio_error(column, k_material_column);
  sink.figure(name + "/per_load", is_even ? per_load * rate : k_unknown, "g/t",
              is_even ? sdk::scaled_error(of_ratio, k_grams_per_tonne) : sdk::k_feed_not_even,
              sdk::detail(sdk::Quantity::mass_per_load));
}

void DustRates::report(sdk::FigureSink& sink) const {
  sink.figure("observed", means_.duration(), "s", sdk::k_no_estimate,
              {.role = sdk::Role::observed_time, .quantity = sdk::Quantity::time});
  if (!(means_.duration() > 0.0)) return;
  const std::vector<std::string>& classes = dust_.class_names();
  for (std::size_t p = 0; p < parts_.size(); ++p) {
    const std::size_t first = 1 + p * (1 + classes.size());
    const std::string name = parts_[p].way + "/" + parts_[p].name;
    // Surfaces that no dust meets are left out; a way out without dust is an answer, and so is a
    // surface that gives more than it takes.
    const bool is_way_out = parts_[p].way == k_left || parts_[p].way == k_drawn_out;
    if (parts_[p].total && !is_way_out && means_.mean(first) == 0.0) continue;
    report_part(sink, name, first);
    for (std::size_t n = 0; n < classes.size(); ++n) {
      report_part(sink, name + "/class/" + classes[n], first + 1 + n);
    }
  }
}

void DustRates::add_parts(SaveParts& parts) const {
  parts.emplace_back("dust_rates", [this](sdk::ArchiveWriter& a) {
    // Where a run that started from another began its means, nothing else tells.
    std::vector<double> before = before_;
    before.push_back(steady_.begin());
    a.numbers("before", before);
    means_.save(a, "means");
  });
}

void DustRates::add_parts(LoadParts& parts) {
  parts.emplace_back("dust_rates", [this](sdk::ArchiveReader& a) {
    before_ = a.numbers("before");
    // Older checkpoints do not hold it.
    if (before_.size() > now_.size()) {
      steady_ = SteadyWindow(before_.back());
      before_.pop_back();
    }
    before_time_.reset();
    means_.load(a, "means");
    if (before_.size() != now_.size() || means_.columns() != now_.size()) {
      throw sdk::ModelError("the saved rates of dust do not fit together");
    }
  });
}

}  // namespace dust::run
