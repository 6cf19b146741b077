"""A row of docs/validation/thesis.md and its verdict."""

import dataclasses
import math

import effects

BETTER, AS_GOOD, WORSE, NOT_RUN, NO_TRUTH = "better", "as good", "worse", "not run", "no measurement"
# Of a sign: its figures are there and do not tell it.
NOT_STEADY = "open: not steady"
UNDECIDED = (effects.NOISE, effects.NO_CHANGE, NOT_STEADY)


@dataclasses.dataclass
class Row:
    """A number of the thesis. `runs`: names of the runs that ours comes from; `limit`: largest relative error that the thesis
    allows itself; `why`: why there is no limit; `differs`: parameters of ours that are not the thesis's."""

    where: str
    what: str
    runs: tuple
    ours: tuple = None           # (value, standard error or None)
    measured: float = None
    uncertainty: float = 0.0
    thesis: float = None
    limit: float = None
    why: str = "the thesis names no limit for it"
    differs: str = "none"
    note: str = ""

    def verdict(self):
        """As good: |ours - measured| <= |thesis - measured| + uncertainty of the measurement."""
        if self.ours is None:
            return NOT_RUN
        if self.measured is None:
            return NO_TRUTH
        ours, uncertainty = abs(self.ours[0] - self.measured), self.uncertainty
        if self.thesis is None:
            return AS_GOOD if ours <= uncertainty else WORSE if self.limit is None or not self.is_inside() else AS_GOOD
        theirs = abs(self.thesis - self.measured)
        return BETTER if ours < theirs else AS_GOOD if ours <= theirs + uncertainty else WORSE

    def is_inside(self):
        return abs(self.ours[0] - self.measured) <= self.limit * abs(self.measured)

    def band(self):
        if self.limit is None:
            return f"none: {self.why}"
        verdict = "" if self.ours is None or self.measured is None else ", pass" if self.is_inside() else ", **FAIL**"
        return f"{100 * self.limit:g} %{verdict}"

    def cells(self, cost):
        return [self.where, self.what, with_uncertainty(self.measured, self.uncertainty), error_of(self.thesis, self.measured),
                error_of(self.ours and self.ours[0], self.measured, self.ours and self.ours[1]), self.verdict(), self.band(),
                self.differs, ", ".join(self.runs), cost]


@dataclasses.dataclass
class Sign:
    """A sign that the thesis shows: ours is the effects.Change, positive where the sign is the thesis's."""

    where: str
    what: str
    runs: tuple
    ours: effects.Change = None
    shown: str = ""
    differs: str = "none"

    def verdict(self):
        if self.ours is None:
            return NOT_RUN
        kind = self.ours.kind()
        return {effects.AS_EXPECTED: AS_GOOD, effects.AGAINST: WORSE, effects.OPEN: NOT_STEADY}.get(kind, kind)

    def band(self):
        if self.ours is None:
            return "sign, told from noise"
        if self.ours.unsteady:
            return f"sign; {self.ours.unsteady_text()}"
        return "sign; no error is known" if self.ours.error is None else f"sign, beyond {effects.clear_limit(self.ours.freedom):.3g} errors"

    def cells(self, cost):
        change = "-"
        if self.ours:
            change = f"{self.ours.size:+.3g}" + (f" ± {self.ours.error:.2g}" if self.ours.error else "")
        return [self.where, self.what, "-", self.shown, change, self.verdict(),
                self.band(), self.differs, ", ".join(self.runs), cost]


def difference(one, other):
    """The effects.Change from one (value, standard error or None) to another: errors add in squares, and where one is not known
    neither is that of the change."""
    errors = one[1], other[1]
    return effects.Change(other[0] - one[0], None if None in errors else math.hypot(*errors))


def with_uncertainty(value, uncertainty):
    return "-" if value is None else f"{value:g}" + (f" ± {uncertainty:g}" if uncertainty else "")


def error_of(value, measured, error=None):
    """A value with its error against the measured one."""
    if value is None:
        return "-"
    text = f"{value:.4g}" + (f" ± {error:.2g}" if error else "")
    return text + (f" ({100 * (value - measured) / measured:+.1f} %)" if measured else "")
