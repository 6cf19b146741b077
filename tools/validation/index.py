"""docs/validation/README.md: every page there with what it says, and all figures that do not
pass or have not been run."""

import stale
from page import FOLDER, is_undecided

JUDGED = ["figure", "ours", "published", "pass band", "verdict"]


def cells(line):
    return [c.strip() for c in line.strip().strip("|").split(" | ")]


def rows_of(text):
    """Rows of the tables that hold a verdict."""
    rows, inside = [], False
    for line in text.splitlines():
        if not line.startswith("|"):
            inside = False
        elif cells(line) == JUDGED:
            inside = True
        elif inside and not line.startswith("| ---"):
            rows.append(cells(line))
    return rows


def index():
    table, failed, undecided, left = [], [], [], []
    for page in sorted(FOLDER.glob("*.md")):
        if page.name == "README.md":
            continue
        text = page.read_text()
        title = text.splitlines()[0].lstrip("# ")
        rows = rows_of(text)
        count = {v: sum(r[-1] == v for r in rows) for v in ("pass", "FAIL", "open")}
        count["undecided"] = sum(is_undecided(r[-1]) for r in rows)
        judged = " ".join(f"{n} {v}" for v, n in count.items() if n) or "-"
        table.append(f"| [{title}]({page.name}) | {len(rows) or '-'} | {judged} | {age_of(text)} |")
        failed += [f"| [{page.stem}]({page.name}) | {r[0]} | {r[1]} | {r[3]} |" for r in rows if r[-1] == "FAIL"]
        undecided += [f"| [{page.stem}]({page.name}) | {r[0]} | {r[1]} | {r[-1]} |" for r in rows if is_undecided(r[-1])]
        if count["open"]:
            left.append(f"| [{page.stem}]({page.name}#what-has-not-been-run) | {count['open']} |")
    lines = ["# Checks against measurements, other codes and the thesis", "",
             "Written by `tools/validation/run --index` from the pages of this folder, which `tools/validation/run CASE` wrote when "
             "the runs had ended. Each page names its commands; `tools/validation/run --stale` says which are of an engine "
             "whose bits have changed since. Closed forms and invariants are tests (`tests/verification`), not pages.", "",
             "| page | figures beside published ones | with a pass band | engine |", "| --- | --- | --- | --- |", *table, ""]
    lines += ["## What does not pass", "", "Why, where it is known, stands on the page; experiments to it: `tools/validation/run experiments`.", "",
              *table_of("| page | figure | ours | pass band |", failed)]
    if undecided:
        lines += ["## What is undecided", "", "Runs are there, and do not tell it.", "",
                  *table_of("| page | figure | ours | found |", undecided)]
    lines += ["## What has not been run", "", "What each run would cost stands on the page.", "",
              *table_of("| page | figures left |", left)]
    return "\n".join(lines)


def age_of(text):
    """Whether the runs of a page are of an engine with today's bits, as the page says."""
    if stale.said(text):
        return "older"
    return "today's bits" if stale.LINE.search(text) and stale.NO_RUN not in text else "-"


def table_of(head, rows):
    return [head, "| " + " | ".join(["---"] * (head.count("|") - 1)) + " |", *rows, ""] if rows else ["Nothing.", ""]


def write():
    (FOLDER / "README.md").write_text(index())
    return 0


def check():
    target = FOLDER / "README.md"
    if target.exists() and target.read_text() == index():
        return 0
    print(f"{target}: not the index of the pages beside it: run tools/validation/run --index")
    return 1
