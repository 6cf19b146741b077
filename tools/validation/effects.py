"""What an input does to an output and whether that is told from noise: the rule of the engine's studies (core/study/effects.cpp,
noise.cpp) for pages that are made of single runs. docs/how_to/run_a_study.md says it in words.

Of a change from one level of an axis to another the error is, of what there is, the first of:
- the scatter of its changes by seed, each the mean over what else is varied, where both levels have the same two seeds or more;
- the noise of single runs: the scatter of the seeds of a point, pooled over all points; without seeds what the sensors tell, the root of
  the mean square over all points, if all of them tell one;
- the scatter of the change over what else is varied, of three or more.
It is told from noise beyond twice that error, or where few values tell the error, beyond the 97.5 % quantile of Student's t. Where a
run's figure is not steady it is open. Scattered inputs (`sample`), whose effect is a fitted line, are the engine's alone."""

import dataclasses
import functools
import math
import statistics

NOT_STEADY = "not steady"
# Values nearer to each other than this, over their size, are the same.
ROUNDING = 1e-12
# Degrees of freedom of an error that allows for its own: those that sensors tell.
FREE = math.inf
CLEAR, PROBABILITY = 2.0, 0.95
AS_EXPECTED, AGAINST, NOISE, NO_CHANGE, OPEN = "as expected", "against the expectation", "not told from noise", "no change", "open"
UNDECIDED = (NOISE, NO_CHANGE, OPEN)


@dataclasses.dataclass(frozen=True)
class Point:
    """What came of one run: `levels` are its places on all axes; runs that differ by the seed alone share them."""

    levels: tuple
    seed: str
    value: float
    error: float = None
    is_unsteady: bool = False


@dataclasses.dataclass(frozen=True)
class Change:
    """Of an output, with its standard error (None: not known), over so many runs."""

    size: float
    error: float = None
    freedom: float = FREE
    used: int = 0
    unsteady: int = 0

    def limit(self):
        """The size beyond which it is told from noise; None where no error is known."""
        return None if self.error is None else clear_limit(self.freedom) * self.error

    def towards(self, then):
        """The same, positive where it goes as expected: "rises" or "falls"."""
        return self if then == "rises" else dataclasses.replace(self, size=-self.size)

    def kind(self, then="rises"):
        """What it says about the sign that was expected. Without an error the sign alone does."""
        if self.unsteady:
            return OPEN
        if self.size == 0.0:
            return NO_CHANGE
        if self.error is not None and abs(self.size) <= self.limit():
            return NOISE
        return AS_EXPECTED if self.towards(then).size > 0.0 else AGAINST

    def unsteady_text(self):
        return f"{self.unsteady} of {self.used} points not steady"

    def text(self, then, unit=""):
        """The verdict as the engine says it."""
        kind, amount = self.kind(then), amount_text(self.size, self.error, unit)
        few = clear_limit(self.freedom)
        more = {OPEN: "", NO_CHANGE: "", NOISE: f", of so few values {few:.4g} times the error tells" if few > CLEAR else ""}
        begin = f"{kind}: {self.unsteady_text()}" if kind == OPEN else kind
        return f"{begin}: {amount}" + more.get(kind, " (no error is known)" if self.error is None else "")


def amount_text(value, error, unit):
    """Two digits of the error, and the value cut at the same place."""
    if error and math.isfinite(error):
        decimals = max(0, 1 - math.floor(math.log10(error)))
        text = f"{value:.{decimals}f} ± {error:.{decimals}f}"
    else:
        text = f"{value:.4g}"
    return text if unit in ("", "1") else f"{text} {unit}"


def clear_limit(freedom):
    """How many standard errors tell a change from noise, by the degrees of freedom of the error."""
    return CLEAR if math.isinf(freedom) else max(CLEAR, student(int(freedom)))


