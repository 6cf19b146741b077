"""Which pages are of an engine whose bits have changed since.

A page keeps, in comments `<!-- bits CASE=STATE ... -->`, the state that each case of tools/dev/check_bits had when the
engine of its runs was built. tests/bits/recorded.json holds those of today. A page is stale when one of the cases that
its own case names under BITS (they go through the same parts of the engine) has another state today, or had none
then: what the page's runs compute may have changed. Where none has, every part that these runs go through gave the
same bits, so the page's figures are those of today. The rule errs on the side of stale."""

import json
import re

import cases
from page import FOLDER
from runs import BITS, ROOT

LINE = re.compile(r"<!-- bits (.*?) -->")
NO_RUN = "<!-- bits none -->"


def bits_of(text):
    """The records on a page, each {case: state}; None for runs of which it is not known."""
    return [None if line == "unknown" else dict(pair.split("=", 1) for pair in line.split()) for line in LINE.findall(text)]


def why(text, watched, today):
    """Why a page is stale; an empty text if it is not."""
    records = bits_of(text)
    if not records:
        return "says nothing of the engine of its runs"
    if None in records:
        return "of some of its runs the engine is not known"
    changed = sorted({case for record in records for case in watched if record.get(case) != today.get(case)})
    return f"bits have changed in {', '.join(changed)}" if changed else ""


def tell():
    today = {case: digests["state"] for case, digests in json.loads((ROOT / BITS).read_text()).items()}
    count = 0
    for case in cases.names():
        file = FOLDER / f"{case}.md"
        watched = cases.load(case).BITS
        if not watched:
            print(f"{case}: holds no figures of runs")
        elif not file.exists() or NO_RUN in file.read_text():
            print(f"{case}: no run has ended")
        else:
            reason = why(file.read_text(), watched, today)
            count += bool(reason)
            print(f"{case}: " + (f"STALE: {reason}" if reason else "of today's bits"))
    return 1 if count else 0
