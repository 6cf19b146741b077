// SPDX-License-Identifier: Apache-2.0
#pragma once

#include "contact/batch.hpp"
#include "contact/batch_kernels.hpp"
#include "contract/coupling/models.hpp"
#include "dust/sdk/random.hpp"
#include "scenario/text/units.hpp"

#include <doctest/doctest.h>

#include <array>
#include <cmath>
#include <map>
#include <sstream>
#include <stdexcept>

namespace dust::test {

/// The values of the README's example, `kind: {model: name, key: value, ...}`, in SI.
inline std::map<std::string, sdk::Value> example_of(const sdk::ModelInfo& info) {
  const std::string readme = readme_of(info);
  const std::string begin = info.kind + ": {model: " + info.name;
  const auto at = readme.find(begin);
  if (at == std::string::npos) throw std::runtime_error("no example for " + info.name);
  const auto end = readme.find('}', at);
  std::istringstream list(readme.substr(at + begin.size(), end - at - begin.size()));
  std::map<std::string, sdk::Value> values;
  for (std::string item; std::getline(list, item, ',');) {
    const auto colon = item.find(':');
    if (colon == std::string::npos) continue;
    const auto first = item.find_first_not_of(' ');
    const std::string key = item.substr(first, colon - first);
    for (const sdk::Parameter& p : info.parameters) {
      if (p.name != key) continue;
      std::string error;
      const auto written = scenario::split_number(item.substr(colon + 2), error);
      const auto value = written ? scenario::to_si(*written, p.dimension, error) : std::nullopt;
      if (!value) throw std::runtime_error(key + ": " + error);
      values[key] = *value;
    }
    if (values.count(key) == 0) throw std::runtime_error("the example's " + key + " is unknown");
  }
  return values;
}

/// One model of a kind with the means to make it.
struct Law {
  PluginLibrary::Offer offer;
  std::map<std::string, sdk::Value> values;

  /// With the example's values, `changed` over them.
  template <class Kind>
  [[nodiscard]] std::unique_ptr<Kind> make(
      const std::map<std::string, sdk::Value>& changed = {}) const {
    std::vector<sdk::Value> row;
    for (const sdk::Parameter& p : offer.info.parameters) {
      const auto other = changed.find(p.name);
      const auto given = values.find(p.name);
      row.push_back(other != changed.end()  ? other->second
                    : given != values.end() ? given->second
                                            : sdk::Value{});
    }
    return std::unique_ptr<Kind>(static_cast<Kind*>(offer.factory(row).release()));
  }
  /// The value the example gives, or the default.
  [[nodiscard]] double number(const sdk::Parameter& p) const {
    const auto given = values.find(p.name);
    return std::get<double>(given != values.end() ? given->second : p.default_value);
  }
  [[nodiscard]] const sdk::Parameter* parameter(const std::string& name) const {
    for (const sdk::Parameter& p : offer.info.parameters) {
      if (p.name == name) return &p;
    }
    return nullptr;
  }
};

/// All models of a kind among the plugins.
inline std::vector<Law> all_laws(const std::string& kind) {
  std::vector<std::string> names;
  for (const auto& entry : std::filesystem::directory_iterator(DUST_TEST_PLUGINS)) {
    const std::string name = entry.path().stem().string();
    if (name.starts_with(kind + "_")) names.push_back(name);
  }
  std::sort(names.begin(), names.end());
  std::vector<Law> laws;
  for (const std::string& name : names) {
    PluginLibrary library(name);
    for (auto& offer : library.offers) {
      if (offer.info.kind == kind) laws.push_back({offer, example_of(offer.info)});
    }
  }
  return laws;
}

/// How the units of the second system compare with SI; powers of two keep products exact.
struct Scale {
  double length = 8.0, mass = 4.0, time = 0.5;
  [[nodiscard]] double of(sdk::Dimension d) const {
    return std::pow(length, d.length) * std::pow(mass, d.mass) * std::pow(time, d.time);
  }
};
inline constexpr Scale k_no_scale{1.0, 1.0, 1.0};

inline sdk::MaterialProperties scaled(const sdk::MaterialProperties& m, const Scale& s) {
  return {m.density * s.of(sdk::dimension::density),
          m.young_modulus * s.of(sdk::dimension::pressure), m.poisson_ratio};
}
inline const sdk::MaterialProperties k_sand{2650.0, 50e6, 0.3};
inline const sdk::MaterialProperties k_belt{1200.0, 20e6, 0.45};

/// A value of every column of a batch, row by row, as vectors: the sample all contracts use.
struct SampleRow {
  double overlap, radius, mass;
  sdk::Vec3 normal, velocity, rotation;
};
/// Sand of 0.2 to 0.6 mm that slides, sticks, rolls, approaches and parts.
inline std::vector<SampleRow> sample_rows(std::size_t count = 64) {
  const sdk::Random random(17, sdk::stream_of("contacts"));
  std::vector<SampleRow> rows;
  for (std::uint64_t n = 0; n < count; ++n) {
    const auto u = [&](std::uint32_t k) { return random.uniform(n, 0, k); };
    const sdk::Vec3 direction{u(0) - 0.5, u(1) - 0.5, u(2) - 0.5};
    const double radius = 1e-4 * (1.0 + u(3));
    rows.push_back({.overlap = radius * 0.02 * (0.05 + u(4)),
                    .radius = radius,
                    .mass = 2650 * 16.0 * radius * radius * radius * (0.5 + u(5)),
                    .normal = direction / norm(direction),
                    .velocity = 0.1 * std::pow(30.0, 2.0 * u(12) - 1.0) *
                                sdk::Vec3{u(6) - 0.5, u(7) - 0.5, u(8) - 0.5},
                    .rotation = 200.0 * sdk::Vec3{u(9) - 0.5, u(10) - 0.5, u(11) - 0.5}});
  }
  return rows;
}

/// What the stages write, as rows.
struct Answer {
  double normal_force, normal_stiffness, tangential_stiffness, contact_overlap, attraction;
  sdk::Vec3 force, couple;
  bool operator==(const Answer& o) const {
    const auto same = [](sdk::Vec3 a, sdk::Vec3 b) {
      return a.x == b.x && a.y == b.y && a.z == b.z;
    };
    return normal_force == o.normal_force && normal_stiffness == o.normal_stiffness &&
           tangential_stiffness == o.tangential_stiffness && contact_overlap == o.contact_overlap &&
           attraction == o.attraction && same(force, o.force) && same(couple, o.couple);
  }
};

/// The columns of one batch with a history that lives as long as the bench.
class LawBench {
 public:
  using B = contact::BatchColumns;
  explicit LawBench(std::vector<SampleRow> rows) : rows_(std::move(rows)) {
    if (rows_.size() > contact::k_batch) throw std::runtime_error("at most one batch");
  }
  std::vector<SampleRow>& rows() { return rows_; }

