// SPDX-License-Identifier: Apache-2.0
#include "particles/neighbours/list_tuner.hpp"

#include "support/approx.hpp"

#include <doctest/doctest.h>

using dust::particles::ListTuner;
using dust::test::approx;

TEST_CASE("an inner list left early shall make the next one half as long, one that lasted twice") {
  ListTuner tuner;
  const std::int64_t first = tuner.inner_lifetime();
  // Left in its first half.
  tuner.record(ListTuner::InnerStatistics{.was_left = true, .steps = first / 2 - 1, .entries = 10});
  CHECK(tuner.inner_lifetime() == first / 2);
  // Left in its second half: it was right.
  tuner.record(ListTuner::InnerStatistics{.was_left = true, .steps = first / 4, .entries = 10});
  CHECK(tuner.inner_lifetime() == first / 2);
  tuner.record(ListTuner::InnerStatistics{.steps = first / 2, .entries = 10});
  CHECK(tuner.inner_lifetime() == first);
  // Never so short that making it costs more than it saves.
  for (int n = 0; n < 20; ++n) {
    tuner.record(ListTuner::InnerStatistics{.was_left = true, .steps = 1, .entries = 10});
  }
  CHECK(tuner.inner_lifetime() == 8);
}

TEST_CASE("inner lists shall last longest in a bed, where most pairs looked at touch") {
  ListTuner in_bed;
  ListTuner in_flight;
  for (int n = 0; n < 20; ++n) {
    in_bed.record(
        ListTuner::InnerStatistics{.steps = in_bed.inner_lifetime(), .entries = 10, .contacts = 6});
    in_flight.record(ListTuner::InnerStatistics{
        .steps = in_flight.inner_lifetime(), .entries = 10, .contacts = 5});
  }
  CHECK(in_bed.inner_lifetime() == 256);
  CHECK(in_flight.inner_lifetime() == 64);
  // A bed that begins to flow has no longer lists than flow.
  in_bed.record(ListTuner::InnerStatistics{.steps = 256, .entries = 10, .contacts = 1});
  CHECK(in_bed.inner_lifetime() == 64);
}

TEST_CASE("outer lists shall be made for as long as that adds few pairs") {
  const auto after = [](std::int64_t pairs, std::int64_t close, bool is_half_used) {
    ListTuner tuner;
    const std::int64_t first = tuner.begin_outer(1e9);
    tuner.record(ListTuner::OuterStatistics{
        .is_half_used = is_half_used, .pairs = pairs, .close_pairs = close, .particles = 1000});
    return static_cast<double>(tuner.begin_outer(1e9)) / static_cast<double>(first);
  };
  // Of 4,000 close pairs and half of 1,000 particles: below a fortieth, a tenth, up to four tenths,
  // above.
  CHECK(after(4100, 4000, false) == 4.0);
  CHECK(after(4300, 4000, false) == 2.0);
  CHECK(after(5000, 4000, false) == 1.0);
  CHECK(after(6000, 4000, false) == 0.5);
  // Given up in its first half it was too long whatever it listed.
  CHECK(after(4100, 4000, true) == 0.5);
}

TEST_CASE("no particle shall fly more than a diameter within an outer list, but for the shortest") {
  ListTuner tuner;
  CHECK(tuner.begin_outer(20.7) == 20);
  CHECK(tuner.begin_outer(3.0) == 16);
}

TEST_CASE("skins shall be widened after short lists that ended early and narrowed in long ones") {
  ListTuner tuner;
  const double first = tuner.skin_in_diameters();
  const ListTuner::OuterStatistics few{.is_early = true, .pairs = 2000, .particles = 1000};
  const ListTuner::OuterStatistics many{.is_early = true, .pairs = 6001, .particles = 1000};
  tuner.record(few);
  CHECK(tuner.skin_in_diameters() == approx(first + 0.15));
  for (int n = 0; n < 20; ++n) tuner.record(few);
  CHECK(tuner.skin_in_diameters() == approx(0.15 * 8));
  CHECK_FALSE(tuner.may_widen_skins(2000, 1000));
  for (int n = 0; n < 20; ++n) tuner.record(many);
  CHECK(tuner.skin_in_diameters() == approx(0.15));
  CHECK(tuner.may_widen_skins(2999, 1000));
  CHECK_FALSE(tuner.may_widen_skins(3000, 1000));
}

TEST_CASE("a restored tuner shall choose as the one it was taken from") {
  ListTuner tuner;
  tuner.begin_outer(1e9);
  tuner.record(ListTuner::OuterStatistics{.is_early = true, .pairs = 100, .particles = 1000});
  tuner.record(ListTuner::InnerStatistics{.was_left = true, .steps = 1, .entries = 10});
  ListTuner other;
  other.restore(tuner.state());
  CHECK(other.skin_in_diameters() == tuner.skin_in_diameters());
  CHECK(other.inner_lifetime() == tuner.inner_lifetime());
  CHECK(other.begin_outer(1e9) == tuner.begin_outer(1e9));
}
