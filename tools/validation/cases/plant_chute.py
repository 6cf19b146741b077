"""The plant's transfer point in full: does it end in time, lose nothing, and what does it tell."""

import sys

from runs import ROOT, Plan

TITLE = "The plant's transfer point, with its dust, in full"
BITS = ("coarse_transfer", "mixer", "dust_field")
READS_FRAMES = True
FEED_ENDS = -0.8  # m, where the load lies still on belt 1
RATES = (("set_free/all", "set free from the load"), ("set_free/grains", "of that by grains on grains"), ("set_free/spoon", "of that by the spoon"),
         ("set_free/hood", "of that by the hood of belt 1"), ("left/back", "out under the curtain with belt 2"), ("drawn_out/top", "drawn out by the hood in the roof"))


def plans():
    return [Plan("plant_chute", "plant/transfer_chute.yaml")]


def at_feed(run):
    """Share of what has been set free that came off where the feed drops onto belt 1."""
    sys.path.append(str(ROOT / "tools/python"))
    import dust_results  # wants numpy and h5py, which nobody needs to list cases

    air = dust_results.Run(run.folder).air()
    fields = [air[f"dust_set_free_by_{cause}"] for cause in ("grains", "walls")]
    near = fields[0].centres("x") < FEED_ENDS
    return float(sum(f.values[..., near].sum() for f in fields) / sum(f.values.sum() for f in fields))


def fill(page, runs):
    run = runs["plant_chute"]
    s = run.summary if run.is_finished() else None
    page.add("wall time for 5.3 s on two threads [min]", s and s["wall_s"] / 60, "at most 30 on two cores", None, 30)
    page.add("largest error of the balance of a class of dust, in the air and on grains",
             s and max(abs(c["balance_error"]) for part in ("dust_field", "dust_on_grains") for c in s[part]["classes"].values()), "0", None, 1e-12)
    page.add("steady stream observed [s]", s and s["dust_rates"]["observed"]["value"], "3", 3)
    for name, text in RATES:
        figure = s and s["dust_rates"].get(f"{name}/per_load")
        page.add(f"dust {text} [g/t]", figure and (figure["value"], figure["uncertainty"]), "-", why="no plant of these dimensions was measured")
    page.add(f"share of it, since the start, that comes off where the feed drops onto belt 1 (x below {FEED_ENDS} m)", s and at_feed(run), "-",
             why="the scenario's own: a plant has its feed elsewhere")
    page.note("500 t/h of limestone, 8 to 60 mm, 0.9 % of it dust of three classes at 1 % of moisture; binding energy of AP-42's drop, 3.3 MJ/kg; 68 x 52 x 60 "
              "cells of 50 mm. One standard error from batch means; a figure without one has not settled in the time observed.")
