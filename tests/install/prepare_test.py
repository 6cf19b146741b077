#!/usr/bin/env python3
"""prepare_test.py SOURCE: what tools/dev/prepare tells while it builds, with a build that is none."""

import os
import pathlib
import subprocess
import sys
import tempfile

NINJA = """#!/bin/sh
n=0
while [ $n -lt "$STEPS" ]; do n=$((n+1)); echo "[$n/$STEPS] c++ $n"; done
"""
# As ninja does: a line of status per step, and what compilers say in between.
CMAKE = """#!/bin/sh
case " $* " in *" --quiet "*) exit 0 ;; esac
n=0
while [ $n -lt "$STEPS" ]; do
  n=$((n+1))
  printf '%s' "$NINJA_STATUS" | sed "s/%f/$n/; s/%t/$STEPS/; s/%e/$((n*2)).5/"
  echo "Building $n"
  # By now something has been told: who listens says so with a file.
  if [ $n = 20 ]; then
    patience=100
    while [ ! -e heard ] && [ $patience -gt 0 ]; do sleep 0.1; patience=$((patience-1)); done
    if [ ! -e heard ]; then echo "nothing heard by step 20"; fi
  fi
done
if [ "$FAILS" = 1 ]; then
  echo "FAILED: core/x.o"
  echo "core/x.cpp:3:1: error: no"
  exit 7
fi
"""


def prepare(source, steps, fails=False):
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        (root / "build/release").mkdir(parents=True)
        (root / "build/release/build.ninja").touch()
        (root / "bin").mkdir()
        for name, text in (("ninja", NINJA), ("cmake", CMAKE),
                           ("dpkg-query", "#!/bin/sh\necho 'install ok installed'\n")):
            (root / "bin" / name).write_text(text)
            (root / "bin" / name).chmod(0o755)
        environment = os.environ | {"PATH": f"{root / 'bin'}:{os.environ['PATH']}",
                                    "STEPS": str(steps), "FAILS": str(int(fails))}
        script = f"set -eu; targets='engine dust_plugins'; . {source}/tools/dev/prepare; echo ran"
        run = subprocess.Popen(["sh", "-c", script], cwd=root, env=environment, text=True,
                               stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        lines = []
        for line in run.stdout:
            lines.append(line)
            if line.startswith("built "):
                (root / "heard").touch()
        return subprocess.CompletedProcess(script, run.wait(), "".join(lines))


def check(condition, run):
    if not condition:
        sys.exit(f"FAILED with status {run.returncode}:\n{run.stdout}")


def main():
    source = pathlib.Path(sys.argv[1]).resolve()
    run = prepare(source, 100)
    lines = run.stdout.splitlines()
    check(run.returncode == 0 and lines[-1] == "ran", run)
    check(lines[0].startswith("building engine dust_plugins from source: 100 steps on "), run)
    # 200 s in steps of 2 s: once every 15 s, with what is left.
    check(10 <= sum(line.startswith("built ") for line in lines) <= 14, run)
    check("built 50 of 100, 2 min gone, about 2 min left" in run.stdout
          or "built 48 of 100, 2 min gone, about 2 min left" in run.stdout, run)
    check("Building" not in run.stdout, run)
    # As it goes, not in lumps.
    check("nothing heard" not in run.stdout, run)

    run = prepare(source, 2)
    check(run.returncode == 0 and run.stdout == "ran\n", run)

    run = prepare(source, 100, fails=True)
    check(run.returncode == 7 and "core/x.cpp:3:1: error: no" in run.stdout, run)
    check("ran" not in run.stdout.splitlines(), run)


if __name__ == "__main__":
    main()
