#!/usr/bin/env python3
"""types_gate.py ROOT [--shrink]: types of core, plugins and tools.

A type with behaviour (a member function that may change it) has no public data and up to 15 data
members. Exempt: plain aggregates, whose functions only look or are operators; from the first rule types
of a source, which nobody else sees. A class has its functions in at most two sources. Its Impl is used
where its functions are and nowhere else. Reads the sources as clang-format
leaves them. Others from before stand in types_allowed.txt by rule and type, which only shrinks."""

import pathlib
import re
import sys

sys.path.insert(0, str(pathlib.Path(__file__).parent))
import allow_list
import cpp_text
import functions_gate

FOLDERS = ("core", "plugins", "tools")
LIMIT = 15
SOURCES = 2
IMPL = re.compile(r"\b([A-Z]\w*)::Impl\b")
TYPE = re.compile(r"(?:template\s*<.*?>\s*)?(?:typedef )?(class|struct|union)\s+"
                  r"(?:alignas\([^)]*\)\s*)?([\w:]+)[^()]*\{$")
SKIPPED = ("using ", "friend ", "typedef ", "static ", "enum ", "public:", "private:", "protected:",
           "template", "class ", "struct ", "union ", "static_assert", "DUST_")


def bare(statement):
    """Without template arguments, attributes, initialisers and array bounds."""
    statement = re.sub(r"\[\[.*?\]\]|__attribute__\(\(.*?\)\)", "", statement).strip()
    statement = re.sub(r"^(inline|constexpr) static\b", "static", statement)
    before = None
    while before != statement:
        before = statement
        statement = re.sub(r"<[^<>]*>", "", statement)
    return re.sub(r"\[[^\]]*\]", "", statement)


def data_members(statement):
    """Names of the data members that a statement of a type's body declares; [] if it declares others."""
    statement = bare(statement).strip().rstrip(";").strip()
    if not statement or statement.startswith(SKIPPED) or "operator" in statement:
        return []
    statement = re.sub(r"\(\*(\w+)\)\(.*?\)", r" \1", statement)
    declared = re.split(r"[={]", statement)[0]
    if "(" in declared:
        return []
    flat = re.sub(r"\{[^{}]*\}", "", statement)
    flat = re.sub(r"\([^()]*\)", "", flat)
    parts = [re.split(r"[={]", part)[0].strip() for part in flat.split(",")]
    if len(parts[0].split()) < 2:
        return []
    return [part.split()[-1].lstrip("*&") for part in parts if part]


def changes_its_object(statement, type_name):
    """Whether it declares a member function that may change an object."""
    declared = bare(statement).strip()
    if "(" not in declared or declared.startswith(("using ", "friend ", "typedef ", "static ", "enum ",
                                                   "static_assert", "DUST_")):
        return False
    declared = re.split(r"\)\s*:\s*\w", declared)[0] + (")" if re.search(r"\)\s*:\s*\w", declared) else "")
    if re.search(r"=\s*(default|delete)", declared):
        return False
    if re.match(r"[^(]*=", declared):
        return False
    if "operator" in declared or "(*" in declared:
        return False
    name = re.search(r"([~\w]+)\s*\(", declared)
    simple = type_name.split("::")[-1]
    if not name or name[1].lstrip("~") == simple or "explicit" in declared.split("(")[0]:
        return False
    return not re.search(r"\)\s*(const|noexcept const)\b", declared)


def types_of(text):
    """(qualified name, first line, public data members, all data members, has behaviour)."""
    lines = cpp_text.code_only(text).split("\n")
    open_types = []  # [name, indent, access, public, all, behaviour, line]
    n = 0
    while n < len(lines):
        line = lines[n].rstrip()
        stripped = line.strip()
        indent = len(line) - len(line.lstrip())
        if not stripped or stripped.startswith("#"):
            n += 1
            continue
        if open_types and indent == open_types[-1]["indent"] and stripped.startswith("}"):
            done = open_types.pop()
            yield done
            n += 1
            continue
        access = re.match(r"(public|private|protected):", stripped)
        if access and open_types:
            open_types[-1]["access"] = access[1]
            n += 1
            continue
        first = n
        words = []
        while n < len(lines):
            words.append(lines[n].strip())
            n += 1
            if re.search(r"[;{}]\s*$", words[-1]):
                break
        statement = " ".join(word for word in words if word)
        match = TYPE.match(statement)
        if match:
            names = [t["name"] for t in open_types] + [match[2]]
            open_types.append({"name": "::".join(names), "indent": indent, "line": first + 1,
                               "access": "private" if match[1] == "class" else "public",
                               "public": [], "all": [], "behaviour": False})
            continue
        if statement.endswith("{") and not re.match(r"(inline )?(namespace|extern)\b", statement):
            is_data = bool(data_members(statement)) and "(" not in bare(statement)
            n = cpp_text.end_of_block(lines, n, statement) + 1
            if not is_data and open_types:
                open_types[-1]["behaviour"] |= changes_its_object(statement, open_types[-1]["name"])
                continue
        if not open_types or indent != open_types[-1]["indent"] + 2:
            continue
        here = open_types[-1]
        members = data_members(statement)
        here["all"] += members
        if here["access"] == "public":
            here["public"] += members
        if not members:
            here["behaviour"] |= changes_its_object(statement, here["name"])


def class_of(function):
    """`Dem::Impl` of `Dem::Impl::step`; nothing for a function of a namespace."""
    parts = function.split("::")[:-1]
    return "::".join(parts) if parts and all(part[:1].isupper() for part in parts) else None


def spread(root):
    """Classes over too many sources, and Impls used where no function of their class stands."""
    sources = {}
    uses = {}
    for path in cpp_text.sources(root, FOLDERS):
        name = path.relative_to(root).as_posix()
        text = path.read_text(errors="replace")
        here = {class_of(function) for function, *_ in functions_gate.functions(text)} - {None}
        if path.suffix == ".cpp":
            for one in here:
                sources.setdefault(one, []).append(name)
        code = cpp_text.code_only(text)
        own = {one.split("::")[0] for one in here}
        own |= set(re.findall(r"\b(?:struct|class) ([A-Z]\w*)(?:::Impl)? (?:final )?[{:]", code))
        for one in set(IMPL.findall(code)) - own:
            uses.setdefault(one, name)
    found = {f"sources {one}": f"{names[0]}: {len(names)} sources" for one, names in sources.items()
             if len(names) > SOURCES}
    found.update((f"impl {one}", name) for one, name in uses.items())
    return found


def findings(root):
    found = spread(root)
    for path in cpp_text.sources(root, FOLDERS):
        name = path.relative_to(root).as_posix()
        for one in types_of(path.read_text(errors="replace")):
            if not one["behaviour"]:
                continue
            where = f"{name}:{one['line']}"
            if one["public"] and path.suffix != ".cpp":
                found[f"public_data {one['name']}"] = where
            if len(one["all"]) > LIMIT:
                found[f"members {one['name']}"] = f"{where}: {len(one['all'])}"
    return found


def main():
    here = pathlib.Path(__file__).parent
    return allow_list.run(findings(allow_list.root_of(sys.argv[1:])), here / "types_allowed.txt",
                          f"a type with behaviour has no public data, up to {LIMIT} data members, "
                          f"at most {SOURCES} sources and an Impl of its own",
                          sys.argv[1:])


if __name__ == "__main__":
    sys.exit(main())
