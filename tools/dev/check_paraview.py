# SPDX-License-Identifier: Apache-2.0
"""Opens the three XDMF files of a run folder in ParaView as a user would and says what is in them;
then the run's paraview_state.py, as Load State does.

usage: xvfb-run -a -s "-screen 0 1600x1200x24 -noreset" pvpython tools/dev/check_paraview.py DIR
           [--frames N] [--picture OUT.png] [--state-picture OUT.png] [--record]

Without -noreset the X server starts anew when ParaView lets go of it for a moment, and is not there.

Prints times, array names, counts and ranges of every frame. Exit status 1 when a file is missing,
ParaView reports an error, a frame lacks an array or holds a number that is not finite. Each file is
opened in a process of its own, because this reader ends the process on some broken files.

The state has to show the grains as spheres as wide as the grains, the bodies, and a slice of the air
that is one cell thick, each where there is something to show; --state-picture keeps what it shows.

--picture renders the last frame: grains as spheres coloured by diameter, air speed in the middle
plane, the walls. --record adds the result to docs/validation/paraview.md.

Needs Debian's paraview, python3-paraview, xvfb, xauth and, for pictures, libgl1-mesa-dri.
"""
import argparse
import datetime
import json
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
DUST_DIAMETER = 100e-6
STATE = "paraview_state.py"
RECORD = os.path.join(os.path.dirname(os.path.abspath(__file__)), "..", "..", "docs", "validation",
                      "paraview.md")
RECORD_HEAD = """# What ParaView reads

Written by `tools/dev/check_paraview.py DIR --record`, newest entry last: the three XDMF files of a
run, opened with Debian's ParaView (reader "XDMF Reader"), every frame loaded, every array present,
with its components, and finite. A run without fluid has empty frames in `fluid.xdmf`. Then the run's
`paraview_state.py`, as *Load State* runs it: grains shown as spheres of their size, bodies, a flat slice of the air.

| date | ParaView | run | state (SHA-256) | file | frames | in the last frame | result |
| --- | --- | --- | --- | --- | --- | --- | --- |
"""


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
    cells = 0
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
    print(f"result {kind} | {len(times)} | {cells:,} "
          + ("grains" if where == "point" else "cells" if kind == "fluid" else "triangles"))
    return 1 if problems else 0


def check_state(folder, picture):
    """Runs the state script and looks at what it shows."""
    from paraview import simple

    path = os.path.join(folder, STATE)
    with open(path, encoding="utf-8") as file:
        exec(compile(file.read(), path, "exec"), {"__file__": path, "__name__": "__main__"})
    view = simple.GetActiveView()
    sources = {name: source for (name, _), source in simple.GetSources().items()}
    problems = []

    def count_of(name):
        if name not in sources:
            return 0
        sources[name].UpdatePipeline(view.ViewTime)
        return sources[name].GetDataInformation().GetNumberOfCells()

    def shown(name):
        """Its bounds where it is shown with something in it."""
        source = sources.get(name)
        if count_of(name) == 0 or not simple.GetRepresentation(source, view).Visibility:
            problems.append(f"{name}: not shown")
            return None
        return source.GetDataInformation().GetBounds()

    counts = []
    if count_of("grains"):
        spheres = shown("grains as spheres")
        grains = sources["grains"].GetDataInformation()
        largest = grains.GetPointDataInformation().GetArrayInformation("diameter")
        widest = largest.GetComponentRange(0)[1]
        if spheres:
            # Spheres reach beyond the centres by at most the largest radius; nothing is larger.
            beyond = max(abs(a - b) for a, b in zip(spheres, grains.GetBounds()))
            if not 0.0 < beyond <= 0.501 * widest:
                problems.append(f"spheres reach {beyond:g} m beyond the centres of grains of {widest:g} m")
        counts.append(f"{grains.GetNumberOfPoints():,} spheres")
    if count_of("bodies"):
        shown("bodies")
        counts.append(f"{count_of('bodies'):,} triangles")
    if count_of("air"):
        cut = shown("air outside bodies")
        if cut and min(cut[1] - cut[0], cut[3] - cut[2]) > 1e-6 * (cut[5] - cut[4]):
            problems.append("the slice of the air is not flat")
        counts.append(f"{count_of('air outside bodies'):,} cells of the slice")
    if not counts:
        problems.append("nothing is shown")
    if picture:
        view.ViewSize = [1400, 1000]
        simple.SaveScreenshot(os.path.abspath(picture), view, ImageResolution=[1400, 1000])
    for problem in problems:
        print(f"FAIL {STATE}: {problem}", file=sys.stderr)
    print(f"result {STATE} | 1 | " + ", ".join(counts), flush=True)
    os._exit(1 if problems else 0)  # as below


