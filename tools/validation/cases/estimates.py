"""Compares what `engine check` tells with what runs take: grains, memory, disk, processor time, and the time term by
term. A scenario that would take long is cut: time.end is shortened until the estimate fits a minute, and the estimate
is asked for anew; --only takes scenarios by name (`thesis/fixed_*`). With --no-run the finished runs of --runs are
taken, whatever case they are of; rows of scenarios that are not among them stay, with their memory and disk told anew
(time is told to the machine)."""

import datetime
import fnmatch
import json
import os
import pathlib
import re
import subprocess
import tempfile

from runs import ROOT

TITLE = "What a run is told to cost, and what it costs"
# Costs, no figures of what runs compute.
BITS = ()
TAKES_FINISHED_RUNS = True
LONGEST = 60.0     # [s], estimate of one run
WORTH_IT = 3600.0  # [s], of a whole run: longer ones are left out, their length says enough
RECORD = ROOT / "docs" / "validation" / "estimates.md"
SHIPPED = [p for p in sorted((ROOT / "scenarios").rglob("*.yaml"))
           if not re.search(r"^base:", p.read_text(), re.M) and p.parent.name != "materials"]
FACTOR = 1.5
MEGA = 1e6
SMALL = {"memory": 64e6, "disk": 4e6, "time": 2.0}  # below this nobody plans by an estimate


def estimate(engine, scenario, settings):
    """What `engine check` says of the cost, as numbers, and the end of the run [s]."""
    # As on a machine of which nothing is learnt yet.
    with tempfile.TemporaryDirectory(prefix="dust-cache-") as cache:
        out = subprocess.run([engine, "check", scenario, "--json", *settings], text=True, check=True,
                             capture_output=True, env=os.environ | {"XDG_CACHE_HOME": cache}).stdout
    return json.loads(out)


def folder_size(folder):
    return sum(p.stat().st_size for p in folder.rglob("*") if p.is_file())


