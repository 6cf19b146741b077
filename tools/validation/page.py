"""A page of docs/validation: figures beside published ones, charts, what failed, what has not been run."""

import datetime
import itertools
import re

import chart
import effects
from kept import Kept
from runs import ROOT, bits_at, cpu_name

FOLDER = ROOT / "docs" / "validation"
HEAD = ["| figure | ours | published | pass band | verdict |", "| --- | --- | --- | --- | --- |"]
NOT_RUN = "not run to its end"


def as_text(value):
    return f"{value:.0f}" if abs(value) >= 1e4 else f"{value:.4g}"


def shown(file, title, text):
    """Lines of a picture."""
    return [f"![{title}](pictures/{file})", "", text, ""]


def with_error(ours, unit=""):
    """A figure as text: a number or (number, uncertainty or None)."""
    value, error = ours if isinstance(ours, tuple) else (ours, None)
    return as_text(value) + (f" ± {error:.2g}" if error else "") + (f" {unit}" if unit else "")


def is_undecided(verdict):
    """Whether a figure is there and says nothing of what was expected of it."""
    return verdict.split(":")[0] in effects.UNDECIDED and verdict != "open"


def figure_in(text):
    """(value, uncertainty or None) of a figure as text; None where it is none."""
    found = re.match(r"([-+]?[\d.]+(?:e[-+]?\d+)?)(?: ± ([\d.]+(?:e[-+]?\d+)?))?(?: |$)", text)
    return found and (float(found.group(1)), float(found.group(2)) if found.group(2) else None)


class Page:
    def __init__(self, name, kept=None):
        self.name, self._kept = name, kept or Kept()
        self._rows, self._notes, self._charts, self._body, self._taken = [], [], [], [], set()

    def add(self, what, ours, published, low=None, high=None, unit="", band=None, why=None, verdict=None, keep=True):
        """A figure; one without a band says why it has none. `verdict`: what another rule than a band of numbers says of it. `keep`: whether the page's row of before stands for one that is not
        there, as it does if its runs are the same. Returns what the row tells, (value, uncertainty or None), for a chart of it."""
        is_judged = low is not None or high is not None or verdict is not None
        if not is_judged and not why:
            raise ValueError(f"{what}: neither a band nor why there is none")
        if band is None and is_judged:
            band = (f"{low:g} to {high:g}" if low is not None and high is not None
                    else f"above {low:g}" if high is None else f"below {high:g}")
        before = self._kept.row(what) if ours is None and keep else None
        if before:
            self._rows.append(tuple(before))
            return figure_in(before[1])
        if ours is None:
            shown, verdict = NOT_RUN, "open"
        else:
            value = ours[0] if isinstance(ours, tuple) else ours
            shown, verdict = with_error(ours, unit), verdict or "-"
            if low is not None or high is not None:
                inside = (low is None or value >= low) and (high is None or value <= high)
                verdict = "pass" if inside else "FAIL"
        self._rows.append((what, shown, published, band or f"none: {why}", verdict))
        return figure_in(shown)

    def note(self, text):
        self._notes.append(text)

    def chart(self, title, across, up, curves, text, in_body=False):
        """Ours beside the published curve: curves as chart.draw takes them; `text` says what is seen. Pictures stand below the tables, or
        where the body has got to."""
        ours = [c for c in curves if c.is_ours]
        is_whole = bool(ours) and all(c.x for c in ours)
        curves = [c for c in curves if c.x]
        before = self._kept.picture(title)
        # A picture of curves some or all of which are gone stays.
        is_kept = before is not None and not is_whole
        if is_kept or any(c.is_ours for c in curves):
            file = before or self._free_picture()
            self._taken.add(file)
            if in_body:
                self._body += shown(file, title, text)
            else:
                self._charts.append((file, title, text))
            if not is_kept:
                chart.draw(FOLDER / "pictures" / file, title, across, up, curves)

    def _free_picture(self):
        taken = self._taken | self._kept.pictures()
        return next(file for n in itertools.count(1) if (file := f"{self.name}_{n}.svg") not in taken)

    def body(self, lines):
        """Lines of a page that is not a table of figures."""
        self._body += lines

    def _left(self, verdict):
        return [f"- {what}" + (f": {shown} (band {band})" if verdict == "FAIL" else "")
                for what, shown, _, band, seen in self._rows if seen == verdict]

    def text(self, title, runs, how):
        """The page. `how`: the command that writes it."""
        out = [f"# {title}", "",
               f"Written by `{how}` on {datetime.date.today()}, {cpu_name()}. {self._origin(runs)}", ""]
        if self._rows:
            out += HEAD + ["| " + " | ".join(row) + " |" for row in self._rows] + [""]
        out += self._body
        for picture in self._charts:
            out += shown(*picture)
        out += [note + "\n" for note in self._notes]
        if self._rows and runs.kept.changed:
            out += [f"Made otherwise today and not yet anew: {', '.join(runs.kept.changed)}. Their rows are from before.", ""]
        if self._rows:
            undecided = [f"- {what}: {shown}: {seen}" for what, shown, *_, seen in self._rows if is_undecided(seen)]
            out += ["## What failed", "", *(self._left("FAIL") or ["Nothing."]), "",
                    *(["## What is undecided", "", *undecided, ""] if undecided else []),
                    "## What has not been run", "", *(self._not_run(runs) or ["Nothing."]), ""]
        return "\n".join(out + runs_section(runs)) + "\n"

    def _not_run(self, runs):
        missing = [f"- `{run.plan.shown()}`" + hours_text(runs, run) for run in runs if not runs.is_done(run)]
        return missing or self._left("open")

    def _origin(self, runs):
        finished = [run for run in runs if run.is_finished()]
        commits = sorted({c for run in finished for c in run.note().get("commits", ["not noted"])} | runs.kept.commits())
        if not commits:
            return ""
        dates = sorted({run.note().get("date", "?") for run in finished} | runs.kept.dates())
        return f"Runs of commit {', '.join(commits)}, " + " to ".join(sorted({dates[0], dates[-1]})) + "."

    def write(self, title, runs, how):
        file = FOLDER / f"{self.name}.md"
        file.write_text(self.text(title, runs, how))
        print(f"wrote {file.relative_to(ROOT)}")


