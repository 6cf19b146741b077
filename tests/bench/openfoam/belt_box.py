"""The belt box as a case for OpenFOAM's pisoFoam: our air_step_bench in its words."""

HEADER = """FoamFile
{{
    version     2.0;
    format      ascii;
    class       {kind};
    object      {name};
}}
"""
NU = 1.8e-5 / 1.2139

# Corners in x and z of the box without the belt in its lower left corner, and the cells between.
X = (0.0, 0.08, 0.33)
Z = (0.0, 0.2, 0.35)
CELLS_X = (64, 200)
CELLS_Z = (160, 120)
DEPTH = 0.011

CONTROL = """application pisoFoam;
startFrom startTime;
startTime 0;
stopAt endTime;
endTime {end};
deltaT 1e-3;
writeControl timeStep;
writeInterval 100000;
writeFormat binary;
timePrecision 8;
runTimeModifiable false;
"""
SCHEMES = """ddtSchemes { default Euler; }
gradSchemes { default Gauss linear; }
divSchemes { default none; div(phi,U) Gauss limitedLinear 1; div((nuEff*dev2(T(grad(U))))) Gauss linear; }
laplacianSchemes { default Gauss linear orthogonal; }
interpolationSchemes { default linear; }
snGradSchemes { default orthogonal; }
"""
# The tolerances of pisoFoam's own tutorials (cavity), with the multigrid for the pressure.
SOLUTION = """solvers
{
    p { solver GAMG; smoother GaussSeidel; tolerance 1e-6; relTol 0.05; }
    pFinal { $p; relTol 0; }
    "(U|UFinal)" { solver smoothSolver; smoother symGaussSeidel; tolerance 1e-5; relTol 0; }
}
PISO { nCorrectors 2; nNonOrthogonalCorrectors 0; pRefCell 0; pRefValue 0; }
"""


def blocks(across):
    """Three blocks round the belt, and their patches."""
    corner = {}
    lines = []
    for a, x in enumerate(X):
        for b, y in enumerate((0.0, DEPTH)):
            for c, z in enumerate(Z):
                corner[a, b, c] = len(lines)
                lines.append(f"    ({x} {y} {z})")

    def block(i, k):
        v = [corner[i + a, b, k + c] for c, order in ((0, ((0, 0), (1, 0), (1, 1), (0, 1))),
                                                      (1, ((0, 0), (1, 0), (1, 1), (0, 1))))
             for a, b in order]
        return (f"    hex ({' '.join(map(str, v))}) ({CELLS_X[i]} {across} {CELLS_Z[k]}) "
                "simpleGrading (1 1 1)")

    def face_x(i, k):
        return "({} {} {} {})".format(*(corner[i, b, k + c] for b, c in ((0, 0), (1, 0), (1, 1), (0, 1))))

    def face_z(i, k):
        return "({} {} {} {})".format(*(corner[i + a, b, k] for a, b in ((0, 0), (1, 0), (1, 1), (0, 1))))

    def face_y(i, k, b):
        return "({} {} {} {})".format(*(corner[i + a, b, k + c] for a, c in ((0, 0), (1, 0), (1, 1), (0, 1))))

    there = [(1, 0), (0, 1), (1, 1)]
    patches = {
        "left": ("patch", [face_x(0, 1)]),
        "right": ("patch", [face_x(2, 0), face_x(2, 1)]),
        "belt": ("wall", [face_z(0, 1)]),
        "walls": ("wall", [face_x(1, 0), face_z(1, 0), face_z(0, 2), face_z(1, 2)]),
        "front": ("empty" if across == 1 else "patch", [face_y(i, k, 0) for i, k in there]),
        "back": ("empty" if across == 1 else "patch", [face_y(i, k, 1) for i, k in there]),
    }
    boundary = "\n".join(f"    {name} {{ type {kind}; faces ({' '.join(faces)}); }}"
                         for name, (kind, faces) in patches.items())
    return ("scale 1;\nvertices\n(\n" + "\n".join(lines) + "\n);\nblocks\n(\n" +
            "\n".join(block(i, k) for i, k in there) + "\n);\nedges ();\nboundary\n(\n" + boundary +
            "\n);\nmergePatchPairs ();\n")


def write(folder, across, steps):
    """Writes the case into `folder`."""
    sides = "empty" if across == 1 else "slip"

    def file(path, kind, text):
        target = folder / path
        target.parent.mkdir(parents=True, exist_ok=True)
        target.write_text(HEADER.format(kind=kind, name=target.name) + text)

    file("system/blockMeshDict", "dictionary", blocks(across))
    file("system/controlDict", "dictionary", CONTROL.format(end=steps * 1e-3))
    file("system/fvSchemes", "dictionary", SCHEMES)
    file("system/fvSolution", "dictionary", SOLUTION)
    file("constant/transportProperties", "dictionary",
         f"transportModel Newtonian;\nnu [0 2 -1 0 0 0 0] {NU:.10g};\n")
    file("constant/turbulenceProperties", "dictionary", "simulationType laminar;\n")
    open_velocity = "{ type pressureInletOutletVelocity; value uniform (0 0 0); }"
    file("0/U", "volVectorField",
         "dimensions [0 1 -1 0 0 0 0];\ninternalField uniform (0 0 0);\nboundaryField\n{\n"
         f"    left {open_velocity}\n    right {open_velocity}\n"
         "    belt { type fixedValue; value uniform (0.8 0 0); }\n    walls { type noSlip; }\n"
         f"    front {{ type {sides}; }}\n    back {{ type {sides}; }}\n}}\n")
    open_pressure = "{ type totalPressure; p0 uniform 0; value uniform 0; }"
    file("0/p", "volScalarField",
         "dimensions [0 2 -2 0 0 0 0];\ninternalField uniform 0;\nboundaryField\n{\n"
         f"    left {open_pressure}\n    right {open_pressure}\n"
         "    belt { type zeroGradient; }\n    walls { type zeroGradient; }\n"
         f"    front {{ type {sides}; }}\n    back {{ type {sides}; }}\n}}\n")
