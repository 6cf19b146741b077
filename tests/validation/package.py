"""Finds tools/validation for the tests beside this file; without python3-yaml they are skipped."""

import pathlib
import sys

ROOT = pathlib.Path(__file__).resolve().parents[2]
sys.path.insert(0, str(ROOT / "tools/validation"))
try:
    import yaml  # noqa: F401
except ImportError:
    print("skipped: needs python3-yaml")
    sys.exit(77)
