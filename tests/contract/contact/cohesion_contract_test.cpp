// SPDX-License-Identifier: Apache-2.0
// What every cohesive law shall keep, whoever wrote it.
#include "contract/contact/laws.hpp"
#include "dust/sdk/error.hpp"
#include "support/approx.hpp"

namespace {

using namespace dust;
using test::Answer;
using test::LawBench;
using test::SampleRow;

constexpr double k_rounding = 1e-11;  // a cube root and some powers

std::unique_ptr<sdk::CohesionLaw> made(const test::Law& law,
                                       const std::map<std::string, sdk::Value>& changed = {}) {
  auto model = law.make<sdk::CohesionLaw>(changed);
  model->prepare(test::k_sand, test::k_belt);
  return model;
}

/// The sample touches, then parts step by step beyond the largest range, then comes back short of
/// touch: all answers on the way.
std::vector<Answer> pulled(const sdk::CohesionLaw& law, std::vector<SampleRow> rows,
                           std::size_t split = contact::k_batch, double step = 1e-6) {
  double largest = 0.0;
  for (const SampleRow& r : rows) largest = std::max(largest, r.radius);
  const double range = std::max(law.range(largest), 1e-3 * largest);  // some laws have none
  std::vector<double> touch;
  for (const SampleRow& r : rows) touch.push_back(r.overlap);
  LawBench bench(std::move(rows));
  std::vector<Answer> all;
  for (int n = 0; n <= 24; ++n) {
    const double share = n <= 12 ? n / 10.0 : (24 - n + 0.01) / 10.0;
    for (std::size_t q = 0; q < touch.size(); ++q) {
      bench.rows()[q].overlap = (1.0 - share) * touch[q] - share * 1.001 * range;
      if (n > 12) bench.rows()[q].overlap = std::min(bench.rows()[q].overlap, -0.01 * range);
    }
    bench.cohesion(law, split, step);
    const auto now = bench.answers();
    all.insert(all.end(), now.begin(), now.end());
  }
  return all;
}

TEST_CASE("every cohesive law shall be described, with an example that can be read") {
  const auto laws = test::all_laws("cohesion");
  CHECK(laws.size() >= 4);
  for (const auto& law : laws) {
    CAPTURE(law.offer.info.name);
    test::check_described(law);
  }
}

/// Whether another value of the parameter changes an answer, or is refused by its name, where the
/// example's other values are `changed` like this.
bool matters(const test::Law& law, const sdk::Parameter& p,
             std::map<std::string, sdk::Value> changed) {
  const auto plain = pulled(*made(law, changed), test::sample_rows());
  changed[p.name] = test::perturbed(law, p);
  try {
    return !(pulled(*made(law, changed), test::sample_rows()) == plain);
  } catch (const sdk::ParameterError& problem) {
    return std::string(problem.what()).find(p.name) != std::string::npos;
  }
}

TEST_CASE("every parameter of a cohesive law shall matter") {
  // Of laws that can be given moisture in place of a volume some matter with it alone.
  const std::map<std::string, sdk::Value> moist = {{"relative_volume", 0.0},
                                                   {"moisture", std::vector<double>{0.01, 0.005}}};
  for (const auto& law : test::all_laws("cohesion")) {
    for (const sdk::Parameter& p : law.offer.info.parameters) {
      CAPTURE(law.offer.info.name);
      CAPTURE(p.name);
      const bool can_be_moist = law.parameter("moisture") != nullptr;
      CHECK((matters(law, p, {}) || (can_be_moist && matters(law, p, moist))));
    }
  }
}

TEST_CASE("a cohesive law shall answer alike in other units") {
  const test::Scale s;
  for (const auto& law : test::all_laws("cohesion")) {
    CAPTURE(law.offer.info.name);
    const auto plain = pulled(*made(law), test::sample_rows());
    auto other = law.make<sdk::CohesionLaw>(test::scaled_values(law, s));
    other->prepare(test::scaled(test::k_sand, s), test::scaled(test::k_belt, s));
    const auto scaled =
        pulled(*other, test::scaled_rows(test::sample_rows(), s), contact::k_batch, 1e-6 * s.time);
    REQUIRE(scaled.size() == plain.size());
    for (std::size_t q = 0; q < plain.size(); ++q) {
      CHECK(std::abs(scaled[q].attraction / s.of(sdk::dimension::force) - plain[q].attraction) <=
            k_rounding * std::abs(plain[q].attraction));
      CHECK(scaled[q].contact_overlap / s.length ==
            test::approx(plain[q].contact_overlap).epsilon(k_rounding));
    }
    const auto model = made(law);
    CHECK(other->range(s.length * 1e-4) / s.length ==
          test::approx(model->range(1e-4)).epsilon(k_rounding));
    CHECK(other->resting_overlap(s.length * 1e-4) / s.length ==
          test::approx(model->resting_overlap(1e-4)).epsilon(k_rounding));
  }
}

TEST_CASE("a cohesive law shall give the same bits however its batch is split") {
  for (const auto& law : test::all_laws("cohesion")) {
    CAPTURE(law.offer.info.name);
    const auto whole = pulled(*made(law), test::sample_rows());
    for (const std::size_t split : {8, 24}) {
      CHECK(pulled(*made(law), test::sample_rows(), split) == whole);
    }
  }
}

/// Attracts nothing at rest: its force is there against motion.
bool is_viscous(const sdk::CohesionLaw& law) { return law.resting_overlap(1e-4) == 0.0; }

std::vector<SampleRow> resting_rows() {
  auto rows = test::sample_rows();
  for (SampleRow& r : rows) r.velocity = {};
  return rows;
}

TEST_CASE("cohesion at rest shall attract, act only after touch and end within its range") {
  for (const auto& law : test::all_laws("cohesion")) {
    CAPTURE(law.offer.info.name);
    const auto rows = resting_rows();
    const auto model = made(law);
    const auto all = pulled(*model, rows);
    const std::size_t count = rows.size();
    for (std::size_t n = 0; n < all.size() / count; ++n) {
      for (std::size_t q = 0; q < count; ++q) {
        const Answer& a = all[n * count + q];
        CHECK(std::isfinite(a.attraction));
        CHECK(std::isfinite(a.contact_overlap));
        CHECK(a.attraction >= 0.0);
        if (n == 0) CHECK((a.attraction > 0.0) == !is_viscous(*model));
        // Beyond the range from the tenth step on, and never again touched.
        if (n >= 10) CHECK(a.attraction == 0.0);
        if (n >= 10) CHECK(a.contact_overlap <= 0.0);
      }
    }
    // Never touched, never bound.
    LawBench bench(resting_rows());
    for (SampleRow& r : bench.rows()) r.overlap = -0.01 * std::max(model->range(r.radius), 1e-9);
    bench.cohesion(*model);
    for (const Answer& a : bench.answers()) CHECK(a.attraction == 0.0);
  }
}

TEST_CASE("what motion adds to cohesion shall resist it, within the law's range") {
  for (const auto& law : test::all_laws("cohesion")) {
    CAPTURE(law.offer.info.name);
    const auto model = made(law);
    const auto rows = test::sample_rows();
    const auto still = pulled(*model, resting_rows());
    const auto moving = pulled(*model, rows);
    double most = 0.0;
    for (std::size_t n = 0; n < moving.size(); ++n) {
      const SampleRow& r = rows[n % rows.size()];
      const double added = moving[n].attraction - still[n].attraction;
      CHECK(added * dot(r.velocity, r.normal) >= 0.0);
      if (n / rows.size() == 10) CHECK(added == 0.0);  // all beyond the range
      most = std::max(most, std::abs(added));
    }
    CHECK((most > 0.0) == is_viscous(*model));
  }
}

TEST_CASE("the range of a cohesive law shall grow with the grains") {
  // The core asks for the largest pair alone.
  for (const auto& law : test::all_laws("cohesion")) {
    CAPTURE(law.offer.info.name);
    const auto model = made(law);
    for (double radius = 1e-6; radius < 0.1; radius *= 2.0) {
      CHECK(model->range(radius) >= 0.0);
      CHECK(model->range(2.0 * radius) >= model->range(radius));
      CHECK((model->resting_overlap(radius) > 0.0) == !is_viscous(*model));
      CHECK(model->resting_overlap(radius) >= 0.0);
    }
  }
}

}  // namespace
