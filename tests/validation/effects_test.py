#!/usr/bin/env python3
"""The rule by which pages judge signs is that of the engine's studies: the cases and texts of tests/unit/study/effects_test.cpp, and
lines as `engine study` prints them."""

import math
import re
import unittest

import package

import effects
import study_runs
from effects import Point

ENGINE_TEST = package.ROOT / "tests/unit/study/effects_test.cpp"
SPEEDS = (1.0, 2.0, 4.0)
SPEED, CASE = 0, 1


def made(replicates, value=None, error=0.5):
    """The study of the engine's test: x = 10 speed + 3 in case b over speeds 1, 2, 4; two replicates lie 0.2 apart."""
    def x(speed, case, seed):
        return 10.0 * speed + 3.0 * case + (0.0 if replicates == 1 else -0.1 if seed == 1 else 0.1)
    return [Point((s, c), seed, (value or x)(speed, c, seed), error)
            for s, speed in enumerate(SPEEDS) for c in range(2) for seed in range(1, replicates + 1)]


def with_speed(points):
    return effects.change_between(points, SPEED, 0, 2)


class Errors(unittest.TestCase):
    def test_student_s_t_is_that_of_tables(self):
        for freedom, quantile in ((1, 12.7062), (2, 4.30265), (3, 3.18245), (4, 2.77645), (5, 2.57058), (10, 2.22814), (30, 2.04227)):
            self.assertAlmostEqual(quantile, effects.clear_limit(freedom), delta=1e-5 * quantile)
        self.assertEqual([2.0, 2.0], [effects.clear_limit(freedom) for freedom in (1000, effects.FREE)])

    def test_without_replicates_the_sensors_tell_the_noise_of_all_points(self):
        change = with_speed(made(1))
        self.assertAlmostEqual(30.0, change.size)
        # The mean of two changes, each of two runs.
        self.assertAlmostEqual(0.5, change.error)
        self.assertEqual(effects.FREE, change.freedom)
        # A point between the ends tells noise, too: the root of the mean square.
        points = [Point(p.levels, p.seed, p.value, 1.3 if p.levels == (1, 0) else 0.5) for p in made(1)]
        self.assertAlmostEqual(math.sqrt((1.3**2 + 5 * 0.25) / 6), with_speed(points).error)

    def test_errors_of_some_points_say_nothing_of_the_others(self):
        points = made(1)
        self.assertIsNone(effects.noise_of([Point((0, 0), 1, 10.0), *points[1:]]))

    def test_replicates_tell_noise_by_their_scatter_pooled(self):
        deviation, freedom = effects.noise_of(made(2))
        self.assertAlmostEqual(0.2 / math.sqrt(2.0), deviation)
        self.assertEqual(6, freedom)

    def test_replicates_with_the_same_seeds_tell_the_error_by_their_changes(self):
        # What a seed adds is the same at both speeds but for 0.3, 0 and -0.3.
        points = made(3, lambda speed, _, seed: 10.0 * speed + 5.0 * seed + (0.3 * (2 - seed) if speed == 4.0 else 0.0))
        change = with_speed(points)
        self.assertAlmostEqual(30.0, change.size)
        self.assertAlmostEqual(0.3 / math.sqrt(3.0), change.error)
        # The cases share what a seed adds: three seeds, however many cases.
        self.assertEqual(2, change.freedom)
        # One seed is missing at an end: what is left is as if independent.
        self.assertGreater(with_speed(points[1:]).error, 2.0)

    def test_seeds_that_differ_are_not_paired(self):
        points = [Point(p.levels, p.seed + (10 if p.levels[SPEED] == 2 else 0), p.value) for p in made(2)]
        self.assertEqual(6, with_speed(points).freedom)
        self.assertAlmostEqual(0.2 / math.sqrt(2.0) * math.sqrt(2.0) / 2.0, with_speed(points).error)

    def test_changes_that_are_equal_tell_no_error_of_0(self):
        self.assertGreater(with_speed(made(2)).error, 0.05)

    def test_without_any_error_the_changes_over_what_else_is_varied_tell_it(self):
        # In case b higher by 2, 3 and 4 at the three speeds.
        points = [Point((s, c), 1, 100.0 * s + (2.0 + s) * c) for s in range(3) for c in range(2)]
        change = effects.change_between(points, CASE, 0, 1)
        self.assertAlmostEqual(3.0, change.size)
        self.assertAlmostEqual(math.sqrt(1.0 / 3.0), change.error)
        self.assertEqual(2, change.freedom)
        self.assertIsNone(with_speed(points).error)
        # Without the third speed in case b two changes are left.
        self.assertIsNone(effects.change_between(points[:-1], CASE, 0, 1).error)

    def test_levels_without_a_combination_in_common_have_no_change(self):
        self.assertIsNone(with_speed([p for p in made(1) if p.levels not in ((0, 1), (2, 0))]))


