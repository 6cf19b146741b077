"""A bed of sand in an upright tube, and scenarios round it, for both codes."""

ALIKE = {"coefficientRestitution": (0.9,) * 3, "coefficientFriction": (0.52,) * 3,
         "coefficientRollingFriction": (0.3,) * 3}
SETTLED = dict.fromkeys(("sand", "glass"), (0.9, 0.52, 0.3))
OPEN = "{grains: open}"
WALL = "{grains: wall, material: glass}"


def read_bed(path):
    with open(path) as lines:
        next(lines)
        return [(*map(float, line.split(",")), 0.0, 0.0, 0.0) for line in lines]


def scenario(domain, grains_at, bodies, interactions):
    """Sand, belt and glass of one elasticity; `grains_at`: what each side does with grains."""
    sides = ["left", "right", "front", "back", "bottom", "top"]
    material = "{density: 2650, young_modulus: 50 MPa, poisson_ratio: 0.3}"
    rows = [f"domain: {{min: {domain[0]}, max: {domain[1]}, boundaries: {{" +
            ", ".join(f"{s}: {g}" for s, g in zip(sides, grains_at)) + "}}",
            "gravity: [0, 0, -9.81]", "fluid: none",
            "materials: {" + ", ".join(f"{m}: {material}" for m in ("sand", "belt", "glass")) + "}",
            "interactions:"]
    for other, (e, mu, mu_r) in interactions.items():
        rows.append(f"  - {{between: [sand, {other}], contact: {{model: hertz_mindlin, "
                    f"restitution: {e}, friction: {mu}}}, rolling: {{model: epsd2, friction: {mu_r}}}}}")
    return "\n".join(rows + bodies) + "\n"


def tube_of(grains):
    """Radius of the upright tube a bed has settled in, round the z axis from z = 0 up: that of its outermost
    grain to 0.1 mm, for a grain at rest is pressed into the wall by much less."""
    return round(max((g[1] ** 2 + g[2] ** 2) ** 0.5 + g[0] / 2 for g in grains), 4)


def in_tube(grains, below):
    """Domain and tube of glass round a bed, for both codes; the domain goes on `below` z = 0 [m]."""
    radius, top = tube_of(grains), max(g[3] + g[0] / 2 for g in grains)
    box = ([-radius - 2e-3, -radius - 2e-3, -below], [radius + 2e-3, radius + 2e-3, top + 0.01])
    body = (f"  tube: {{shape: cylinder, material: glass, base: [0, 0, {-min(below, 2e-3)}], axis: [0, 0, 1], "
            f"length: {top + min(below, 2e-3) + 0.011}, radius: {radius!r}, thickness: 1 mm}}")
    return box, body, f"fix tube all wall/gran {{law}} primitive type 1 zcylinder {radius:.10g} 0 0"
