// SPDX-License-Identifier: Apache-2.0
// What every rolling law shall keep, whoever wrote it.
#include "contract/contact/laws.hpp"

#include "support/approx.hpp"

namespace {

using namespace dust;
using sdk::Vec3;
using test::Answer;
using test::LawBench;
using test::SampleRow;

constexpr double k_step = 1e-6;
constexpr double k_rounding = 1e-12;
constexpr double k_load = 3e-5;        // N
constexpr double k_stiffness = 400.0;  // N/m

std::vector<Answer> history_of(const sdk::RollingLaw& law, std::vector<SampleRow> rows,
                               const test::Scale& s = test::k_no_scale,
                               std::size_t split = contact::k_batch, double load = k_load) {
  LawBench bench(std::move(rows));
  bench.load(load * s.of(sdk::dimension::force), k_stiffness * s.of(sdk::dimension::stiffness));
  for (int n = 0; n < 5; ++n) bench.rolling(law, k_step * s.time, split);
  return bench.answers();
}

/// Slow enough that some contacts are not at their limit.
std::vector<SampleRow> rolling_rows() {
  auto rows = test::sample_rows();
  for (std::size_t q = 0; q < rows.size(); q += 2) rows[q].rotation = 2e-3 * rows[q].rotation;
  return rows;
}

std::unique_ptr<sdk::RollingLaw> made(const test::Law& law,
                                      const std::map<std::string, sdk::Value>& changed = {}) {
  auto model = law.make<sdk::RollingLaw>(changed);
  model->prepare(test::k_sand, test::k_belt);
  return model;
}

TEST_CASE("every rolling law shall be described, with an example that can be read") {
  const auto laws = test::all_laws("rolling");
  CHECK(laws.size() >= 3);
  for (const auto& law : laws) {
    CAPTURE(law.offer.info.name);
    test::check_described(law);
  }
}

TEST_CASE("every parameter of a rolling law shall matter") {
  for (const auto& law : test::all_laws("rolling")) {
    const auto plain = history_of(*made(law), rolling_rows());
    for (const sdk::Parameter& p : law.offer.info.parameters) {
      CAPTURE(law.offer.info.name);
      CAPTURE(p.name);
      const auto other = made(law, {{p.name, test::perturbed(law, p)}});
      CHECK_FALSE(history_of(*other, rolling_rows()) == plain);
    }
  }
}

TEST_CASE("a rolling law shall answer alike in other units") {
  const test::Scale s;
  for (const auto& law : test::with_choices(test::all_laws("rolling"))) {
    CAPTURE(law.offer.info.name);
    const auto plain = history_of(*made(law), rolling_rows());
    auto other = law.make<sdk::RollingLaw>(test::scaled_values(law, s));
    other->prepare(test::scaled(test::k_sand, s), test::scaled(test::k_belt, s));
    const auto scaled = history_of(*other, test::scaled_rows(rolling_rows(), s), s);
    for (std::size_t q = 0; q < plain.size(); ++q) {
      CHECK(norm(scaled[q].couple / s.of(sdk::dimension::energy) - plain[q].couple) <=
            k_rounding * norm(plain[q].couple));
    }
  }
}

TEST_CASE("a rolling law shall give the same bits however its batch is split") {
  for (const auto& law : test::with_choices(test::all_laws("rolling"))) {
    CAPTURE(law.offer.info.name);
    const auto whole = history_of(*made(law), rolling_rows());
    for (const std::size_t split : {8, 24}) {
      CHECK(history_of(*made(law), rolling_rows(), test::k_no_scale, split) == whole);
    }
  }
}

TEST_CASE("a rolling law shall give the opposite couple from the other side and turn with space") {
  const Vec3 axis = Vec3{1, 2, -0.5} / norm(Vec3{1, 2, -0.5});
  for (const auto& law : test::all_laws("rolling")) {
    CAPTURE(law.offer.info.name);
    const auto plain = history_of(*made(law), rolling_rows());
    auto swapped = rolling_rows();
    auto turned = rolling_rows();
    for (std::size_t q = 0; q < plain.size(); ++q) {
      swapped[q].normal = -1.0 * swapped[q].normal;
      swapped[q].velocity = -1.0 * swapped[q].velocity;
      swapped[q].rotation = -1.0 * swapped[q].rotation;
      turned[q].normal = rotate(turned[q].normal, axis, 1.1);
      turned[q].velocity = rotate(turned[q].velocity, axis, 1.1);
      turned[q].rotation = rotate(turned[q].rotation, axis, 1.1);
    }
    const auto from_j = history_of(*made(law), swapped);
    const auto elsewhere = history_of(*made(law), turned);
    for (std::size_t q = 0; q < plain.size(); ++q) {
      CHECK(norm(from_j[q].couple + plain[q].couple) == 0.0);
      CHECK(norm(rotate(elsewhere[q].couple, axis, -1.1) - plain[q].couple) <=
            1e-11 * norm(plain[q].couple));
    }
  }
}

TEST_CASE("a couple shall stay within mu_r R* N, across the normal, and against the rolling") {
  for (const auto& law : test::all_laws("rolling")) {
    const sdk::Parameter* friction = law.parameter("friction");
    if (friction == nullptr) continue;
    CAPTURE(law.offer.info.name);
    const auto rows = rolling_rows();
    const auto answers = history_of(*made(law), rows);
    int saturated = 0;
    for (std::size_t q = 0; q < rows.size(); ++q) {
      const double limit = law.number(*friction) * rows[q].radius * k_load;
      const double size = norm(answers[q].couple);
      CHECK(size <= limit * (1.0 + k_rounding));
      CHECK(std::abs(dot(answers[q].couple, rows[q].normal)) <= k_rounding * limit);
      CHECK(dot(answers[q].couple, rows[q].rotation) <= 0.0);
      saturated += size > 0.999 * limit ? 1 : 0;
    }
    CHECK(saturated > 0);
    CHECK(saturated < 64);
    // No load, no couple; none without friction; none for the twist about the normal.
    for (const Answer& a : history_of(*made(law), rows, test::k_no_scale, contact::k_batch, 0.0)) {
      CHECK(norm(a.couple) == 0.0);
    }
    for (const Answer& a : history_of(*made(law, {{"friction", 0.0}}), rows)) {
      CHECK(norm(a.couple) == 0.0);
    }
    auto twisting = rows;
    for (SampleRow& r : twisting) r.rotation = 100.0 * r.normal;
    for (std::size_t q = 0; const Answer& a : history_of(*made(law), twisting)) {
      // What rounding leaves of the twist, through at most the stiffest spring or dashpot.
      CHECK(norm(a.couple) <= 1e-9 * law.number(*friction) * rows[q++].radius * k_load);
    }
  }
}

TEST_CASE("the rolling spring shall turn with its contact at constant length") {
  for (const auto& law : test::all_laws("rolling")) {
    const auto model = made(law);
    if (model->history_size() == 0) continue;
    CAPTURE(law.offer.info.name);
    LawBench bench({{.overlap = 1e-6,
                     .radius = 1.5e-4,
                     .mass = 1e-7,
                     .normal = {0, 0, 1},
                     .velocity = {},
                     .rotation = {0, 1.0, 0}}});
    bench.load(k_load, k_stiffness);
    for (int n = 0; n < 10; ++n) bench.rolling(*model, k_step);
    SampleRow& r = bench.rows()[0];
    r.rotation = {};
    bench.rolling(*model, k_step);
    const double before = bench.answers()[0].couple.y;
    REQUIRE(before < 0.0);
    constexpr int k_turns = 200;
    for (int n = 1; n <= k_turns; ++n) {
      const double angle = 0.5 * std::acos(-1.0) * n / k_turns;
      r.normal = {0, std::sin(angle), std::cos(angle)};
      bench.rolling(*model, k_step);
    }
    CHECK(bench.answers()[0].couple.z == test::approx(-before).epsilon(1e-9));
  }
}

}  // namespace