@functools.lru_cache(maxsize=None)
def student(freedom):
    """The 97.5 % quantile of Student's t of whole degrees of freedom: between plus and minus it lie 95 %."""
    low, high = 0.0, math.pi / 2
    while low < (middle := 0.5 * (low + high)) < high:
        low, high = (middle, high) if inside(middle, freedom) < PROBABILITY else (low, middle)
    return math.sqrt(freedom) * math.tan(low)


def inside(angle, freedom):
    """Probability that |t| is below sqrt(freedom) tan(angle), a finite sum (Abramowitz and Stegun 26.7.3 and 26.7.4)."""
    is_odd, cosine = freedom % 2, math.cos(angle)
    term, total = (cosine if is_odd else 1.0), 0.0
    for n in range(2 + is_odd, freedom + 1, 2):
        total += term
        term *= cosine * cosine * (n - 1) / n
    total *= math.sin(angle)
    return 2.0 / math.pi * (angle + total) if is_odd else total


def noise_of(points):
    """(standard deviation of a single run, its degrees of freedom); None where nothing tells it. What some sensors tell says nothing
    of the others."""
    groups = {}
    for point in points:
        groups.setdefault(point.levels, []).append(point.value)
    freedom = sum(len(values) - 1 for values in groups.values())
    if freedom > 0:
        return math.sqrt(sum(scatter_of(values) for values in groups.values()) / freedom), freedom
    errors = [point.error for point in points]
    if not errors or None in errors:
        return None
    return math.sqrt(sum(e * e for e in errors) / len(errors)), FREE


def scatter_of(values):
    mean = statistics.fmean(values)
    return sum((value - mean) ** 2 for value in values)


def error_of_mean(values):
    return math.sqrt(scatter_of(values) / (len(values) * (len(values) - 1)))


def by_others(points, axis, level):
    """The points at a level of an axis, by their levels of the other ones."""
    found = {}
    for point in points:
        if point.levels[axis] == level:
            found.setdefault(point.levels[:axis] + point.levels[axis + 1:], []).append(point)
    return found


def changes_by_seed(pairs):
    """The change of every seed, as the mean over the combinations of the other inputs; none unless both levels have the same two
    seeds or more at each of them."""
    changes, seeds = {}, None
    for before, after in pairs:
        sides = [{point.seed: point.value for point in side} for side in (before, after)]
        seeds = seeds or set(sides[0])
        if any(set(side) != seeds for side in sides) or not len(seeds) == len(before) == len(after) > 1:
            return []
        for seed in sides[0]:
            changes.setdefault(seed, []).append(sides[1][seed] - sides[0][seed])
    return [statistics.fmean(values) for values in changes.values()]


def are_equal(values):
    """Whether they are the same but for rounding. Counts are, by chance: that tells no error of 0."""
    return max(values) - min(values) <= ROUNDING * max(abs(min(values)), abs(max(values)))


def change_between(points, axis, first, last):
    """From one level of an axis to another, over the combinations of the other inputs that both have; None without any. `points` are
    all that are looked at, those at other levels too: they tell the noise."""
    before, after = (by_others(points, axis, level) for level in (first, last))
    pairs = [(before[others], after[others]) for others in before if others in after]
    if not pairs:
        return None
    changes = [statistics.fmean(p.value for p in b) - statistics.fmean(p.value for p in a) for a, b in pairs]
    used = [point for pair in pairs for side in pair for point in side]
    unsteady = sum(point.is_unsteady for point in used)
    variance = sum(1.0 / len(side) for pair in pairs for side in pair)
    error, freedom = (None, FREE) if unsteady else error_of_change(changes_by_seed(pairs), noise_of(points), variance, changes)
    return Change(statistics.fmean(changes), error, freedom, len(used), unsteady)


def error_of_change(by_seed, noise, variance, changes):
    """(standard error, its degrees of freedom); `variance` in those of a single run."""
    if by_seed and not are_equal(by_seed):
        return error_of_mean(by_seed), len(by_seed) - 1
    if noise:
        return noise[0] * math.sqrt(variance) / len(changes), noise[1]
    if len(changes) > 2:
        return error_of_mean(changes), len(changes) - 1
    return None, FREE
