"""Words of integers that wrapped around."""

from __future__ import annotations

from collections.abc import Iterator

import numpy as np

from pyimu.errors import Finding
from pyimu.recording.quality.scatter import WINDOW

WRAP = 0.8
"""A step above this part of a column's range goes across the edge of a word, where the column is
else smooth."""


SMOOTH = 1 / 16
"""Half of a smooth column's steps are below this part of its range."""


def wraps(values: np.ndarray) -> tuple[np.ndarray, float]:
    """(rows, span): where an integer word wrapped around in ``values`` (n,), and its range.

    The range is in the unit of the values; there are no rows where none wrapped.

    A smooth column jumps from end to end of its range, and less the slope beside it each jump is
    the same: the word's range. The samples span no more than that. Those of a motion that is
    reversed at once, whose jumps look the same, do, by their noise; those of a spike jump back at
    once.
    """
    change = np.diff(values)
    size, rows = np.abs(change), np.zeros(0, int)
    reach = np.nanmax(values) - np.nanmin(values)
    if (
        len(values) < 4 * WINDOW
        or not (size > WRAP * reach).any()
        or not 0 < np.nanmedian(size) < SMOOTH * reach
    ):
        return rows, 0.0
    jumps = np.flatnonzero(size[1:-1] > WRAP * reach) + 1
    jumps = jumps[np.maximum(size[jumps - 1], size[jumps + 1]) < (1 - WRAP) * reach]
    spans = np.abs(change[jumps] - (change[jumps - 1] + change[jumps + 1]) / 2)
    noise = np.nanmedian(np.abs(np.diff(change)))
    span = float(np.median(spans)) if len(spans) > 1 else 0.0
    if reach > span + 2 * noise or np.median(np.abs(spans - span)) > 2 * noise:
        return rows, 0.0
    return np.flatnonzero(size > WRAP * reach) + 1, span


def wrap_findings(name: str, values: np.ndarray) -> Iterator[Finding]:
    rows, span = wraps(values)
    if len(rows):
        yield Finding("wrapped", name, len(rows), {"span": span, "first_row": int(rows[0])})
