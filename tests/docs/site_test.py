#!/usr/bin/env python3
"""site_test.py ROOT: the site that tools/dev/build_site makes: search, formulas, the API, links that lead somewhere."""

import html.parser
import json
import pathlib
import re
import subprocess
import sys
import tempfile
import urllib.parse

ROOT = pathlib.Path(sys.argv[1])


class Links(html.parser.HTMLParser):
    """What the article of a page links to and shows."""

    def __init__(self, text):
        super().__init__()
        self.found, self.depth = [], 0
        self.feed(text)

    def handle_starttag(self, tag, attributes):
        self.depth += tag == "article"
        if self.depth:
            self.found += [value for name, value in attributes if name in ("href", "src") and value]

    def handle_endtag(self, tag):
        self.depth -= tag == "article"


def links(site):
    for page in sorted(site.rglob("*.html")):
        # Pages of the API have no article: Doxygen links them.
        if {"assets", "api"} & set(page.relative_to(site).parts) or page.name == "404.html":
            continue
        for link in Links(page.read_text()).found:
            target = urllib.parse.unquote(link.split("#")[0])
            if not target or "://" in target or target.startswith(("mailto:", "data:")):
                continue
            yield page.parent.joinpath(target), f"{page.relative_to(site)}: {link}"


def api_problems(site):
    """What a reader of the API would miss: the models' base classes, their formulas, the way there."""
    api = site / "api"
    if "api/index.html" not in (site / "index.html").read_text():
        yield "index.html does not lead to the API"
    for name, words in (("classdust_1_1sdk_1_1DragLaw.html", ("Public Member Functions", "DragLaw")),
                        ("classdust_1_1sdk_1_1ContactLaw.html", ("Public Member Functions",)),
                        ("classdust_1_1fluid_1_1FluidSolver.html", ("FluidSolver",))):
        text = (api / name).read_text() if (api / name).exists() else ""
        if missing := [word for word in words if word not in text]:
            yield f"api/{name} lacks {', '.join(missing)}"
    formulas = [page for page in api.glob("*.html") if "\\(" in page.read_text(errors="replace")]
    if not formulas:
        yield "no page of the API has a formula"
    for page in formulas[:1]:
        script = re.search(r'src="([^"]*MathJax\.js)', page.read_text(errors="replace"))
        if not script or not (api / script[1]).exists():
            yield f"api/{page.name}: its formulas have no MathJax"


def main():
    with tempfile.TemporaryDirectory() as folder:
        site = pathlib.Path(folder) / "site"
        done = subprocess.run([ROOT / "tools/dev/build_site", "-o", site], text=True, capture_output=True)
        if done.returncode:
            print(done.stdout + done.stderr)
            sys.exit(done.returncode)
        found = list(links(site))
        problems = [f"{said} leads nowhere" for target, said in found if not target.exists()]
        entries = json.loads((site / "search" / "search_index.json").read_text())["docs"]
        if not any("Janssen" in entry["text"] for entry in entries):
            problems.append("a search for Janssen would find nothing")
        problems += api_problems(site)
        if "arithmatex" not in (site / "docs" / "theory" / "fluid.html").read_text():
            problems.append("docs/theory/fluid.html has no formulas")
        print(f"{len(entries)} entries to search, {len(found)} links, {len(problems)} problems")
        print("\n".join(problems))
        sys.exit(1 if problems else 0)


if __name__ == "__main__":
    main()
