// SPDX-License-Identifier: Apache-2.0
#include "io/paraview/paraview_state.hpp"

#include "base/text.hpp"

#include <nlohmann/json.hpp>

namespace dust::io {
namespace {

constexpr const char* k_head =
    R"py("""The run in ParaView: grains as spheres of their size, bodies, a slice of the air.

File > Load State in ParaView, or: paraview --script=paraview_state.py
"""
import os

from paraview import simple

)py";

constexpr const char* k_body = R"py(

def folder():
    """Where the run is: beside this file, or where it was written."""
    beside = os.path.dirname(os.path.abspath(globals().get("__file__", FOLDER + "/x")))
    for place in (beside, FOLDER):
        if os.path.exists(os.path.join(place, "particles.xdmf")):
            return place
    raise RuntimeError("particles.xdmf is not in " + FOLDER + ": correct FOLDER in this script")


def read(kind, name):
    reader = simple.XDMFReader(FileNames=[os.path.join(folder(), kind + ".xdmf")])
    simple.RenameSource(name, reader)
    reader.UpdatePipelineInformation()
    times = list(reader.TimestepValues) or [0.0]
    reader.UpdatePipeline(times[-1])
    return reader, times[-1], reader.GetDataInformation()


def colour(source, view, where, array, time, title, preset):
    """Colours by the size of an array over its range in the last frame."""
    shown = simple.Show(source, view)
    simple.ColorBy(shown, (where, array, "Magnitude") if array == "velocity" else (where, array))
    source.UpdatePipeline(time)
    data = source.PointData if where == "POINTS" else source.CellData
    high = max(abs(v) for c in range(data[array].GetNumberOfComponents())
               for v in data[array].GetRange(c))
    table = simple.GetColorTransferFunction(array)
    table.ApplyPreset(preset, True)
    if preset == "Blues":
        table.InvertTransferFunction()  # fast air dark
    table.RescaleTransferFunction(0.0, high or 1.0)
    bar = simple.GetScalarBar(table, view)
    bar.Title, bar.ComponentTitle = title, ""
    shown.SetScalarBarVisibility(view, True)
    return shown


def show_grains(view):
    grains, time, info = read("particles", "grains")
    if info.GetNumberOfCells() == 0:
        return time
    spheres = simple.Glyph(Input=grains, GlyphType="Sphere")
    simple.RenameSource("grains as spheres", spheres)
    spheres.ScaleArray = ["POINTS", "diameter"]
    spheres.ScaleFactor = 1.0
    spheres.GlyphMode = "All Points"
    resolution = 8 if info.GetNumberOfPoints() > 20000 else 16
    spheres.GlyphType.ThetaResolution = spheres.GlyphType.PhiResolution = resolution
    colour(spheres, view, "POINTS", "velocity", time, "grains, m/s", "Viridis (matplotlib)")
    return time


def show_bodies(view):
    bodies, _, info = read("walls", "bodies")
    if info.GetNumberOfCells() == 0:
        return
    shown = simple.Show(bodies, view)
    shown.ColorArrayName = ["POINTS", ""]
    shown.DiffuseColor = shown.AmbientColor = [0.55, 0.58, 0.62]
    shown.Opacity = 0.35
    # Surfaces that stand on edge are seen by their outlines alone.
    outlines = simple.FeatureEdges(Input=simple.ExtractSurface(Input=bodies))
    simple.RenameSource("outlines of bodies", outlines)
    lines = simple.Show(outlines, view)
    lines.ColorArrayName = ["POINTS", ""]
    lines.DiffuseColor = lines.AmbientColor = [0.15, 0.15, 0.15]
    lines.LineWidth = 2.0


def show_air(view, across):
    air, time, info = read("fluid", "air")
    if info.GetNumberOfCells() == 0:
        return
    middle = [0.5 * (a + b) for a, b in zip(MIN, MAX)]
    plane = simple.Slice(Input=air, SliceType="Plane")
    simple.RenameSource("slice of the air", plane)
    plane.SliceType.Origin = middle
    plane.SliceType.Normal = [float(d == across) for d in range(3)]
    speed = simple.Calculator(Input=plane, AttributeType="Cell Data",
                              ResultArrayName="air_speed", Function="mag(velocity)")
    simple.RenameSource("speed of the air", speed)
    outside = simple.Threshold(Input=speed, Scalars=["CELLS", "open_fraction"])
    simple.RenameSource("air outside bodies", outside)
    try:
        outside.LowerThreshold, outside.UpperThreshold = 0.5, 1.0
    except AttributeError:  # ParaView below 5.10
        outside.ThresholdRange = [0.5, 1.0]
    shown = colour(outside, view, "CELLS", "air_speed", time, "air, m/s", "Blues")
    if is_thin(across):  # behind the grains, so that it does not hide half of them
        shown.Position = [(MAX[d] - MIN[d]) * (d == across) for d in range(3)]


def is_thin(across):
    return MAX[across] - MIN[across] < 0.25 * min(MAX[d] - MIN[d] for d in range(3) if d != across)


def look(view, across):
    """From the side at a thin domain, else at a slant."""
    middle = [0.5 * (a + b) for a, b in zip(MIN, MAX)]
    towards = [0.0, 0.0, 0.0]
    towards[across] = -1.0 if across == 1 else 1.0
    if not is_thin(across):
        towards = [-0.6 if across == 1 else 1.0, -1.0 if across == 1 else -0.6, 0.6]
    extent = max(b - a for a, b in zip(MIN, MAX))
    view.CameraFocalPoint = middle
    view.CameraPosition = [m + 3.0 * extent * t for m, t in zip(middle, towards)]
    view.CameraViewUp = [0.0, 0.0, 1.0]
    simple.ResetCamera(view)


def main():
    view = simple.GetActiveViewOrCreate("RenderView")
    across = 1 if MAX[1] - MIN[1] <= MAX[0] - MIN[0] else 0
    time = show_grains(view)
    show_bodies(view)
    show_air(view, across)
    scene = simple.GetAnimationScene()
    scene.UpdateAnimationUsingDataTimeSteps()
    scene.AnimationTime = time
    view.ViewTime = time
    look(view, across)
    simple.Render(view)


main()
)py";

/// "[0.1, 2, 3]" as Python reads it.
std::string triple(sdk::Vec3 v) {
  return "[" + base::shortest_text(v.x) + ", " + base::shortest_text(v.y) + ", " +
         base::shortest_text(v.z) + "]";
}

}  // namespace

std::string paraview_state(const std::filesystem::path& folder, sdk::Vec3 min, sdk::Vec3 max) {
  // A JSON string is a Python string, whatever the folder is called.
  const std::string where = nlohmann::json(std::filesystem::absolute(folder).string()).dump();
  return k_head + ("FOLDER = " + where) + "\nMIN, MAX = " + triple(min) + ", " + triple(max) +
         "  # the domain [m]\n" + k_body;
}

}  // namespace dust::io