def hours_text(runs, run):
    hours = runs.engine.hours(run.plan) if runs.engine else None
    begun = run.summary["simulated_s"] if run.summary else None
    return (f": {hours:.2g} hours of one core, as `engine check` expects" if hours is not None else "") + (
        f"; stopped at {begun:.3g} s" if begun else "")


RUN_COLUMNS = ("run", "commit", "grains", "simulated [s]", "DEM step [s]", "stiffness", "fluid steps", "grain-steps",
               "CPU [s]", "state")


def runs_section(runs):
    """The runs of a page, with what they cost, and their commands."""
    kept, runs = runs.kept, [run for run in runs if run.is_finished()]
    before = kept.run_rows(RUN_COLUMNS, {run.name for run in runs})
    if not runs and not before:
        return ["<!-- bits none -->"]
    out = ["## Runs", "", f"| {' | '.join(RUN_COLUMNS)} |", "|" + " --- |" * len(RUN_COLUMNS)]
    for run in runs:
        s = run.summary
        out.append(f"| {run.name} | {', '.join(run.note().get('commits', ['?']))} | {s['particles']['max']} | "
                   f"{s['simulated_s']:.3g} | {s['dem_step_s']:.3g} | {run.stiffness()} | {s['fluid_steps']} | "
                   f"{s['particle_steps']:.3g} | {s['cpu_s']:.0f} | `{s['state_sha256'][:12]}` |")
    commands = dict.fromkeys([*(kept.commands() if before else []), *(run.plan.shown() for run in runs)])
    out += [f"| {' | '.join(row)} |" for row in before]
    return out + ["", "```", *commands, "```", "", *dict.fromkeys([*kept_bits(kept), *bits_lines(runs)])]


def bits_line(bits):
    """What `tools/validation/run --stale` reads: the record of bits that an engine had."""
    return f"<!-- bits {' '.join(f'{case}={state}' for case, state in sorted(bits.items())) or 'unknown'} -->"


def kept_bits(kept):
    """The records of kept runs: of their commits, or where the history does not tell one of them, all that the page had."""
    records = [bits_at(commit) for commit in sorted(kept.commits())]
    return [bits_line(bits) for bits in records] if all(records) else kept.bits()


def bits_lines(runs):
    return sorted({bits_line(bits) for run in runs for bits in run.note().get("bits") or [{}]})
