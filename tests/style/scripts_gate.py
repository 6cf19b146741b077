#!/usr/bin/env python3
"""scripts_gate.py ROOT: shell scripts pass shellcheck, Python files compile. Exit status 1 and the findings; 77 without shellcheck (the
Python is checked all the same)."""

import pathlib
import re
import shutil
import subprocess
import sys

# What holds scripts.
FOLDERS = (".ci", "tools", "tests", "plugins", "scenarios", "core")
SHELL = re.compile(rb"#!\s*/(usr/)?bin/(env )?(ba|da)?sh\b")
PYTHON = re.compile(rb"#!.*\bpython3?\b")


def scripts(root):
    """(path, "shell" or "python") of every script below the folders that hold sources."""
    for folder in FOLDERS:
        for path in sorted((root / folder).rglob("*")):
            if not path.is_file() or path.suffix in (".stl", ".png", ".hpp", ".cpp"):
                continue
            with path.open("rb") as file:
                first = file.read(200).split(b"\n")[0]
            if SHELL.match(first):
                yield path, "shell"
            elif path.suffix == ".py" or PYTHON.match(first):
                yield path, "python"


def compiles(path):
    """What is wrong with a Python file, or nothing."""
    try:
        compile(path.read_text(), str(path), "exec")
    except SyntaxError as error:
        return f"{path}:{error.lineno}: {error.msg}"
    return ""


def findings(root, checker):
    """(scripts in the shell, files in Python, what is wrong with them)."""
    found = list(scripts(root))
    problems = [text for path, kind in found if kind == "python" and (text := compiles(path))]
    shell = [path for path, kind in found if kind == "shell"]
    if checker and shell:
        # With what they source, which they name from the root.
        names = [path.relative_to(root) for path in shell]
        done = subprocess.run([checker, "--external-sources", "--format=gcc", *names], cwd=root, text=True, capture_output=True)
        problems += done.stdout.splitlines()
    return len(shell), len(found) - len(shell), problems


def main():
    checker = shutil.which("shellcheck")
    shell, python, problems = findings(pathlib.Path(sys.argv[1]), checker)
    print("\n".join(problems))
    if problems:
        sys.exit(1)
    print(f"{shell} shell scripts, {python} Python files")
    if not checker:
        print("skipped: the package shellcheck is needed for the shell scripts")
        sys.exit(77)


if __name__ == "__main__":
    main()
