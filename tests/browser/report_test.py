#!/usr/bin/env python3
# SPDX-License-Identifier: Apache-2.0
"""Reports in a real headless browser: the page draws without a script error, asks nobody for anything,
shows the numbers of summary.json, can be read by everybody (axe-core: contrast, names, headings, keyboard), and
stays within its size. report.json is what its schema says.

    report_test.py ENGINE SOURCE

Exit status 77 (skipped) where there is no chromium: it is no dependency of the project."""
import html.parser
import json
import math
import pathlib
import re
import shutil
import subprocess
import sys
import tempfile

SKIPPED = 77
MOST_BYTES = 15e6  # of a page: what a mail still takes


def browser():
    for name in ("chromium", "chromium-browser", "google-chrome"):
        if shutil.which(name):
            return name
    print("skipped: no chromium on this machine (apt-get install chromium)")
    sys.exit(SKIPPED)


def run(*command):
    done = subprocess.run([str(c) for c in command], capture_output=True, text=True)
    if done.returncode != 0:
        sys.exit(f"{' '.join(map(str, command))}\nended with {done.returncode}:\n{done.stderr}")
    return done.stdout


SOFTWARE_GL = ["--use-angle=swiftshader", "--enable-unsafe-swiftshader", "--ignore-gpu-blocklist"]


def drawn(chromium, page, profile, graphics=("--disable-gpu",)):
    """The page's document after its scripts have run. Every name resolves to nothing: no request can
    succeed, and the log would tell of one that was tried."""
    profile.mkdir(exist_ok=True)
    log = profile / "log"
    command = [chromium, "--headless", "--no-sandbox", *graphics, "--disable-quic", "--no-first-run",
               "--disable-background-networking", "--disable-component-update", "--disable-sync",
               "--host-resolver-rules=MAP * ~NOTFOUND", f"--user-data-dir={profile}", "--enable-logging=stderr",
               "--virtual-time-budget=20000", "--window-size=1280,4000", "--dump-dom", page.as_uri()]
    with open(log, "w") as err:
        done = subprocess.run(command, stdout=subprocess.PIPE, stderr=err, text=True, timeout=240)
    # What the browser's software graphics say of their own speed is no matter of the page.
    console = [line for line in log.read_text(errors="replace").splitlines() if "CONSOLE" in line and "WebGL" not in line]
    return done.stdout, console


class Document(html.parser.HTMLParser):
    """Ids, text by element, the attributes of the root, what would be fetched, and sections with
    nothing but their heading."""

    def __init__(self):
        super().__init__()
        self.root, self.ids, self.fetched, self.rows = {}, set(), [], []
        self.cells, self.in_cell = None, False
        self.text, self.empty, self.silent = "", [], None
        self.section, self.in_heading = None, False  # section: [name, has content]
        self.canvases, self.has_svg = {}, False

    def handle_starttag(self, tag, attributes):
        attributes = dict(attributes)
        if tag == "html":
            self.root = attributes
        if tag in ("script", "style"):
            self.silent = tag
        if tag == "section" and "hidden" not in attributes:
            self.section = [attributes.get("id", "?"), False]
        if tag == "h2":
            self.in_heading = True
        if tag == "canvas" and self.section:
            self.section[1] = True
            self.canvases.setdefault(self.section[0], 0)
            self.canvases[self.section[0]] += 1
        if tag == "svg":
            self.has_svg = True
        if "id" in attributes:
            self.ids.add(attributes["id"])
        for key in ("src", "href", "data", "poster", "srcset"):
            value = attributes.get(key)
            # A link is followed by the reader, not fetched by the page.
            if value and tag != "a" and not value.startswith(("#", "data:")):
                self.fetched.append(f"<{tag} {key}={value}>")
        if tag == "tr":
            self.cells = []
        if tag in ("td", "th") and self.cells is not None:
            self.cells.append("")
            self.in_cell = True

    def handle_endtag(self, tag):
        if tag == self.silent:
            self.silent = None
        if tag == "h2":
            self.in_heading = False
        if tag == "section" and self.section:
            if not self.section[1]:
                self.empty.append(self.section[0])
            self.section = None
        if tag in ("td", "th"):
            self.in_cell = False
        if tag == "tr" and self.cells is not None:
            self.rows.append(self.cells)
            self.cells = None

    def handle_data(self, data):
        if not self.silent:
            self.text += data
            if self.section and not self.in_heading and data.strip():
                self.section[1] = True
        if self.in_cell and self.cells:
            self.cells[-1] += data


