#!/usr/bin/env python3
"""share/dust/plugin_template as it is, and `engine new-plugin`: builds, loads, passes its own
tests, refuses what it should."""

import pathlib

from prefix import Prefix, arguments, check

with Prefix(arguments()) as prefix:
    template = prefix.path / "share/dust/plugin_template"
    kinds = sorted(p.name for p in template.iterdir() if p.is_dir())
    check(kinds == ["boundary", "cohesion", "contact", "drag", "emitter", "fluid_force",
                    "liberation", "motion", "rolling", "sensor", "turbulence", "voidage"], f"templates for {kinds}")
    for kind in kinds:
        page = pathlib.Path(prefix.options.source) / f"docs/how_to/write_a_{kind}.md"
        check(f"engine new-plugin {kind} my_{kind}" in page.read_text(), f"{page} does not begin")
    build = prefix.folder / "build"
    log = prefix.build(template, build)
    check("warning" not in log, f"a template gives warnings:\n{log}")
    print(prefix.run(pathlib.Path(prefix.options.cmake).parent / "ctest", "--test-dir", build,
                     "--output-on-failure"))
    listed = prefix.run(prefix.engine, "plugins", "--plugin-path", build)
    for kind in kinds:
        check(f"my_{kind}.so" in listed, f"my_{kind} is not found")

    made = prefix.folder / "made"
    made.mkdir()
    for kind in kinds:
        prefix.run(prefix.engine, "new-plugin", kind, f"own_{kind}", cwd=made)
        for file in (made / f"own_{kind}").rglob("*"):
            text = file.read_text()
            check("my_" not in text and "My" not in text, f"{file} still holds the template's name")
            check("my_" not in file.name, f"{file} still has the template's name")
    for command, message in (
            (("drga", "a"), "there is no kind 'drga'; did you mean 'drag'?"),
            (("drag", "BadName"), "'BadName' is not snake_case"),
            (("drag", "wen_yu"), "there is a drag/wen_yu already"),
            (("contact", "class"), "the name 'class' is a keyword of C++, so the plugin would not build"),
            (("drag", "main"), "the name 'main' is a name of the sources"),
            (("drag", "pow"), "the name 'pow' is a function or type of the C library"),
            (("sensor", "test"), "the name 'test' is a target that CMake makes itself"),
            (("drag", "own_drag"), "exists already")):
        said = prefix.run(prefix.engine, "new-plugin", *command, cwd=made, status=2)
        check(message in said and said.count("\n") == 1, said)
    # A library that is no plugin, one that is broken, a value that is none.
    for command, status, message in (
            ((made / "nothing.so",), 2, "no such file"),
            ((prefix.engine,), 2, "error: "),
            ((build / "my_drag.so", "--set", "exponent=x"), 2, "exponent"),
            ((build / "my_drag.so", "--set", "exponnt=1"), 2, "did you mean 'exponent'?"),
            ((build / "my_drag.so", "--set", "exponent=3"), 0, "all rules are kept"),
            ((build / "my_drag.so", "--json"), 0, '"verdict": "pass"')):
        said = prefix.run(prefix.engine, "test-plugin", *command, status=status)
        check(message in said, said)
