"""What runs have in common that differ by chance alone."""

import math


def mean_of(values):
    """(mean, standard error by the scatter) of the runs that are there; None of fewer than three."""
    values = [value for value in values if value is not None]
    if len(values) < 3:
        return None
    mean = sum(values) / len(values)
    return mean, math.sqrt(sum((v - mean) ** 2 for v in values) / (len(values) * (len(values) - 1)))
