// SPDX-License-Identifier: Apache-2.0
#include "particles/fine_level/fine_level.hpp"

#include "dust/sdk/random.hpp"
#include "dust/sdk/sphere.hpp"
#include "support/approx.hpp"
#include "support/dem_rig.hpp"

#include <doctest/doctest.h>

#include <algorithm>
#include <cmath>
#include <memory>
#include <utility>
#include <vector>

using dust::test::approx;
using namespace dust::particles;
using dust::sdk::Vec3;
using dust::test::DemRig;
using dust::test::MemoryArchive;

namespace {

constexpr double k_density = 2650;
constexpr double k_coarse = 600e-6;
constexpr double k_fine = 30e-6;

std::vector<PairLaws> sand_on_sand(DemRig& rig) {
  const int sand = rig.material(k_density, 50e6, 0.3);
  rig.law(sand, sand, 0.7, 0.4, 0.2);
  rig.diameters = {k_fine, k_coarse};
  rig.setup.time.expected_speed = 1.0;
  return std::move(rig.laws);
}

/// The fine level without the solver: a few particles, all of them in one another's lists, and no
/// contacts but its own.
class FineRig {
 public:
  explicit FineRig(Vec3 gravity = {})
      : laws_(sand_on_sand(rig_), {"sand"}, k_coarse),
        steps_(time_steps(rig_.setup, rig_.bodies, laws_.all(), rig_.diameters, 0.0)),
        gravity_{gravity.x, gravity.y, gravity.z, 0.0} {
    for (int d = 0; d < 3; ++d) images_.half[d] = 1e300;
  }

  /// Coarse particles come first.
  std::int32_t add(double diameter, Vec3 position, Vec3 velocity, Vec3 spin = {}) {
    const std::size_t n = store.size();
    dust::particles::NewGrain grain;
    grain.position = position;
    grain.velocity = velocity;
    grain.rotation = spin;
    grain.diameter = diameter;
    store.append(grain, k_density * dust::sdk::sphere_volume(diameter), 0);
    if (diameter == k_coarse) {
      ++coarse_count_;
    } else {
      active_.push_back(static_cast<std::int32_t>(n));
    }
    return static_cast<std::int32_t>(n);
  }

  void list(std::int32_t fine, std::int32_t partner) {
    a_.push_back(fine);
    b_.push_back(partner);
    is_touching_.push_back(0);
    history_.resize(a_.size() * laws_.history_stride(), 0.0);
    level.clear_force(active_.size());
  }
  void unlist_all() { a_.clear(), b_.clear(), is_touching_.clear(), history_.clear(); }

  FineScene scene() {
    return {.laws = laws_,
            .surfaces = {},
            .steps = steps_,
            .images = images_,
            .gravity = gravity_,
            .particles = store,
            .coarse_count = coarse_count_,
            .active = active_,
            .contacts = {a_.data(), b_.data(), is_touching_.data(), history_.data(),
                         laws_.history_stride(), a_.size()},
            .time = time_,
            .wall_loads = wall_loads_,
            .contact_force = {}};
  }

  /// One coarse step in the order of the solver.
  void step() {
    for (const DeferredImpulse& impulse : level.deferred().all()) impulse.act_on(store);
    for (std::size_t n = 0; n < coarse_count_; ++n) move_alone(n);
    const FineScene s = scene();
    level.form_clusters(s);
    for (const std::int32_t particle : active_) move_alone(static_cast<std::size_t>(particle));
    level.sub_cycle(s);
    time_ += steps_.coarse_step;
  }

  /// Of the velocities that particles end the step with.
  Vec3 momentum() const {
    Vec3 sum;
    for (std::size_t n = 0; n < store.size(); ++n) sum += end_velocity(n) / store.velocity(n)[3];
    return sum;
  }
  Vec3 end_velocity(std::size_t n) const {
    Vec3 v = vector_of(store.half_velocity(n));
    if (const auto* waiting = level.deferred().find(static_cast<std::int32_t>(n))) {
      v += waiting->velocity;
    }
    return v;
  }
  double coarse_step() const { return steps_.coarse_step; }
  /// All but the fine level.
  void take_state(const FineRig& other) {
    store = other.store;
    is_touching_ = other.is_touching_;
    history_ = other.history_;
    time_ = other.time_;
  }

  ParticleStore store;
  FineLevel level;

 private:
  void move_alone(std::size_t n) {
    const double step = steps_.coarse_step;
    const double kick = store.half_velocity(n)[3] + 0.5 * step;
    for (int d = 0; d < 3; ++d) {
      const double change = kick * gravity_[static_cast<std::size_t>(d)];
      store.half_velocity(n)[d] += change;
      store.position(n)[d] += step * store.half_velocity(n)[d];
      store.velocity(n)[d] = store.half_velocity(n)[d] + 0.5 * step / kick * change;
      store.rotation(n)[d] = store.half_rotation(n)[d];
    }
    store.half_velocity(n)[3] = 0.5 * step;
  }

