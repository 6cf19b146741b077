# SPDX-License-Identifier: Apache-2.0
"""Opens the three XDMF files of a run folder in ParaView as a user would and says what is in them.

usage: xvfb-run -a pvpython tools/dev/check_paraview.py DIR [--frames N]

Prints times, array names, counts and ranges of every frame. Exit status 1 when a file is missing,
ParaView reports an error, a frame lacks an array or holds a number that is not finite. Each file is
opened in a process of its own, because this reader ends the process on some broken files.
"""
import argparse
import math
import os
import subprocess
import sys

EXPECTED = {
    "particles": ("point", {"velocity": 3, "angular_velocity": 3, "force": 3, "diameter": 1,
                            "weight": 1, "mass": 1, "material": 1, "id": 1}),
    "fluid": ("cell", {"velocity": 3, "pressure": 1, "void_fraction": 1, "momentum_exchange": 3,
                       "open_fraction": 1}),
    "walls": ("cell", {"body": 1}),
}


def arrays_of(attributes):
    found = {}
    for i in range(len(attributes)):
        array = attributes[i]
        ranges = [array.GetRange(c) for c in range(array.GetNumberOfComponents())]
        found[array.Name] = ranges
    return found


def check_file(path, frames_wanted):
    from paraview.simple import XDMFReader
    from paraview import servermanager

    kind = os.path.splitext(os.path.basename(path))[0]
    where, expected = EXPECTED[kind]
    problems = []
    reader = XDMFReader(FileNames=[path])
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues) or [0.0]
    print(f"{kind}: {len(times)} times from {times[0]:g} to {times[-1]:g} s")
    if times != sorted(set(times)):
        problems.append("times do not ascend")
    if frames_wanted is not None and len(times) != frames_wanted:
        problems.append(f"{len(times)} frames, not {frames_wanted}")
    for time in times:
        reader.UpdatePipeline(time)
        info = reader.GetDataInformation()
        # The reader reports nothing but an empty data set when it fails; even an empty set has a point.
        if info.GetNumberOfPoints() == 0:
            problems.append(f"t = {time:g} s cannot be read")
            continue
        cells = info.GetNumberOfCells()
        found = arrays_of(reader.PointData if where == "point" else reader.CellData)
        print(f"  t = {time:g} s: {cells} cells, bounds "
              + " ".join(f"{b:g}" for b in info.GetBounds()))
        if cells == 0:
            continue
        for name, components in expected.items():
            ranges = found.get(name)
            if ranges is None or len(ranges) != components:
                problems.append(f"t = {time:g} s: no {name} with {components} components")
            elif not all(math.isfinite(v) for r in ranges for v in r):
                problems.append(f"t = {time:g} s: {name} is not finite")
            else:
                print(f"    {name}: " + ", ".join(f"{a:g} to {b:g}" for a, b in ranges))
        data = servermanager.Fetch(reader)
        if where == "point" and data.GetNumberOfPoints() != cells:
            problems.append(f"t = {time:g} s: {cells} grains at {data.GetNumberOfPoints()} points")
    for problem in problems:
        print(f"FAIL {kind}: {problem}", file=sys.stderr)
    return 1 if problems else 0


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--frames", type=int, help="how many frames there must be")
    parser.add_argument("--only", choices=sorted(EXPECTED), help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    if arguments.only:
        sys.exit(check_file(os.path.join(arguments.folder, arguments.only + ".xdmf"),
                            arguments.frames))
    failed = []
    for kind in EXPECTED:
        path = os.path.join(arguments.folder, kind + ".xdmf")
        if not os.path.exists(path):
            print(f"FAIL {kind}: no {path}", file=sys.stderr)
            failed.append(kind)
            continue
        command = ["pvpython", os.path.abspath(__file__), os.path.abspath(arguments.folder),
                   "--only", kind]
        if arguments.frames is not None:
            command += ["--frames", str(arguments.frames)]
        result = subprocess.run(command, capture_output=True, text=True)
        sys.stdout.write(result.stdout)
        sys.stderr.write(result.stderr)
        if result.returncode != 0 or "ERR|" in result.stderr or "XDMF Error" in result.stderr:
            print(f"FAIL {kind}", file=sys.stderr)
            failed.append(kind)
    print("failed: " + ", ".join(failed) if failed else "ok: ParaView reads all three files")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
