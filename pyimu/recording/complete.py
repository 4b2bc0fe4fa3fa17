"""A log whose lost rows are there again, empty."""

from __future__ import annotations

from dataclasses import replace

import numpy as np

from pyimu.recording.recording import Recording

MOST = 3
"""Rows lost in a row that are put in: a longer gap hides motion that the rows beside it do not
show."""


def completed(recording: Recording) -> Recording:
    """The recording with an empty row for each that was lost, as far as ``MOST`` at once were.

    Its groups are NaN there, its time is that between the neighbours; longer gaps stay.
    """
    after = np.array([a for a, _ in recording.segments[1:]], dtype=int)
    steps = recording.time[after] - recording.time[after - 1]
    lost = np.rint(steps / recording.sample_period).astype(int) - 1
    small = (lost >= 1) & (lost <= MOST)
    if not small.any():
        return recording
    at, count = after[small], lost[small]
    rows = np.repeat(at, count)
    part = np.concatenate([np.arange(1, k + 1) / (k + 1) for k in count])
    between = recording.time[rows - 1] + part * np.repeat(steps[small], count)
    groups = {
        name: np.insert(values.astype(float), rows, np.nan, axis=0)
        for name, values in recording.groups.items()
    }
    left = after[~small]
    return replace(
        recording,
        time=np.insert(recording.time, rows, between),
        period=recording.sample_period,
        gaps=left + np.searchsorted(rows, left, side="right"),
        **groups,
    )
