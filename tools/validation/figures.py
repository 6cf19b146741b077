"""What a page has read off its runs, beside it in docs/validation/figures: a change between two runs is so told even when
the folder of one of them is gone."""

import csv

COLUMNS = ("run", "sensor", "figure", "value", "uncertainty", "no_error")


class Figures:
    """(value, uncertainty or None) by run, sensor and name, in SI as in summary.json."""

    def __init__(self, file=None):
        self._found, self._why = {}, {}
        if file and file.exists():
            with open(file) as lines:
                for row in csv.DictReader(lines):
                    error = float(row["uncertainty"]) if row["uncertainty"] else None
                    self.note(row["run"], row["sensor"], row["figure"], (float(row["value"]), error), row.get("no_error", ""))

    def note(self, run, sensor, name, found, no_error=""):
        self._found[run, sensor, name] = found
        self._why[run, sensor, name] = no_error

    def of(self, run, sensor, name):
        return self._found.get((run, sensor, name))

    def no_error(self, run, sensor, name):
        """Why it has no uncertainty, where the run said so."""
        return self._why.get((run, sensor, name), "")

    def forget(self, run):
        """Of a run that is there anew: what nobody reads off it any more is not kept."""
        self._found = {key: found for key, found in self._found.items() if key[0] != run}

    def only(self, runs):
        """Forgets what was read off others."""
        self._found = {key: found for key, found in self._found.items() if key[0] in runs}

    def write(self, file):
        """Sorted, each value in as many digits as it has; no file where nothing was read."""
        if not self._found:
            file.unlink(missing_ok=True)
            return
        file.parent.mkdir(exist_ok=True)
        with open(file, "w", newline="") as lines:
            writer = csv.writer(lines, lineterminator="\n")
            writer.writerow(COLUMNS)
            for key, (value, error) in sorted(self._found.items()):
                writer.writerow([*key, repr(value), "" if error is None else repr(error), self._why[key]])