def render(folder, picture):
    """The last frame from the side, along y."""
    from paraview import simple

    view = simple.CreateRenderView()
    view.ViewSize = [1400, 1400]
    view.UseColorPaletteForBackground = 0
    view.Background = [1.0, 1.0, 1.0]
    view.OrientationAxesVisibility = 0

    def read(kind):
        reader = simple.XDMFReader(FileNames=[os.path.join(folder, kind + ".xdmf")])
        reader.UpdatePipelineInformation()
        time = (list(reader.TimestepValues) or [0.0])[-1]
        reader.UpdatePipeline(time)
        return reader, time, reader.GetDataInformation()

    def bar(title, array, display):
        table = simple.GetColorTransferFunction(array)
        scale = simple.GetScalarBar(table, view)
        scale.Title, scale.ComponentTitle = title, ""
        scale.TitleColor = scale.LabelColor = [0.0, 0.0, 0.0]
        scale.TitleFontSize = scale.LabelFontSize = 14
        display.SetScalarBarVisibility(view, True)
        return table, scale

    def rescale(table, source, where, array, at):
        # Filters shown before the view has a time still know the first frame only.
        source.UpdatePipeline(at)
        data = source.PointData if where == "POINTS" else source.CellData
        low, high = data[array].GetRange(0)
        table.RescaleTransferFunction(min(low, 0.0), high if high > low else low + 1e-12)

    fluid, time, info = read("fluid")
    bounds = info.GetBounds()
    if info.GetNumberOfCells() > 0:
        # Behind the grains, so that it does not hide half of them.
        plane = simple.Slice(Input=fluid, SliceType="Plane")
        plane.SliceType.Origin = [0.0, 0.5 * (bounds[2] + bounds[3]), 0.0]
        plane.SliceType.Normal = [0.0, 1.0, 0.0]
        speed = simple.Calculator(Input=plane, AttributeType="Cell Data",
                                  ResultArrayName="air_speed", Function="mag(velocity)")
        air = simple.Threshold(Input=speed, Scalars=["CELLS", "open_fraction"])
        try:
            air.LowerThreshold, air.UpperThreshold = 0.5, 1.0
        except AttributeError:
            air.ThresholdRange = [0.5, 1.0]
        moved = simple.Transform(Input=air)
        moved.Transform.Translate = [0.0, bounds[3] - bounds[2], 0.0]
        shown = simple.Show(moved, view)
        simple.ColorBy(shown, ("CELLS", "air_speed"))
        table, scale = bar("air speed, m/s", "air_speed", shown)
        table.ApplyPreset("Blues", True)
        table.InvertTransferFunction()  # fast air dark
        rescale(table, moved, "CELLS", "air_speed", time)
        scale.WindowLocation = "Any Location"
        scale.Position, scale.ScalarBarLength = [0.89, 0.12], 0.3
    grains, time, info = read("particles")
    grain_bounds = info.GetBounds()
    if info.GetNumberOfPoints() > 0 and info.GetNumberOfCells() > 0:
        # Gaussian points are cheaper than glyphs but hide the size; spheres to scale.
        glyph = simple.Glyph(Input=grains, GlyphType="Sphere")
        glyph.ScaleArray = ["POINTS", "diameter"]
        glyph.ScaleFactor = 1.0
        glyph.GlyphMode = "All Points"
        glyph.GlyphType.ThetaResolution = glyph.GlyphType.PhiResolution = 8
        shown = simple.Show(glyph, view)
        simple.ColorBy(shown, ("POINTS", "diameter"))
        table, scale = bar("diameter, m", "diameter", shown)
        table.ApplyPreset("Viridis (matplotlib)", True)
        rescale(table, grains, "POINTS", "diameter", time)
        scale.WindowLocation = "Any Location"
        scale.Position, scale.ScalarBarLength = [0.89, 0.55], 0.3
        # Dust would be a tenth of a pixel: dots of fixed size in red.
        dust = simple.Threshold(Input=grains, Scalars=["POINTS", "diameter"])
        try:
            dust.LowerThreshold, dust.UpperThreshold = 0.0, DUST_DIAMETER
        except AttributeError:
            dust.ThresholdRange = [0.0, DUST_DIAMETER]
        dots = simple.Show(dust, view)
        dots.ColorArrayName = ["POINTS", ""]
        dots.SetRepresentationType("Points")
        dots.PointSize = 3.0
        dots.DiffuseColor = dots.AmbientColor = [0.8, 0.1, 0.3]
    walls, _, info = read("walls")
    if info.GetNumberOfCells() > 0:
        # Seen along y the surfaces stand on edge: lines draw the bodies.
        edges = simple.ExtractEdges(Input=walls)
        shown = simple.Show(edges, view)
        shown.ColorArrayName = ["POINTS", ""]
        shown.DiffuseColor = shown.AmbientColor = [0.25, 0.25, 0.25]
        shown.LineWidth = 2.0
    note = simple.Text(Text=f"t = {time:.3f} s")
    text = simple.Show(note, view)
    text.Color = [0.0, 0.0, 0.0]
    view.ViewTime = time
    box = bounds if bounds[1] > bounds[0] else grain_bounds
    middle = [0.5 * (box[0] + box[1]), 0.5 * (box[2] + box[3]), 0.5 * (box[4] + box[5])]
    view.CameraParallelProjection = 1
    middle[0] += 0.06 * (box[1] - box[0])  # room for the scales
    view.CameraFocalPoint = middle
    view.CameraPosition = [middle[0], middle[1] - 10.0, middle[2]]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.Render(view)
    view.CameraParallelScale = 0.58 * max(box[1] - box[0], box[5] - box[4])
    simple.SaveScreenshot(os.path.abspath(picture), view, ImageResolution=[1400, 1400])
    print(f"picture: {picture}", flush=True)
    # ParaView 5.11 may crash while it takes its windows apart; the picture is on disk.
    os._exit(0)


