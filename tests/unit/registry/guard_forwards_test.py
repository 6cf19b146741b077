#!/usr/bin/env python3
"""Every virtual function of the plugin interfaces is passed on by core/registry/guard.cpp.

A guard that lacks one answers with the interface's default, and a model of others silently loses
its own answer. Reads the headers of the SDK and the guard as text; says what is missing, a line
each, and ends with status 1.

usage: guard_forwards_test.py SOURCE_FOLDER"""

import pathlib
import re
import sys


def code_of(path):
    """The text without comments."""
    text = re.sub(r"/\*.*?\*/", "", path.read_text(), flags=re.DOTALL)
    return re.sub(r"//[^\n]*", "", text)


def body_at(text, opening):
    """What stands between the brace at `opening` and its partner."""
    depth = 0
    for at in range(opening, len(text)):
        depth += {"{": 1, "}": -1}.get(text[at], 0)
        if depth == 0:
            return text[opening + 1:at]
    raise ValueError("a brace is not closed")


def classes_of(text):
    """Name, what is derived from, body; of structs, too."""
    head = re.compile(r"\b(?:class|struct)\s+(\w+)\s*(?:final\s*)?(?::\s*(?:public\s+)?([\w:<>]+)\s*)?\{")
    return [(m[1], m[2] or "", body_at(text, m.end() - 1)) for m in head.finditer(text)]


def virtuals_of(body):
    """Names of the functions declared virtual, without the destructor."""
    return set(re.findall(r"\bvirtual\b[^;{(]*?\b(\w+)\s*\((?!\s*\*)", body)) - {
        name for name in re.findall(r"\bvirtual\s+~(\w+)", body)}


def interfaces(sdk):
    """Kind's class: its virtual functions, those of Model among them."""
    found, base = {}, set()
    for header in sorted(sdk.glob("*.hpp")):
        for name, parent, body in classes_of(code_of(header)):
            if name == "Model":
                base = virtuals_of(body)
            elif "k_kind" in body and parent == "Model":
                found[name] = virtuals_of(body)
    if not base:
        raise ValueError("no class Model in the SDK's headers")
    return {name: own | base for name, own in found.items()}


def passed_on(body):
    """Functions overridden in a guard's class that ask the model for the same function."""
    done = set()
    for m in re.finditer(r"\b(\w+)\s*\([^;{}]*\)\s*(?:const\s*)?override\s*\{", body):
        inside = body_at(body, m.end() - 1)
        if re.search(rf"&[\w:]+::{m[1]}\b|model_->{m[1]}\(|model\(\)\.{m[1]}\(", inside):
            done.add(m[1])
    return done


def missing(root):
    kinds = interfaces(root / "core/sdk/include/dust/sdk")
    text = code_of(root / "core/registry/guard.cpp")
    guards = {name: (parent, body) for name, parent, body in classes_of(text)}
    makers = dict(re.findall(r"\{sdk::(\w+)::k_kind,\s*make<(\w+)>\}", text))
    if len(kinds) < 11:
        yield f"only {len(kinds)} interfaces found in the SDK: {', '.join(kinds)}"
    for kind, functions in kinds.items():
        if kind not in makers:
            yield f"sdk::{kind}: no guard is made for this kind"
            continue
        done, at = set(), makers[kind]
        while at in guards:  # a guard and the templates it derives from
            parent, body = guards[at]
            done |= passed_on(body)
            at = re.sub(r"<.*", "", parent)
        for name in sorted(functions - done):
            yield f"sdk::{kind}::{name}: not passed on by {makers[kind]} in core/registry/guard.cpp"


found = list(missing(pathlib.Path(sys.argv[1])))
print("\n".join(found))
sys.exit(1 if found else 0)
