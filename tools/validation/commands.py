"""Commands as the reader of a page types them."""

import functools
import pathlib
import re
import shlex

import yaml

ROOT = pathlib.Path(__file__).resolve().parents[2]


@functools.cache
def read_file(file):
    # The loader in C, ten times as fast, where PyYAML has it.
    return yaml.load(file.read_text(), getattr(yaml, "CSafeLoader", yaml.SafeLoader))


def value_in(file, path):
    """What a scenario says at `bodies.belt.speed` or `interactions[0].contact.friction`, itself or by what it includes; None where it
    does not say."""
    found = text = read_file(file)
    for step in re.findall(r"[^.\[\]]+", path):
        is_there = int(step) < len(found) if isinstance(found, list) and step.isdigit() else isinstance(found, dict) and step in found
        if not is_there:
            break
        found = found[int(step) if isinstance(found, list) else step]
    else:
        return found
    if not isinstance(found, dict):
        return None  # a list, or a value like `fluid: none`, replaces the included one
    includes = text.get("include", [])
    for other in reversed([includes] if isinstance(includes, str) else includes):
        below = value_in(file.parent / other, path)
        if below is not None:
            return below
    return None


def says_nothing_new(file, path, value):
    """Whether a scenario says so already: only of numbers, texts and lists of them."""
    said = value_in(file, path)
    try:
        given = yaml.safe_load(value)
    except yaml.YAMLError:
        return False
    return said is not None and not isinstance(said, dict) and type(said) is type(given) and said == given


def within_another(path, paths):
    return any(other != path and (path.startswith(f"{other}.") or path.startswith(f"{other}[") or other.startswith(f"{path}.")
                                  or other.startswith(f"{path}[")) for other in paths)


@functools.cache
def same_of(command):
    """What two commands have in common that run the same, in whatever order their settings stand, and whether or not they say what the
    scenario says already."""
    words = shlex.split(command)
    settings = [words[n + 1] for n in range(len(words) - 1) if words[n] == "--set"]
    files = [ROOT / word for word in words if word.endswith(".yaml") and (ROOT / word).is_file()]
    paths = [setting.partition("=")[0] for setting in settings]
    empty = {setting for setting, path in zip(settings, paths)
             if files and not within_another(path, paths) and says_nothing_new(files[0], path, setting.partition("=")[2])}
    return frozenset(words) - empty - {"--set"}
