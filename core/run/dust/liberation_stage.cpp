// SPDX-License-Identifier: Apache-2.0
#include "run/dust/liberation_stage.hpp"

#include "base/text.hpp"
#include "dust/sdk/error.hpp"
#include "preflight/dust_check.hpp"

#include <oneapi/tbb/parallel_for.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <utility>

namespace dust::run {
namespace {

/// Grains per call of a law, and from one class's column to the next within a call.
constexpr std::size_t k_rows_per_call = 256;

std::vector<std::string> causes_of(const std::vector<std::string>& walls, bool has_wind) {
  std::vector<std::string> causes{"grains"};
  causes.insert(causes.end(), walls.begin(), walls.end());
  if (has_wind) causes.emplace_back("wind");
  return causes;
}

double cube(double l) { return l * l * l; }

std::size_t padded(std::size_t rows) {
  return (rows + k_rows_per_call - 1) / k_rows_per_call * k_rows_per_call;
}

}  // namespace

LiberationStage::LiberationStage(const scenario::Setup& setup,
                                 const scenario::DustSetup& dust_setup,
                                 std::unique_ptr<sdk::LiberationLaw> law, DustStage& dust,
                                 particles::Dem& particles)
    : particles_(particles),
      dust_(dust),
      law_(std::move(law)),
      law_name_(dust_setup.liberation->name),
      classes_(dust_setup.field->diameters.size()),
      loads_(dust_setup.loads),
      feed_zones_(dust_setup.feed_zones) {
  for (scenario::DustLoadSpec& load : loads_) load.share.resize(classes_, 0.0);
  for (const scenario::MaterialSpec& m : setup.materials) {
    coarse_graining_.push_back(m.coarse_graining);
  }
  law_->prepare(preflight::dust_properties(setup, *dust_setup.field));
  causes_ = causes_of(particles_.wall_names(), law_->needs_wind());
  set_free_.resize(causes_.size() * classes_);
  impact_energy_.resize(1 + particles_.wall_names().size());
  for (std::size_t kind = 0; kind < k_kinds; ++kind) {
    if (kind != by_wind || law_->needs_wind()) places_[kind].assign(dust_.cells(), 0.0);
  }
}

double LiberationStage::coarse_graining(std::size_t row) const {
  return coarse_graining_[static_cast<std::size_t>(particles_.rows().material[row])];
}

bool LiberationStage::is_in_feed_zone(sdk::Vec3 centre) const {
  const sdk::Vec3 x = dust_.inside(centre);
  return std::any_of(feed_zones_.begin(), feed_zones_.end(), [&](const scenario::FeedZoneSpec& z) {
    return x[0] >= z.min.x && x[0] <= z.max.x && x[1] >= z.min.y && x[1] <= z.max.y &&
           x[2] >= z.min.z && x[2] <= z.max.z;
  });
}

/// Rows that contacts have done something to, and what.
void LiberationStage::find_impacts() {
  const particles::ContactWork& work = particles_.contact_work();
  const particles::GrainRows grains = particles_.rows();
  rows_.clear();
  impact_energy_.assign(impact_energy_.size(), {});
  auto& c = columns_;
  for (Column* column : {&c.normal, &c.tangential, &c.acceleration}) column->clear();
  for (std::size_t row = 0; row < grains.count; ++row) {
    const particles::ContactWork::Energy energy = work.sum(row);
    const double acceleration = work.acceleration(row);
    if (!(energy.sum() > 0.0 || acceleration > 0.0)) continue;
    if (is_in_feed_zone(grains.centre(row))) continue;
    if (energy.sum() > 0.0) add_impact_energy(row, grains.weight[row]);
    rows_.push_back(static_cast<std::int32_t>(row));
    // Impacts of grains of one stiffness are alike in form: the smaller ones' are l times shorter.
    const double l = coarse_graining(row);
    c.normal.push_back(energy.normal / cube(l));
    c.tangential.push_back(energy.tangential / cube(l));
    c.acceleration.push_back(l * acceleration);
  }
  for (Column* column : {&c.normal, &c.tangential, &c.acceleration}) {
    column->resize(padded(rows_.size()));
  }
  load_columns();
}

/// In the order of rows.
void LiberationStage::add_impact_energy(std::size_t row, double weight) {
  const particles::ContactWork& work = particles_.contact_work();
  impact_energy_[0] += weight * work.with_particles(row).sum();
  for (std::size_t wall = 0; wall < work.walls(); ++wall) {
    const double energy = work.with_wall(row, wall).sum();
    if (energy > 0.0) impact_energy_[1 + wall] += weight * energy;
  }
}

/// All rows but those that are fed, and the wind at them. Spheres that the grid resolves have none:
/// no law tells their drag.
void LiberationStage::find_wind() {
  const particles::GrainRows grains = particles_.rows();
  rows_.clear();
  for (std::size_t row = 0; row < grains.count; ++row) {
    if (is_in_feed_zone(grains.centre(row))) continue;
    rows_.push_back(static_cast<std::int32_t>(row));
  }
  load_columns();
  auto& c = columns_;
  for (Column* column : {&c.slip, &c.shear, &c.void_fraction}) {
    column->resize(padded(rows_.size()));
  }
  for (std::size_t q = 0; q < rows_.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows_[q]);
    const double* wind = grains.wind + 4 * row;
    const double* v = grains.velocity_of(row);
    const double slip =
        wind[3] > 0.0 ? norm(sdk::Vec3{wind[0] - v[0], wind[1] - v[1], wind[2] - v[2]}) : 0.0;
    // A coarse particle drags as all that it stands for do.
    const double drag = wind[3] / cube(coarse_graining(row)) * slip;
    c.slip[q] = slip;
    c.shear[q] = drag / (std::numbers::pi * c.diameter[q] * c.diameter[q]);
    c.void_fraction[q] = dust_.void_fraction_at(grains.centre(row));
  }
}