  DemRig rig_;
  PairLawTable laws_;
  TimeSteps steps_;
  dust::contact::Images images_;
  std::vector<double> gravity_;
  std::size_t coarse_count_ = 0;
  std::vector<std::int32_t> active_;
  std::vector<std::int32_t> a_, b_;
  std::vector<std::uint8_t> is_touching_;
  dust::contact::AlignedVector<double> history_;
  WallLoads wall_loads_;
  double time_ = 0.0;
};

}  // namespace

TEST_CASE("the fine level shall keep momentum at each step, with what it defers") {
  FineRig rig;
  const auto sand = rig.add(k_coarse, {0, 0, 0}, {0.2, 0, 0}, {0, 0, 300});
  const double touch = 0.5 * (k_coarse + k_fine);
  const auto first = rig.add(k_fine, {touch + 5e-6, 1e-6, 0}, {-0.4, 0, 0.1});
  const auto second = rig.add(k_fine, {touch + 5e-6, 1e-6, 1.1 * k_fine}, {-0.4, 0.2, 0});
  for (const auto& [a, b] : {std::pair{first, sand}, {second, sand}, {second, first}}) {
    rig.list(a, b);
  }
  const Vec3 before = rig.momentum();
  const double scale = norm(before);
  int deferred = 0;
  for (int n = 0; n < 30; ++n) {
    rig.step();
    deferred += rig.level.deferred().all().empty() ? 0 : 1;
    CAPTURE(n);
    CHECK(norm(rig.momentum() - before) < 1e-14 * scale);
  }
  CHECK(deferred > 1);
  CHECK(rig.level.largest_overlap() > 1e-3);
  CHECK(norm(rig.end_velocity(static_cast<std::size_t>(first)) - Vec3{-0.4, 0, 0.1}) > 0.3);
  CHECK(norm(rig.end_velocity(static_cast<std::size_t>(sand)) - Vec3{0.2, 0, 0}) > 1e-5);
}

TEST_CASE("a deferred impulse shall act once, and not again when its contact is over") {
  FineRig rig;
  const auto sand = rig.add(k_coarse, {0, 0, 0}, {0, 0, 0});
  const auto dust = rig.add(k_fine, {0.5 * (k_coarse + k_fine) - 1e-6, 0, 0}, {-0.4, 0, 0});
  rig.list(dust, sand);
  rig.step();
  const Vec3 end = rig.end_velocity(0);
  // The way of the step is that of a particle which was pushed in the course of it.
  const Vec3 mean = vector_of(rig.store.half_velocity(0));
  CHECK(end.x < mean.x);
  CHECK(mean.x < 0.0);
  CHECK(rig.store.position(0)[0] == approx(mean.x * rig.coarse_step()).epsilon(1e-12));
  REQUIRE(rig.level.deferred().all().size() == 1);

  rig.unlist_all();
  const double x = rig.store.position(0)[0];
  rig.step();
  CHECK(rig.store.half_velocity(0)[0] == end.x);
  CHECK(rig.store.position(0)[0] == x + rig.coarse_step() * end.x);
  CHECK(rig.level.deferred().all().empty());
  rig.step();
  CHECK(rig.store.half_velocity(0)[0] == end.x);
}

TEST_CASE("a cluster that touches nothing shall step like free flight") {
  const Vec3 gravity{1.0, -2.0, -9.81};
  FineRig rig(gravity);
  const Vec3 place[2] = {{0, 0, 0}, {1.02 * k_fine, 0, 0}};
  const Vec3 velocity{0.1, 0.2, 0.3};
  const auto first = rig.add(k_fine, place[0], velocity);
  const auto second = rig.add(k_fine, place[1], velocity);
  rig.list(second, first);
  constexpr int k_steps = 20;
  for (int n = 0; n < k_steps; ++n) rig.step();
  // In reach of each other they take shorter steps, which must not show.
  CHECK(rig.level.sub_steps() >= 4 * k_steps);
  const double t = k_steps * rig.coarse_step();
  for (std::size_t n = 0; n < 2; ++n) {
    const Vec3 x = vector_of(rig.store.position(n));
    const Vec3 v = vector_of(rig.store.velocity(n));
    CHECK(norm(x - (place[n] + t * velocity + (0.5 * t * t) * gravity)) < 1e-15);
    CHECK(norm(v - (velocity + t * gravity)) < 1e-14);
    CHECK(rig.level.force()[4 * n] == 0.0);
  }
}

TEST_CASE("a fine particle in reach of nobody shall be left to its own step") {
  FineRig rig;
  const auto first = rig.add(k_fine, {0, 0, 0}, {0.1, 0, 0});
  const auto second = rig.add(k_fine, {1e-2, 0, 0}, {0.1, 0, 0});
  rig.list(second, first);
  for (int n = 0; n < 5; ++n) rig.step();
  CHECK(rig.level.sub_steps() == 10);
  CHECK(rig.store.half_velocity(0)[3] == 0.5 * rig.coarse_step());
}

