// SPDX-License-Identifier: Apache-2.0
#include "dust/sdk/sphere.hpp"
#include "run/audit/departures.hpp"
#include "run/audit/force_shares.hpp"
#include "support/approx.hpp"

#include <doctest/doctest.h>

#include <cmath>
#include <map>
#include <vector>

using namespace dust;
using run::Departures;
using run::ForceKind;
using run::ForceShares;
using sdk::Vec3;

namespace {

/// Grains as rows.
class Rows {
 public:
  void add(Vec3 place, double diameter, double mass, double weight = 1.0, Vec3 velocity = {}) {
    position_.insert(position_.end(), {place.x, place.y, place.z, 0.5 * diameter});
    velocity_.insert(velocity_.end(), {velocity.x, velocity.y, velocity.z, 1.0 / mass});
    action_.insert(action_.end(), {0.0, 0.0, 0.0, 0.0});
    weight_.push_back(weight);
    id_.push_back(100 - static_cast<std::int64_t>(id_.size()));
    material_.push_back(0);
  }
  /// Relaxes the last one towards `target` at `rate` [1/s].
  void relax(Vec3 target, double rate) {
    const std::size_t n = action_.size() - 4;
    for (int d = 0; d < 3; ++d) action_[n + static_cast<std::size_t>(d)] = target[d];
    action_[n + 3] = rate;
  }
  [[nodiscard]] particles::GrainRows view() {
    particles::GrainRows rows;
    rows.count = id_.size();
    rows.position = position_.data();
    rows.velocity = velocity_.data();
    rows.id = id_.data();
    rows.material = material_.data();
    rows.weight = weight_.data();
    rows.drag_relaxation = action_.data();
    return rows;
  }

 private:
  std::vector<double> position_, velocity_, action_, weight_;
  std::vector<std::int64_t> id_;
  std::vector<std::int32_t> material_;
};

/// Keeps what is written by its name.
class Memory final : public sdk::ArchiveWriter, public sdk::ArchiveReader {
 public:
  void numbers(std::string_view name, std::span<const double> v) override {
    numbers_[std::string(name)] = {v.begin(), v.end()};
  }
  void integers(std::string_view name, std::span<const std::int64_t> v) override {
    integers_[std::string(name)] = {v.begin(), v.end()};
  }
  std::vector<double> numbers(std::string_view name) override {
    return numbers_.at(std::string(name));
  }
  std::vector<std::int64_t> integers(std::string_view name) override {
    return integers_.at(std::string(name));
  }

 private:
  std::map<std::string, std::vector<double>> numbers_;
  std::map<std::string, std::vector<std::int64_t>> integers_;
};

scenario::DomainSpec open_box() {
  scenario::DomainSpec domain;
  domain.max = {1, 1, 1};
  return domain;
}

constexpr double k_g = 9.81;
constexpr std::size_t k_left = 0, k_right = 1, k_bottom = 4;

}  // namespace

TEST_CASE("grains beyond an open side shall be counted there, and the first be named") {
  Departures departures(open_box());
  Rows rows;
  rows.add({0.5, 0.5, 0.5}, 0.01, 2.0);
  rows.add({1.1, 0.5, 0.5}, 0.02, 3.0, 0.5);
  rows.add({1.2, 0.5, 0.5}, 0.03, 4.0);
  rows.add({0.5, 0.5, -0.1}, 0.04, 5.0);
  departures.note(rows.view(), {}, 0.0, {77, 0.25});
  CHECK(departures.through(k_left).count == 0);
  CHECK(departures.through(k_right).count == 2);
  CHECK(departures.through(k_right).mass == test::approx(0.5 * 3.0 + 4.0));
  CHECK(departures.through(k_bottom).count == 1);
  // By their ids: the rows stand the other way round.
  const auto& first = departures.through(k_right).first;
  REQUIRE(first.size() == 2);
  CHECK(first[0].id == 98);
  CHECK(first[1].id == 99);
  CHECK(first[1].diameter == 0.02);
  CHECK(first[1].place == Vec3{1.1, 0.5, 0.5});
  CHECK(first[1].step == 77);
  CHECK(first[1].time == 0.25);
}

TEST_CASE("what walls hold and openings take shall not have left") {
  auto domain = open_box();
  domain.sides[k_bottom].grains = scenario::GrainSide::wall;
  Departures departures(domain);
  Rows rows;
  rows.add({0.5, 0.5, -0.001}, 0.04, 5.0);
  rows.add({1.1, 0.5, 0.5}, 0.02, 3.0);
  particles::Opening hood{
      .name = "right", .side = static_cast<int>(k_right), .min = {0, 0, 0.4}, .max = {0, 1, 0.6}};
  departures.note(rows.view(), std::span(&hood, 1), 0.0, {1, 0.0});
  CHECK(departures.through(k_bottom).count == 0);
  CHECK(departures.through(k_right).count == 0);
  hood.min.z = 0.55;
  departures.note(rows.view(), std::span(&hood, 1), 0.0, {1, 0.0});
  CHECK(departures.through(k_right).count == 1);
}

