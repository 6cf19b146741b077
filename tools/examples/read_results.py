#!/usr/bin/env python3
"""Draws a run or a study (Debian: python3-h5py, python3-matplotlib).

usage: read_results.py FOLDER [PICTURE.png]

Of a run the grains of the last frame are drawn, coloured by speed; of a study every output against
every input. More: docs/how_to/read_results_in_python.md.
"""

import pathlib
import sys

sys.path.insert(0, str(pathlib.Path(__file__).resolve().parents[1] / "python"))
import dust_results  # noqa: E402


def main():
    if len(sys.argv) not in (2, 3):
        sys.exit(__doc__)
    folder = pathlib.Path(sys.argv[1])
    picture = sys.argv[2] if len(sys.argv) == 3 else str(folder / "picture.png")
    try:
        if (folder / "study.h5").exists():
            results = dust_results.Study(folder)
            figure = dust_results.draw_study(results)
        else:
            results = dust_results.Run(folder)
            figure = dust_results.draw_grains(results)
    except dust_results.ResultsError as problem:
        sys.exit(f"error: {problem}")
    figure.savefig(picture)
    print(f"{results}; drawn in {picture}")


main()
