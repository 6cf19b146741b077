"""Runs of scenarios: what shall be run, how, and what a run has left."""

import atexit
import contextlib
import csv
import dataclasses
import datetime
import fcntl
import itertools
import json
import pathlib
import re
import shlex
import subprocess
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.append(str(ROOT / "tools/dev"))

from commands import same_of  # noqa: E402
from figures import Figures  # noqa: E402
from kept import Kept  # noqa: E402
from machine import cpu_name  # noqa: E402,F401  for the pages too

BITS = "tests/bits/recorded.json"


def git(*command):
    """What git says in the checkout; an empty text where it has nothing to say."""
    done = subprocess.run(["git", *command], cwd=ROOT, capture_output=True, text=True)
    return done.stdout.strip() if done.returncode == 0 else ""


def read_table(name):
    """Rows of a table of docs/validation/data, comments left out."""
    with open(ROOT / "docs/validation/data" / name) as lines:
        return list(csv.DictReader(l for l in lines if not l.startswith("#")))


@dataclasses.dataclass(frozen=True)
class Plan:
    """What shall be run: a scenario, relative to scenarios/, and what is set on top of it. `$RUNS` in a setting is the folder of the
    runs: a run may begin with what another has left."""

    name: str
    scenario: str
    settings: dict = dataclasses.field(default_factory=dict)

    def options(self, runs="$RUNS"):
        return [part for key, value in self.settings.items() for part in ("--set", f"{key}={value}".replace("$RUNS", str(runs)))]

    def begins_with(self):
        """Names of the runs that it begins with."""
        return re.findall(r"\$RUNS/([^/]+)/", " ".join(self.options()))

    def file(self):
        return ROOT / "scenarios" / self.scenario

    def shown(self):
        """The command as the reader of a page would type it."""
        return shlex.join(["engine", "run", f"scenarios/{self.scenario}", *self.options()])

    def same(self):
        """What plans of different names have in common that are one run: scenario and settings, in whatever order."""
        return same_of(self.shown())


def one_of_each(runs, plan_of):
    """The first of those that are one run under several names."""
    first = {}
    for run in runs:
        first.setdefault(plan_of(run).same(), run)
    return list(first.values())


# Settings that leave a run's cost about as it is; a speed does not: on a slow belt the grains lie many times as long and thick.
CHEAP = ("seed", "interactions", "bodies", "frames", "sensors", "drag", "voidage", "coupling.correct", "domain.boundaries", "fluid_forces",
         "fluid.initial_velocity", "emitters.feed.velocity", "emitters.feed.min", "emitters.feed.max", "materials.sand.density")


class Engine:
    """The program that runs, and of which commit and bits it is."""

    def __init__(self, file, threads=1, commit=None):
        self._file, self._threads = pathlib.Path(file), threads
        self._commit = commit or self._commit_told() or self._commit_beside() or commit_of_checkout(self._file)
        self._told, self._runs = {}, None

    def _commit_told(self):
        """What `engine --version` says of it, where it does."""
        if not self._file.exists():
            return None
        done = subprocess.run([self._file, "--version"], capture_output=True, text=True)
        return commit_in(done.stdout)

    def _commit_beside(self):
        """An engine that was copied says in a file `commit` beside its bin of which commit it is."""
        beside = self._file.parent.parent / "commit"
        return beside.read_text().strip() if beside.exists() else None

    def commit(self):
        return self._commit

    def path(self):
        return str(self._file)

    def exists(self):
        return self._file.exists()

    def bits(self):
        """State at the end of each case of tools/dev/check_bits, as recorded at the engine's commit."""
        return bits_at(self._commit)

    def command(self, plan, folder):
        resume = ["--resume"] if (folder / "checkpoint.h5").exists() else []
        return [self.path(), "run", str(plan.file()), "-o", str(folder), "--threads", str(self._threads),
                "--quiet", *plan.options(folder.resolve().parent), *resume]

    def hours(self, plan):
        """Hours of one core that `engine check` expects; None if it refuses the scenario."""
        # A check of a large grid takes seconds: runs that differ by what hardly changes the cost are asked for once.
        counts = {k: v for k, v in plan.settings.items() if not k.startswith(CHEAP) or k.endswith(".speed")}
        like = Plan(plan.name, plan.scenario, counts)
        if self._told.get(like.shown()) is None:
            self._told[like.shown()] = self._ask_hours(plan)
        return self._told[like.shown()]

    def remember(self, file):
        """Keeps what was asked in a file: a check of a large grid takes a second."""
        self._told, self._runs = self._kept_in(file), file.resolve().parent
        atexit.register(self._keep_in, file)

    def _kept_in(self, file):
        kept = json.loads(file.read_text()) if file.exists() else {"commit": ""}
        return kept["hours"] if kept["commit"] == self._commit else {}

    def _keep_in(self, file):
        """With what other processes have asked meanwhile."""
        if file.parent.is_dir():
            told = {**self._kept_in(file), **self._told}
            file.with_suffix(".part").write_text(json.dumps({"commit": self._commit, "hours": told}, indent=1))
            file.with_suffix(".part").replace(file)

    def _ask_hours(self, plan):
        done = subprocess.run([self.path(), "check", str(plan.file()), "--json", *plan.options(self._runs)],
                              capture_output=True, text=True)
        return json.loads(done.stdout)["core_s"] / 3600 if done.returncode == 0 else None


