"""Every number and sign of chapters 3 to 6 of the thesis beside ours."""

import operator
import re

from chart import Curve, published
from kept import Kept
from page import FOLDER
from runs import one_of_each
from thesis import chapter_3, chapter_4, chapter_5, chapter_6, explained
from thesis.row import AS_GOOD, BETTER, NO_TRUTH, NOT_RUN, UNDECIDED, WORSE

import campaign_list
import cases

TITLE = "The thesis: every number beside ours"
BITS = ("transfer_point", "container_walls", "container_periodic", "settling_a1", "fluidised_bed_column", "rare_sizes", "mixer")
SOURCES = ("settling_a1", "air_to_water", "settling_b", "resolved", "rectangular_container", "conical_pile", "hourglass",
           "fluidised_vessel", "fluidised_studies", "belt", "dust", "hourglass_friction")
CHAPTERS = {"3: one sphere settling": chapter_3, "4: hourglass, piles, container": chapter_4, "5: fluidised bed": chapter_5,
            "6: belt conveyor and transfer point": chapter_6}
PLAN = operator.attrgetter("plan")
HEAD = ("where", "what", "measured", "thesis", "ours", "verdict", "band", "parameters that differ", "runs", "hours of one core")


def plans():
    return [plan for case in SOURCES for plan in cases.load(case).plans()]


def cost_of(row, runs):
    """Hours that the runs took, or what `engine check` expects of those that are left."""
    texts = []
    for name in row.runs:
        if name.startswith("..."):
            continue
        run = runs[name]
        if run.is_finished():
            texts.append(f"{run.summary['cpu_s'] / 3600:.2g}")
        elif runs.kept.is_of(run):
            texts.append(f"{runs.kept.cpu_s(run) / 3600:.2g}")
        elif runs.engine:
            hours = runs.engine.hours(run.plan)
            texts.append("refused" if hours is None else f"about {hours:.2g} left" + (" each" if len(row.runs) > 1 else ""))
    return " + ".join(dict.fromkeys(texts))


class Before:
    """A row as the page has it, of runs whose folders are gone."""

    runs = ()

    def __init__(self, cells):
        self._cells = cells

    def verdict(self):
        return self._cells[5]

    def cells(self, _):
        return self._cells


def with_those_before(rows, runs):
    """Rows that have not been run, as the page had them where it had a figure of the same runs."""
    def are_the_same(names):
        return all(name.startswith("...") or runs.is_done(runs[name]) for name in names)

    before = [runs.kept.row(row.where, row.what, among=", ".join(row.runs)) if row.verdict() == NOT_RUN and are_the_same(row.runs) else None
              for row in rows]
    return [Before(cells) if cells else row for row, cells in zip(rows, before)]


def fill(page, runs):
    chapters = {title: with_those_before(chapter.rows(runs), runs) for title, chapter in CHAPTERS.items()}
    every = [row for rows in chapters.values() for row in rows]
    page.body([*summary(every), *by_chapter(chapters)])
    draw(page, every)
    for title, rows in chapters.items():
        page.body([f"## Chapter {title}", "", "| " + " | ".join(HEAD) + " |", "| --- |" + " --- |" * (len(HEAD) - 1),
                   *("| " + " | ".join(row.cells(cost_of(row, runs))) + " |" for row in rows), ""])
    page.body(explained.section(every, Kept(FOLDER / "experiments.md")))
    page.body(left(runs))


def draw(page, rows):
    """How far ours and the thesis's model are from what was measured."""
    measured = [row.cells("") for row in rows if row.verdict() in (BETTER, AS_GOOD, WORSE)]
    ours, theirs = ([(n, error) for n, cells in enumerate(measured, 1) if (error := percent_of(cells[place])) is not None] for place in (4, 3))
    page.chart("How far off: ours, and the thesis's model", "row that is judged, in the order of this page", "from the measured value [%]",
               [Curve("ours", *zip(*ours), is_points=True) if ours else Curve("ours", [], []),
                published("the thesis's model", *(zip(*theirs) if theirs else ([], [])))],
               "Rows with a measured number; signs have none.", in_body=True)


