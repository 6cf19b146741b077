#!/usr/bin/env python3
"""publishing_test.py ROOT VERSION: what the hosting, packagers and containers read fits the sources:
versions, presets, package names, scripts. Exit status 1, one line per problem; 77 without PyYAML."""

import json
import pathlib
import re
import sys

try:
    import yaml
except ImportError:
    print("skipped: PyYAML (package python3-yaml) is needed")
    sys.exit(77)

ROOT = pathlib.Path(sys.argv[1])
VERSION = sys.argv[2]
THESIS = "10.4233/uuid:0d8c6401-fc4e-4b7b-babc-6eb9573d79b3"
# What CMake calls a package, and Spack.
SPACK = {"TBB": "tbb", "Eigen3": "eigen", "yaml-cpp": "yaml-cpp", "spdlog": "spdlog", "HDF5": "hdf5",
         "Boost": "boost", "CLI11": "cli11", "nlohmann_json": "nlohmann-json", "ZLIB": "zlib-api",
         "doctest": "doctest"}
problems = []


def check(is_right, file, what):
    if not is_right:
        problems.append(f"{file}: {what}")


def text(file):
    return (ROOT / file).read_text()


def citation():
    file = "CITATION.cff"
    cff = yaml.safe_load(text(file))
    for key in ("cff-version", "message", "title", "authors", "version", "license"):
        check(key in cff, file, f"has no {key}")
    check(str(cff["version"]) == VERSION, file, f"version {cff['version']}, the project has {VERSION}")
    check(cff["license"] == "Apache-2.0" and "Apache License" in text("LICENSE"), file, "another licence")
    thesis = cff["references"][0]
    check(thesis["doi"] == THESIS and thesis["year"] == 2016, file, "does not cite the thesis")
    for page in ("AUTHORS", "docs/README.md"):
        check(THESIS in text(page), page, "does not name the thesis by its identifier")


def issue_forms():
    for form in sorted((ROOT / ".github/ISSUE_TEMPLATE").glob("*.yml")):
        content = yaml.safe_load(form.read_text())
        if form.name == "config.yml":
            continue
        for key in ("name", "description", "body"):
            check(content.get(key), form.name, f"has no {key}")
        ids = [part["id"] for part in content["body"]]
        check(len(ids) == len(set(ids)), form.name, "an id is used twice")
        for part in content["body"]:
            check(part["type"] in ("textarea", "input", "dropdown", "checkboxes", "markdown"), form.name,
                  f"there is no type {part['type']}")
            check("label" in part["attributes"], form.name, f"{part['id']} has no label")


def workflows():
    presets = {one["name"] for one in json.loads(text("CMakePresets.json"))["configurePresets"]}
    for file in sorted((ROOT / ".github/workflows").glob("*.yml")):
        content = yaml.safe_load(file.read_text())
        check(content.get("permissions") == {"contents": "read"}, file.name, "may do more than read")
        for job in content["jobs"].values():
            check("timeout-minutes" in job, file.name, "a job may run for ever")
            for preset in job.get("strategy", {}).get("matrix", {}).get("preset", []):
                check(preset in presets, file.name, f"there is no preset {preset}")
            for step in job["steps"]:
                for script in re.findall(r"\btools/[\w/]+", step.get("run", "")):
                    check((ROOT / script).exists(), file.name, f"there is no {script}")
                for preset in re.findall(r"--preset ([a-z-]+)", step.get("run", "")):
                    check(preset in presets, file.name, f"there is no preset {preset}")


def recipes():
    found = set(re.findall(r"find_package\((\w[\w-]*)", text("CMakeLists.txt") + text("core/io/CMakeLists.txt")))
    recipe = text("tools/packaging/spack/package.py")
    compile(recipe, "package.py", "exec")
    for package in found - {"benchmark", "Python3", "Threads"}:
        check(f'depends_on("{SPACK[package]}' in recipe, "package.py", f"does not depend on {package}")
    for file in ("Containerfile", "tools/packaging/apptainer/dust.def"):
        check(". tools/dev/prepare" in text(file), file, "names packages of its own")
        for option in re.findall(r"-D(DUST_\w+)", text(file)):
            check(f"option({option}" in text("CMakeLists.txt"), file, f"there is no option {option}")


citation()
issue_forms()
workflows()
recipes()
print("\n".join(problems))
sys.exit(1 if problems else 0)
