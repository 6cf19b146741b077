#!/usr/bin/env python3
"""approx_gate ROOT: tests compare numbers by test::approx (tests/support/approx.hpp): doctest::Approx adds 1 to what
its epsilon multiplies, so that it takes any two small numbers for alike, and a test of grams in kg cannot fail."""

import pathlib
import re
import sys

ALLOWED = {"tests/support/approx.hpp"}


def findings(root):
    for path in sorted((root / "tests").rglob("*.[ch]pp")):
        name = path.relative_to(root).as_posix()
        for number, line in enumerate(path.read_text().splitlines(), 1):
            if re.search(r"\bApprox\b", line) and name not in ALLOWED:
                yield f"{name}:{number}: doctest::Approx takes small numbers for alike; write test::approx (support/approx.hpp)"


def main():
    found = list(findings(pathlib.Path(sys.argv[1])))
    print("\n".join(found))
    sys.exit(1 if found else 0)


if __name__ == "__main__":
    main()
