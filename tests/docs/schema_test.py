#!/usr/bin/env python3
"""`engine schema` against the meta-schema of draft-07, and every shipped scenario against it. Each
scenario names the schema in its first line, for editors."""

import json
import os
import pathlib
import re
import subprocess
import sys

root = pathlib.Path(sys.argv[1])
environment = {k: v for k, v in os.environ.items() if k != "DUST_PLUGIN_PATH"}


def schema_of(*options):
    return json.loads(subprocess.run([sys.argv[2], "schema", *options], check=True, text=True,
                                     capture_output=True, env=environment).stdout)


schema = schema_of()
study_schema = schema_of("--study")

def is_study(file):
    return re.search(r"^base:", file.read_text(), re.M) is not None


failed = []
scenarios = sorted((root / "scenarios").rglob("*.yaml"))
for scenario in scenarios:
    first = scenario.read_text().split("\n", 1)[0]
    mark = "# yaml-language-server: $schema="
    named = (scenario.parent / first[len(mark):]).resolve()
    wanted = "study" if is_study(scenario) else "scenario"
    if not first.startswith(mark) or named != (root / f"scenarios/{wanted}.schema.json").resolve():
        failed.append(f"{scenario}: the first line does not name scenarios/{wanted}.schema.json")
if not scenarios:
    failed.append("no scenarios found")

try:
    import jsonschema
    import yaml
except ImportError as problem:
    print("\n".join(failed) or f"skipped the validation: {problem} (python3-jsonschema, python3-yaml)")
    sys.exit(1 if failed else 77)

jsonschema.Draft7Validator.check_schema(schema)
jsonschema.Draft7Validator.check_schema(study_schema)
validator = jsonschema.Draft7Validator(schema)
study_validator = jsonschema.Draft7Validator(study_schema)


class Loader(yaml.SafeLoader):
    """YAML 1.2 as the engine reads it: yes, no, on and off are words; 1e-3 is a number."""


Loader.yaml_implicit_resolvers = {
    key: [(tag, pattern) for tag, pattern in resolvers
          if tag not in ("tag:yaml.org,2002:bool", "tag:yaml.org,2002:float",
                         "tag:yaml.org,2002:timestamp")]
    for key, resolvers in yaml.SafeLoader.yaml_implicit_resolvers.items()}
Loader.add_implicit_resolver("tag:yaml.org,2002:bool", re.compile(r"^(true|false)$"), list("tf"))
Loader.add_implicit_resolver(
    "tag:yaml.org,2002:float",
    re.compile(r"^[-+]?(\.\d+|\d+(\.\d*)?)([eE][-+]?\d+)?$"), list("-+.0123456789"))


def problems(document, of=validator):
    return [f"{'.'.join(map(str, e.absolute_path))}: {e.message[:200]}"
            for e in of.iter_errors(document)]


for scenario in scenarios:
    document = yaml.load(scenario.read_text(), Loader)
    judge = study_validator if is_study(scenario) else validator
    failed += [f"{scenario}: {p}" for p in problems(document, judge)]

# It refuses what the engine refuses: a schema that allows everything is none.
whole = yaml.load((root / "scenarios/transfer_point.yaml").read_text(), Loader)
for change in (lambda d: d.update(viscocity=1),
               lambda d: d["time"].pop("end"),
               lambda d: d["drag"].update(model="gidaspov"),
               lambda d: d["interactions"][0]["contact"].update(restitution=1.4),
               lambda d: d["domain"].update(min=[0, 0])):
    wrong = json.loads(json.dumps(whole))
    change(wrong)
    if not problems(wrong):
        failed.append("the schema accepts a scenario that is wrong")
print("\n".join(failed) or f"{len(scenarios)} scenarios are valid")
sys.exit(1 if failed else 0)
