#!/usr/bin/env python3
"""materials_test.py ENGINE SOURCE: every file of scenarios/materials can be included, holds its contacts with
itself, steel and rubber, and its page says the values the files have."""

import pathlib
import re
import subprocess
import sys
import tempfile

try:
    import yaml
except ImportError:
    print("skipped: PyYAML (package python3-yaml) is needed")
    sys.exit(77)

ENGINE, SOURCE = sys.argv[1], pathlib.Path(sys.argv[2])
FOLDER = SOURCE / "scenarios/materials"
PAGE = (FOLDER / "README.md").read_text()
WALLS = {"steel", "rubber"}
problems = []
files = {file.stem: yaml.safe_load(file.read_text()) for file in sorted(FOLDER.glob("*.yaml"))}
bulk = [name for name in files if name not in WALLS]


def row(title):
    """The cells of a row of the page's table of values."""
    line = re.search(rf"^\| {re.escape(title)}(?: \[[^]]*\])? \|(.*)$", PAGE, re.M)
    head = re.search(r"^\| value \|(.*)$", PAGE, re.M)
    names = [cell.strip().replace(" ", "_") for cell in head[1].split("|")]
    return dict(zip(names, (cell.strip() for cell in line[1].split("|"))))


def expect(title, name, value):
    told = row(title)[name]
    if float(told.split()[0]) != float(str(value).split()[0]):
        problems.append(f"README.md: {title} of {name} is {told}, {name}.yaml has {value}")


def check(scenario):
    return subprocess.run([ENGINE, "check", scenario], capture_output=True, text=True)


for name in bulk:
    own = files[name]["materials"][name]
    pairs = {tuple(one["between"]): one for one in files[name]["interactions"]}
    if set(pairs) != {(name, name), (name, "steel"), (name, "rubber")}:
        problems.append(f"{name}.yaml: contacts of {sorted(pairs)}")
        continue
    expect("density", name, own["density"])
    expect("Poisson's ratio", name, own["poisson_ratio"])
    expect("Young's modulus", name, own["young_modulus"])
    for title, other in (("friction among grains", name), ("on steel", "steel"), ("on rubber", "rubber")):
        expect(title, name, pairs[(name, other)]["contact"]["friction"])
    expect("rolling friction", name, pairs[(name, name)]["rolling"]["friction"])
    expect("restitution", name, pairs[(name, name)]["contact"]["restitution"])
    expect("restitution on rubber", name, pairs[(name, "rubber")]["contact"]["restitution"])

with tempfile.TemporaryDirectory() as folder:
    for name in bulk:
        scenario = pathlib.Path(folder, f"{name}_box.yaml")
        # A box of steel on a floor of rubber, full of the material; only the file itself names contacts.
        walls = {side: {"grains": "wall", "material": "steel"}
                 for side in ("left", "right", "front", "back", "top")}
        walls["bottom"] = {"grains": "wall", "material": "rubber"}
        scenario.write_text(yaml.safe_dump({
            "include": [str(FOLDER / f"{name}.yaml")],
            "time": {"end": "1 s", "fluid_step": "1 ms", "output_every": "100 ms"},
            "gravity": [0, 0, -9.81], "fluid": "none",
            "domain": {"min": [0, 0, 0], "max": ["1 m", "1 m", "1 m"], "boundaries": walls},
            "emitters": {"bed": {"model": "fill", "material": name, "min": [0.1, 0.1, 0.1],
                                 "max": [0.9, 0.9, 0.9], "count": 100, "diameters": [0.03],
                                 "mass_fractions": [1]}}}))
        done = check(scenario)
        if done.returncode != 0 or "warning" in done.stderr:
            problems.append(f"{name}.yaml: {done.stderr}")
        # Without the file nothing says what touches what: the check above can fail.
        lone = pathlib.Path(folder, "lone.yaml")
        lone.write_text(scenario.read_text().replace(f"{name}.yaml", "steel.yaml"))
        if check(lone).returncode == 0:
            problems.append(f"{name}: a scenario without its file is accepted")
print("\n".join(problems))
sys.exit(1 if problems else 0)
