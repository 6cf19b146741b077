# SPDX-License-Identifier: Apache-2.0
"""Results of `dust` in Python: a run as tables, grains, fields and series; a study as a table.

    import dust_results
    run = dust_results.Run("results/transfer_point")
    dust_results.draw_grains(run).savefig("grains.png")

Needs h5py and numpy; pictures need Matplotlib.
"""

from .fields import Field, Fields, Walls
from .pictures import draw_air, draw_grains, draw_series, draw_study
from .run import Run
from .study import Study
from .table import ResultsError, Table

__version__ = "0.1.0"
__all__ = ["Field", "Fields", "ResultsError", "Run", "Study", "Table", "Walls", "draw_air",
           "draw_grains", "draw_series", "draw_study"]