TEST_CASE("no more than some shall be named, the earliest, and they shall survive a checkpoint") {
  Departures departures(open_box());
  for (int n = 0; n < 30; ++n) {
    Rows rows;
    rows.add({-0.1, 0.5, 0.5}, 0.02, 3.0);
    departures.note(rows.view(), {}, 0.0, {n, 0.1 * n});
  }
  Memory memory;
  departures.save(memory);
  Departures resumed(open_box());
  resumed.load(memory);
  for (const Departures* d : {&departures, &resumed}) {
    CHECK(d->through(k_left).count == 30);
    CHECK(d->through(k_left).mass == test::approx(90.0));
    REQUIRE(d->through(k_left).first.size() == Departures::k_named);
    CHECK(d->through(k_left).first.back().step == 19);
    CHECK(d->through(k_left).first.back().time == test::approx(1.9));
    CHECK(d->through(k_left).first.back().place == Vec3{-0.1, 0.5, 0.5});
  }
}

TEST_CASE("on a grain at rest on another the contacts shall hold its weight") {
  Rows rows;
  rows.add({0.5, 0.5, 0.5}, 0.1, 2.0);
  rows.add({0.5, 0.5, 0.6}, 0.1, 2.0);
  // The upper one on the lower one, which carries both on the floor.
  const double w = 2.0 * k_g;
  const std::vector<particles::ContactRecord> contacts = {
      {.row_i = 0, .row_j = 1, .force = {0, 0, -w}, .branch = {0, 0, 0.1}, .overlap = 1e-4},
      {.row_i = 0, .row_j = -1, .force = {0, 0, 2 * w}, .branch = {0, 0, -0.05}, .overlap = 1e-4}};
  ForceShares shares;
  shares.sample(rows.view(), contacts, {.gravity = {0, 0, -k_g}});
  CHECK(shares.share(ForceKind::gravity) == test::approx(0.5));
  CHECK(shares.share(ForceKind::contact_normal) == test::approx(0.5));
  CHECK(shares.over_weight(ForceKind::contact_normal) == test::approx(1.0));
  CHECK(shares.share(ForceKind::attraction) == 0.0);
  CHECK(shares.share(ForceKind::drag) == 0.0);
}

TEST_CASE("a contact that pulls shall count as attraction, what acts along it as tangential") {
  Rows rows;
  rows.add({0, 0, 0}, 0.1, 1.0);
  rows.add({0.1, 0, 0}, 0.1, 1.0, 3.0);
  const std::vector<particles::ContactRecord> contacts = {
      {.row_i = 0, .row_j = 1, .force = {4, 0, 3}, .branch = {0.1, 0, 0}, .overlap = -1e-6}};
  ForceShares shares;
  shares.sample(rows.view(), contacts, {});
  // 4 N and 3 N on each, weighted alike.
  CHECK(shares.share(ForceKind::attraction) == test::approx(4.0 / 7.0));
  CHECK(shares.share(ForceKind::contact_tangential) == test::approx(3.0 / 7.0));
  CHECK(shares.share(ForceKind::contact_normal) == 0.0);
  CHECK(shares.over_weight(ForceKind::attraction) == 0.0);
}

TEST_CASE("buoyancy, pressure gradient and drag shall be those of their formulas") {
  // Pressure falls by 20 Pa/m along x in cells of 0.1 m, where the grain is: 1 kg, D = 0.2 m.
  const std::vector<float> pressure = {6, 4, 2, 0};
  const std::vector<float> open(4, 1.0F);
  ForceShares::Surroundings in;
  in.gravity = {0, 0, -k_g};
  in.fluid_density = 1.2;
  in.fluid.spacing = {0.1, 1, 1};
  in.fluid.count[0] = 4;
  in.fluid.count[1] = in.fluid.count[2] = 1;
  in.fluid.pressure = pressure;
  in.fluid.open_fraction = open;
  Rows rows;
  rows.add({0.15, 0.5, 0.5}, 0.2, 1.0, 1.0, {1, 0, 0});
  // F = m rate (target - v) = 2 kg/s * 3 m/s.
  rows.relax({4, 0, 0}, 2.0);
  ForceShares shares;
  shares.sample(rows.view(), {}, in);
  const double volume = sdk::sphere_volume(0.2);
  CHECK(shares.over_weight(ForceKind::buoyancy) == test::approx(1.2 * volume));
  CHECK(shares.over_weight(ForceKind::pressure_gradient) ==
        test::approx(20.0 * volume / k_g).epsilon(1e-6));
  CHECK(shares.over_weight(ForceKind::drag) ==
        test::approx((6.0 - 20.0 * volume) / k_g).epsilon(1e-6));
  // Beside a wall the difference is taken from the open side alone: the same slope here.
  const std::vector<float> cut = {1, 1, 0.2F, 1};
  in.fluid.open_fraction = cut;
  ForceShares beside;
  beside.sample(rows.view(), {}, in);
  CHECK(beside.over_weight(ForceKind::pressure_gradient) ==
        test::approx(20.0 * volume / k_g).epsilon(1e-6));
}

TEST_CASE("shares shall be means over all samples and survive a checkpoint") {
  Rows rows;
  rows.add({0, 0, 0}, 0.1, 1.0);
  const std::vector<particles::ContactRecord> held = {
      {.row_i = 0, .row_j = -1, .force = {0, 0, k_g}, .branch = {0, 0, -0.05}, .overlap = 1e-4}};
  ForceShares shares;
  shares.sample(rows.view(), held, {.gravity = {0, 0, -k_g}});
  shares.sample(rows.view(), {}, {.gravity = {0, 0, -k_g}});
  Memory memory;
  shares.save(memory);
  ForceShares resumed;
  resumed.load(memory);
  for (const ForceShares* s : {&shares, &resumed}) {
    CHECK(s->samples() == 2);
    CHECK(s->share(ForceKind::gravity) == test::approx(2.0 / 3.0));
    CHECK(s->over_weight(ForceKind::contact_normal) == test::approx(0.5));
  }
}
