#!/usr/bin/env python3
"""plant_drawings_test.py ROOT: the STL files of scenarios/plant are those that make_chute draws, and no
edge of a bend turns by more than the 8 degrees that grains feel as one smooth surface."""

import math
import pathlib
import subprocess
import sys
import tempfile

root = pathlib.Path(sys.argv[1]) / "scenarios/plant"
problems = []
with tempfile.TemporaryDirectory() as folder:
    subprocess.run([sys.executable, root / "make_chute", folder], check=True)
    drawn = sorted(pathlib.Path(folder).glob("*.stl"))
    if len(drawn) != 2:
        problems.append(f"make_chute drew {len(drawn)} files, not hood and spoon")
    for file in drawn:
        shipped = root / file.name
        if not shipped.exists() or shipped.read_text() != file.read_text():
            problems.append(f"{file.name}: run scenarios/plant/make_chute again")


def normals_by_edge(file):
    """The normals of the triangles at every edge that two of them share."""
    edges = {}
    corners = []
    for line in file.read_text().split("\n"):
        if line.startswith("vertex"):
            corners.append(tuple(float(v) for v in line.split()[1:]))
    for a, b, c in zip(corners[0::3], corners[1::3], corners[2::3]):
        u, v = [q - p for p, q in zip(a, b)], [q - p for p, q in zip(a, c)]
        n = (u[1] * v[2] - u[2] * v[1], u[2] * v[0] - u[0] * v[2], u[0] * v[1] - u[1] * v[0])
        length = math.sqrt(sum(x * x for x in n))
        for edge in ((a, b), (b, c), (c, a)):
            edges.setdefault(frozenset(edge), []).append([x / length for x in n])
    return [pair for pair in edges.values() if len(pair) == 2]


for file in sorted(root.glob("*.stl")):
    turns = [math.degrees(math.acos(max(-1.0, min(1.0, sum(p * q for p, q in zip(*pair))))))
             for pair in normals_by_edge(file)]
    # Bends of the arc are smooth; the folds between back plate and cheeks are sharp.
    if not turns or any(8.0 < turn < 60.0 for turn in turns):
        problems.append(f"{file.name}: a bend turns by {max(t for t in turns if t < 60.0):.1f} degrees")
print("\n".join(problems) or "drawings are as the script draws them")
sys.exit(1 if problems else 0)
