"""What the thesis names in 7.2 as still to be done, each as a study of a scenario at the plant's size, with what comes out."""

import dataclasses
import fnmatch

import chart
import study_runs
from cases.hood_capture import COARSE
from page import FOLDER, bits_line
from runs import ROOT

TITLE = "The thesis's outlook, 7.2, at the size of a plant"
BITS = ("coarse_transfer", "mixer", "dust_field")
SCENARIOS = ROOT / "scenarios"
CHUTE = {**COARSE, "time.end": "5.3 s"}


@dataclasses.dataclass
class Part:
    number: str
    title: str
    study: str        # in scenarios/
    figures: tuple    # outputs that are drawn; of one unit
    along: str        # what they are, with their unit
    settings: dict    # on top of the study's own
    text: str


PARTS = (
    Part("7.2.1", "Wind from any side at real size", "plant/chamber_wind", ("set_free", "out_all"), "dust [g/t]", CHUTE,
         "500 t/h fall from belt 1 through hood and spoon onto belt 2 in an open chamber: what is set free, and what a wind of 2 or 4 m/s takes "
         "out of the domain, by its direction."),
    Part("7.2.2", "Idlers that vibrate", "plant/idlers_shake", ("fines_up",), "middle of the fines above that of the lumps [mm]", {},
         "A piece of belt and load, shaken by 1 mm at 25 Hz or not: the fines sink."),
    Part("7.2.4", "Belt scraper", "plant/scraper_or_none", ("carried_back",), "carried back [% of the load]", {},
         "Moist fines of 3 mm stick to the belt behind the head pulley; a blade takes them off."),
    Part("7.2.5", "Belt surface: cleats", "plant/cleats_or_none", ("carried",), "carried up [kg]", {},
         "A belt of 30 degrees with crossbars of 80 mm and without: what passes 1.3 m beyond the feed."),
    Part("7.2.5", "Belt surface: waves", "plant/waves_or_none", ("carried",), "carried up [kg]", {},
         "The same belt with a surface of waves of 20 mm every 80 mm, and smooth."),
    Part("7.2.6", "Cohesive material: moisture", "studies/wet_slope", ("angle",), "slope that stays [deg]", {},
         "Grains of 6 mm in a box whose bottom opens at a slot; their moisture makes liquid bridges."),
    Part("7.2.7", "Extraction and the receiving belt", "plant/receiving_belt", ("load",), "load [kg/m]", CHUTE,
         "The transfer chute over the speed of the receiving belt and the flow drawn out of its roof."),
)


def plans():
    return []


def study_of(part, folder):
    """The study on absolute paths, with the part's settings in every point."""
    import yaml

    shipped = SCENARIOS / f"{part.study}.yaml"
    study = yaml.safe_load(shipped.read_text())
    study["base"] = str(shipped.parent / study["base"])
    study["set"] = {**study.get("set", {}), **{path: yaml.safe_load(value) for path, value in part.settings.items()}}
    folder.mkdir(parents=True, exist_ok=True)
    file = folder / shipped.name
    file.write_text(yaml.safe_dump(study, sort_keys=False))
    return file


def inputs_of(row):
    """Columns of what is varied: all between the point's number and the replicate's."""
    columns = list(row)
    return columns[columns.index("point") + 1:columns.index("replicate")]


def name_of(row):
    """What tells a row of a study's table from the others, with the last part of each input's name where there are several."""
    inputs = inputs_of(row)
    if len(inputs) == 1:
        return row[inputs[0]]
    return ", ".join(f"{column.split(' ')[0].rsplit('.', 1)[-1]} {row[column]}" for column in inputs)


def mean_of(rows, output):
    """Mean of a figure over the replicates of a point; None where one is missing."""
    column = next((c for c in rows[0] if c.split(" ")[0] == output and "error" not in c), None)
    try:
        values = [float(row[column]) for row in rows]
    except (KeyError, ValueError):
        return None
    return sum(values) / len(values)


def section(args, part, number):
    file = study_of(part, args.runs / "outlook")
    folder = args.runs / f"outlook_{file.stem}"
    told, _ = study_runs.run(args, file, "-o", folder, *(["--resume"] if folder.exists() else []), allowed=(0, 1))
    rows = study_runs.table(folder)
    out = [f"## {part.number} {part.title}", "", part.text, ""]
    picture = FOLDER / "pictures" / f"outlook_{number}.svg"
    points = {}
    for row in rows:
        points.setdefault(name_of(row), []).append(row)
    chart.draw_bars(picture, part.title, part.along, list(points), {f: [mean_of(p, f) for p in points.values()] for f in part.figures})
    out += [f"![{part.title}](pictures/{picture.name})", ""]
    keep = [c for c in rows[0] if c not in ("point", "replicate", "hash", "status") and (c != "reason" or any(r["reason"] for r in rows))]
    out += ["| " + " | ".join(keep) + " |", "|" + " --- |" * len(keep)]
    out += ["| " + " | ".join(study_runs.rounded(r[c]) for c in keep) + " |" for r in rows]
    verdicts = [line for line in told if study_runs.verdict_of(line)]
    settings = "".join(f" `{path}: {value}`" for path, value in part.settings.items())
    return [*out, "", *(f"- {line}" for line in verdicts), "", f"`{command(part)}`" + (f", each point with{settings}" if settings else "") + ".", ""]


def command(part):
    return f"engine study scenarios/{part.study}.yaml"


def write(args):
    out = [f"# {TITLE}", "", study_runs.written_by("outlook", args.engine), "",
           "Section 7.2 of the thesis names what a table-top transfer point could not tell. Each part below is a scenario and a study that "
           "runs in minutes; the transfer chute itself, in full, is in [plant_chute](plant_chute.md) (7.2.3: enclosed), a hood where "
           "`engine suggest-hoods` puts it in [hood_capture](hood_capture.md) (7.2.7).", ""]
    for number, part in enumerate(PARTS, 1):
        is_wanted = any(fnmatch.fnmatch(part.study.split("/")[-1], pattern) for pattern in args.only)
        out += section(args, part, number) if is_wanted else [f"## {part.number} {part.title}", "", part.text + f" Not run: `{command(part)}`.", ""]
    study_runs.write_page("outlook", [*out, bits_line(args.engine.bits())])
