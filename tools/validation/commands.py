"""Commands as the reader of a page types them."""

import shlex


def same_of(command):
    """What two commands have in common that run the same, in whatever order their settings stand."""
    return frozenset(shlex.split(command))