def check(condition, text):
    if not condition:
        sys.exit("FAILED: " + text)


AUDIT = """<script>{axe}</script><script>
(async () => {{
  await new Promise((done) => setTimeout(done, 2000));
  if ('{theme}' === 'dark') Dust.set_theme('dark');
  for (const part of document.querySelectorAll('details')) part.open = true;
  await new Promise((done) => setTimeout(done, 1500));
  const graph = document.querySelector('#graph-picture');
  if (graph) document.documentElement.dataset.graph = graph.querySelectorAll('canvas').length;
  const {{violations}} = await axe.run(document, {{resultTypes: ['violations']}});
  document.documentElement.dataset.violations = JSON.stringify(violations.map((v) => [v.id, v.help, v.nodes[0].html.slice(0, 120)]));
}})();
</script></body>"""


def check_access(chromium, page, source, theme):
    """No rule of axe-core is broken, whatever the theme, with everything folded out."""
    axe = (source / "third_party/axe/axe.min.js").read_text()
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "audit.html"
        copy.write_text(page.read_text().replace("</body>", AUDIT.format(axe=axe, theme=theme)))
        text, _ = drawn(chromium, copy, pathlib.Path(folder) / "profile", SOFTWARE_GL)
    document = Document()
    document.feed(text)
    found = document.root.get("data-violations")
    name = f"{page.parent.name}/{page.name}, {theme}"
    check(found is not None, f"{name}: the audit did not come to its end")
    check(json.loads(found) == [], f"{name}: {found}")
    check("data-errors" not in document.root, f"{name}: {document.root.get('data-errors')}")
    check(document.root.get("data-graph", "1") == "1", f"{name}: the task graph is not drawn when it is opened")


# Looks at the picture in three dimensions before and after keys: how many pixels are painted, how many changed.
PROBE = """<script>
(async () => {
  const wait = (ms) => new Promise((done) => setTimeout(done, ms));
  for (let k = 0; k < 40 && document.documentElement.dataset.drawn !== 'yes'; ++k) await wait(100);
  const figure = document.getElementById('space'), first = !figure.hidden;
  await Dust.space.choose('space');
  const canvas = figure.querySelector('canvas');
  const pixels = () => {
    const copy = Dust.el('canvas', {width: canvas.width, height: canvas.height}), pen = copy.getContext('2d');
    pen.drawImage(canvas, 0, 0);
    return pen.getImageData(0, 0, copy.width, copy.height).data;
  };
  const differing = (a, b) => a.reduce((n, v, k) => n + (v !== b[k]), 0);
  const before = pixels(), seen = {first, painted: before.filter((v, k) => k % 4 === 3 && v > 0).length, label: canvas.getAttribute('aria-label')};
  for (const key of ['ArrowLeft', '+', 'Home']) {
    const last = pixels();
    canvas.dispatchEvent(new KeyboardEvent('keydown', {key, bubbles: true}));
    seen[key] = differing(last, pixels());
  }
  seen.whole = differing(before, pixels());
  const cut = document.getElementById('space-cut'), last = pixels();
  cut.value = cut.querySelector('[value=all]') ? 'all' : 'bodies';
  cut.dispatchEvent(new Event('input'));
  seen.cut = differing(last, pixels());
  document.documentElement.dataset.space = JSON.stringify(seen);
})();
</script></body>"""


