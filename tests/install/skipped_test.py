#!/usr/bin/env python3
"""skipped_test.py ROOT: tools/dev/tell_skipped on what ctest itself writes."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
TESTS = """
add_test("a page shall open" "sh" "-c" "echo looking; echo no browser on this machine; exit 77")
set_tests_properties("a page shall open" PROPERTIES SKIP_RETURN_CODE 77)
add_test("sums shall be right" "true")
"""


class Skipped(unittest.TestCase):
    def told(self, *options):
        with tempfile.TemporaryDirectory() as folder:
            (pathlib.Path(folder) / "CTestTestfile.cmake").write_text(TESTS)
            results = pathlib.Path(folder) / "tests.xml"
            subprocess.run(["ctest", "--output-junit", results, *options], cwd=folder, check=True,
                           capture_output=True)
            return subprocess.run([ROOT / "tools/dev/tell_skipped", results], check=True, text=True,
                                  capture_output=True).stdout

    def test_a_skipped_test_is_told_with_its_reason(self):
        self.assertEqual(self.told(), "1 test was skipped:\n  a page shall open: no browser on this machine\n")

    def test_that_none_was_is_told_too(self):
        self.assertEqual(self.told("-R", "sums"), "no test was skipped\n")


if __name__ == "__main__":
    unittest.main()
