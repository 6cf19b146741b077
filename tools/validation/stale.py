"""Which pages are of an engine whose bits have changed since.

A page keeps, in comments `<!-- bits CASE=STATE ... -->`, the state that each case of tools/dev/check_bits had when the
engine of its runs was built. tests/bits/recorded.json holds those of today. A page is stale when one of the cases that
its own case names under BITS (they go through the same parts of the engine) has another state today, or had none
then: what the page's runs compute may have changed. Where none has, every part that these runs go through gave the
same bits, so the page's figures are those of today. The rule errs on the side of stale."""

import json
import re

import cases
from kept import Kept
from page import FOLDER
from runs import BITS, ROOT

LINE = re.compile(r"<!-- bits (.*?) -->")
MARK = "*Figures of an older engine"
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


def pages():
    """(case, file, why it is stale or None where no run stands on it) of each case."""
    today = {case: digests["state"] for case, digests in json.loads((ROOT / BITS).read_text()).items()}
    for case in cases.names():
        file, watched = FOLDER / f"{case}.md", cases.load(case).BITS
        has_runs = watched and file.exists() and NO_RUN not in file.read_text()
        yield case, file, why(file.read_text(), watched, today) if has_runs else None


def tell():
    count = 0
    for case, _, reason in pages():
        if reason is None:
            print(f"{case}: " + ("no run has ended" if cases.load(case).BITS else "holds no figures of runs"))
        else:
            count += bool(reason)
            print(f"{case}: " + (f"STALE: {reason}" if reason else "of today's bits"))
    return 1 if count else 0


def said(text):
    """What a page says of its engine's age: the line below its title; empty where it says nothing."""
    lines = text.splitlines()
    return lines[2] if len(lines) > 2 and lines[2].startswith(MARK) else ""


def unsaid():
    """Tells the pages that are stale and do not say so, or say so and are not; status 1 if any."""
    wrong = [(case, reason) for case, file, reason in pages() if reason is not None and bool(reason) != bool(said(file.read_text()))]
    for case, reason in wrong:
        print(f"docs/validation/{case}.md: " + (f"does not say that it is stale ({reason})" if reason else "says that it is stale, and is not") +
              ": run tools/validation/run --stale --mark")
    return 1 if wrong else 0


def marked(text, line):
    """The page with `line` below its title, in place of an earlier one; with an empty line without it."""
    title, *rest = text.splitlines()
    if len(rest) > 1 and rest[1].startswith(MARK):
        del rest[:2]
    return "\n".join([title, *(["", line] if line else []), *rest]) + "\n"


def mark(today):
    """Says on each stale page that it is, since when that is known, and what its runs took."""
    for case, file, reason in pages():
        if reason is None:
            continue
        before = file.read_text()
        since = re.search(rf"\((\S+): {re.escape(reason)}\)", said(before)) if reason else None
        total = Kept(file).hours()
        cost = f": about {total:.0f} hours of one core" if total > 10 else f": about {max(60 * total, 1):.0f} min of one core" if total else ""
        line = f"{MARK} ({since.group(1) if since else today}: {reason}). Anew by `tools/validation/run {case}`{cost}.*" if reason else ""
        file.write_text(marked(before, line))
