// SPDX-License-Identifier: Apache-2.0
#include "io/scenario_leaves.hpp"

#include <doctest/doctest.h>

using dust::io::ScenarioLeaves;

TEST_CASE("what differs between two scenarios shall be told, five settings of it") {
  const ScenarioLeaves before("time: {end: 1}\na: 1\nb: 2\n");
  CHECK(before.differences(ScenarioLeaves("time: {end: 1}\na: 1\nb: 2\n"), {}).empty());
  CHECK(before.differences(ScenarioLeaves("time: {end: 3}\na: 4\nc: 5\n"), {}) ==
        "'time.end: 1' in the checkpoint, 'time.end: 3' now; 'a: 1' in the checkpoint, 'a: 4' now; "
        "'b: 2' in the checkpoint, nothing now; nothing in the checkpoint, 'c: 5' now");
  constexpr std::string_view ignored[] = {"time.end"};
  CHECK(before.differences(ScenarioLeaves("time: {end: 3}\na: 1\nb: 3\n"), ignored) ==
        "'b: 2' in the checkpoint, 'b: 3' now");
  const std::string many = ScenarioLeaves("[1, 1, 1, 1, 1, 1, 1]")
                               .differences(ScenarioLeaves("[2, 2, 2, 2, 2, 2, 2]"), {});
  CHECK(many.ends_with("'[4]: 1' in the checkpoint, '[4]: 2' now; and 2 more"));
  // The order of bodies and laws counts.
  CHECK_FALSE(
      ScenarioLeaves("{a: 1, b: 2}").differences(ScenarioLeaves("{b: 2, a: 1}"), {}).empty());
}