def measure(engine, scenario, seconds):
    whole = estimate(engine, scenario, [])
    end = whole["end_s"]
    piece = whole
    # The cost of a piece is not proportional to its length while the domain fills.
    while piece["core_s"] > seconds:
        end *= max(0.5, 0.95 * seconds / piece["core_s"])
        end = max(1.0, end // whole["fluid_step_s"]) * whole["fluid_step_s"]
        piece = estimate(engine, scenario, ["--set", f"time.end={end:.9g} s"])
        if end <= whole["fluid_step_s"]:
            break
    with tempfile.TemporaryDirectory(prefix="dust-estimate-") as folder:
        run = pathlib.Path(folder) / "run"
        subprocess.run([engine, "run", scenario, "-o", run, "--quiet", "--threads", "1", "--set",
                        f"time.end={end:.9g} s"], check=True, capture_output=True)
        summary = json.loads((run / "summary.json").read_text())
        disk = folder_size(run)
    return {"end": end, "share": end / whole["end_s"], "grains": (piece["grains"], summary["particles"]["max"]),
            "memory": (piece["memory_bytes"], summary["peak_rss_bytes"]), "disk": (piece["disk_bytes"], disk),
            "time": (piece["core_s"], summary["cpu_s"]), "parts": parts(piece, summary)}


def recorded(engine, folder):
    """A run that was done before, whole or up to where it was stopped."""
    summary = json.loads((folder / "summary.json").read_text())
    end = summary["simulated_s"]
    told = estimate(engine, folder / "scenario.yaml", ["--set", f"time.end={end:.9g} s"])
    whole = estimate(engine, scenario_named(summary["scenario"]), [])
    return {"end": end, "share": end / whole["end_s"], "grains": (told["grains"], summary["particles"]["max"]),
            "memory": (told["memory_bytes"], summary["peak_rss_bytes"]),
            "disk": (told["disk_bytes"], folder_size(folder)), "time": (told["core_s"], summary["cpu_s"]),
            "changes": changes(folder), "parts": parts(told, summary)}


NODES = {"grains": ("synchronise", "neighbour", "contact", "force", "integration"), "fine_grains": ("fine_level",),
         "fluid": ("fluid",), "exchange": ("voidage", "drag", "collect"), "dust": ("dust", "liberation"),
         "output": ("output",)}


def parts(told, summary):
    """Seconds by term: what was told, and what the timers say, shared out over the processor time."""
    timers = {name: s for name, s in summary["timers_s"].items() if name != "dem_cycle"}
    scale = summary["cpu_s"] / sum(timers.values())
    taken = {term: scale * sum(timers.get(n, 0.0) for n in nodes) for term, nodes in NODES.items()}
    taken["rest"] = summary["cpu_s"] - sum(taken.values())
    return {term: (told["core_s_terms"][term]["core_s"], s) for term, s in taken.items()}


def part_text(r):
    term, (told, taken) = max(r["parts"].items(), key=lambda part: part[1][1])
    return f"{term.replace('_', ' ')}: {told:,.3g} / {taken:,.3g} s"


def scenario_named(name):
    return next(p for p in SHIPPED if p.stem == name or re.search(rf"^name: {name}\b", p.read_text(), re.M))


def changes(folder):
    """Soft grains of long runs: their steps are longer."""
    moduli = re.findall(r"young_modulus: ([0-9.e+]+)", (folder / "scenario.yaml").read_text())
    return f", run before, E {float(moduli[0]) / 1e6:g} MPa" if moduli else ", run before"


def is_near(what, pair):
    told, seen = pair
    return max(told, seen) < SMALL[what] or 1 / FACTOR <= told / seen <= FACTOR


def cell(r, what, scale, unit):
    told, seen = r[what]
    mark = "" if what == "grains" or is_near(what, r[what]) else " **!**"
    return f"{told / scale:,.3g} / {seen / scale:,.3g} {unit}{mark}".strip()


def row(scenario, r):
    share = "whole" if r["share"] > 0.999 else f"first {100 * r['share']:.2g} %"
    share += r.get("changes", "")
    return (f"| `{scenario.relative_to(ROOT / 'scenarios')}` | {r['end']:.4g} s, {share} | {cell(r, 'grains', 1, '')} | "
            f"{cell(r, 'memory', MEGA, 'MB')} | {cell(r, 'disk', MEGA, 'MB')} | {cell(r, 'time', 1, 's')} | "
            f"{r['time'][0] / max(r['time'][1], 1e-9):.2f} | {part_text(r)} |")


def recorded_rows():
    old = RECORD.read_text().splitlines() if RECORD.exists() else []
    columns = 8
    return {line.split("`")[1]: line for line in old if line.startswith("| `") and line.count("|") == columns + 1}


def told_anew(engine, scenario, line):
    """A row of the page with the memory and disk that this engine tells of its piece, beside what was taken. Its time
    was told to the machine that took it."""
    cells = [text.strip() for text in line.strip("|").split("|")]
    told = estimate(engine, scenario, ["--set", f"time.end={cells[1].split()[0]} s"])
    for place, what in ((3, "memory"), (4, "disk")):
        taken = float(cells[place].split("/")[1].split()[0]) * MEGA
        cells[place] = cell({what: (told[f"{what}_bytes"], taken)}, what, MEGA, "MB")
    return "| " + " | ".join(cells) + " |"


def record(rows, commit):
    kept = recorded_rows() | rows
    names = [str(p.relative_to(ROOT / "scenarios")) for p in SHIPPED]
    lines = ["# What a run is told to cost, and what it costs", "",
             f"Written by `tools/validation/run estimates`, last on {datetime.date.today()} at commit {commit}: what",
             "`engine check` tells / what the run has taken, on one thread; told as on a machine where nothing has been",
             "learnt yet from runs. Long scenarios are cut; what is told is that of the piece. Time is processor time: a",
             "machine with other work beside it needs up to twice as much of it. *Largest part*: where most of the time",
             "went, and what was told of it. The rates of a machine where nothing has been learnt were fitted to runs of this",
             "list in 2026-11; numbers of grains, steps and cells were not. How it is told:",
             "[0037](../decisions/0037_cost_is_told_by_terms.md).", "",
             "| scenario | run | most grains | memory | disk | processor time | told over taken | largest part |",
             "|---|---|---|---|---|---|---|---|",
             *(kept[n] for n in names if n in kept), "",
             f"Not run for this page (those told to take more than {WORTH_IT / 3600:g} h are left out): " + ", ".join(f"`{n}`" for n in names if n not in kept) + ".", "",
             f"**!** marks what is beyond a factor of {FACTOR:g}; memory below {SMALL['memory'] / 1e6:.0f} MB, disk below "
             f"{SMALL['disk'] / 1e6:.0f} MB and times below {SMALL['time']:.0f} s do not count.", ""]
    RECORD.write_text("\n".join(lines))


def plans():
    return []


def finished_runs(folder):
    for file in sorted(folder.glob("*/summary.json")):
        if json.loads(file.read_text())["status"] == "finished":
            yield file.parent


def write(args):
    engine, rows = args.engine.path(), {}
    if args.no_run:
        names = {str(p.relative_to(ROOT / "scenarios")): p for p in SHIPPED}
        rows = {name: told_anew(engine, names[name], line) for name, line in recorded_rows().items() if name in names}
        done = [(scenario_named(json.loads((f / "summary.json").read_text())["scenario"]), f) for f in finished_runs(args.runs)]
        results = ((scenario, recorded(engine, folder)) for scenario, folder in done)
    else:
        asked = (s for s in SHIPPED if any(fnmatch.fnmatch(str(s.relative_to(ROOT / "scenarios").with_suffix("")), name) for name in args.only))
        short = (scenario for scenario in asked if estimate(engine, scenario, [])["core_s"] <= WORTH_IT)
        results = ((scenario, measure(engine, scenario, LONGEST)) for scenario in short)
    for scenario, result in results:
        rows[str(scenario.relative_to(ROOT / "scenarios"))] = row(scenario, result)
        print(row(scenario, result), flush=True)
        record(rows, args.engine.commit())
    # The index of the scenarios has its times from here.
    subprocess.run([ROOT / "tools" / "dev" / "write_scenarios"], check=True)
