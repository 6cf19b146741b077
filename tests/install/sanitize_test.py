#!/usr/bin/env python3
"""sanitize_test.py ROOT: the page that tools/dev/sanitize writes of runs that ctest has recorded."""

import pathlib
import subprocess
import sys
import tempfile
import unittest

ROOT = pathlib.Path(sys.argv.pop(1))
FAULT = "==7==ERROR: AddressSanitizer: heap-use-after-free on address 0x60"
TESTS = f"""
add_test("sums shall be right" "true")
add_test("memory shall be kept" "sh" "-c" "echo '{FAULT}'; exit 1")
add_test("a page shall open" "sh" "-c" "exit 77")
set_tests_properties("a page shall open" PROPERTIES SKIP_RETURN_CODE 77)
"""


class Sanitize(unittest.TestCase):
    def setUp(self):
        self.folder = tempfile.TemporaryDirectory()
        self.addCleanup(self.folder.cleanup)
        self.page = pathlib.Path(self.folder.name) / "page.md"

    def results(self, name, tests, *options):
        folder = pathlib.Path(self.folder.name)
        (folder / "CTestTestfile.cmake").write_text(tests)
        subprocess.run(["ctest", "--output-junit", folder / name, *options], cwd=folder, capture_output=True)
        return folder / name

    def write(self, preset, *results):
        return subprocess.run([ROOT / "tools/dev/sanitize", preset, "--results", *results, "--record", "--page",
                               self.page], text=True, capture_output=True)

    def record(self, preset, *options):
        return self.write(preset, self.results("tests.xml", TESTS, *options))

    def test_a_test_that_ran_again_after_a_mend_counts_once_and_is_told(self):
        mended = TESTS.replace("exit 1", "exit 0").replace("ERROR: AddressSanitizer", "was")
        self.assertNotEqual(mended, TESTS)
        done = self.write("asan-ubsan", self.results("first.xml", TESTS),
                          self.results("again.xml", mended, "-R", "memory"))
        self.assertEqual(done.returncode, 0, done.stdout)
        text = self.page.read_text()
        row = next(line for line in text.splitlines() if line.startswith("| asan-ubsan |"))
        self.assertEqual([c.strip() for c in row.split("|")][4:8], ["2", "0", "nothing", "1"])
        self.assertIn("* run again after a mend: memory shall be kept", text)

    def test_faults_failures_and_skips_stand_on_the_page(self):
        done = self.record("asan-ubsan")
        self.assertEqual(done.returncode, 1, done.stderr)
        text = self.page.read_text()
        row = next(line for line in text.splitlines() if line.startswith("| asan-ubsan |"))
        cells = [c.strip() for c in row.split("|")]
        self.assertEqual(cells[4:8], ["2", "1", "1", "1"])
        self.assertIn("* failed: memory shall be kept: `ERROR: AddressSanitizer: heap-use-after-free", text)
        self.assertIn("* skipped: a page shall open", text)

    def test_rows_of_before_stay_and_a_preset_has_one_last_run(self):
        self.record("asan-ubsan")
        self.assertEqual(self.record("asan-ubsan", "-R", "sums").returncode, 0)
        self.record("tsan", "-R", "sums")
        text = self.page.read_text()
        self.assertEqual(text.count("\n| asan-ubsan |"), 2)
        self.assertEqual(text.count("\n| tsan |"), 1)
        self.assertEqual(text.count("## asan-ubsan: the last run"), 1)
        self.assertNotIn("memory shall be kept", text)
        self.assertEqual(text.count("no sanitizer reported anything"), 2)

    def test_what_a_stopped_ctest_printed_counts_too(self):
        log = pathlib.Path(self.folder.name) / "suite.log"
        log.write_text("""      Start  1: sums shall be right
 1/4 Test   #1: sums shall be right .............   Passed    0.11 sec
 2/4 Test   #2: memory shall be kept ............***Failed    1.50 sec
WARNING: ThreadSanitizer: data race (pid=7)
 3/4 Test  #12: a page shall open ...............***Skipped   0.02 sec
      Start  3: a test that was stopped
""")
        self.assertEqual(self.write("tsan", log).returncode, 1)
        text = self.page.read_text()
        row = next(line for line in text.splitlines() if line.startswith("| tsan |"))
        self.assertEqual([c.strip() for c in row.split("|")][4:8], ["2", "1", "1", "1"])
        self.assertIn("* failed: memory shall be kept: `WARNING: ThreadSanitizer: data race", text)
        self.assertNotIn("a test that was stopped", text.split("not run")[0])


if __name__ == "__main__":
    unittest.main()