void LiberationStage::load_columns() {
  const particles::GrainRows grains = particles_.rows();
  const std::size_t size = padded(rows_.size());
  auto& c = columns_;
  for (Column* column : {&c.diameter, &c.mass, &c.moisture}) column->resize(size);
  for (Column* column : {&c.load, &c.fresh}) column->resize(classes_ * size);
  c.released.assign(classes_ * size, 0.0);
  for (std::size_t q = 0; q < rows_.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows_[q]);
    const scenario::DustLoadSpec& fresh = loads_[static_cast<std::size_t>(grains.material[row])];
    const auto load = particles_.dust_load(row);
    const double l = coarse_graining(row);
    c.diameter[q] = grains.diameter(row) / l;
    c.mass[q] = grains.mass(row) / cube(l);
    c.moisture[q] = fresh.moisture;
    for (std::size_t n = 0; n < classes_; ++n) {
      c.load[place(q, n)] = load[n] / cube(l);
      c.fresh[place(q, n)] = fresh.share[n] * c.mass[q];
    }
  }
}

/// Of a class of a row: each call has its own columns.
std::size_t LiberationStage::place(std::size_t q, std::size_t n) const {
  const std::size_t call = q / k_rows_per_call * k_rows_per_call;
  return classes_ * call + n * k_rows_per_call + (q - call);
}

sdk::DustyGrains LiberationStage::grains(std::size_t first, std::size_t count, double step) {
  auto& c = columns_;
  return {.count = count,
          .classes = classes_,
          .stride = k_rows_per_call,
          .time_step = step,
          .diameter = c.diameter.data() + first,
          .mass = c.mass.data() + first,
          .moisture = c.moisture.data() + first,
          .load = c.load.data() + classes_ * first,
          .fresh = c.fresh.data() + classes_ * first,
          .released = c.released.data() + classes_ * first};
}

void LiberationStage::ask_law(
    double step, const std::function<void(std::size_t, const sdk::DustyGrains&)>& ask) {
  const std::size_t calls = padded(rows_.size()) / k_rows_per_call;
  oneapi::tbb::parallel_for(std::size_t{0}, calls, [&](std::size_t call) {
    const std::size_t first = call * k_rows_per_call;
    ask(first, grains(first, std::min(k_rows_per_call, rows_.size() - first), step));
  });
}

/// In the order of rows: sums of many small numbers.
void LiberationStage::give_to_air(bool is_by_wind) {
  const particles::GrainRows grains = particles_.rows();
  for (std::size_t q = 0; q < rows_.size(); ++q) {
    const auto row = static_cast<std::size_t>(rows_[q]);
    const double weight = grains.weight[row];
    const double count = cube(coarse_graining(row));
    std::int32_t cell = -1;
    for (std::size_t n = 0; n < classes_; ++n) {
      const double of_one = columns_.released[place(q, n)];
      if (of_one == 0.0) continue;
      const double load = columns_.load[place(q, n)];
      if (!(of_one > 0.0 && of_one <= load * (1.0 + sdk::LiberationLaw::k_rounding))) {
        fail(row, count * of_one, count * load);
      }
      // All of them together; not more than there is by rounding.
      const double mass = std::min(count * of_one, particles_.dust_load(row)[n]);
      if (cell < 0) cell = dust_.cell_with_gas(grains.centre(row));
      if (cell < 0) {
        kept_back_ += weight * mass;
        continue;
      }
      particles_.set_dust_free(row, n, mass);
      dust_.release(n, cell, weight * mass);
      if (is_by_wind) {
        set_free_[(causes_.size() - 1) * classes_ + n] += weight * mass;
        places_[by_wind][static_cast<std::size_t>(cell)] += weight * mass;
      } else {
        share_by_cause(row, n, weight * mass, static_cast<std::size_t>(cell));
      }
    }
  }
}

