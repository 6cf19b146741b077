"""Imported first by tests that read HDF5: without h5py the test goes on under Debian's own Python, which
`tools/test` gives h5py and Matplotlib; where that has none either the test is skipped."""

import os
import sys

DEBIAN_PYTHON = "/usr/bin/python3"
SKIPPED = 77

try:
    import h5py  # noqa: F401
except ImportError:
    if os.path.exists(DEBIAN_PYTHON) and os.environ.get("DUST_TEST_PYTHON") != DEBIAN_PYTHON:
        os.environ["DUST_TEST_PYTHON"] = DEBIAN_PYTHON
        os.execv(DEBIAN_PYTHON, [DEBIAN_PYTHON, *sys.argv])
    print("skipped: h5py (package python3-h5py) is needed")
    sys.exit(SKIPPED)
