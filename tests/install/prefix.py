"""An installed prefix in a fresh folder, moved after installing, and what the tests do with it."""

import argparse
import os
import pathlib
import shutil
import subprocess
import sys
import tempfile


def arguments():
    parser = argparse.ArgumentParser()
    for name in ("build", "source", "cmake", "compiler"):
        parser.add_argument(f"--{name}", required=True)
    return parser.parse_args()


class Prefix:
    """`cmake --install` into one folder, renamed to another: nothing in it may be absolute."""

    def __init__(self, options):
        self.options = options
        self.folder = pathlib.Path(tempfile.mkdtemp(prefix="dust-install-"))
        first = self.folder / "first"
        self.path = self.folder / "moved" / "prefix"
        self.run(options.cmake, "--install", options.build, "--prefix", first)
        self.path.parent.mkdir()
        first.rename(self.path)
        self.engine = self.path / "bin" / "engine"

    def __enter__(self):
        return self

    def __exit__(self, *_):
        shutil.rmtree(self.folder, ignore_errors=True)

    def run(self, *command, cwd=None, status=0):
        """Runs a command without the environment's plugins; its output, or the end of the test."""
        environment = {k: v for k, v in os.environ.items() if k != "DUST_PLUGIN_PATH"}
        done = subprocess.run([str(c) for c in command], cwd=cwd or self.folder, env=environment,
                              text=True, stdout=subprocess.PIPE, stderr=subprocess.STDOUT)
        if done.returncode != status:
            sys.exit(f"{' '.join(map(str, command))}\nexit status {done.returncode}:\n{done.stdout}")
        return done.stdout

    def build(self, source, build):
        """Configures and builds a project that has nothing but the prefix."""
        self.run(self.options.cmake, "-S", source, "-B", build, "-G", "Ninja",
                 f"-DCMAKE_PREFIX_PATH={self.path}",
                 f"-DCMAKE_CXX_COMPILER={self.options.compiler}")
        return self.run(self.options.cmake, "--build", build)


def check(is_right, what):
    if not is_right:
        sys.exit(f"failed: {what}")
