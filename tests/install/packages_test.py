#!/usr/bin/env python3
"""`cpack -G DEB`: the packages unpacked into a root of their own run, and write plugins; `dust`
alone says what is missing."""

import pathlib
import shutil
import subprocess
import sys
import tempfile

from prefix import arguments, check

options = arguments()
if not all(map(shutil.which, ("dpkg-deb", "dpkg-shlibdeps"))):
    print("skipped: dpkg-deb and dpkg-shlibdeps (package dpkg-dev) are needed")
    sys.exit(77)
folder = pathlib.Path(tempfile.mkdtemp(prefix="dust-deb-"))


def run(*command, status=0):
    done = subprocess.run([str(c) for c in command], cwd=folder, text=True, stdout=subprocess.PIPE,
                          stderr=subprocess.STDOUT, env={"PATH": "/usr/bin:/bin"})
    if done.returncode != status:
        sys.exit(f"{' '.join(map(str, command))}\nexit status {done.returncode}:\n{done.stdout}")
    return done.stdout


try:
    run(pathlib.Path(options.cmake).parent / "cpack", "-G", "DEB", "--config",
        pathlib.Path(options.build) / "CPackConfig.cmake", "-B", folder / "out")
    packages = {p.name.split("_")[0]: p for p in (folder / "out").glob("*.deb")}
    check(sorted(packages) == ["dust", "dust-dev"], f"packages {sorted(packages)}")
    depends = run("dpkg-deb", "-f", packages["dust"], "Depends")
    for library in ("libc6", "libtbb12", "libyaml-cpp", "libhdf5"):
        check(library in depends, f"{library} is not among: {depends}")
    check("dust (= " in run("dpkg-deb", "-f", packages["dust-dev"], "Depends"),
          "dust-dev does not ask for dust")

    run("dpkg-deb", "-x", packages["dust"], folder / "root")
    engine = folder / "root/usr/bin/engine"
    check(str(folder / "root/usr/lib/dust/plugins") in run(engine, "plugins"), "no plugins found")
    run(engine, "check", folder / "root/usr/share/dust/scenarios/transfer_point.yaml")
    check("install the package dust-dev" in run(engine, "new-plugin", "drag", "own", status=2),
          "without dust-dev the remedy is not told")
    for file in ("man/man1/engine.1", "bash-completion/completions/engine"):
        check((folder / "root/usr/share" / file).stat().st_size > 0, f"no {file}")
    run("dpkg-deb", "-x", packages["dust-dev"], folder / "root")
    run(engine, "new-plugin", "drag", "own")
    package = folder / "root/usr/lib/python3/dist-packages/dust_results"
    check(sorted(p.name for p in package.glob("*")) == sorted(
        p.name for p in pathlib.Path(options.source, "tools/python/dust_results").glob("*.py")),
        "the Python package is not whole")
    check((folder / "root/usr/lib/cmake/dust/dust-config.cmake").exists(), "no CMake package")
    check((folder / "root/usr/include/dust/sdk/plugin.hpp").exists(), "no headers")
finally:
    shutil.rmtree(folder, ignore_errors=True)