def check_space(chromium, page, is_first):
    """In three dimensions something is painted, keys turn and look closer, Home goes back, the cut takes away."""
    with tempfile.TemporaryDirectory() as folder:
        copy = pathlib.Path(folder) / "space.html"
        copy.write_text(page.read_text().replace("</body>", PROBE))
        text, console = drawn(chromium, copy, pathlib.Path(folder) / "profile", SOFTWARE_GL)
    document = Document()
    document.feed(text)
    name = f"{page.parent.name}/{page.name} in three dimensions"
    check("data-errors" not in document.root, f"{name}: {document.root.get('data-errors')}")
    check("data-space" in document.root, f"{name}: the probe did not come to its end; the console says {console}")
    seen = json.loads(document.root["data-space"])
    check(seen["first"] == is_first, f"{name}: {'not ' if is_first else ''}shown first")
    check(seen["painted"] > 2000, f"{name}: {seen['painted']} pixels are painted")
    check(all(seen[key] > 500 for key in ("ArrowLeft", "+", "Home", "cut")), f"{name}: keys and cut change {seen}")
    check(seen["whole"] == 0, f"{name}: Home does not go back")
    check("seen from" in seen["label"] and ("grains" in seen["label"] or "set-up" in seen["label"]), f"{name}: says only '{seen['label']}'")


def check_stream(chromium, run_folder, source):
    """Quantiles of a stream are drawn as its path: a canvas with its numbers and picture to take away."""
    data = json.loads((run_folder / "report.json").read_text())
    part = lambda value: {"value": value, "error": 0.001}
    data["stream"] = [{"sensor": "stream", "drop": h, "low": part(0.7 * h ** 0.5 - 0.01), "median": part(0.7 * h ** 0.5), "high": part(0.7 * h ** 0.5 + 0.01)} for h in (0.02, 0.05, 0.1)]
    folder = run_folder.parent / "stream"
    folder.mkdir()
    (folder / "report.json").write_text(json.dumps(data))
    subprocess.run([source / "tools/report/watch", folder, "--once", folder / "report.html"], check=True)
    _, document = check_page(chromium, folder / "report.html")
    check(document.canvases.get("stream", 0) == 1, "the path of the stream is not drawn")
    check("5\u202f%" in document.text and "free flight" in document.text, "the path of the stream has no key")
    check_access(chromium, folder / "report.html", source, "light")


def check_document(folder, source):
    """report.json is what the schema says."""
    try:
        import jsonschema
    except ImportError:
        print("report.json is not held against its schema: no python3-jsonschema")
        return
    schema = json.loads((source / "tools/report/report.schema.json").read_text())
    faults = [e.message[:200] for e in jsonschema.Draft7Validator(schema).iter_errors(json.loads((folder / "report.json").read_text()))]
    check(not faults, f"{folder.name}/report.json: {faults}")


def check_page(chromium, page):
    with tempfile.TemporaryDirectory() as profile:
        text, console = drawn(chromium, page, pathlib.Path(profile))
    document = Document()
    document.feed(text)
    name = page.parent.name + "/" + page.name
    check("data-errors" not in document.root, f"{name}: {document.root.get('data-errors')}")
    check(document.root.get("data-drawn") == "yes", f"{name}: the scripts did not come to their end")
    check(not console, f"{name}: the console says {console}")
    check(not document.fetched, f"{name} would fetch {document.fetched}")
    check(not document.empty, f"{name}: nothing in the sections {document.empty}")
    odd = re.search(r".{0,40}\b(nan|NaN|undefined|null|Infinity)\b.{0,40}", document.text)
    check(not odd, f"{name} says '{odd.group(0) if odd else ''}'")
    check(not document.has_svg, f"{name} draws SVG by hand")
    check(page.stat().st_size < MOST_BYTES, f"{name} has {page.stat().st_size} bytes")
    return text, document