def percent_of(cell):
    """The error against the measurement [%] that a cell tells, or None."""
    told = re.search(r"\(([+-][0-9.]+) %\)", cell)
    return float(told.group(1)) if told else None


KINDS = {BETTER: (BETTER,), AS_GOOD: (AS_GOOD,), WORSE: (WORSE,), "undecided": UNDECIDED, NO_TRUTH: (NO_TRUTH,), "left": (NOT_RUN,)}


def counts_of(rows):
    """How many rows came out how, by the names of KINDS."""
    return {kind: sum(row.verdict() in verdicts for row in rows) for kind, verdicts in KINDS.items()}


def by_chapter(chapters):
    """How many rows of each chapter came out how."""
    return ["| chapter | " + " | ".join(KINDS) + " |", "| --- |" + " --- |" * len(KINDS),
            *(f"| {title} | " + " | ".join(map(str, counts_of(rows).values())) + " |"
              for title, rows in chapters.items()), ""]


def summary(rows):
    count = counts_of(rows)
    judged = count[BETTER] + count[AS_GOOD] + count[WORSE]
    share = f"{100 * (count[BETTER] + count[AS_GOOD]) / judged:.0f} % of the {judged} rows that are judged" if judged else "none yet"
    return ["**As good**: |ours - measured| <= |thesis - measured| + uncertainty of the measurement. **Better**: nearer than the "
            "thesis's model. A sign is as good when the change goes the thesis's way and is told from noise: beyond twice its "
            "standard error, or where few seeds tell that, beyond Student's t of so few; where it is not, it is undecided. Bands are the "
            "thesis's own limits: 5.7 % of the angle, 7.7 % of the time, 6.6 % of the pile. Where nothing was measured, nothing is "
            "judged; where the thesis gives no value of its model, as good is within the uncertainty or the band. A1 has no measurement: "
            "it is held against one sphere's analytic velocity, 0.158 m/s by Abraham's coefficient (the thesis prints 0.160), its "
            "uncertainty being what lies between that and Schiller and Naumann's 0.155. Where the thesis prints an error and no "
            "value, its model stands below the measured one by that error. Tables 4.1 and 6.7 are what goes in, the sizes of the sand; Table A.2 is the "
            "loss of the empty vessel, which the pressures of Table A.4 are corrected by: neither has a row.", "",
            f"{len(rows)} rows: " + ", ".join(f"{n} {v}" for v, n in count.items() if n) + f". As good or better: {share}.", ""]


def left(runs):
    """What has not been run, with its scenario and its cost: what the campaign's budget reaches in its order, and what not."""
    missing = {run.name: run for run in one_of_each((run for run in runs if not runs.is_done(run)), PLAN)}
    hours = {name: runs.engine.hours(run.plan) if runs.engine else None for name, run in missing.items()}
    spent = sum(run.summary["cpu_s"] if run.is_finished() else runs.kept.cpu_s(run) for run in one_of_each(filter(runs.is_done, runs), PLAN)) / 3600
    experiments = Kept(FOLDER / "experiments.md").hours({run.name for run in runs})
    within = campaign_list.within_budget(hours, spent + experiments, campaign_list.patterns())
    out = ["## What has not been run", "", f"The runs above took {spent:.3g} hours of one core, the experiments to what is worse {experiments:.3g} "
           f"more, of the campaign's budget of {campaign_list.BUDGET_HOURS:g} (40 of two cores); costs are what `engine check` expects of this machine.", ""]
    for title, names in (("Within the budget, in the campaign's order", within),
                         ("Beyond the budget", sorted(missing.keys() - set(within), key=list(missing).index))):
        total = sum(hours[name] or 0.0 for name in names)
        out += [f"### {title}", "", f"{len(names)} runs, about {total:.0f} hours of one core.", "",
                *(f"- {name}: `{missing[name].plan.shown()}`" + (f", {hours[name]:.2g} h" if hours[name] else "") for name in names), ""]
    return out