  void contact(const sdk::ContactLaw& law, double step, std::size_t split = contact::k_batch) {
    each(split, step, [&](sdk::ContactBatch b, sdk::CohesionBatch) {
      b.time_step = step;
      law.evaluate(b);
    });
  }
  void rolling(const sdk::RollingLaw& law, double step, std::size_t split = contact::k_batch) {
    each(split, step, [&](sdk::ContactBatch b, sdk::CohesionBatch) {
      b.time_step = step;
      law.evaluate(b);
    });
  }
  void cohesion(const sdk::CohesionLaw& law, std::size_t split = contact::k_batch,
                double step = 1e-6) {
    each(split, step, [&](sdk::ContactBatch, sdk::CohesionBatch b) {
      b.time_step = step;
      law.evaluate(b);
    });
  }
  /// What a rolling law reads from the contact stage.
  void load(double normal_force, double stiffness) {
    for (std::size_t q = 0; q < contact::k_batch; ++q) {
      columns_.column(B::normal_force)[q] = normal_force;
      columns_.column(B::normal_stiffness)[q] = stiffness;
      columns_.column(B::tangential_stiffness)[q] = stiffness;
    }
  }
  [[nodiscard]] std::vector<Answer> answers() {
    std::vector<Answer> out;
    for (std::size_t q = 0; q < rows_.size(); ++q) {
      const auto at = [&](int c) { return columns_.column(c)[q]; };
      const auto vector = [&](int c) { return sdk::Vec3{at(c), at(c + 1), at(c + 2)}; };
      out.push_back({at(B::normal_force), at(B::normal_stiffness), at(B::tangential_stiffness),
                     at(B::contact_overlap), at(B::attraction), vector(B::force_x),
                     vector(B::torque_x)});
    }
    return out;
  }