def commit_in(version):
    """The commit in the text of `engine --version`; with "+changes" where the build had any."""
    for line in version.splitlines():
        if line.startswith("commit: ") and line != "commit: unknown":
            commit, *changed = line.removeprefix("commit: ").split(", ")
            return commit + ("+changes" if changed else "")
    return None


SOURCES = ("core", "plugins", "tools/engine")


def commit_of_checkout(engine):
    """Short name of the commit; with "+changes" where the sources differ from it, "+older" where the engine was built
    before their last commit."""
    commit = git("log", "-1", "--format=%h")
    if not commit:
        return "unknown"
    if git("status", "--porcelain", "--untracked-files=no", *SOURCES):
        return f"{commit}+changes"
    last = git("log", "-1", "--format=%ct", "--", *SOURCES)
    return f"{commit}+older" if engine.exists() and last and engine.stat().st_mtime < int(last) else commit


def bits_at(commit):
    """The record of bits at a commit; empty where the engine is not just that of a commit, so that nothing is claimed."""
    text = git("show", f"{commit}:{BITS}") if "+" not in commit else ""
    return {case: digests["state"] for case, digests in json.loads(text or "{}").items()}


class Run:
    """One run of a plan and what it left in its folder."""

    def __init__(self, plan, folder, kept=None, figures=None):
        self.plan, self.folder = plan, pathlib.Path(folder)
        self._kept, self._figures = kept or Kept(), figures or Figures()

    @property
    def name(self):
        return self.plan.name

    @property
    def summary(self):
        file = self.folder / "summary.json"
        return json.loads(file.read_text()) if file.exists() else None

    def is_finished(self):
        return self.summary is not None and self.summary["status"] == "finished" and not self.is_another()

    def is_begun(self):
        return (self.folder / "checkpoint.h5").exists() and not self.is_another()

    def is_another(self):
        """Whether the folder holds what a plan of this name ran that was another one then."""
        command = self.note().get("command")
        return bool(self.plan and command) and same_of(command) != self.plan.same()

    def figure(self, sensor, name):
        """(value, uncertainty or None) of a finished run, or of one that the page has kept, else None."""
        def find():
            found = self.summary["sensors"].get(sensor, {}).get(name)
            return None if not found or found["value"] is None else (found["value"], found["uncertainty"])
        return self.read_off(sensor, name, find, self._no_error_told(sensor, name))

    def no_error(self, sensor, name):
        """Why a figure has no uncertainty, as a finished run or one that the page has kept says: "few grains", "not steady"; else ""."""
        if not self.is_finished():
            return self._figures.no_error(self.name, sensor, name) if self._kept.is_of(self) else ""
        return self._no_error_told(sensor, name)

    def _no_error_told(self, sensor, name):
        return ((self.summary or {}).get("sensors", {}).get(sensor, {}).get(name) or {}).get("no_error", "")

    def read_off(self, source, name, find, no_error=""):
        """What `find` finds in the files of a finished run, (value, uncertainty or None); of one that the page has kept, what it found
        then. None if there is nothing."""
        if not self.is_finished():
            return self._figures.of(self.name, source, name) if self._kept.is_of(self) else None
        found = find()
        if found:
            self._figures.note(self.name, source, name, found, no_error)
        return found

    def series(self):
        """Rows of series.csv as numbers, of a finished run; else none."""
        if not self.is_finished():
            return []
        with open(self.folder / "series.csv") as lines:
            return [{k: float(v or "nan") for k, v in row.items()} for row in csv.DictReader(lines)]

    def curve(self, column, scale=1.0, since=0.0):
        """(times [s], values) of a column of series.csv."""
        rows = [r for r in self.series() if r["time [s]"] >= since]
        return [r["time [s]"] for r in rows], [scale * r[column] for r in rows]

    def stiffness(self):
        """Young's moduli as run, from the resolved scenario."""
        text, inside = [], False
        for line in (self.folder / "scenario.yaml").read_text().splitlines():
            if not line.startswith(" "):
                inside = line.startswith("materials:")
            elif inside and "young_modulus:" in line:
                name = line.split(":")[0].strip()
                value = float(line.split("young_modulus:")[1].split(",")[0].strip(" }"))
                text.append(f"{name} {value / 1e6:g} MPa")
        return ", ".join(text)

    def note(self):
        """Who ran it: {commits, bits, date, machine}; empty for a run of another tool."""
        file = self.folder / "validation.json"
        return json.loads(file.read_text()) if file.exists() else {}

    def start(self, engine):
        """Starts it, or goes on from its checkpoint; returns the process, or None if it runs already. What another command has
        left under its name is put aside."""
        if self.is_another():
            with self._locked() as lock:
                if lock is None:
                    return None
                self.folder.rename(next(aside for n in itertools.count(1)
                                        if not (aside := self.folder.with_name(f"{self.folder.name}.before_{n}")).exists()))
        self.folder.mkdir(parents=True, exist_ok=True)
        with self._locked() as lock:
            if lock is None:
                return None
            self._write_note(engine)
            # What an earlier start that ended before its first checkpoint left is no obstacle.
            force = [] if self.is_begun() else ["--force"]
            # The engine inherits the lock and holds it until it ends.
            return subprocess.Popen([*engine.command(self.plan, self.folder), *force], pass_fds=[lock.fileno()],
                                    stdin=subprocess.DEVNULL)

    @contextlib.contextmanager
    def _locked(self):
        """The lock of its folder, or None where a run that goes on there holds it."""
        with open(self.folder / "lock", "w") as lock:
            try:
                fcntl.flock(lock, fcntl.LOCK_EX | fcntl.LOCK_NB)
            except BlockingIOError:
                lock = None
            yield lock

    def is_running(self):
        """Whether a run goes on in its folder, whoever began it."""
        if not (self.folder / "lock").exists():
            return False
        with self._locked() as lock:
            return lock is None

    def _write_note(self, engine):
        before = self.note() if self.is_begun() else {}
        bits = [b for b in before.get("bits", []) if b != engine.bits()]
        note = {"command": self.plan.shown(), "commits": sorted({*before.get("commits", []), engine.commit()}),
                "bits": [*bits, engine.bits()], "date": datetime.date.today().isoformat(), "machine": cpu_name()}
        (self.folder / "validation.json").write_text(json.dumps(note, indent=1) + "\n")


