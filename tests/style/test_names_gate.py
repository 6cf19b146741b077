#!/usr/bin/env python3
"""test_names_gate.py ROOT [--shrink]: a source with test cases is named *_test.cpp, and a source named
so has test cases. Others from before stand in test_names_allowed.txt, which only shrinks."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allow_list
import cpp_text

CASE = re.compile(r"^\s*(TEST_CASE|TEST_CASE_TEMPLATE|SCENARIO)\b", re.M)


def findings(root):
    found = {}
    for path in cpp_text.sources(root, ("tests",)):
        has_cases = bool(CASE.search(path.read_text(errors="replace")))
        if has_cases != path.name.endswith("_test.cpp"):
            name = path.relative_to(root).as_posix()
            found[name] = "has test cases" if has_cases else "has no test case"
    return found


def main():
    here = pathlib.Path(__file__).parent
    return allow_list.run(findings(allow_list.root_of(sys.argv[1:])),
                          here / "test_names_allowed.txt",
                          "sources with test cases, and only they, are named *_test.cpp", sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