class Verdicts(unittest.TestCase):
    """Texts that the engine's own test holds it to."""

    def holds(self, text):
        """That the engine's test has this text, so that both change together."""
        literals = "".join(re.findall(r'"((?:[^"\\]|\\.)*)"', ENGINE_TEST.read_text()))
        self.assertIn(text, literals)
        return text.replace("+-", "±")

    def test_few_values_tell_an_effect_by_student_s_t(self):
        # The two seeds rise by 30 -+ 4: 7.5 times their error, of two values.
        points = [Point(p.levels, p.seed, p.value + (0.0 if p.levels[SPEED] < 2 else -4.0 if p.seed == 1 else 4.0)) for p in made(2)]
        change = with_speed(points)
        self.assertEqual(effects.NOISE, change.kind("rises"))
        self.assertEqual(self.holds("not told from noise: 30.0 +- 4.0 mm, of so few values 12.71 times the error tells"),
                         change.text("rises", "mm"))

    def test_what_is_not_steady_is_open_whatever_replicates_say(self):
        points = [Point(p.levels, p.seed, p.value) for p in made(3)]
        self.assertEqual(effects.AS_EXPECTED, with_speed(points).kind("rises"))

        def unsteady(*places):
            return [Point(p.levels, p.seed, p.value, None, n in places) for n, p in enumerate(points)]
        # The middle speed is not compared.
        self.assertEqual(effects.AS_EXPECTED, with_speed(unsteady(6)).kind("rises"))
        change = with_speed(unsteady(0, 1, 6))
        self.assertEqual(effects.OPEN, change.kind("rises"))
        self.assertIsNone(change.error)
        self.assertEqual(self.holds("open: 2 of 12 points not steady: 30 mm"), change.text("rises", "mm"))

    def test_points_that_failed_are_left_out_with_those_they_would_be_compared_with(self):
        points = [Point(p.levels, p.seed, p.value + 300.0 * p.levels[CASE]) for p in made(2)]
        change = with_speed([p for p in points if p.levels != (2, 1)])
        self.assertEqual(4, change.used)
        self.holds("as expected: 30.00 +- 0.14 mm (")
        self.assertEqual("as expected: 30.00 ± 0.14 mm", change.text("rises", "mm"))

    def test_signs_and_noise_decide(self):
        change = with_speed(made(1))
        self.assertEqual((effects.AS_EXPECTED, effects.AGAINST), (change.kind("rises"), change.kind("falls")))
        self.assertEqual("against the expectation: 30.00 ± 0.50 mm", change.text("falls", "mm"))
        self.assertEqual(effects.NOISE, effects.change_between(made(1, error=5.0), CASE, 0, 1).kind("rises"))
        # Sensors that have seen nothing yet say 0.
        nothing = with_speed(made(1, lambda *_: 0.0, error=None))
        self.assertEqual("no change: 0 mm", nothing.text("rises", "mm"))
        # Without any error the sign alone decides, and it is said.
        self.assertEqual("as expected: 30 mm (no error is known)", with_speed(made(1, error=None)).text("rises", "mm"))

    def test_amounts_are_cut_where_their_error_allows(self):
        for args, text in (((60.3345, 0.09865, "mm"), "60.334 +- 0.099 mm"), ((-3.5, 12.4, "1"), "-4 +- 12"), ((628.0, None, "1"), "628"),
                           ((0.123456, 0.0, "m"), "0.1235 m")):
            self.assertEqual(self.holds(text), effects.amount_text(*args))


class Lines(unittest.TestCase):
    """What `engine study` prints of an expectation is read in its parts."""

    def parts(self, line):
        return study_runs.verdict_of(line).groups()

    def test_every_verdict_is_known(self):
        begin = "x rises with belt.speed at case a: "
        for verdict, change in (
                ("as expected", "30.00 +- 0.14 mm (2 of 8 points are missing, 2 left out: nothing finished to compare them with)"),
                ("against the expectation", "-3 mm (no error is known)"), ("no change", "0 mm"),
                ("not told from noise", "30.0 +- 4.0 mm, of so few values 12.71 times the error tells"),
                ("open: 2 of 12 points not steady", "30 mm")):
            self.assertEqual(("x", "rises", "with belt.speed at case a", verdict, change), self.parts(f"{begin}{verdict}: {change}"))
        self.assertEqual(("not enough points finished (2 of 4 points are missing)", None),
                         self.parts(begin + "not enough points finished (2 of 4 points are missing)")[3:])
        self.assertIsNone(study_runs.verdict_of("4 points, 4 finished"))

    def test_numbers_are_rounded_and_a_hash_is_not(self):
        for shown, text in (("0.00043399", "0.00043398912345"), ("finished", "finished"), ("9e32198066326825", "9e32198066326825")):
            self.assertEqual(shown, study_runs.rounded(text))


if __name__ == "__main__":
    unittest.main()
