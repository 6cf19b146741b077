"""Lists of what a gate allows because it was there before the gate. They only shrink: an entry that is
no longer found has to be taken out, a finding that is not listed fails."""

import sys


def read(path):
    lines = path.read_text().split("\n") if path.exists() else []
    return {line.strip() for line in lines if line.strip() and not line.startswith("#")}


def differences(found, allowed, where, advice):
    """found: entry -> where it was found first. One line of text per difference."""
    for entry in sorted(set(found) - allowed):
        yield f"{found[entry]}: {entry}: {advice}"
    for entry in sorted(allowed - set(found)):
        yield f"{where}: {entry} is allowed and no longer there; take it out"


def run(found, path, advice, arguments):
    """The end of a gate's main(): prints the differences, or with --shrink takes out what is gone."""
    allowed = read(path)
    if "--shrink" in arguments:
        head = [line for line in path.read_text().split("\n") if line.startswith("#")]
        path.write_text("\n".join(head + sorted(allowed & set(found))) + "\n")
        allowed &= set(found)
    problems = list(differences(found, allowed, path.name, advice))
    for problem in problems:
        print(problem)
    return 1 if problems else 0


def root_of(arguments):
    import pathlib
    return pathlib.Path(next(a for a in arguments if not a.startswith("--"))).resolve()


if __name__ == "__main__":
    sys.exit("a module of the gates, not a gate")