 private:
  /// Whole groups of eight, as the core promises.
  template <class Call>
  void each(std::size_t split, double step, Call&& call) {
    const std::size_t count = contact::padded(rows_.size());
    for (std::size_t q = 0; q < count; ++q) {
      const SampleRow& r = rows_[std::min(q, rows_.size() - 1)];
      columns_.column(B::overlap)[q] = r.overlap;
      columns_.column(B::effective_radius)[q] = r.radius;
      columns_.column(B::effective_mass)[q] = r.mass;
      // Two equal ones.
      columns_.column(B::radius_i)[q] = columns_.column(B::radius_j)[q] = 2.0 * r.radius;
      columns_.column(B::inverse_mass_i)[q] = columns_.column(B::inverse_mass_j)[q] = 0.5 / r.mass;
      for (int d = 0; d < 3; ++d) {
        columns_.column(B::normal_x + d)[q] = r.normal[d];
        columns_.column(B::velocity_x + d)[q] = r.velocity[d];
        columns_.column(B::rotation_x + d)[q] = r.rotation[d];
        columns_.column(B::displacement_x + d)[q] = step * r.velocity[d];
        columns_.column(B::angle_x + d)[q] = step * r.rotation[d];
      }
    }
    contact::derive_normal_velocity(columns_, count);
    for (std::size_t first = 0; first < count; first += split) {
      const std::size_t n = std::min(split, count - first);
      sdk::ContactBatch b = columns_.view(n, 0.0);
      sdk::CohesionBatch c = columns_.cohesion_view(n, 0.0, 0);
      std::array<double*, contact::k_max_history> history{};
      for (std::size_t h = 0; h < history.size(); ++h) history[h] = columns_.history()[h] + first;
      b.history = c.history = history.data();
      for (const double** column : {&b.overlap,
                                    &b.normal.x,
                                    &b.normal.y,
                                    &b.normal.z,
                                    &b.velocity.x,
                                    &b.velocity.y,
                                    &b.velocity.z,
                                    &b.angular_velocity.x,
                                    &b.angular_velocity.y,
                                    &b.angular_velocity.z,
                                    &b.displacement.x,
                                    &b.displacement.y,
                                    &b.displacement.z,
                                    &b.angle.x,
                                    &b.angle.y,
                                    &b.angle.z,
                                    &b.effective_radius,
                                    &b.effective_mass,
                                    &b.radius_i,
                                    &b.radius_j,
                                    &b.inverse_mass_i,
                                    &b.inverse_mass_j,
                                    &c.overlap,
                                    &c.effective_radius,
                                    &c.effective_mass,
                                    &c.normal_velocity}) {
        *column += first;
      }
      for (double** column :
           {&b.normal_force, &b.normal_stiffness, &b.tangential_stiffness, &b.force.x, &b.force.y,
            &b.force.z, &b.torque.x, &b.torque.y, &b.torque.z, &c.contact_overlap, &c.attraction}) {
        *column += first;
      }
      call(b, c);
    }
  }

  std::vector<SampleRow> rows_;
  contact::BatchColumns columns_;
};

/// The laws, and besides each with every other choice that it offers.
inline std::vector<Law> with_choices(std::vector<Law> laws) {
  const std::size_t plain = laws.size();
  for (std::size_t n = 0; n < plain; ++n) {
    const Law law = laws[n];  // the list grows
    for (const sdk::Parameter& p : law.offer.info.parameters) {
      for (const std::string& option : p.options) {
        Law other = law;
        other.values[p.name] = option;
        laws.push_back(std::move(other));
      }
    }
  }
  return laws;
}

/// Another of the choices, or the example's value moved a little, within its range.
inline sdk::Value perturbed(const Law& law, const sdk::Parameter& p) {
  if (!p.options.empty()) {
    return p.options[p.options[0] == std::get<std::string>(p.default_value) ? 1 : 0];
  }
  if (p.type == sdk::ParameterType::numbers) return std::vector<double>{0.01, 0.01};
  const double value = law.number(p);
  if (value == 0.0) return std::isfinite(p.range.high) ? 0.1 * p.range.high : 1e-3;
  return p.range.contains(1.1 * value) ? 1.1 * value : 0.9 * value;
}

/// All parameters and the sample in other units.
inline std::map<std::string, sdk::Value> scaled_values(const Law& law, const Scale& s) {
  std::map<std::string, sdk::Value> values;
  for (const sdk::Parameter& p : law.offer.info.parameters) {
    const auto given = law.values.find(p.name);
    const bool is_number = p.options.empty() && p.type == sdk::ParameterType::number;
    values[p.name] = is_number                   ? sdk::Value(law.number(p) * s.of(p.dimension))
                     : given != law.values.end() ? given->second
                                                 : p.default_value;
  }
  return values;
}
inline std::vector<SampleRow> scaled_rows(std::vector<SampleRow> rows, const Scale& s) {
  for (SampleRow& r : rows) {
    r.overlap *= s.length;
    r.radius *= s.length;
    r.mass *= s.mass;
    r.velocity = (s.length / s.time) * r.velocity;
    r.rotation = (1.0 / s.time) * r.rotation;
  }
  return rows;
}

inline void check_described(const Law& law) {
  const sdk::ModelInfo& info = law.offer.info;
  CHECK_FALSE(info.summary.empty());
  CHECK_FALSE(info.equation.empty());
  CHECK_FALSE(info.source.empty());
  const std::string readme = readme_of(info);
  CHECK(readme.find("Source") != std::string::npos);
  CHECK(readme.find("Limits:") != std::string::npos);
  CHECK(readme.find("Verified in") != std::string::npos);
  for (const sdk::Parameter& p : info.parameters) {
    CAPTURE(p.name);
    CHECK_FALSE(p.sentence.empty());
    CHECK(p.sentence.ends_with('.'));
    // No number of a contact can be negative.
    if (p.options.empty()) CHECK_FALSE(p.range.contains(-1e-300));
  }
}

}  // namespace dust::test