def finished_in(folder):
    """Folders of finished runs by what they ran: a run is made once, whatever cases call it."""
    runs = (Run(None, file.parent) for file in sorted(pathlib.Path(folder).glob("*/validation.json")))
    return {same_of(run.note().get("command", "")): run.folder for run in runs if run.is_finished()}


class Runs:
    """The runs of a case in one folder, begun or not."""

    def __init__(self, plans, folder, engine, kept=None, figures=None):
        self.folder, self.engine, self.kept = pathlib.Path(folder), engine, kept or Kept()
        figures = figures or Figures()
        self._runs = {plan.name: Run(plan, self.folder / plan.name, self.kept, figures) for plan in plans}
        finished = finished_in(self.folder)
        for run in self._runs.values():
            if not run.is_finished():
                run.folder = finished.get(run.plan.same(), run.folder)
            if run.is_finished():
                figures.forget(run.name)

    def __getitem__(self, name):
        return self._runs[name]

    def __iter__(self):
        return iter(self._runs.values())

    def is_done(self, run):
        """Finished, or on the page from before."""
        return run.is_finished() or self.kept.is_of(run)

    def do(self, run):
        """Brings a run to its end, unless it is there."""
        if run.is_finished():
            return
        print(run.plan.shown(), flush=True)
        process = run.start(self.engine)
        if process is None or process.wait() != 0:
            print(f"{run.name}: " + ("runs already" if process is None else "not finished"), flush=True)
