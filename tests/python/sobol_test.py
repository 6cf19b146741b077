#!/usr/bin/env python3
"""sobol_test.py ENGINE SOURCE: the estimators against a function whose indices are known, and the example
against runs in which one parameter alone counts."""

import pathlib
import subprocess
import sys
import tempfile

ENGINE, SOURCE = sys.argv[1:3]
sys.path[:0] = [SOURCE + "/tests/support", SOURCE + "/tools/examples"]
import needs_h5py  # noqa: E402, F401
import numpy as np  # noqa: E402
import sobol_indices  # noqa: E402

# Ishigami's function: indices in closed form (a = 7, b = 0.1).
OWN, TOTAL = (0.3139, 0.4424, 0.0), (0.5576, 0.4424, 0.2437)
COUNT = 1 << 14
# Four standard errors of the estimators at this count.
TOLERANCE = 0.06


def ishigami(x):
    return np.sin(x[:, 0]) + 7 * np.sin(x[:, 1]) ** 2 + 0.1 * x[:, 2] ** 4 * np.sin(x[:, 0])


def check(is_right, what):
    if not is_right:
        sys.exit(f"failed: {what}")


settings = {"count": COUNT, "over": {name: [-np.pi, np.pi] for name in "xyz"}}
found = sobol_indices.indices(ishigami(sobol_indices.sample(settings)), COUNT)
for (own, total), expected_own, expected_total in zip(found, OWN, TOTAL):
    check(abs(own - expected_own) < TOLERANCE, f"own effect {own:.3f}, not {expected_own}")
    check(abs(total - expected_total) < TOLERANCE, f"total effect {total:.3f}, not {expected_total}")

with tempfile.TemporaryDirectory() as folder:
    file = pathlib.Path(folder, "settings.yaml")
    file.write_text(f"base: {SOURCE}/tests/study/drop.yaml\ncount: 4\nquantity: particles.emitted\n"
                    "over: {emitters.feed.mass_flow: [0.001, 0.002], time.expected_speed: [1, 2]}\n")
    out = subprocess.run([sys.executable, SOURCE + "/tools/examples/sobol_indices.py", file,
                          pathlib.Path(folder, "out"), ENGINE], check=True, text=True,
                         capture_output=True).stdout.splitlines()
    totals = {line.split(":")[0]: float(line.split(",")[-1]) for line in out[2:]}
    check(out[0].startswith("16 points"), out[0])
    check(totals["emitters.feed.mass_flow"] > 0.3, f"the flow has no effect: {totals}")
    check(totals["time.expected_speed"] == 0, f"what sets the step makes grains: {totals}")
