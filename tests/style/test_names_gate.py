#!/usr/bin/env python3
"""test_names_gate.py ROOT [--shrink]: a source with test cases is named *_test.cpp, and a source named
so has test cases; the name of a case says what shall be. Others from before stand in test_names_allowed.txt, which only shrinks."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allow_list
import cpp_text

CASE = re.compile(r"^\s*(TEST_CASE|TEST_CASE_TEMPLATE|SCENARIO)\b", re.M)
NAMED = re.compile(r'\bTEST_CASE(?:_TEMPLATE)?\(\s*((?:"(?:[^"\\]|\\.)*"\s*)+)')


def names_of(text):
    """Of the cases of a source, each a literal that may be cut into several."""
    return ["".join(re.findall(r'"((?:[^"\\]|\\.)*)"', m.group(1))) for m in NAMED.finditer(text)]


def findings(root):
    found = {}
    for path in cpp_text.sources(root, ("tests",)):
        text = path.read_text(errors="replace")
        has_cases = bool(CASE.search(text))
        for case in names_of(text):
            if not re.search(r"\bshall\b", case):
                found[f"{path.relative_to(root).as_posix()}: {case}"] = "does not say what shall be"
        if has_cases != path.name.endswith("_test.cpp"):
            name = path.relative_to(root).as_posix()
            found[name] = "has test cases" if has_cases else "has no test case"
    return found


def main():
    here = pathlib.Path(__file__).parent
    return allow_list.run(findings(allow_list.root_of(sys.argv[1:])),
                          here / "test_names_allowed.txt",
                          "sources with test cases, and only they, are named *_test.cpp; a case's "
                          "name says what shall be", sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