def record(folder, results):
    """One row per file at the end of the table."""
    from paraview import __version__ as version

    with open(os.path.join(folder, "summary.json"), encoding="utf-8") as file:
        summary = json.load(file)
    run = f"{summary['scenario']}, {summary['status']} at {summary['simulated_s']:.4g} s"
    if not summary.get("fluid_steps"):
        run += ", without fluid"
    os.makedirs(os.path.dirname(RECORD), exist_ok=True)
    is_new = not os.path.exists(RECORD)
    with open(RECORD, "a", encoding="utf-8") as file:
        if is_new:
            file.write(RECORD_HEAD)
        for kind, (facts, verdict) in results.items():
            name = STATE if kind == "state" else kind + ".xdmf"
            file.write(f"| {datetime.date.today()} | {version} | {run} | "
                       f"`{summary['state_sha256'][:12]}` | {name} | {facts} | {verdict} |\n")


def main():
    parser = argparse.ArgumentParser(description=__doc__,
                                     formatter_class=argparse.RawDescriptionHelpFormatter)
    parser.add_argument("folder")
    parser.add_argument("--frames", type=int, help="how many frames there must be")
    parser.add_argument("--picture", help="render the last frame into this PNG")
    parser.add_argument("--state-picture", help="keep what the state shows in this PNG")
    parser.add_argument("--record", action="store_true",
                        help="add the result to docs/validation/paraview.md")
    parser.add_argument("--only", choices=sorted(EXPECTED) + ["picture", "state"], help=argparse.SUPPRESS)
    arguments = parser.parse_args()
    folder = os.path.abspath(arguments.folder)
    if arguments.only == "state":
        check_state(folder, arguments.state_picture)
    if arguments.only == "picture":
        render(folder, arguments.picture)
    if arguments.only:
        sys.exit(check_file(os.path.join(folder, arguments.only + ".xdmf"), arguments.frames))
    failed = []
    results = {}

    def run_part(part, options):
        command = ["pvpython", os.path.abspath(__file__), folder, "--only", part] + options
        result = subprocess.run(command, capture_output=True, text=True)
        lines = result.stdout.splitlines()
        facts = [line[len("result "):] for line in lines if line.startswith("result ")]
        sys.stdout.write("".join(line + "\n" for line in lines if not line.startswith("result ")))
        sys.stderr.write(result.stderr)
        is_bad = (result.returncode != 0 or "ERR|" in result.stderr
                  or "XDMF Error" in result.stderr)
        if is_bad:
            print(f"FAIL {part}", file=sys.stderr)
            failed.append(part)
        known = facts[0].split(" | ", 1)[1] if facts else "– | –"
        results[part] = (known, "fails" if is_bad else "ok")

    for kind in EXPECTED:
        path = os.path.join(folder, kind + ".xdmf")
        if not os.path.exists(path):
            print(f"FAIL {kind}: no {path}", file=sys.stderr)
            failed.append(kind)
            results[kind] = ("0 | no file", "fails")
            continue
        run_part(kind, [] if arguments.frames is None else ["--frames", str(arguments.frames)])
    picture = ["--state-picture", arguments.state_picture] if arguments.state_picture else []
    run_part("state", picture)
    if arguments.record:
        record(folder, results)
    if arguments.picture:
        run_part("picture", ["--picture", arguments.picture])
        if not os.path.exists(arguments.picture):
            print("FAIL picture: not written", file=sys.stderr)
            failed.append("picture")
    print("failed: " + ", ".join(failed) if failed else "ok: ParaView reads all three files and the state")
    sys.exit(1 if failed else 0)


if __name__ == "__main__":
    main()
