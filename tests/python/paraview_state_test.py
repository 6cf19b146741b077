#!/usr/bin/env python3
"""paraview_state_test.py ENGINE SOURCE: what paraview_state.py of a run asks ParaView for, without ParaView: a stand-in for
paraview.simple notes every call. tools/dev/check_paraview.py runs the same script in ParaView itself."""

import os
import pathlib
import shutil
import subprocess
import sys
import tempfile
import types
import unittest
import xml.etree.ElementTree
from unittest.mock import MagicMock

ENGINE, SOURCE = sys.argv[1:3]
FOLDER = pathlib.Path(tempfile.mkdtemp(prefix="dust-paraview-"))


def setUpModule():
    scenario = SOURCE + "/tests/scenario/small_transfer.yaml"
    options = ["--threads", "1", "--quiet", "--set", "time.end=4 ms", "--set", "time.output_every=2 ms"]
    subprocess.run([ENGINE, "run", scenario, "-o", FOLDER / "a run's \"folder\"", *options], check=True, capture_output=True)


def tearDownModule():
    shutil.rmtree(FOLDER, ignore_errors=True)


class Simple(types.ModuleType):
    """Stands in for paraview.simple: readers know their XDMF file, all else takes anything."""

    def __init__(self):
        super().__init__("paraview.simple")
        self.names, self.files, self.shown, self.made = {}, [], [], []

    def __getattr__(self, name):
        if name.startswith("__"):
            raise AttributeError(name)

        def call(*arguments, **options):
            made = MagicMock(name=name)
            made.kind, made.options = name, options
            made.source = options.get("Input")
            for field in ("PointData", "CellData"):
                array = getattr(made, field).__getitem__.return_value
                array.GetNumberOfComponents.return_value = 3
                array.GetRange.side_effect = lambda c: (-2.0, 1.0 + c)
            self.made.append(made)
            return made
        return call

    def XDMFReader(self, FileNames):
        self.files += FileNames
        grids = xml.etree.ElementTree.parse(FileNames[0]).getroot().findall(".//Grid[@GridType='Uniform']")
        reader = MagicMock()
        reader.kind = "XDMFReader"
        reader.TimestepValues = [float(grid.find("Time").get("Value")) for grid in grids]
        topology = grids[-1].find("Topology")
        count = topology.get("NumberOfElements") or topology.get("Dimensions").split()[0]
        reader.GetDataInformation.return_value.GetNumberOfCells.return_value = int(count)
        reader.GetDataInformation.return_value.GetNumberOfPoints.return_value = int(count)
        return reader

    def RenameSource(self, name, source):
        self.names[name] = source

    def Show(self, source, view):
        self.shown.append(source)
        return MagicMock()


def load(folder, **variables):
    """The state as ParaView loads it."""
    simple = Simple()
    package = types.ModuleType("paraview")
    package.simple = simple
    path = pathlib.Path(folder, "paraview_state.py")
    before = {name: sys.modules.get(name) for name in ("paraview", "paraview.simple")}
    sys.modules.update({"paraview": package, "paraview.simple": simple})
    try:
        exec(compile(path.read_text(), str(path), "exec"), {"__name__": "__main__", **variables})
    finally:
        for name, module in before.items():
            if module is None:
                del sys.modules[name]
            else:
                sys.modules[name] = module
    return simple


class AState(unittest.TestCase):
    def setUp(self):
        self.folder = next(FOLDER.glob("a run*"))

    def test_opens_the_three_files_beside_it(self):
        simple = load(self.folder, __file__=str(self.folder / "paraview_state.py"))
        self.assertEqual(sorted(map(os.path.basename, simple.files)), ["fluid.xdmf", "particles.xdmf", "walls.xdmf"])
        self.assertEqual({os.path.dirname(f) for f in simple.files}, {str(self.folder)})

    def test_knows_its_folder_where_it_is_not_told(self):
        self.assertEqual({os.path.dirname(f) for f in load(self.folder).files}, {str(self.folder)})

    def test_goes_with_its_folder(self):
        moved = FOLDER / "moved"
        shutil.copytree(self.folder, moved)
        simple = load(moved, __file__=str(moved / "paraview_state.py"))
        self.assertEqual({os.path.dirname(f) for f in simple.files}, {str(moved)})

    def test_shows_grains_as_spheres_bodies_and_a_slice(self):
        simple = load(self.folder, __file__=str(self.folder / "paraview_state.py"))
        spheres = simple.names["grains as spheres"]
        self.assertEqual((spheres.kind, spheres.options["GlyphType"]), ("Glyph", "Sphere"))
        self.assertIs(spheres.source, simple.names["grains"])
        self.assertEqual((spheres.ScaleArray, spheres.ScaleFactor, spheres.GlyphMode), (["POINTS", "diameter"], 1.0, "All Points"))
        cut = simple.names["slice of the air"]
        self.assertEqual(cut.SliceType.Normal, [0.0, 1.0, 0.0])
        for name in ("grains as spheres", "bodies", "outlines of bodies", "air outside bodies"):
            self.assertTrue(any(simple.names[name] is source for source in simple.shown), name)

    def test_says_what_to_do_where_the_files_are_gone(self):
        lone = FOLDER / "lone"
        lone.mkdir()
        text = (self.folder / "paraview_state.py").read_text()
        (lone / "paraview_state.py").write_text(text.replace(str(self.folder).replace('"', '\\"'), "/nowhere"))
        with self.assertRaisesRegex(RuntimeError, "correct FOLDER in this script"):
            load(lone, __file__=str(lone / "paraview_state.py"))


unittest.main(argv=sys.argv[:1])
