#!/usr/bin/env python3
"""The sources of the shipped models and of the templates are written in one way.

Somebody who copies a template, or reads a second model after a first one, finds the same things at
the same places: headers of the SDK in angle brackets; everything in an unnamed namespace that knows
the SDK as `sdk` and the model's own formulas as `formula`; Parameters, schema(), describe(),
constructor, in this order; names beside the values of ModelInfo; one DUST_PLUGIN at the end.

usage: plugin_sources_test.py SOURCE_FOLDER"""

import pathlib
import re
import sys

ORDER = ["struct Parameters", "static sdk::ParameterSchema schema()",
         "static sdk::ModelInfo describe()", "explicit "]
INFO = [".name =", ".version =", ".summary =", ".equation =", ".source ="]


def faults(path):
    text = path.read_text()
    if '"dust/sdk/' in text:
        yield "headers of the SDK stand in angle brackets"
    if "using namespace" in text:
        yield "no `using namespace`: say sdk::"
    if "\nnamespace {\n" not in text or "namespace sdk = dust::sdk;" not in text:
        yield "everything stands in an unnamed namespace with `namespace sdk = dust::sdk;`"
    if re.search(r"^namespace [\w:]+ \{", text, re.MULTILINE):
        yield "no named namespace: formulas of a header are `namespace formula = ...`"
    header = path.with_suffix(".hpp")
    if header.exists():
        own = re.search(r"^namespace ([\w:]+) \{", header.read_text(), re.MULTILINE)
        if own and f"namespace formula = {own[1]};" not in text:
            yield f"the formulas of {header.name} are known as `namespace formula = {own[1]};`"
    at = [text.find(mark) for mark in ORDER]
    if at[0] < 0:  # those of a base shared by several models
        at = at[1:]
    if min(at) < 0 or at != sorted(at):
        yield "order: Parameters, schema(), describe(), constructor"
    info = text[max(at[-2], 0):at[-1]]
    places = [info.find(mark) for mark in INFO]
    if min(places) < 0 or places != sorted(places):
        yield "describe() returns {.name, .version, .summary, .equation, .source}, by name"
    if re.search(r"\bModelInfo \w+;", text):
        yield "describe() returns its ModelInfo at once"
    if "parameters_" in text:
        yield "the member that keeps the parameters is p_"
    if not re.search(r"\}  // namespace\n\nDUST_PLUGIN\(registrar\) \{[^\n]*\}\n\Z", text):
        yield "DUST_PLUGIN ends the file"


root = pathlib.Path(sys.argv[1])
sources = [p for p in sorted((root / "plugins").glob("*/*/*.cpp")) if not p.name.endswith("_test.cpp")]
found = [f"{p.relative_to(root)}: {fault}" for p in sources for fault in faults(p)]
if len(sources) < 60:
    found.append(f"only {len(sources)} sources of models found")
print("\n".join(found))
sys.exit(1 if found else 0)
