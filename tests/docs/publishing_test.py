#!/usr/bin/env python3
"""publishing_test.py ROOT VERSION: what the hosting, packagers and containers read fits the sources:
versions, presets, package names, scripts. Exit status 1, one line per problem; 77 without PyYAML."""

import json
import pathlib
import re
import subprocess
import sys
import tempfile

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


def contexts(text):
    """Names that ${{ ... }} asks for."""
    return re.findall(r"\$\{\{\s*([\w.]+)\s*\}\}", text)


def step_problems(step, matrix):
    """What a runner would refuse in a step, or would do otherwise than meant."""
    if ("run" in step) == ("uses" in step):
        yield "a step neither or both runs and uses something"
    if unknown := set(step) - {"name", "id", "if", "uses", "with", "run", "shell", "env", "working-directory"}:
        yield f"a step has no {', '.join(sorted(unknown))}"
    if "uses" in step and not re.fullmatch(r"[\w-]+/[\w/-]+@v\d+", step["uses"]):
        yield f"{step['uses']} is no action of a version"
    for name in contexts(json.dumps(step)):
        if not (name.startswith("matrix.") and name.removeprefix("matrix.") in matrix):
            yield f"nothing gives {name}"


def job_problems(job):
    matrix = job.get("strategy", {}).get("matrix", {})
    names = set(matrix) - {"include"} | {key for one in matrix.get("include", []) for key in one}
    if job.get("runs-on") != "ubuntu-latest":
        yield "a job has no machine to run on"
    if not 0 < job.get("timeout-minutes", 0) <= 360:
        yield "a job may run for ever, or longer than a machine is lent"
    for name in contexts(f"{job.get('name', '')} {job.get('container', '')}"):
        if name.removeprefix("matrix.") not in names:
            yield f"nothing gives {name}"
    checked_out = False
    for step in job["steps"]:
        yield from step_problems(step, names)
        checked_out = checked_out or step.get("uses", "").startswith("actions/checkout@")
        if "tools/" in step.get("run", "") and not checked_out:
            yield "a step needs the sources before they are checked out"


def workflow_problems(content, presets):
    # YAML 1.1 reads the key `on` as true.
    events = content.get("on", content.get(True))
    names = {events} if isinstance(events, str) else set(events or ())
    if not names or names - {"push", "pull_request", "schedule", "workflow_dispatch"}:
        yield "it begins at nothing that happens"
    for one in events.get("schedule", []) if isinstance(events, dict) else []:
        if not re.fullmatch(r"\d{1,2} \d{1,2} (\S+) (\S+) (\S+)", one["cron"]):
            yield f"{one['cron']} is no time"
    if content.get("permissions") != {"contents": "read"}:
        yield "it may do more than read"
    for job in content["jobs"].values():
        yield from job_problems(job)
        for preset in job.get("strategy", {}).get("matrix", {}).get("preset", []):
            if preset not in presets:
                yield f"there is no preset {preset}"
        for step in job["steps"]:
            for script in re.findall(r"\btools/[\w/]+", step.get("run", "")):
                if not (ROOT / script).exists():
                    yield f"there is no {script}"
            for preset in re.findall(r"--preset ([a-z-]+)", step.get("run", "")):
                if preset not in presets:
                    yield f"there is no preset {preset}"


def workflows():
    presets = {one["name"] for one in json.loads(text("CMakePresets.json"))["configurePresets"]}
    files = sorted((ROOT / ".github/workflows").glob("*.yml"))
    for file in files:
        problems.extend(f"{file.name}: {told}" for told in workflow_problems(yaml.safe_load(file.read_text()), presets))
    planted_faults(files, presets)


def planted_faults(files, presets):
    """The checks find what they are for: each fault planted in a workflow is told."""
    for old, new, told in (("timeout-minutes: 60", "", "run for ever"), ("@v4", "", "no action of a version"),
                           ("contents: read", "contents: write", "more than read"), ("runs-on", "run-on", "no machine"),
                           ("tools/dev/prepare", "tools/dev/prepared", "there is no tools"),
                           ("--preset release", "--preset relase", "no preset relase"),
                           ("      - run: apt", "      - rum: apt", "neither or both")):
        source = next(f for f in files if f.name == "docs.yml").read_text()
        check(old in source, "docs.yml", f"holds no {old} to try the checks on")
        found = list(workflow_problems(yaml.safe_load(source.replace(old, new)), presets))
        check(any(told in one for one in found), "publishing_test.py", f"does not find {new or 'missing ' + old}: {found}")


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


def release_problems(root, tag):
    done = subprocess.run([ROOT / "tools/packaging/check_release", tag, "--root", root], capture_output=True, text=True)
    return done.stdout.splitlines() if done.returncode == 1 else []


def release():
    """A checkout that is ready may be tagged, and each thing that is forgotten is told."""
    ready = {"CMakeLists.txt": "project(dust VERSION 1.2.3 LANGUAGES CXX)\n", "CITATION.cff": "version: 1.2.3\n",
             "CHANGELOG.md": "# Changelog\n\n## 1.2.3 (2027-02-03)\n\n## 1.2.2 (2027-01-01)\n"}
    with tempfile.TemporaryDirectory() as folder:
        root = pathlib.Path(folder)
        for tag, file, old, new in (("v1.2.3", "CHANGELOG.md", "", ""), ("1.2.3", "CMakeLists.txt", "", ""),
                                    ("v1.2.3", "CMakeLists.txt", "1.2.3", "1.2.4"), ("v1.2.3", "CITATION.cff", "1.2.3", "1.2.2"),
                                    ("v1.2.3", "CHANGELOG.md", "(2027-02-03)", "(unreleased)"),
                                    ("v1.2.3", "CHANGELOG.md", "## 1.2.3 (2027-02-03)\n", "")):
            for name, content in ready.items():
                (root / name).write_text(content.replace(old, new) if old and name == file else content)
            found, is_ready = release_problems(root, tag), tag == "v1.2.3" and not old
            check(not found if is_ready else any(one.startswith(file) for one in found), "check_release",
                  f"{tag} with {new or 'no'} for {old} in {file}: {found}")
    # Of this checkout nothing but the day is open.
    for one in release_problems(ROOT, f"v{VERSION}"):
        check(one.startswith("CHANGELOG.md") and "(unreleased)" in one, "check_release", one)


citation()
issue_forms()
workflows()
recipes()
release()
print("\n".join(problems))
sys.exit(1 if problems else 0)
