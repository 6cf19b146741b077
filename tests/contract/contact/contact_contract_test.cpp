// SPDX-License-Identifier: Apache-2.0
// What every contact law shall keep, whoever wrote it.
#include "contract/contact/laws.hpp"

#include "support/approx.hpp"

namespace {

using namespace dust;
using sdk::Vec3;
using test::Answer;
using test::LawBench;
using test::SampleRow;

constexpr double k_step = 1e-7;
/// Roundings of some forty operations per row and step.
constexpr double k_rounding = 1e-12;

/// Several steps, so that the history matters; the sample moves on as the velocities say.
std::vector<Answer> history_of(const sdk::ContactLaw& law, std::vector<SampleRow> rows,
                               double step = k_step, std::size_t split = contact::k_batch) {
  LawBench bench(std::move(rows));
  for (int n = 0; n < 5; ++n) {
    bench.contact(law, step, split);
    for (SampleRow& r : bench.rows()) r.overlap -= step * dot(r.velocity, r.normal);
  }
  return bench.answers();
}

std::unique_ptr<sdk::ContactLaw> made(const test::Law& law,
                                      const std::map<std::string, sdk::Value>& changed = {}) {
  auto model = law.make<sdk::ContactLaw>(changed);
  model->prepare(test::k_sand, test::k_belt);
  return model;
}

/// A head-on collision of two grains, alone: speed after over speed before.
double rebound(const sdk::ContactLaw& law, double speed) {
  constexpr double radius = 1.5e-4;
  constexpr double mass = 1.5e-7;
  const double step = law.collision_time(radius, mass, speed) / 2000.0;
  LawBench bench({{.overlap = 0.0,
                   .radius = radius,
                   .mass = mass,
                   .normal = {0, 0, 1},
                   .velocity = {0, 0, -speed},
                   .rotation = {}}});
  SampleRow& r = bench.rows()[0];
  r.overlap = 0.5 * speed * step;
  for (int n = 0; n < 20000 && r.overlap > 0.0; ++n) {
    bench.contact(law, step);
    r.velocity.z += step / mass * bench.answers()[0].force.z;
    r.overlap -= step * r.velocity.z;
  }
  return r.velocity.z / speed;
}

TEST_CASE("every contact law shall be described, with an example that can be read") {
  const auto laws = test::all_laws("contact");
  CHECK(laws.size() >= 2);
  for (const auto& law : laws) {
    CAPTURE(law.offer.info.name);
    test::check_described(law);
  }
}

TEST_CASE("every parameter of a contact law shall matter") {
  for (const auto& law : test::all_laws("contact")) {
    const auto plain = history_of(*made(law), test::sample_rows());
    for (const sdk::Parameter& p : law.offer.info.parameters) {
      CAPTURE(law.offer.info.name);
      CAPTURE(p.name);
      const auto other = made(law, {{p.name, test::perturbed(law, p)}});
      CHECK_FALSE(history_of(*other, test::sample_rows()) == plain);
    }
  }
}

TEST_CASE("a contact law shall answer alike in other units") {
  const test::Scale s;
  const double force = s.of(sdk::dimension::force);
  const double stiffness = s.of(sdk::dimension::stiffness);
  for (const auto& law : test::with_choices(test::all_laws("contact"))) {
    CAPTURE(law.offer.info.name);
    const auto plain = history_of(*made(law), test::sample_rows());
    auto other = law.make<sdk::ContactLaw>(test::scaled_values(law, s));
    other->prepare(test::scaled(test::k_sand, s), test::scaled(test::k_belt, s));
    const auto scaled =
        history_of(*other, test::scaled_rows(test::sample_rows(), s), k_step * s.time);
    for (std::size_t q = 0; q < plain.size(); ++q) {
      const double size = norm(plain[q].force);
      CHECK(norm(scaled[q].force / force - plain[q].force) <= k_rounding * size);
      CHECK(scaled[q].normal_stiffness / stiffness ==
            test::approx(plain[q].normal_stiffness).epsilon(k_rounding));
      CHECK(scaled[q].tangential_stiffness / stiffness ==
            test::approx(plain[q].tangential_stiffness).epsilon(k_rounding));
    }
    CHECK(other->collision_time(s.length * 1e-4, s.mass * 1e-8, s.length / s.time * 0.3) / s.time ==
          test::approx(made(law)->collision_time(1e-4, 1e-8, 0.3)).epsilon(k_rounding));
    CHECK(other->half_period(s.length * 1e-4, s.mass * 1e-8, s.length * 1e-6) / s.time ==
          test::approx(made(law)->half_period(1e-4, 1e-8, 1e-6)).epsilon(k_rounding));
  }
}

TEST_CASE("a contact law shall give the same bits however its batch is split") {
  for (const auto& law : test::with_choices(test::all_laws("contact"))) {
    CAPTURE(law.offer.info.name);
    const auto whole = history_of(*made(law), test::sample_rows());
    for (const std::size_t split : {8, 24}) {
      CHECK(history_of(*made(law), test::sample_rows(), k_step, split) == whole);
    }
  }
}

TEST_CASE("seen from the other side a contact's force shall be the opposite") {
  for (const auto& law : test::with_choices(test::all_laws("contact"))) {
    CAPTURE(law.offer.info.name);
    const auto plain = history_of(*made(law), test::sample_rows());
    auto rows = test::sample_rows();
    for (SampleRow& r : rows) {
      r.normal = -1.0 * r.normal;
      r.velocity = -1.0 * r.velocity;
    }
    const auto swapped = history_of(*made(law), rows);
    for (std::size_t q = 0; q < plain.size(); ++q) {
      CHECK(norm(swapped[q].force + plain[q].force) == 0.0);
      CHECK(swapped[q].normal_force == plain[q].normal_force);
    }
  }
}

TEST_CASE("a turned contact shall have a turned force") {
  const Vec3 axis = Vec3{1, 2, -0.5} / norm(Vec3{1, 2, -0.5});
  for (const auto& law : test::with_choices(test::all_laws("contact"))) {
    CAPTURE(law.offer.info.name);
    const auto plain = history_of(*made(law), test::sample_rows());
    auto rows = test::sample_rows();
    for (SampleRow& r : rows) {
      r.normal = rotate(r.normal, axis, 1.1);
      r.velocity = rotate(r.velocity, axis, 1.1);
    }
    const auto turned = history_of(*made(law), rows);
    for (std::size_t q = 0; q < plain.size(); ++q) {
      CHECK(norm(rotate(turned[q].force, axis, -1.1) - plain[q].force) <=
            1e-11 * norm(plain[q].force));
    }
  }
}

TEST_CASE("without touch a contact law shall give nothing and forget its spring") {
  for (const auto& law : test::with_choices(test::all_laws("contact"))) {
    CAPTURE(law.offer.info.name);
    const auto model = made(law);
    LawBench bench(test::sample_rows());
    bench.contact(*model, k_step);
    for (SampleRow& r : bench.rows()) r.overlap = -0.1 * r.overlap;
    for (int n = 0; n < 3; ++n) bench.contact(*model, k_step);
    for (const Answer& a : bench.answers()) {
      CHECK(norm(a.force) == 0.0);
      CHECK(a.normal_force == 0.0);
      CHECK(a.normal_stiffness == 0.0);
      CHECK(a.tangential_stiffness == 0.0);
    }
  }
}

TEST_CASE("friction shall never exceed its share of the pressing force") {
  for (const auto& law : test::all_laws("contact")) {
    const sdk::Parameter* friction = law.parameter("friction");
    if (friction == nullptr) continue;
    CAPTURE(law.offer.info.name);
    const auto rows = test::sample_rows();
    const auto answers = history_of(*made(law), rows);
    int sliding = 0;
    for (std::size_t q = 0; q < answers.size(); ++q) {
      const Answer& a = answers[q];
      const Vec3 tangential = a.force - a.normal_force * rows[q].normal;
      const double limit = law.number(*friction) * std::max(a.normal_force, 0.0);
      // The normal part taken out again leaves some roundings of the whole force.
      CHECK(norm(tangential) <= limit + k_rounding * norm(a.force));
      CHECK(std::abs(dot(tangential, rows[q].normal)) <= k_rounding * norm(a.force));
      sliding += norm(tangential) > 0.999 * limit ? 1 : 0;
    }
    CHECK(sliding > 0);
    CHECK(sliding < 64);
  }
}

TEST_CASE("the tangential spring shall turn with its contact at constant length") {
  // A spring wound up, then the contact turns by 90 degrees about the axis across the spring,
  // without slip: projection alone would leave nothing of it.
  for (const auto& law : test::all_laws("contact")) {
    if (law.parameter("friction") == nullptr) continue;
    CAPTURE(law.offer.info.name);
    const auto model = made(law, {{"friction", 5.0}});
    LawBench bench({{.overlap = 1e-6,
                     .radius = 1.5e-4,
                     .mass = 1e-7,
                     .normal = {0, 0, 1},
                     .velocity = {0.01, 0, 0},
                     .rotation = {}}});
    for (int n = 0; n < 10; ++n) bench.contact(*model, k_step);
    SampleRow& r = bench.rows()[0];
    r.velocity = {};
    bench.contact(*model, k_step);
    const double before = bench.answers()[0].force.x;
    REQUIRE(before < 0.0);
    constexpr int k_turns = 200;
    for (int n = 1; n <= k_turns; ++n) {
      const double angle = 0.5 * std::acos(-1.0) * n / k_turns;
      r.normal = {std::sin(angle), 0, std::cos(angle)};
      bench.contact(*model, k_step);
    }
    const Answer after = bench.answers()[0];
    CHECK(after.force.z == test::approx(-before).epsilon(1e-9));
  }
}

TEST_CASE("the declared restitution shall be the realised one, and no impact shall gain energy") {
  constexpr double k_realised = 0.005;
  for (const auto& law : test::all_laws("contact")) {
    if (law.parameter("restitution") == nullptr) continue;
    for (const double e : {0.1, 0.3, 0.5, 0.7, 0.9, 1.0}) {
      for (const double speed : {0.02, 1.0}) {
        CAPTURE(law.offer.info.name);
        CAPTURE(e);
        const double realised = rebound(*made(law, {{"restitution", e}}), speed);
        CHECK(std::abs(realised - e) < k_realised);
        CHECK(realised < 1.0 + 1e-3);
      }
    }
  }
}

}  // namespace
