#!/usr/bin/env python3
"""about_test.py ENGINE: what the engine says of itself: version, manual page, completion, bug report."""

import json
import os
import pathlib
import re
import shutil
import socket
import subprocess
import sys
import tempfile
import unittest

ENGINE = sys.argv[1]


def run(*command, status=0, **more):
    environment = {k: v for k, v in os.environ.items() if k != "DUST_PLUGIN_PATH"}
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True, env=environment, **more)
    if done.returncode != status:
        raise AssertionError(f"{command}: exit status {done.returncode}\n{done.stdout}{done.stderr}")
    return done.stderr if status else done.stdout


def engine(*arguments, **more):
    return run(ENGINE, *arguments, **more)


def commands():
    return re.findall(r"^  ([a-z][a-z-]+) {2,}", engine("--help").split("Subcommands:")[1], re.M)


def options_of(command):
    text = engine(command, "--help").split("Options:")[1]
    return set(re.findall(r"^  (?:-\w,)?(--?[a-z][a-z-]*)", text, re.M)) - {"--help", "-h"}


class Version(unittest.TestCase):
    def test_says_commit_compiler_and_interface(self):
        first, commit, compiler, interface = engine("--version").strip().split("\n")
        self.assertRegex(first, r"^engine \d+\.\d+\.\d+$")
        self.assertRegex(commit, r"^commit: ([0-9a-f]{12}(, changed)?|unknown)$")
        self.assertRegex(compiler, r"^compiler: (g\+\+|clang) \d+\..*, \S+, \w+$")
        self.assertRegex(interface, r"^plugin interface: \d+$")


class Describe(unittest.TestCase):
    def test_lists_the_choices_of_a_parameter(self):
        self.assertIn("tangential: text, default rescaled; one of rescaled, liggghts", engine("describe", "contact/hertz_mindlin"))

    def test_lists_them_for_all_models_of_a_kind(self):
        said = engine("describe", "boundary")
        self.assertIn("measure (superficial | interstitial), profile (uniform | parabolic | table) = uniform", said)


class ManualPage(unittest.TestCase):
    def setUp(self):
        self.page = engine("man").replace("\\-", "-")

    def test_has_every_command_with_its_options(self):
        parts = dict(re.findall(r"^\.SS engine (\S+)(.*?)(?=^\.S[SH])", self.page, re.M | re.S))
        self.assertEqual(list(parts), commands())
        for command, part in parts.items():
            for option in options_of(command):
                self.assertIn(f"\\fB{option}\\fR", part, command)

    def test_is_understood_by_man(self):
        if not shutil.which("man") or not shutil.which("groff"):
            self.skipTest("man and groff are needed")
        page = pathlib.Path(FOLDER, "engine.1")
        page.write_text(engine("man"))
        done = subprocess.run(["man", "--warnings", "-E", "UTF-8", "-l", "-Tutf8", page], text=True,
                              capture_output=True, env={**os.environ, "MANWIDTH": "100"})
        self.assertEqual((done.returncode, done.stderr), (0, ""))
        self.assertIn("engine describe KIND/NAME", re.sub(r"\x1b\[[0-9;]*m|.\x08", "", done.stdout))


class Completion(unittest.TestCase):
    def offers(self, *words):
        """What bash offers for the last of the words behind `engine`."""
        line = " ".join(f"'{word}'" for word in (ENGINE, *words))
        script = (f"source <('{ENGINE}' completion); COMP_WORDS=({line}); COMP_CWORD={len(words)}; "
                  f"_engine '{ENGINE}'; printf '%s\\n' \"${{COMPREPLY[@]}}\"")
        return set(run("bash", "-c", script, cwd=FOLDER).split())

    def test_offers_commands_options_choices_and_models(self):
        self.assertEqual(self.offers("stu"), {"study"})
        self.assertEqual(self.offers("run", "x.yaml", "--th"), {"--threads"})
        self.assertEqual(self.offers("study", "x.yaml", "--launcher", ""), {"local", "slurm"})
        self.assertEqual(self.offers("describe", "drag/gi"), {"drag/gidaspow"})

    def test_offers_files_and_folders(self):
        pathlib.Path(FOLDER, "case.yaml").write_text("")
        pathlib.Path(FOLDER, "cases").mkdir()
        self.assertEqual(self.offers("check", "ca"), {"case.yaml", "cases"})
        self.assertEqual(self.offers("run", "case.yaml", "--plugin-path", "ca"), {"cases"})

    def test_knows_every_command_with_its_options(self):
        self.assertTrue(set(commands()) <= self.offers(""))
        for command in commands():
            self.assertTrue(options_of(command) <= self.offers(command, "-"), command)


class BugReport(unittest.TestCase):
    def setUp(self):
        self.run = pathlib.Path(tempfile.mkdtemp(dir=FOLDER))
        (self.run / "scenario.yaml").write_text("name: broken\n")
        (self.run / "run.log").write_text("".join(f"line {n}\n" for n in range(1, 101)))
        summary = {"status": "failed", "reason": "a number is none", "sensors": {"out": {}}}
        (self.run / "summary.json").write_text(json.dumps(summary))
        (self.run / "frames").mkdir()
        (self.run / "frames/000000.h5").write_bytes(b"12345")
        self.file = self.run.with_suffix(".md")

    def test_holds_what_an_issue_needs(self):
        engine("report-bug", self.run, "-o", self.file)
        text = self.file.read_text()
        version = engine("--version").strip()
        for part in (version, "a number is none", "name: broken", "frames/000000.h5  5", "line 100",
                     "line 41\n", "processor: ", "memory: "):
            self.assertIn(part, text)
        self.assertNotIn("line 40\n", text)
        self.assertNotIn('"sensors"', text)

    def test_holds_neither_the_name_of_the_machine_nor_where_the_run_stands(self):
        engine("report-bug", self.run, "-o", self.file)
        text = self.file.read_text()
        self.assertNotIn(str(FOLDER), text)
        if len(socket.gethostname()) > 5:
            self.assertNotIn(socket.gethostname(), text)

    def test_a_run_that_crashed_has_one_too(self):
        (self.run / "summary.json").unlink()
        engine("report-bug", self.run, "-o", self.file)
        self.assertIn("there is no summary.json", self.file.read_text())

    def test_replaces_nothing_and_takes_nothing_else(self):
        self.file.write_text("mine")
        said = engine("report-bug", self.run, "-o", self.file, status=2)
        self.assertEqual(said, f"{self.file}: error: exists already; give another -o\n")
        self.assertEqual(self.file.read_text(), "mine")
        said = engine("report-bug", FOLDER, "-o", self.file, status=2)
        self.assertIn("neither run.log nor scenario.yaml; give the output folder of a run", said)


FOLDER = tempfile.mkdtemp(prefix="dust-about-")
try:
    unittest.main(argv=sys.argv[:1])
finally:
    shutil.rmtree(FOLDER, ignore_errors=True)
