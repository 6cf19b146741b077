"""What a page says already of runs whose folders are gone: with --keep it stays as it is."""

import re

from commands import same_of

EMPTY_CELLS = ("not run", "not run to its end", "open")


def cells_of(line):
    return [cell.strip() for cell in line.strip().strip("|").split(" | ")]


class Kept:
    """The lines of a page that was written before; none of a page that is not there, or without --keep."""

    def __init__(self, file=None):
        lines = file.read_text().splitlines() if file and file.exists() else []
        begin = lines.index("## Runs") if "## Runs" in lines else len(lines)
        self._rows = [line for line in lines[:begin] if line.startswith("| ")]
        header = next((cells_of(line) for line in lines[begin:] if line.startswith("| run | ")), [])
        self._runs = {cells_of(line)[0]: dict(zip(header, cells_of(line)))
                      for line in lines[begin:] if line.startswith("| ") and "`" in line}
        self._commands = [line for line in lines[begin:] if line.startswith("engine run ")]
        self._same, self.changed = {same_of(command) for command in self._commands}, []
        shown = (re.fullmatch(r"!\[(.*)\]\(pictures/(.*)\)", line) for line in lines[:begin])
        self._pictures = {found.group(1): found.group(2) for found in shown if found}
        self._bits = [line for line in lines if line.startswith("<!-- bits ")]
        origin = re.search(r"Runs of commit .*", "\n".join(lines[:6]))
        self._dates = set(re.findall(r"\d{4}-\d\d-\d\d", origin.group())) if origin else set()

    def row(self, *begin, among=""):
        """The cells of the row that begins like this and holds a figure, or None; `among`: a cell that it has besides."""
        for line in self._rows:
            cells = cells_of(line)
            if cells[:len(begin)] == list(begin) and (not among or among in cells) and not any(cell in EMPTY_CELLS for cell in cells):
                return cells
        return None

    def picture(self, title):
        """The file of the picture of that title; None where the page has none."""
        return self._pictures.get(title)

    def pictures(self):
        return set(self._pictures.values())

    def only(self, runs):
        """Forgets runs but these: those that are there anew, those that the case has no more, and those that it makes by another
        command today, whose names are `changed`."""
        self.changed = sorted(run.name for run in runs if run.name in self._runs and not self.is_of(run))
        names = {run.name for run in runs}.difference(self.changed)
        self._runs = {name: cells for name, cells in self._runs.items() if name in names}

    def is_of(self, run):
        """Whether it has this run, and by the command that it would be made with today."""
        return run.name in self._runs and run.plan.same() in self._same

    def cpu_s(self, run):
        return float(self._runs[run.name]["CPU [s]"])

    def hours(self, besides=()):
        """What its runs but those named took; one that stands under two names was made once."""
        took = {cells.get("state", name): cells.get("CPU [s]", "-") for name, cells in self._runs.items() if name not in besides}
        return sum(float(seconds) for seconds in took.values() if seconds != "-") / 3600

    def run_rows(self, columns, besides):
        """Rows of the table of runs but of those named, which are there anew; what the page did not tell is `-`."""
        return [[cells.get(column, "-") for column in columns] for name, cells in self._runs.items() if name not in besides]

    def commands(self):
        return self._commands

    def bits(self):
        """Records of the kept runs' engines; a page from before there were any does not tell which these were."""
        return (self._bits or ["<!-- bits unknown -->"]) if self._runs else []

    def commits(self):
        return {commit for cells in self._runs.values() for commit in cells.get("commit", "not noted").split(", ")}

    def dates(self):
        return self._dates if self._runs else set()
