#!/usr/bin/env python3
"""The pages of an installed prefix: each file that they link to is there."""

import re

from prefix import Prefix, arguments, check

LINK = re.compile(r"\]\(([^)\s#]+)(?:#[^)]*)?\)|src=\"([^\"]+)\"")

with Prefix(arguments()) as prefix:
    pages = prefix.path / "share/doc/dust"
    broken, count = [], 0
    for page in sorted(pages.rglob("*.md")):
        text = re.sub(r"```.*?```", "", page.read_text(), flags=re.S)
        for found in LINK.finditer(text):
            link = found[1] or found[2]
            if re.match(r"[a-z]+:", link):
                continue
            count += 1
            if not (page.parent / link).exists():
                broken.append(f"{page.relative_to(pages)}: {link}")
    check(count > 500, f"only {count} links: where are the pages?")
    check(not broken, "links to what is not installed:\n" + "\n".join(broken))
    for page in ("docs/how_to/walls.md", "docs/tutorials/5_where_to_put_the_hood.md", "docs/result_files.md",
                 "scenarios/transfer_point.yaml"):
        check((pages / page).exists(), f"{page} is not installed")