TEST_CASE("no two particles that meet within a step shall be predicted to keep apart") {
  const dust::sdk::Random random(5, 1);
  int met = 0;
  int apart = 0;
  for (std::uint64_t n = 0; n < 2000; ++n) {
    const auto draw = [&](std::uint32_t slot) { return 2.0 * random.uniform(n, 0, slot) - 1.0; };
    FineRig rig;
    const double size = n % 2 == 0 ? k_coarse : k_fine;
    const Vec3 speed = 20.0 * Vec3{draw(0), draw(1), draw(2)};
    const auto partner = rig.add(size, {}, -1.0 * speed);
    const Vec3 way{draw(3), draw(4), draw(5)};
    const double distance = 0.5 * (size + k_fine) + 100e-6 * (1.0 + draw(6));
    const auto dust = rig.add(k_fine, (distance / norm(way)) * way, speed);
    rig.list(dust, partner);
    // Coarse particles have made their step when the fine level looks at them.
    if (size == k_coarse) {
      for (int d = 0; d < 3; ++d) {
        rig.store.position(0)[d] -= rig.coarse_step() * speed[d];
      }
    }
    const Vec3 from = (distance / norm(way)) * way;
    const double t =
        std::clamp(-dot(from, 2.0 * speed) / dot(2.0 * speed, 2.0 * speed), 0.0, rig.coarse_step());
    const bool meets = norm(from + (2.0 * t) * speed) < 0.5 * (size + k_fine);
    const bool is_near = predict_contact(rig.scene(), 0, 0.0).is_near;
    met += meets ? 1 : 0;
    apart += is_near ? 0 : 1;
    if (meets) CHECK(is_near);
  }
  CHECK(met > 50);
  CHECK(apart > 500);
}

TEST_CASE(
    "deferred impulses shall be one per particle, found in one tile, and follow a new order") {
  const auto impulse = [](std::int32_t particle, double x) {
    return DeferredImpulse{.particle = particle,
                           .velocity = {x, 0, 0},
                           .angular_velocity = {0, x, 0},
                           .predicted_velocity = {0, 0, x},
                           .predicted_angular_velocity = {2 * x, 0, 0}};
  };
  DeferredImpulses all;
  for (const auto& [particle, x] :
       {std::pair{7, 1.0}, {2, 2.0}, {7, 4.0}, {9, 8.0}, {4, 16.0}, {2, 32.0}}) {
    all.add(impulse(particle, x));
  }
  all.merge();
  REQUIRE(all.all().size() == 4);
  CHECK(all.find(7)->velocity.x == 5.0);
  CHECK(all.find(2)->predicted_angular_velocity.x == 68.0);
  CHECK(all.find(3) == nullptr);
  CHECK(all.find(10) == nullptr);
  std::vector<std::int32_t> seen;
  for (const auto& [begin, end] : {std::pair{0, 3}, {3, 4}, {4, 9}, {9, 12}}) {
    for (const DeferredImpulse& i : all.of(begin, end)) seen.push_back(i.particle);
  }
  CHECK(seen == std::vector<std::int32_t>{2, 4, 7, 9});

  MemoryArchive archive;
  all.save(archive);
  DeferredImpulses copy;
  copy.load(archive);
  // Particle 4 is gone, the others turn round.
  const std::vector<std::int32_t> order{9, 8, 7, 6, -1, 4, 3, 2, 1, 0};
  for (DeferredImpulses* d : {&all, &copy}) {
    d->renumber(order);
    REQUIRE(d->all().size() == 3);
    CHECK(d->all()[0].particle == 0);
    CHECK(d->all()[0].predicted_velocity.z == 8.0);
    CHECK(d->all()[1].particle == 2);
    CHECK(d->all()[2].particle == 7);
    CHECK(d->find(7)->angular_velocity.y == 34.0);
  }
}

TEST_CASE("a fine level that was saved shall go on with the same bits") {
  const auto make = [] {
    auto rig = std::make_unique<FineRig>();
    const auto sand = rig->add(k_coarse, {0, 0, 0}, {0.2, 0, 0}, {0, 0, 300});
    const auto dust = rig->add(k_fine, {0.5 * (k_coarse + k_fine) - 1e-6, 2e-6, 0}, {-0.4, 0, 0.1});
    rig->list(dust, sand);
    return rig;
  };
  const auto first = make();
  first->step();
  MemoryArchive archive;
  first->level.save(archive);
  const auto second = make();
  second->take_state(*first);
  second->level.load(archive, first->level.sub_steps());
  for (FineRig* rig : {first.get(), second.get()}) {
    for (int n = 0; n < 3; ++n) rig->step();
  }
  CHECK(first->store.position_digest() == second->store.position_digest());
  CHECK(first->store.motion_digest() == second->store.motion_digest());
  CHECK(first->level.sub_steps() == second->level.sub_steps());
  CHECK(first->level.largest_overlap() == second->level.largest_overlap());
  CHECK(first->level.force()[0] == second->level.force()[0]);
}
