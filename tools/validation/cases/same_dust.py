"""The same dust as grains and as a field, set free at one place of the thesis's transfer point."""

import math

from runs import Plan

TITLE = "The same dust twice: free grains of 10 um and a field of 10 um"
BITS = ("transfer_point", "rare_sizes")
# Planes that the grains pass on their way out, and the side of the domain behind each.
WAYS = {"left": ("dust_out_below_belt", "dust_out_above_belt"), "right": ("dust_out_right",)}


def plans():
    return [Plan("same_dust", "dust/same_dust_twice.yaml")]


def shares(run):
    """By way out (share of the grains, share of the field, number of grains); None before the run has ended."""
    if not run.is_finished():
        return None
    s = run.summary
    freed = s["emitters"]["free"]["achieved"]
    field = s["dust_field"]["classes"]["10_um"]
    found = {}
    for side, planes in WAYS.items():
        passed = sum(sign * run.figure(plane, f"{way}/mass")[0] for plane in planes for way, sign in (("forward", 1), ("backward", -1)))
        found[side] = (passed / freed["mass_kg"], field["left_kg"].get(side, 0.0) / field["released_kg"], freed["computed"])
    gone = [sum(part[k] for part in found.values()) for k in (0, 1)]
    found["not yet out"] = (1 - gone[0], 1 - gone[1], freed["computed"])
    return found


def fill(page, runs):
    found = shares(runs["same_dust"])
    for way in (*WAYS, "not yet out"):
        what = f"share of what was set free, {'out at the ' + way if way in WAYS else way}"
        if found is None:
            page.add(f"{what}: grains", None, "-", why="the field's is judged by it")
            page.add(f"{what}: field less grains, in standard errors of the grains", None, "0", -3, 3)
            continue
        grains, field, number = found[way]
        error = math.sqrt(max(grains * (1 - grains), 1 / number) / number)
        page.add(f"{what}: grains", (grains, error), f"{field:.4g} as a field", why="the next row judges it")
        page.add(f"{what}: field less grains, in standard errors of the grains", (field - grains) / error, "0", -3, 3)
    page.note("10 um of sand are set free from 0.35 to 0.7 s in a box of one cell's height, 1 to 3.5 mm below the return run of the belt: 20,000 grains a second, "
              "each tracked, and as much as a concentration. The standard error is that of so many independent grains. They leave at planes 2 mm before "
              "the sides. Both are carried by the same air; the field has no inertia, does not bounce, and is smeared over its cells.")
    page.note("Set free between head pulley and stream instead, at x 130 to 150 mm and z 100 mm, both are alike until the stream takes them up (at 0.7 s, in "
              "tenths of the length of the domain: grains 0.203, 0.388, 0.191, 0.210 of what was set free, the field 0.205, 0.389, 0.187, 0.159 and 0.058 in "
              "the next). In the stream the grains are hit by sand and taken down with it, the field is not: 45 % of the grains and 61 % of the field are "
              "still in the domain at 1 s. `scavenging: true` of a dust field is there for that.")