/// Shared among the causes as they have dissipated energy.
void LiberationStage::share_by_cause(std::size_t row, std::size_t n, double mass,
                                     std::size_t cell) {
  const particles::ContactWork& work = particles_.contact_work();
  const double whole = work.sum(row).sum();
  const double by_others = whole > 0.0 ? work.with_particles(row).sum() / whole : 1.0;
  set_free_[n] += mass * by_others;
  places_[by_grains][cell] += mass * by_others;
  if (!(whole > 0.0)) return;
  for (std::size_t wall = 0; wall < work.walls(); ++wall) {
    const double share = work.with_wall(row, wall).sum() / whole;
    if (!(share > 0.0)) continue;
    set_free_[(1 + wall) * classes_ + n] += mass * share;
    places_[by_walls][cell] += mass * share;
  }
}

void LiberationStage::fail(std::size_t row, double released, double load) const {
  // As many as show what differs.
  constexpr int k_few = 6, k_all = 17;
  const int digits =
      base::digits_text(load, k_few) == base::digits_text(released, k_few) ? k_all : k_few;
  throw sdk::ModelError("liberation law '" + law_name_ + "': grain " +
                        std::to_string(particles_.rows().id[row]) + " carries " +
                        base::digits_text(load, digits) + " kg of dust and is to lose " +
                        base::digits_text(released, digits) +
                        " kg: what comes off lies between 0 and the load; mend the law");
}

void LiberationStage::advance(double step) {
  find_impacts();
  ask_law(step, [&](std::size_t first, const sdk::DustyGrains& grains) {
    law_->in_contacts({.grains = grains,
                       .normal_energy = columns_.normal.data() + first,
                       .tangential_energy = columns_.tangential.data() + first,
                       .acceleration = columns_.acceleration.data() + first});
  });
  give_to_air(false);
  particles_.clear_contact_work();
  if (!law_->needs_wind()) return;
  find_wind();
  ask_law(step, [&](std::size_t first, const sdk::DustyGrains& grains) {
    law_->in_wind({.grains = grains,
                   .slip = columns_.slip.data() + first,
                   .shear = columns_.shear.data() + first,
                   .void_fraction = columns_.void_fraction.data() + first});
  });
  give_to_air(true);
}

std::vector<io::SensorField> LiberationStage::fields() const {
  std::vector<io::SensorField> fields;
  for (std::size_t kind = 0; kind < k_kinds; ++kind) {
    if (places_[kind].empty()) continue;
    fields.push_back(dust_.cell_field(std::string("dust_set_free_by_") + k_kind_names[kind], "kg",
                                      places_[kind]));
  }
  return fields;
}

void LiberationStage::transfer_from(sdk::ArchiveReader& archive,
                                    const std::vector<std::string>& walls, bool is_same_grid) {
  const auto numbers = archive.numbers("set_free");
  std::vector<std::string> causes = causes_of(walls, true);
  kept_back_ = {numbers.at(0), numbers.at(1)};
  for (std::size_t n = 0; 2 * n + 3 < numbers.size(); ++n) {
    const auto cause = std::find(causes_.begin(), causes_.end(), causes.at(n / classes_));
    // What is gone here, or cannot be a cause, counts with the grains: nothing gets lost.
    const auto at = cause == causes_.end() ? 0 : static_cast<std::size_t>(cause - causes_.begin());
    set_free_[at * classes_ + n % classes_] += numbers[2 * n + 2];
    set_free_[at * classes_ + n % classes_] += numbers[2 * n + 3];
  }
  const bool had_wind = numbers.size() == 2 + 2 * classes_ * causes.size();
  for (std::size_t kind = 0; kind < k_kinds; ++kind) {
    if (!is_same_grid || places_[kind].empty() || (kind == by_wind && !had_wind)) continue;
    places_[kind] = archive.numbers(k_kind_names[kind]);
  }
}

void LiberationStage::add_parts(SaveParts& parts) const {
  parts.emplace_back("liberation", [this](sdk::ArchiveWriter& a) {
    std::vector<double> numbers{kept_back_.sum(), kept_back_.lost()};
    for (const base::ExactSum& s : set_free_) numbers.insert(numbers.end(), {s.sum(), s.lost()});
    a.numbers("set_free", numbers);
    for (std::size_t kind = 0; kind < k_kinds; ++kind) {
      if (!places_[kind].empty()) a.numbers(k_kind_names[kind], places_[kind]);
    }
  });
}

void LiberationStage::add_parts(LoadParts& parts) {
  parts.emplace_back("liberation", [this](sdk::ArchiveReader& a) {
    const auto numbers = a.numbers("set_free");
    kept_back_ = {numbers.at(0), numbers.at(1)};
    for (std::size_t n = 0; n < set_free_.size(); ++n) {
      set_free_[n] = {numbers.at(2 + 2 * n), numbers.at(3 + 2 * n)};
    }
    for (std::size_t kind = 0; kind < k_kinds; ++kind) {
      if (!places_[kind].empty()) places_[kind] = a.numbers(k_kind_names[kind]);
    }
  });
}

}  // namespace dust::run
