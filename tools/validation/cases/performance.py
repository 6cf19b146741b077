"""docs/performance.md: how fast the transfer point is, and where its time goes."""

import datetime

from cases import transfer_point, transfer_point_4s
from runs import ROOT, Runs, cpu_name

TITLE = "How fast it is"
# Times, no figures of what runs compute.
BITS = ()
TAKES_FINISHED_RUNS = True
TARGET = ROOT / "docs" / "performance.md"
NEIGHBOURS = ("Beside the peers, in one run each: [grains](performance_grains.md), [air](performance_air.md), "
              "[both](performance_coupled.md). Several time rates beside one: [rates](performance_rates.md). A class of dust "
              "beside the air: [dust](performance_dust.md). Air and grains at the same time: [overlap](performance_overlap.md).")
EXPLAINED = ("DEM rate: million grain-steps per second of the time in the particles' nodes (`timer_groups.particles` of "
             "`summary.json`), dust and its sub-steps included in the time, not in the steps. Processor time far below threads x "
             "wall time: the machine had other work beside the run.")
COLUMNS = ("run", "threads", "simulated [s]", "wall [s]", "processor [s]", "min per simulated s", "most grains", "DEM rate",
           "s per fluid step", "memory [MiB]")


def plans():
    return [*transfer_point.plans(), *transfer_point_4s.plans()]


def row(label, s):
    particles = sum(s["timers_s"][name] for name in s["timer_groups"]["particles"])
    fluid = f"{s['timers_s']['fluid'] / s['fluid_steps']:.3f}" if s["fluid_steps"] else "-"
    return (f"| {label} | {s['threads']} | {s['simulated_s']:.3g} | {s['wall_s']:.0f} | {s['cpu_s']:.0f} | "
            f"{s['wall_s'] / s['simulated_s'] / 60:.1f} | {s['particles']['max']} | {s['particle_steps'] / particles / 1e6:.1f} | "
            f"{fluid} | {s['peak_rss_bytes'] / 2**20:.0f} |")


def timers(done):
    """Seconds per node, the longest first; in italics what is part of `dem_cycle`."""
    most = {}
    for _, s in done:
        for node, seconds in s["timers_s"].items():
            most[node] = max(most.get(node, 0.0), seconds)
    nested = {node for _, s in done for node in s["timer_groups"]["dem_cycle"]}
    for node in sorted((n for n in most if most[n] >= 0.1), key=lambda n: -most[n]):
        yield (f"| {f'*{node}*' if node in nested else node} | " +
               " | ".join(f"{s['timers_s'].get(node, 0.0):.1f}" for _, s in done) + " |")


def write(args):
    runs = Runs(plans(), args.runs, args.engine)
    for run in runs:
        if not args.no_run:
            runs.do(run)
    done = [(run.name, run.summary) for run in runs if run.is_finished() and "timer_groups" in run.summary]
    if not done:
        print("no run has ended: docs/performance.md stays as it is")
        return
    labels = " | ".join(label for label, _ in done)
    out = ["# How fast it is", "",
           f"Written by `tools/validation/run performance` on {datetime.date.today()}: {cpu_name()}, 2 cores of a shared virtual "
           f"machine, Debian 12, g++ 12, Release, commit {args.engine.commit()}.", NEIGHBOURS, "",
           "Command of each run: `tools/run SCENARIO` with the settings named; times are those of its `summary.json`.", "",
           EXPLAINED, "", "| " + " | ".join(COLUMNS) + " |", "| --- |" + " --- |" * (len(COLUMNS) - 1),
           *(row(label, s) for label, s in done), "", "## Where the time goes", "",
           "Seconds per node; those in italics are parts of `dem_cycle`.", "", f"| node | {labels} |",
           "| --- |" + " --- |" * len(done), *timers(done), ""]
    TARGET.write_text("\n".join(out))
    print(f"wrote {TARGET.relative_to(ROOT)}")