def check_figures(folder, document):
    """Every figure of every sensor stands on the page, unrounded to nine digits."""
    summary = json.loads((folder / "summary.json").read_text())
    words = lambda s: re.sub(r" um(?=$|/| )", " \u00b5m", s.replace("_", " ")).replace("/", " / ")
    shown = {}
    for row in document.rows:
        if len(row) == 3:
            shown.setdefault(row[0].strip(), []).append(row[2])
    for sensor, figures in summary["sensors"].items():
        for name, figure in figures.items():
            value = figure["value"]
            if value is None or not math.isfinite(value):
                continue
            check(words(name) in shown, f"{folder.name}: {sensor} {name} is not on the page")
            texts = [float(t.split()[0]) for t in shown[words(name)] if t.strip()]
            check(any(t == float(f"{value:.9g}") for t in texts), f"{folder.name}: {sensor} {name}: {value} is not among {texts}")


def main():
    engine, source = sys.argv[1], pathlib.Path(sys.argv[2])
    chromium = browser()
    scenarios = source / "tests" / "scenario"
    with tempfile.TemporaryDirectory() as folder:
        folder = pathlib.Path(folder)
        transfer = scenarios / "small_transfer.yaml"
        runs = {
            "transfer": [transfer, "--set", "time.end=0.02 s"],
            "grains": [scenarios / "small_hourglass.yaml", "--set", "time.end=0.03 s"],
            # Air alone: frames without a grain.
            "air": [transfer, "--set", "time.end=0.02 s", "--set", "emitters.feed.begin=1 s"],
            # Numbers and a curve from elsewhere.
            "settling": [source / "scenarios/thesis/settling_air_to_water.yaml", "--set", "time.end=0.02 s"],
        }
        for name, arguments in runs.items():
            run(engine, "run", *arguments, "-o", folder / name, "--quiet", "--threads", "1")
            text, document = check_page(chromium, folder / name / "report.html")
            check_figures(folder / name, document)
            check_document(folder / name, source)
            check(("speed-picture" in document.ids) == (name != "grains"), f"{name}: the map of the air")
            check("<canvas" in text, f"{name}: no picture was drawn")
            # The side view and the maps of speed and pressure give their numbers.
            check(text.count(' as CSV"') >= (1 if name == "grains" else 2), f"{name}: pictures without their numbers")
            check(("line dashed" in text) == (name == "settling"), f"{name}: curves from elsewhere")
            print(f"{name}: {(folder / name / 'report.html').stat().st_size} bytes, {len(document.rows)} rows")
        check_space(chromium, folder / "transfer" / "report.html", False)
        check_space(chromium, folder / "grains" / "report.html", True)
        for theme in ("light", "dark"):
            check_access(chromium, folder / "transfer" / "report.html", source, theme)
        check_access(chromium, folder / "grains" / "report.html", source, "light")  # in three dimensions
        check_stream(chromium, folder / "transfer", source)
        setup = folder / "setup" / "setup.html"
        setup.parent.mkdir()
        run(engine, "check", transfer, "-o", setup)
        text, document = check_page(chromium, setup)
        check(document.canvases.get("setting", 0) == 1 and document.canvases.get("space-section", 0) == 1, f"the set-up is not drawn: {document.canvases}")
        check("conveyor of belt" in document.text, "the set-up does not tell what its bodies are")
        check_space(chromium, setup, True)
        for theme in ("light", "dark"):
            check_access(chromium, setup, source, theme)
        both = folder / "both" / "compare.html"
        both.parent.mkdir()
        table = run(engine, "compare", folder / "transfer", folder / "air", "-o", both)
        check("emitters.feed.begin" in table, f"the comparison does not tell the difference:\n{table}")
        text, document = check_page(chromium, both)
        check(text.count("<canvas") >= 3, "the comparison shows no pictures")
        run(engine, "study", source / "tests/study/drop_study.yaml", "-o", folder / "study", "--quiet")
        text, document = check_page(chromium, folder / "study" / "report.html")
        check(text.count("<canvas") >= 3, "the study shows no effects")
        check(document.text.count("finished") >= 8, "the study does not list its points")
        check_access(chromium, folder / "study" / "report.html", source, "light")
        check_access(chromium, both, source, "light")


main()
